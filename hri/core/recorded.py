"""What a recording consists of, where recordings lie, and the folder of a new one."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from itertools import count
from pathlib import Path

from hri.core.errors import HriError
from hri.core.privacy import PRIVATE_FOLDER
from hri.core.writing import leftovers, make_folder, not_written, write_new_text

EVENTS, FACE, SOUND = STREAMS = ("events.jsonl", "face.mp4", "robot.wav")
"""Files that grow while the robot lives."""
ABOUT = "recording.json"
"""What was run, when, and how, so that it can be repeated."""
FILES = (*STREAMS, ABOUT, "timeline.png", "feelings.svg")
"""All that a recording consists of."""
STARTED = "recording.started"
"""The first event of a log: its `face` and `sound` say when these two files begin, in seconds of
the clock of `t`; in a log without it, all begin at 0. Its `version`, `seed`, `app`, `personality`
and `config` say what was run."""
RECORDINGS = "recordings"
"""The folder, below the current one, in which earlier versions recorded what nobody saw."""
BY_DATE = "[0-9][0-9][0-9][0-9]-[0-9][0-9]-[0-9][0-9]-*"
"""The names of recordings there: a date and a time."""


def parts(folder: Path) -> list[Path]:
    """The files of a recording that are there, with what killed writers left beside them."""
    files = [folder / name for name in FILES]
    beside = [left for file in files for left in leftovers(file)]
    return [file for file in files if os.path.lexists(file)] + beside


def claim(asked: Path, about: Callable[[Path], str]) -> Path:
    """Make the folder of a new recording, with its `recording.json`, and return it.

    It is the one asked for unless that has a file by the name of one of a recording; then it is
    the first free one of p01-2, p01-3 ... beside it. No file that was there is changed, and no two
    programs get the same folder, also when they start at once. `about` gives the text of
    `recording.json`. Raises NotWritten, HriError for a folder without a name.
    """
    make_folder(asked, PRIVATE_FOLDER)
    is_free = not any(os.path.lexists(asked / name) for name in FILES)
    if is_free and write_new_text(asked / ABOUT, about(asked)):
        return asked
    return next(
        folder
        for folder in _numbered(asked)
        if _is_made(folder) and write_new_text(folder / ABOUT, about(folder))
    )


def _numbered(asked: Path) -> Iterator[Path]:
    folder = asked if asked.name not in ("", "..") else asked.resolve()
    if not folder.name:
        raise HriError(f"{asked}: holds a recording already - name another folder")
    return (folder.with_name(f"{folder.name}-{number}") for number in count(2))


def _is_made(folder: Path) -> bool:
    """Make a folder that is not there yet; whether it was not. Raises NotWritten."""
    try:
        folder.mkdir(PRIVATE_FOLDER)
    except FileExistsError:
        return False
    except OSError as error:
        raise not_written(folder, error) from error
    return True
