from app.panels.screenshot import file_name


def test_names_hold_nothing_that_a_file_system_refuses():
    assert file_name("x/y: z 1", 7) == "x_y_z_1_frame_0007.png"


def test_names_say_which_views_they_show():
    assert file_name("a", 7, ("3D", "Top")) == "a_frame_0007_3d_top.png"
