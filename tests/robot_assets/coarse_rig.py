"""Rig of two coarse sensors on a Panda, as a rig file."""

COARSE_RIG = """
name = "two eyes"

[sensor_model]
name = "coarse"
rows = 4
columns = 4
field_of_view_deg = 60.0
min_range_m = 0.02
max_range_m = 4.0
distance = "perpendicular"
reading_order = "row_major"
flip_vertical = false
flip_horizontal = false

[[sensors]]
name = "left"
link = "panda_link0"
position_m = [-0.2, 0.1, 0.45]
forward = [0.2, 1.0, 0.0]
up = [0.0, 0.0, 1.0]

[[sensors]]
name = "right"
link = "panda_hand"
position_m = [0.2, 0.1, 0.0]
forward = [0.0, 0.0, 1.0]
up = [0.0, 1.0, 0.0]
"""
