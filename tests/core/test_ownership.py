"""Caches and state that somebody else may have written are not used."""

import os
import stat

import pytest

from hri.core import ownership
from hri.core.ownership import is_of_user, is_private_folder, private_folder


@pytest.fixture
def folder(tmp_path):
    made = tmp_path / "cache"
    made.mkdir(mode=0o700)
    (made / "kept").write_text("code")
    (made / "kept").chmod(0o600)
    return made


def test_a_folder_is_made_for_its_user_alone(tmp_path):
    made = private_folder(tmp_path / "hri" / "compiled")
    assert made is not None
    assert stat.S_IMODE(made.stat().st_mode) == 0o700
    assert is_private_folder(made)


def test_what_is_kept_in_a_private_folder_stays(folder):
    assert private_folder(folder) == folder
    assert (folder / "kept").read_text() == "code"


@pytest.mark.parametrize("mode", [0o777, 0o702, 0o1777])
def test_a_folder_that_others_could_write_to_is_emptied(folder, mode):
    folder.chmod(mode)
    assert not is_private_folder(folder)
    assert private_folder(folder) == folder
    assert list(folder.iterdir()) == []
    assert is_private_folder(folder)


def test_so_is_one_with_a_file_that_others_could_write(folder):
    (folder / "kept").chmod(0o666)
    assert is_of_user(folder)
    assert private_folder(folder) == folder
    assert list(folder.iterdir()) == []


def test_what_belongs_to_somebody_else_is_neither_used_nor_touched(folder, monkeypatch):
    monkeypatch.setattr(os, "getuid", lambda: os.stat(folder).st_uid + 1)
    monkeypatch.setattr(ownership, "_ROOT", -1)
    assert not is_of_user(folder)
    assert private_folder(folder) is None
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
    assert private_folder(tmp_path / "file" / "below") is None
