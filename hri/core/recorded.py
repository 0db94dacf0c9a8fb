"""What a recording consists of, and where recordings lie."""

from __future__ import annotations

import os
from pathlib import Path

from hri.core.writing import leftovers

EVENTS, FACE, SOUND = STREAMS = ("events.jsonl", "face.mp4", "robot.wav")
"""Files that grow while the robot lives."""
FILES = (*STREAMS, "timeline.png", "feelings.svg")
"""All that a recording consists of."""
STARTED = "recording.started"
"""The first event of a log: its `face` and `sound` say when these two files begin, in seconds of
the clock of `t`. In a log without it, all begin at 0."""
RECORDINGS = "recordings"
"""The folder, below the current one, in which a robot records that nobody sees."""
BY_DATE = "[0-9][0-9][0-9][0-9]-[0-9][0-9]-[0-9][0-9]-*"
"""The names of recordings there: a date and a time."""


def parts(folder: Path) -> list[Path]:
    """The files of a recording that are there, with what killed writers left beside them."""
    files = [folder / name for name in FILES]
    beside = [left for file in files for left in leftovers(file)]
    return [file for file in files if os.path.lexists(file)] + beside
