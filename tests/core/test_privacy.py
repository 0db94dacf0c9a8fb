import os
import stat
from pathlib import Path

import pytest

from hri.core.privacy import close_to_others, is_named, private_file, private_folder
from hri.core.writing import NotWritten

NAMED = {
    "Anna": (
        "anna", "ANNA", "anna-cup", "anna_ball", "anna2.jpg", "2anna3", "IMG_anna.jpg", "Annas cup",
        "anna's", "Anna\N{RIGHT SINGLE QUOTATION MARK}s cup", "annaCup", "myAnnaCup", "IMGAnna.jpg",
        "AnnasCup", "an\u00adna", "/home/anna/cup.jpg", "We met Anna.",
    ),
    "Anna Lee": ("anna lee", "annaLee2", "anna_lee.jpg", "ANNA  LEE"),
    "mcdonald": ("McDonaldCup", "McDonald", "mcdonald's"),
    "O'Brien": ("o_brien", "OBrien"),
    "José": ("jose\u0301_1", "JOSÉ"),
    "R2D2": ("my r2d2 box",),
    "!!": ("a!!b",),
}  # fmt: skip
NOT_NAMED = {
    "Anna": (
        "Joanna", "Hannah", "annabel", "savannah", "JOANNA2", "Annas", "annals", "an na", "annä",
        "anna\u0301", "Annass cup", "",
    ),
    "Ann": ("Anna", "annCup"[1:]),
    "Anna Lee": ("Anna", "Lee Anna"),
    "": ("", "anna"),
    " ": ("a b",),
}  # fmt: skip


@pytest.mark.parametrize("person", NAMED)
def test_a_person_is_named_where_their_name_stands_as_a_word_of_letters(person: str) -> None:
    assert [text for text in NAMED[person] if not is_named(person, text)] == []


@pytest.mark.parametrize("person", NOT_NAMED)
def test_a_name_that_is_part_of_another_word_is_not_theirs(person: str) -> None:
    assert [text for text in NOT_NAMED[person] if is_named(person, text)] == []


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
