import os
import re
import stat
import subprocess
import sys
import threading
from pathlib import Path

import pytest
from hypothesis import given, settings, strategies as st

from hri.core.errors import HriError
from hri.core.writing import (
    PRIVATE,
    append_line,
    delete,
    leftovers,
    make_folder,
    new_folder,
    replacing,
    write_bytes,
    write_text,
)
from tests.disk import full_disk

DIES = """
import os, pathlib, sys
from hri.core.writing import replacing
with replacing(pathlib.Path(sys.argv[1])) as new:
    new.write_text("half")
    os.kill(os.getpid(), 9)
"""


def mode_of(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


@given(old=st.binary(max_size=5000), new=st.binary(max_size=5000), room=st.integers(0, 6000))
@settings(max_examples=50, deadline=None)
def test_on_a_disk_of_any_size_the_old_or_the_new_file_is_there_whole(
    tmp_path_factory, old, new, room
):
    path = tmp_path_factory.mktemp("disk") / "file.toml"
    path.write_bytes(old)
    try:
        with full_disk(after=room):
            write_bytes(path, new)
    except HriError:
        assert len(new) > room
        assert path.read_bytes() == old
    else:
        assert path.read_bytes() == new
    assert os.listdir(path.parent) == [path.name]


def test_what_cannot_be_deleted_is_named_and_what_is_gone_already_is_not(tmp_path):
    (tmp_path / "file").touch()
    delete(tmp_path / "gone", tmp_path / "file")
    assert not os.listdir(tmp_path)
    with pytest.raises(HriError, match=re.escape(f"{tmp_path}: cannot be deleted: ")):
        delete(tmp_path)


def test_a_full_disk_is_said_in_one_line(tmp_path):
    path = tmp_path / "file.toml"
    with full_disk(), pytest.raises(HriError) as error:
        write_text(path, "words")
    assert str(error.value) == f"{path}: cannot be written: File too large - make room on the disk"
    assert not path.exists()


def test_a_file_keeps_its_permissions_and_a_new_one_follows_the_users_mask(tmp_path):
    path = tmp_path / "file"
    before = os.umask(0o027)
    try:
        write_text(path, "one")
        assert mode_of(path) == 0o640
        path.chmod(0o751)
        write_text(path, "two")
        assert mode_of(path) == 0o751
    finally:
        os.umask(before)


def test_a_private_file_is_private_also_where_it_was_not(tmp_path):
    path = tmp_path / "file"
    path.write_text("open to all")
    path.chmod(0o666)
    write_text(path, "private", PRIVATE)
    assert mode_of(path) == 0o600
    assert path.read_text() == "private"


def test_a_link_stays_and_its_target_is_written(tmp_path):
    target, link = tmp_path / "below" / "target", tmp_path / "link"
    target.parent.mkdir()
    link.symlink_to(target)
    for text in ("made", "replaced"):
        write_text(link, text)
        assert link.is_symlink()
        assert target.read_text() == text


def test_a_pipe_is_written_to_and_a_device_stays_one(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    heard: list[bytes] = []
    reader = threading.Thread(target=lambda: heard.append(pipe.read_bytes()))
    reader.start()
    write_text(pipe, "words")
    reader.join()
    assert heard == [b"words"]
    with pytest.raises(HriError, match="/dev/full: cannot be written: No space left"):
        write_text(Path("/dev/full"), "words")
    assert stat.S_ISCHR(os.stat("/dev/full").st_mode)


def loops(folder: Path) -> Path:
    (folder / "one").symlink_to(folder / "other")
    (folder / "other").symlink_to(folder / "one")
    return folder / "one"


WRONG = {
    "a folder": (lambda folder: folder, "name a file, not a folder"),
    "in no folder": (lambda folder: folder / "none" / "file", "check the path"),
    "too long": (lambda folder: folder / ("x" * 300), "choose a shorter name"),
    "a zero byte": (lambda folder: folder / "a\0b", "choose another name"),
    "links in a circle": (loops, "c"),
}


@pytest.mark.parametrize("what", WRONG)
def test_what_cannot_be_written_is_refused_in_one_line(tmp_path, what):
    path, remedy = WRONG[what]
    with pytest.raises(HriError, match=f"cannot be written: .* - {remedy}") as error:
        write_text(path(tmp_path), "words")
    assert "\n" not in str(error.value)


def test_a_name_as_long_as_a_name_can_be_is_written(tmp_path):
    path = tmp_path / ("ü" * 127)
    write_text(path, "words")
    assert path.read_text() == "words"


def test_what_a_killed_writer_left_is_found_and_goes_with_the_next_write(tmp_path):
    path = tmp_path / "file.toml"
    subprocess.run([sys.executable, "-c", DIES, path], timeout=60)
    assert not path.exists()
    assert [file.read_text() for file in leftovers(path)] == ["half"]
    write_text(tmp_path / "file", "of another name")
    assert len(leftovers(path)) == 1
    write_text(path, "whole")
    assert sorted(os.listdir(tmp_path)) == ["file", "file.toml"]


def test_a_writer_at_work_is_not_taken_for_a_dead_one(tmp_path):
    path = tmp_path / "file.toml"
    with replacing(path) as new:
        new.write_text("later")
        assert leftovers(path) == []
        write_text(path, "sooner")
        assert path.read_text() == "sooner"
    assert path.read_text() == "later"


def test_an_error_while_it_is_written_leaves_the_old_file(tmp_path):
    path = tmp_path / "file.toml"
    path.write_text("old")
    with pytest.raises(ZeroDivisionError), replacing(path) as new:
        new.write_bytes(bytes(1 // 0))
    with pytest.raises(HriError, match="cannot be written: No space"), replacing(path) as new:
        Path("/dev/full").write_text("words")
    assert path.read_text() == "old"
    assert os.listdir(tmp_path) == ["file.toml"]


def test_many_writers_of_one_file_leave_one_of_theirs(tmp_path):
    path = tmp_path / "file"
    texts = [str(number) * 10_000 for number in range(8)]
    writers = [
        threading.Thread(target=lambda text=text: [write_text(path, text) for _ in range(5)])
        for text in texts
    ]
    for writer in writers:
        writer.start()
    for writer in writers:
        writer.join()
    assert path.read_text() in texts
    assert os.listdir(tmp_path) == ["file"]


def test_the_status_is_that_of_the_new_file(tmp_path):
    path = tmp_path / "file"
    status = write_text(path, "words")
    assert (status.st_ino, status.st_mtime_ns) == (path.stat().st_ino, path.stat().st_mtime_ns)


def test_a_folder_is_made_with_those_it_lies_in_or_refused_in_one_line(tmp_path):
    make_folder(tmp_path / "a" / "b", 0o700)
    assert mode_of(tmp_path / "a" / "b") == 0o700
    (tmp_path / "file").write_text("")
    with pytest.raises(HriError, match=r"file/c: cannot be written: .* - check the path"):
        make_folder(tmp_path / "file" / "c")


def test_a_folder_is_there_whole_or_not_at_all(tmp_path):
    folder = tmp_path / "face"
    with full_disk(after=3), pytest.raises(HriError, match="make room"), new_folder(folder) as new:
        (new / "face.toml").write_text("too long")
    assert os.listdir(tmp_path) == []
    with new_folder(folder) as new:
        (new / "face.toml").write_text("whole")
    assert (folder / "face.toml").read_text() == "whole"
    assert os.listdir(tmp_path) == ["face"]


def test_a_line_is_added_whole_or_not_at_all(tmp_path):
    path = tmp_path / "notes"
    append_line(path, "one")
    with full_disk(after=6), pytest.raises(HriError, match="make room"):
        append_line(path, "another")
    assert path.read_text() == "one\n"
    path.write_text("one\nhal")
    append_line(path, "two")
    assert path.read_text() == "one\nhal\ntwo\n"
    append_line(tmp_path / "new", "private")
    assert mode_of(tmp_path / "new") == 0o600
