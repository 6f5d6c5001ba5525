"""What stands in every scene: light, grid and axes."""

import viser

from app.scene.first_view import up_of

GRID = "/grid"
AXES = "/axes"


def light(scene: viser.SceneApi) -> None:
    """Even light from the sky and two lamps, cheaper than an environment map and its shadows."""
    scene.configure_environment_map(None)
    scene.configure_default_lights(enabled=False)
    scene.add_light_hemisphere(
        "/lights/sky", sky_color=(255, 255, 255), ground_color=(190, 195, 205), intensity=1.6
    )
    scene.add_light_directional(
        "/lights/key", intensity=1.5, position=(2.0, -3.0, 4.0), color=(255, 250, 243)
    )
    scene.add_light_directional(
        "/lights/fill", intensity=0.6, position=(-3.0, 2.0, 2.5), color=(235, 242, 255)
    )


class Stage:
    """The grid through the fixed frame's origin and its axes."""

    def __init__(self, scene: viser.SceneApi, fixed_frame: str) -> None:
        up = up_of(fixed_frame)
        scene.set_up_direction((float(up[0]), float(up[1]), float(up[2])))
        self._grid = scene.add_grid(
            GRID,
            width=8.0,
            height=8.0,
            plane="xy" if up[2] else "xz",
            cell_size=0.25,
            cell_color=(228, 231, 236),
            section_size=1.0,
            section_color=(200, 205, 214),
            shadow_opacity=0.0,
            fade_distance=9.0,
        )
        self._axes = scene.add_frame(AXES, axes_length=0.2, axes_radius=0.004, origin_radius=0.0)

    def remove(self) -> None:
        """Take grid and axes out of the scene."""
        self._grid.remove()
        self._axes.remove()
