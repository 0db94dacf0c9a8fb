import os
import stat
from pathlib import Path

import pytest

from hri.core.privacy import close_to_others, private_file, private_folder
from hri.core.writing import NotWritten


def mode(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


def test_a_private_folder_and_file_are_the_owners_alone_whatever_they_were(tmp_path: Path) -> None:
    folder = tmp_path / "above" / "folder"
    private_folder(folder)
    assert mode(folder) == 0o700
    file = folder / "file"
    private_file(file)
    assert mode(file) == 0o600
    file.write_text("kept")
    file.chmod(0o664)
    folder.chmod(0o755)
    private_folder(folder)
    private_file(file)
    assert (mode(folder), mode(file)) == (0o700, 0o600)
    assert file.read_text() == "kept"


def test_what_the_owner_may_not_do_stays_so(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.touch()
    file.chmod(0o444)
    close_to_others(file)
    assert mode(file) == 0o400


def test_what_is_missing_or_no_file_is_left_alone(tmp_path: Path) -> None:
    close_to_others(tmp_path / "missing")
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe, 0o666)
    before = mode(pipe)
    close_to_others(pipe)
    assert mode(pipe) == before


def test_a_folder_that_cannot_be_made_is_one_line(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(NotWritten, match=r"cannot be written: .* - "):
        private_folder(tmp_path / "file" / "folder")
    with pytest.raises(NotWritten, match=r"cannot be written: .* - "):
        private_file(tmp_path / "file" / "folder")
