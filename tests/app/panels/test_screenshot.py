import io

import numpy as np
from PIL import Image

from app.panels.screenshot import file_name, on_white


def test_a_transparent_background_becomes_white():
    pixels = np.zeros((4, 6, 4), dtype=np.uint8)
    pixels[:, :3] = [200, 30, 40, 255]
    picture = np.asarray(Image.open(io.BytesIO(on_white(pixels))))
    assert picture.shape == (4, 6, 3)
    assert (picture[:, :3] == [200, 30, 40]).all()
    assert (picture[:, 3:] == 255).all()


def test_names_hold_nothing_that_a_file_system_refuses():
    assert file_name("x/y: z 1", 7) == "x_y_z_1_frame_0007.png"
