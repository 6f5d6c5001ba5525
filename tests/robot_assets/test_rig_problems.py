"""One sentence for each wrong key of a rig file."""

import pytest

from robot_assets import RigError
from tests.robot_assets.rig_files import HEAD, RING, SINGLE, rig_of

WRONG = [
    (
        'name = "Panda with three',
        'named = "',
        "my_rig.toml: name is missing; named is not a known key; known are name, sensor_model, ",
    ),
    ("rows = 8", "rows = 1", "sensor_model.rows must be a whole number from 2 to 64, got 1."),
    ("rows = 8", "rows = 8.0", "sensor_model.rows must be a whole number"),
    ("rows = 8", "rows = true", "sensor_model.rows must be a whole number"),
    ("columns = 8", "", "sensor_model.columns is missing."),
    (
        "columns = 8",
        "colums = 8",
        "sensor_model.columns is missing; sensor_model.colums is not a known key; known are name, ",
    ),
    ("columns = 8", "columns = 8\ncolour = 1", "sensor_model.colour is not a known key; known are"),
    (
        "field_of_view_deg = 45.0",
        "field_of_view_deg = 180",
        "field_of_view_deg must be a number from",
    ),
    (
        "field_of_view_deg = 45.0",
        "field_of_view_deg = [45, 45, 45]",
        "field_of_view_deg must be a number from 1 to 170, or two of them, got [45, 45, 45].",
    ),
    (
        "field_of_view_deg = 45.0",
        "field_of_view_deg = [45, 180]",
        "field_of_view_deg must be a number from 1 to 170, or two of them, got [45, 180].",
    ),
    (
        "min_range_m = 0.02",
        'min_range_m = "0.02"',
        "sensor_model.min_range_m must be a number from",
    ),
    ("min_range_m = 0.02", "min_range_m = nan", "sensor_model.min_range_m must be a number from"),
    ("max_range_m = 4.0", "max_range_m = -4.0", "sensor_model.max_range_m must be a number from"),
    (
        "max_range_m = 4.0",
        "max_range_m = 0.01",
        "sensor_model.max_range_m must be a number from 0.02",
    ),
    ('distance = "perpendicular"', 'distance = "slant"', "sensor_model.distance must be "),
    ('reading_order = "row_major"', "reading_order = 1", "sensor_model.reading_order must be "),
    (
        "flip_vertical = false",
        "flip_vertical = 0",
        "sensor_model.flip_vertical must be true or false",
    ),
    ('name = "base"', 'name = ""', "rings[0].name must be a text, got ''."),
    ('name = "base"', "name = 7", "rings[0].name must be a text, got 7."),
    (
        'link = "panda_link0"',
        'lnk = "panda_link0"',
        "rings[0].link is missing; rings[0].lnk is not",
    ),
    ("count = 8", "count = 0", "rings[0].count must be a whole number from 1 to 1000, got 0."),
    ("radius_m = 0.085", "radius_m = -1", "rings[0].radius_m must be a number from 0 to 10"),
    (
        "centre_m = [0.0, 0.0, 0.19]",
        "centre_m = [0.0, 0.19]",
        "rings[0].centre_m must be three numbers",
    ),
    (
        "centre_m = [0.0, 0.0, 0.19]",
        "centre_m = [0, 0, inf]",
        "rings[0].centre_m must be three numbers",
    ),
    ("axis = [0.0, 0.0, 1.0]", "axis = [0, 0, 0]", "rings[0].axis must be a direction, not zero"),
    (
        "first_direction = [1.0, 0.0, 0.0]",
        "first_direction = [0, 0, -2]",
        "rings[0].first_direction must be a direction that is not along",
    ),
    ("[[rings]]", "[rings]", "rings must be tables, each headed [[rings]]"),
    ("[[rings]]", "[[ring]]", "ring is not a known key; known are"),
    ("[sensor_model]", "[sensormodel]", "sensor_model is missing; sensormodel is not a known key"),
    ('distance = "perpendicular"', 'distance = "slant"', 'be "perpendicular" or "radial", got '),
    ("radius_m = 0.085", "radius_m = true", "rings[0].radius_m must be a number from 0 to 10, got"),
    (
        "rows = 8",
        "rows = 1979-05-27",
        "sensor_model.rows must be a whole number from 2 to 64, got ",
    ),
    (
        "rows = 8",
        "rows = 0x" + 5000 * "f",
        "sensor_model.rows must be a whole number from 2 to 64, got a number of thousands of",
    ),
    (
        "centre_m = [0.0, 0.0, 0.19]",
        f"centre_m = [{','.join(1000 * ['1'])}]",
        "rings[0].centre_m must be three numbers, got [1, 1, 1, 1, 1, 1, ...].",
    ),
    (
        "centre_m = [0.0, 0.0, 0.19]",
        f"centre_m = {50 * '['}{50 * ']'}",
        "rings[0].centre_m must be three numbers, got [[[[[[[...]]]]]]].",
    ),
    (
        "columns = 8",
        'columns = 8\n"\\u001b[31m\\n" = 1',
        r"sensor_model.'\x1b[31m\n' is not a known key",
    ),
]


@pytest.mark.parametrize(("right", "wrong", "sentence"), WRONG)
def test_a_wrong_key_is_one_sentence_that_names_file_and_key(tmp_path, right, wrong, sentence):
    text = HEAD + RING
    assert right in text
    with pytest.raises(RigError) as caught:
        rig_of(tmp_path, text.replace(right, wrong, 1))
    message = str(caught.value)
    assert message.startswith(f"{tmp_path / 'my_rig.toml'}: ")
    assert sentence in message
    assert message.endswith(".")
    assert message.isprintable()
    assert len(message) < 500


def test_three_of_several_problems_are_said_and_an_unknown_key_once_a_table(tmp_path):
    text = (HEAD + RING).replace("rows = 8", "rows = 8\nrow = 1\ncolumn = 1")
    text = text.replace("flip_vertical = false", "flip_vertical = 0")
    text = text.replace("count = 8", "").replace("axis = [0.0, 0.0, 1.0]", "axis = []")
    text += SINGLE.replace("wrist", "")
    with pytest.raises(RigError) as caught:
        rig_of(tmp_path, text)
    _, _, said = str(caught.value).partition("my_rig.toml: ")
    keys = "name, rows, columns, field_of_view_deg, min_range_m, max_range_m, distance, "
    keys += "reading_order, flip_vertical, flip_horizontal"
    assert said == (
        "sensor_model.flip_vertical must be true or false, got 0; "
        f"sensor_model.row is not a known key; known are {keys}; "
        "rings[0].count is missing; and 2 more."
    )


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ("rings = [1]", "rings must be tables, each headed [[rings]], got 1."),
        ("sensors = {}", "sensors must be tables, each headed [[sensors]], got {}."),
        ("sensor_model = 1", "sensor_model must be a table, got 1."),
    ],
)
def test_tables_must_be_tables(tmp_path, content, sentence):
    head = HEAD.partition("[sensor_model]")[0] if "model" in content else ""
    text = f"{content}\n{head or HEAD}"
    with pytest.raises(RigError) as caught:
        rig_of(tmp_path, text)
    assert str(caught.value) == f"{tmp_path / 'my_rig.toml'}: {sentence}"
