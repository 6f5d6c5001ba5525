"""3D drawing of a recording on viser's scene: robot, sensors, clouds, flow, camera."""
