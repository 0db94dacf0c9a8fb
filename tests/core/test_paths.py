import os
import pwd
from pathlib import Path

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


def test_own_folders_come_before_all_others(tmp_path, monkeypatch):
    own, here = tmp_path / "own", tmp_path / "here"
    for folder in (own, here):
        (folder / "size").mkdir(parents=True)
        (folder / "size.jsgf").write_text("")
    (own / "companion.jsgf").write_text("")
    monkeypatch.chdir(here)
    for name in ("size", "size.jsgf"):
        assert paths.find("grammars", name, [tmp_path, own]) == own / "size.jsgf"
        assert paths.find("grammars", name).resolve() == here / "size.jsgf"
    assert paths.find("grammars", "companion", [own]).parent == own
    assert paths.find("grammars", "numbers", [own]).parent != own
    with pytest.raises(HriError, match='did you mean "size"'):
        paths.find("grammars", "sise", [own])


def test_a_missing_thing_says_what_is_near():
    with pytest.raises(
        HriError, match=r'no "companoin.jsgf" in grammars - did you mean "companion"'
    ):
        paths.find("grammars", "companoin.jsgf")


def test_a_grammar_of_sphinx_is_found_by_its_name(tmp_path, monkeypatch):
    (tmp_path / "grammars").mkdir()
    (tmp_path / "grammars" / "lamp.gram").write_text("")
    (tmp_path / "here.gram").write_text("")
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    assert paths.find("grammars", "lamp").name == "lamp.gram"
    assert paths.find("grammars", "here").name == "here.gram"
    with pytest.raises(HriError, match='did you mean "lamp"'):
        paths.find("grammars", "lamb")


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
    with pytest.raises(HriError, match="known are: astronaut, eyes, person, robot"):
        paths.find("faces", "gestures")


def test_an_empty_name_is_none():
    with pytest.raises(HriError, match="an empty name"):
        paths.find("faces", "")


FOLDERS = {
    "XDG_CONFIG_HOME": paths.settings_folder,
    "XDG_CACHE_HOME": paths.cache_folder,
    "XDG_DATA_HOME": paths.data_folder,
    "XDG_STATE_HOME": paths.state_folder,
}


@pytest.mark.parametrize("variable", FOLDERS)
@pytest.mark.parametrize("home", ["", "home"])
@pytest.mark.parametrize("named", ["", "kept", "./kept"])
def test_what_is_no_folder_is_not_taken_for_one_here(monkeypatch, variable, home, named):
    monkeypatch.setenv("HOME", home)
    monkeypatch.setenv(variable, named)
    of_user = pwd.getpwuid(os.getuid()).pw_dir
    assert FOLDERS[variable]().is_relative_to(of_user)
    assert paths.expanded("~/words.txt") == Path(of_user, "words.txt")


@pytest.mark.parametrize("variable", FOLDERS)
def test_the_folders_of_the_user_are_where_the_user_says(monkeypatch, tmp_path, variable):
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.delenv(variable, raising=False)
    assert FOLDERS[variable]().is_relative_to(tmp_path)
    monkeypatch.setenv(variable, "/kept")
    assert FOLDERS[variable]() == Path("/kept/hri")
    monkeypatch.setenv(variable, "~/kept")
    assert FOLDERS[variable]() == tmp_path / "kept" / "hri"


def test_a_user_without_a_home_is_told_in_one_line(monkeypatch):
    monkeypatch.setenv("HOME", "")
    monkeypatch.setattr(os, "getuid", lambda: 2**31 - 7)
    monkeypatch.delenv("XDG_STATE_HOME", raising=False)
    with pytest.raises(HriError, match="no home folder - set HOME"):
        paths.state_folder()
    with pytest.raises(HriError, match="there is no such user"):
        paths.expanded("~nobody-of-this-name/file")


def test_an_app_in_this_folder_is_suggested(tmp_path, monkeypatch):
    (tmp_path / "joke").mkdir()
    (tmp_path / "joke" / "app.toml").touch()
    monkeypatch.chdir(tmp_path)
    with pytest.raises(HriError, match='did you mean "joke"'):
        paths.find("apps", "jokee")


@pytest.mark.parametrize("name", ["mine/nope.jsgf", "nope/"])
def test_what_looks_like_a_path_is_reported_as_one(name, tmp_path, monkeypatch):
    (tmp_path / "mine").mkdir()
    monkeypatch.chdir(tmp_path)
    with pytest.raises(HriError, match=f"^{name}: no such file or folder"):
        paths.find("grammars", name)
