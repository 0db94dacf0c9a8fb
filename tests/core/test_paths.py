import pytest

from hri.core import paths, registry
from hri.core.errors import HriError, did_you_mean


def test_the_users_folders_come_first(tmp_path, monkeypatch):
    mine = tmp_path / "mine" / "grammars"
    mine.mkdir(parents=True)
    (mine / "companion.jsgf").write_text("#JSGF V1.0; grammar mine;")
    assert paths.find("grammars", "companion.jsgf").parent != mine
    monkeypatch.setenv("HRI_PATH", f"/nowhere:{tmp_path / 'mine'}")
    assert paths.find("grammars", "companion.jsgf").parent == mine
    monkeypatch.delenv("HRI_PATH")
    monkeypatch.setenv("EVOLUTION_CONFIG_PATH", str(tmp_path / "mine"))
    assert paths.find("grammars", "companion.jsgf").parent == mine


def test_a_missing_thing_says_what_is_near():
    with pytest.raises(
        HriError, match=r'no "companoin.jsgf" in grammars - did you mean "companion"'
    ):
        paths.find("grammars", "companoin.jsgf")


@pytest.mark.parametrize("name", ["wander.xml", "networks/wandr", "other/wnder"])
def test_a_missing_thing_may_be_in_a_folder_of_its_kind(name):
    with pytest.raises(HriError, match=r'did you mean "networks/wander"'):
        paths.find("config", name)


def test_only_files_of_its_kind_are_offered(tmp_path, monkeypatch):
    (tmp_path / "grammars").mkdir()
    for name in ("lamp.jsgf", "lamp_test.txt", "words.txt"):
        (tmp_path / "grammars" / name).write_text("")
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    with pytest.raises(HriError, match=r"known are: .*lamp, ") as error:
        paths.find("grammars", "zzzzzz")
    assert "words" not in str(error.value)
    assert "lamp_test" not in str(error.value)


def test_names_of_2003_are_aliases():
    assert registry.canonical("Evolution.LinuxCamera") == "Hri.Webcam"
    assert registry.canonical("Evolution.Constant") == "Hri.Constant"
    assert registry.find("hri.behaviors", "Evolution.Constant").__name__ == "Constant"


def test_every_declared_class_loads():
    for group in registry.GROUPS:
        for name in (name for name in registry.known(group) if name.startswith("Hri.")):
            assert registry.find(group, name), name


def test_an_unknown_type_is_named_with_what_was_meant():
    with pytest.raises(
        HriError, match=r'unknown behavior type "Hri.Constnt" - did you mean "Hri.Con'
    ):
        registry.find("hri.behaviors", "Hri.Constnt")


def test_did_you_mean_lists_when_nothing_is_near():
    assert did_you_mean("zzz", ["a", "b"]) == "known are: a, b"
    assert did_you_mean("x", []) == "none is known here"


def test_the_folder_one_works_in_comes_last(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("lamp.jsgf", "companion.jsgf"):
        (tmp_path / name).write_text("")

    assert paths.find("grammars", "lamp").resolve() == tmp_path / "lamp.jsgf"
    assert paths.find("grammars", "companion").parent == paths.house() / "grammars"
    with pytest.raises(HriError, match='no "lamp" in faces'):
        paths.find("faces", "lamp")
    (tmp_path / "lamp").mkdir()
    assert paths.find("faces", "lamp").resolve() == tmp_path / "lamp"


def test_of_faces_only_folders_are_offered():
    with pytest.raises(HriError, match=r'did you mean "eyes"\?'):
        paths.find("faces", "eye")
    with pytest.raises(HriError, match="known are: eyes, person, robot"):
        paths.find("faces", "gestures")


def test_an_empty_name_is_none():
    with pytest.raises(HriError, match="an empty name"):
        paths.find("faces", "")
