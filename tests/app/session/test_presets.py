import sys

import pytest

from app.analysis.parameter_files import load
from app.errors import InputError
from app.session.presets import Presets, PresetUse, composed, preset_folder
from estimator import Parameters

OTHER = Parameters(n=3, delta=0.1, min_samples=5)


@pytest.fixture
def presets(tmp_path):
    return Presets(tmp_path / "made" / "presets")


def test_what_is_saved_is_listed_and_loaded_and_is_a_file_of_the_command_line(presets, tmp_path):
    assert presets.names() == []
    presets.save("two hands", Parameters())
    presets.save("two hands", OTHER)
    presets.save("Änderung-2", Parameters())
    assert presets.names() == ["two hands", "Änderung-2"]
    assert presets.load("two hands") == OTHER
    assert load(tmp_path / "made" / "presets" / "two hands.json") == OTHER
    assert len(list((tmp_path / "made" / "presets").iterdir())) == 2


def test_what_is_deleted_is_gone(presets):
    presets.save("a", OTHER)
    presets.delete("a")
    presets.delete("a")
    assert presets.names() == []
    with pytest.raises(InputError, match=r"There is no file .*a\.json"):
        presets.load("a")


@pytest.mark.parametrize(
    "name", ["", ".", "..", "../a", "a/b", "a\\b", ".hidden", "a\0b", "a\n", "x" * 51, " a", "a "]
)
def test_no_path_can_be_made_of_a_name(presets, tmp_path, name):
    for action in (presets.load, presets.delete, lambda n: presets.save(n, OTHER)):
        with pytest.raises(InputError, match="A preset's name is made of"):
            action(name)
    assert list(tmp_path.rglob("*")) == []


def test_a_folder_that_cannot_be_made_is_told(tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match=r"cannot be saved at .*file/presets/a\.json"):
        Presets(tmp_path / "file" / "presets").save("a", OTHER)


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere the user's folder is another")
def test_the_folder_is_the_users(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    assert preset_folder() == tmp_path / "tofscope" / "presets"
    monkeypatch.setenv("HOME", "/home/a")
    for value in ("", "relative"):
        monkeypatch.setenv("XDG_CONFIG_HOME", value)
        assert str(preset_folder()) == "/home/a/.config/tofscope/presets"


@pytest.mark.parametrize("linked", [True, False])
def test_what_is_no_preset_is_not_replaced(presets, tmp_path, linked):
    presets.save("a", OTHER)
    place = tmp_path / "made" / "presets" / "tie.json"
    file = tmp_path / "measured.mcap" if linked else place
    file.write_bytes(b"\x89MCAP0\r\n")
    if linked:
        place.symlink_to(file)
    with pytest.raises(InputError, match=r"tie\.json exists and was not made by this command"):
        presets.save("tie", OTHER)
    assert file.read_bytes() == b"\x89MCAP0\r\n"


def test_a_preset_gets_another_name_that_is_not_in_use(presets):
    presets.save("a", OTHER)
    presets.save("b", Parameters())
    with pytest.raises(InputError, match="There is a preset b already"):
        presets.rename("a", "b")
    presets.rename("a", "c")
    assert presets.names() == ["b", "c"]
    assert presets.load("c") == OTHER
    with pytest.raises(InputError, match="There is no file"):
        presets.rename("a", "d")


def test_letters_with_marks_are_letters_however_they_are_typed(presets):
    presets.save(composed(" a\u0308 "), OTHER)
    assert presets.names() == ["ä"]


def test_a_question_is_answered_by_the_same_use_in_time():
    asked = PresetUse("delete", "a", done=False, asked=100.0)
    again = PresetUse("delete", "a", done=False)
    assert again.confirms(asked, 105.0)
    assert not again.confirms(asked, 111.0)
    assert not again.confirms(None, 105.0)
    assert not again.confirms(again, 105.0)
    assert not PresetUse("delete", "b", done=False).confirms(asked, 105.0)
