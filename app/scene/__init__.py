"""What a browser client sees in 3D, on viser's scene."""
