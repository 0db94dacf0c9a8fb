"""Caches and state that someone else may have written are not used."""

import os
import stat

import numba
import pytest

from hri.core import models, ownership
from hri.core.errors import HriError
from hri.core.ownership import is_all_of_user, is_of_user, own_cache
from hri.emotion.persistence import recall
from hri.face.drawing import cache
from hri.face.renderers import compiling
from hri.speech.pronunciation.guesses import Guesses
from hri.vision.tracking.face_recognition import Acquaintances


@pytest.fixture
def folder(tmp_path):
    made = tmp_path / "cache"
    made.mkdir(mode=0o700)
    (made / "kept").write_text("code")
    (made / "kept").chmod(0o600)
    return made


def test_a_folder_is_made_for_its_user_alone(tmp_path):
    made = own_cache(tmp_path / "hri" / "compiled")
    assert made is not None
    assert stat.S_IMODE(made.stat().st_mode) == 0o700
    assert is_all_of_user(made)


def test_what_is_kept_in_a_own_cache_stays(folder):
    assert own_cache(folder) == folder
    assert (folder / "kept").read_text() == "code"


@pytest.mark.parametrize("mode", [0o777, 0o702, 0o1777])
def test_a_folder_that_others_could_write_to_is_emptied(folder, mode):
    folder.chmod(mode)
    assert not is_all_of_user(folder)
    assert own_cache(folder) == folder
    assert list(folder.iterdir()) == []
    assert is_all_of_user(folder)


def test_so_is_one_with_a_file_that_others_could_write(folder):
    (folder / "kept").chmod(0o666)
    assert is_of_user(folder)
    assert own_cache(folder) == folder
    assert list(folder.iterdir()) == []


def test_what_belongs_to_somebody_else_is_neither_used_nor_touched(folder, monkeypatch):
    monkeypatch.setattr(os, "getuid", lambda: os.stat(folder).st_uid + 1)
    monkeypatch.setattr(ownership, "_ROOT", -1)
    assert not is_of_user(folder)
    assert own_cache(folder) is None
    assert (folder / "kept").read_text() == "code"


def test_a_group_may_write_only_if_it_is_the_users_own(folder):
    import grp

    folder.chmod(0o770)
    group = grp.getgrgid(folder.stat().st_gid)
    is_own = group.gr_name == _name() and set(group.gr_mem) <= {_name()}
    assert is_of_user(folder) == is_own


def _name():
    import pwd

    return pwd.getpwuid(os.getuid()).pw_name


def test_what_is_not_there_is_nobodys(tmp_path):
    assert not is_of_user(tmp_path / "nothing")
    (tmp_path / "file").write_text("")
    assert own_cache(tmp_path / "file" / "below") is None


def test_state_that_somebody_else_may_have_written_is_not_used(tmp_path):
    for name, load in (("feelings.json", recall), ("faces.json", Acquaintances.load)):
        path = tmp_path / name
        path.write_text("{}")
        path.chmod(0o666)
        with pytest.raises(HriError, match=r"someone else may have written this .* chmod go-w it"):
            load(path)


def test_so_is_a_model_that_was_fetched(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    folder = models.folder_of("mine")
    folder.mkdir(parents=True)
    assert models.Catalog(()).find("mine") == folder
    folder.chmod(0o777)
    with pytest.raises(HriError, match="someone else may have written this model"):
        models.Catalog(()).find("mine")


def test_guessed_words_that_somebody_else_may_have_written_are_begun_anew(tmp_path):
    path = tmp_path / "words.txt"
    Guesses(path)["hello"]
    kept = path.read_text()
    path.write_text(kept.replace("hello", "planted"))
    path.chmod(0o666)
    Guesses(path)["hello"]
    assert path.read_text() == kept


def test_a_baked_face_is_taken_only_from_a_folder_of_the_user(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    folder = own_cache(cache.folder())
    (folder / "planted.face").write_text("planted")
    folder.chmod(0o777)
    assert cache.own_folder() == folder
    assert list(folder.iterdir()) == []


@pytest.mark.parametrize("chosen", [True, False], ids=["chosen by the user", "ours"])
def test_compiled_code_that_somebody_else_may_have_written_is_not_run(
    chosen, tmp_path, monkeypatch
):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    folder = tmp_path / "hri" / "compiled"
    folder.mkdir(parents=True)
    (folder / "planted").write_text("code")
    folder.chmod(0o777)
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(folder) if chosen else "")
    found = compiling.folder()
    if chosen:
        assert found is None
        assert (folder / "planted").exists()
    else:
        assert found == folder
        assert list(folder.iterdir()) == []
