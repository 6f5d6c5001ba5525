import json
from pathlib import Path

import pytest

from app.analysis.parameter_files import flag_of, from_text, load, to_text
from app.errors import InputError
from estimator import Parameters, to_nested


def test_what_is_written_is_read():
    parameters = Parameters(n=2, min_samples=5, method="baseline")
    assert from_text(to_text(parameters), "x.json") == parameters
    assert from_text("{}", "x.json") == Parameters()


def test_a_table_of_evaluate_is_parameters_too():
    parameters = Parameters(n=2, min_samples=5)
    table = json.dumps({"parameters": to_nested(parameters), "recordings": []})
    assert from_text(table, "table.json") == parameters


def test_flags_are_named_like_parameters():
    assert flag_of("n_min") == "--n-min"
    assert flag_of("rays.noise_sigma") == "--rays-noise-sigma"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{", "x.json is not JSON: Expecting property name enclosed in double quotes: line 1 "),
        ("[1]", 'x.json must hold parameters, such as {"n": 8, "gamma": 0.7}, and not a list.'),
        ("null", "x.json must hold parameters, such as "),
        ('{"parameters": 7}', "and not a number."),
        ('{"gama": 1}', "x.json: gama is no parameter; parameters are n, gamma"),
        ('{"gamma": 2}', "x.json: gamma must be between 0 and 1, got 2"),
        ('{"n": "8"}', "x.json: n must be a whole number, got '8'"),
        ('{"n": 8.0}', "x.json: n must be a whole number, got 8.0"),
        ('{"n": true}', "x.json: n must be a whole number, got True"),
        ('{"gamma": 1e999}', "x.json: gamma must be between 0 and 1, got inf."),
        ('{"n": [1, 2]}', "x.json: n must be a number, a text, true, false or null, or"),
        ('{"rays": {"a": {"b": 1}}}', "or a table of such, got {'a': {'b': 1}}."),
        (f'{{"n": "{"8" * 5000}"}}', "got '888888888888...8888888888888'."),
        (
            f'{{"{"n" * 5000}": 1}}',
            "x.json: 'nnnnnnnnnnnn...nnnnnnnnnnnnn' is longer than the name",
        ),
        ('{"method": "none"}', "x.json: method must be "),
    ],
)
def test_wrong_content_is_one_sentence(text: str, said: str):
    with pytest.raises(InputError) as caught:
        from_text(text, "x.json")
    assert said in str(caught.value)
    assert str(caught.value).isprintable()
    assert len(str(caught.value)) < 300


def test_a_file_is_read(tmp_path: Path):
    path = tmp_path / "mine.json"
    path.write_text(to_text(Parameters(n=3)))
    assert load(path) == Parameters(n=3)


def test_files_that_cannot_be_read_are_one_sentence(tmp_path: Path):
    with pytest.raises(InputError, match=r"^There is no file .*none\.json; check the spelling\.$"):
        load(tmp_path / "none.json")
    with pytest.raises(InputError, match=r"cannot be read as parameters \(it is a folder\)\.$"):
        load(tmp_path)
    (tmp_path / "bytes").write_bytes(b"\xff\xfe")
    with pytest.raises(
        InputError, match=r"bytes is not a text file, so it cannot be a parameter file\.$"
    ):
        load(tmp_path / "bytes")


def test_a_file_that_is_too_large_is_not_read_to_its_end(tmp_path: Path):
    path = tmp_path / "recording.mcap"
    with path.open("wb") as file:
        file.truncate(100_000_000_000)  # a hole, which takes no place
    with pytest.raises(InputError, match=r"mcap has more than 10 MB, too much to be read as JSON"):
        load(path)
