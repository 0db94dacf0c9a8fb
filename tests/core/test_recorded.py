"""The folder of a new recording: no file of another one is changed, whoever records when."""

import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from hri.core import recorded, writing
from hri.core.errors import HriError
from hri.core.recorded import ABOUT, FILES, claim


def about(folder):
    return f"{folder}\n"


def taken(folder, name="events.jsonl"):
    folder.mkdir(exist_ok=True)
    (folder / name).write_text("someone's")
    return folder


def test_a_new_folder_is_made_with_its_parents_for_its_owner_alone(tmp_path):
    asked = tmp_path / "study" / "p01"
    assert claim(asked, about) == asked
    assert (asked / ABOUT).read_text() == f"{asked}\n"
    assert [path.stat().st_mode & 0o777 for path in (asked, asked / ABOUT)] == [0o700, 0o600]


@pytest.mark.parametrize("name", FILES)
def test_a_file_by_any_name_of_a_recording_is_left_alone(tmp_path, name):
    first = taken(tmp_path / "p01", name)
    assert claim(first, about) == tmp_path / "p01-2"
    assert claim(first, about) == tmp_path / "p01-3"
    assert [(path.name, path.read_text()) for path in first.iterdir()] == [(name, "someone's")]


def test_other_files_are_left_alone_and_the_recording_lies_beside_them(tmp_path):
    (tmp_path / "notes.txt").write_text("shy")
    assert claim(tmp_path, about) == tmp_path
    assert (tmp_path / "notes.txt").read_text() == "shy"


@pytest.mark.parametrize("kind", ["link to nothing", "link", "folder"])
def test_what_is_not_a_file_is_not_replaced_either(tmp_path, kind):
    asked = tmp_path / "p01"
    asked.mkdir()
    if kind == "folder":
        (asked / ABOUT).mkdir()
    else:
        target = Path(taken(tmp_path / "else") / "events.jsonl" if kind == "link" else "nowhere")
        (asked / "events.jsonl").symlink_to(target)
    assert claim(asked, about) == tmp_path / "p01-2"
    assert len(list(asked.iterdir())) == 1


def test_a_numbered_folder_or_file_that_is_there_is_not_used_whatever_it_holds(tmp_path):
    taken(tmp_path / "p01")
    (tmp_path / "p01-2").mkdir()
    (tmp_path / "p01-3").write_text("a file")
    assert claim(tmp_path / "p01", about) == tmp_path / "p01-4"
    assert not list((tmp_path / "p01-2").iterdir())


@pytest.mark.parametrize("name", [".", "", "sub/.."])
def test_the_folder_that_one_is_in_has_a_name_too(tmp_path, monkeypatch, name):
    here = taken(tmp_path / "p01")
    (here / "sub").mkdir()
    monkeypatch.chdir(here)
    assert claim(Path(name), about) == tmp_path / "p01-2"


def test_a_folder_without_a_name_is_refused(monkeypatch):
    monkeypatch.setattr(recorded, "FILES", ("",))  # the root of the disk, as if it had one
    with pytest.raises(HriError, match="holds a recording already - name another folder"):
        claim(Path("/"), about)


def test_a_file_is_no_folder(tmp_path):
    (tmp_path / "p01").write_text("mine")
    with pytest.raises(HriError, match=r"p01: cannot be written: File exists"):
        claim(tmp_path / "p01", about)
    assert (tmp_path / "p01").read_text() == "mine"


@pytest.mark.parametrize("has_links", [True, False])
@pytest.mark.parametrize("is_there", [True, False])
def test_of_many_at_once_each_gets_a_folder_of_its_own(tmp_path, monkeypatch, has_links, is_there):
    def refused(*args, **options):
        raise PermissionError

    if not has_links:
        monkeypatch.setattr(writing.os, "link", refused)
    asked = tmp_path / "p01"
    if is_there:
        asked.mkdir()
    with ThreadPoolExecutor(16) as threads:
        folders = list(threads.map(lambda _: claim(asked, about), range(48)))
    assert len(set(folders)) == 48
    assert asked in folders
    assert all((folder / ABOUT).read_text() == about(folder) for folder in folders)
    assert all(os.listdir(folder) == [ABOUT] for folder in folders)
