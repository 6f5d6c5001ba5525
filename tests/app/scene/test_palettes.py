"""Colours that mean different things look different."""

import numpy as np
import pytest

from app.scene.palettes import PALETTES, palette


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("name", PALETTES)
def test_a_ramp_contains_no_other_layers_colour(name: str, dark: bool):
    colours = palette(name, dark)
    ramp = colours.along_ramp(np.linspace(0, 1, 50)).astype(float)
    for layer in ("source", "target", "truth", "true_object", "picked"):
        apart = np.linalg.norm(ramp - np.array(getattr(colours, layer)), axis=1).min()
        assert apart > 45, f"{layer} is in the ramp"
