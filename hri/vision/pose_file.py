"""Series of head poses as CSV files: columns t_s, pitch_deg, yaw_deg, roll_deg."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from hri.core.errors import AuthoringError, HriError, Place
from hri.core.reading import read_lines
from hri.core.signals import HeadPose

COLUMNS = ("t_s", "pitch_deg", "yaw_deg", "roll_deg")
SLOWEST, FASTEST = 9.5, 105.0
"""Poses a second that the recognizer is made for, with some tolerance."""
LARGEST_FILE = 40_000_000
"""Bytes; poses are read one by one."""
LONGEST_LINE = 100_000
"""Characters; a longer line is not a line of numbers."""


@dataclass
class Remarks:
    """What is odd about a file but costs no more than some of its rows."""

    path: Path
    _lines: dict[str, tuple[int, int]] = field(default_factory=dict)
    """The first line and how many, by what is odd."""

    def add(self, line: int, what: str) -> None:
        first, count = self._lines.get(what, (line, 0))
        self._lines[what] = first, count + 1

    def __iter__(self) -> Iterator[str]:
        """A sentence for each kind of oddity."""
        for what, (line, count) in self._lines.items():
            times = f" ({count} times)" if count > 1 else ""
            yield f"{self.path}:{line}: {what}{times}"


def read_poses(path: Path, remarks: Remarks) -> Iterator[HeadPose]:
    """The poses of a file, one by one; other columns are passed over.

    Rows without finite numbers, and those of the time of the row before, are passed over, and
    remarked; so is time that goes back and a rate out of range, with which the recognizer does what
    it can. Raises AuthoringError for a column
    that is missing or not a number, HriError for a file that cannot be read.
    """
    try:
        with read_lines(path, "file of poses", LARGEST_FILE, LONGEST_LINE) as lines:
            yield from _poses(path, lines, remarks)
    except csv.Error as error:
        raise HriError(f"{path}: not a CSV file: {error} - write {','.join(COLUMNS)}") from error


def _poses(path: Path, lines: Iterator[str], remarks: Remarks) -> Iterator[HeadPose]:
    rows = csv.reader(lines)
    header = [name.strip() for name in next(rows, [])]
    places = []
    for name in COLUMNS:
        if name not in header:
            remedy = f"begin the file with {','.join(COLUMNS)}"
            raise AuthoringError(Place(path, 1), f'no column "{name}"', remedy)
        places.append(header.index(name))
    first = last = -math.inf
    count = 0
    for row in rows:
        if not any(cell.strip() for cell in row):
            continue
        time, pitch, yaw, roll = _numbers(path, rows.line_num, row, places)
        if not all(map(math.isfinite, (time, pitch, yaw, roll))):
            remarks.add(rows.line_num, "a row without numbers - passed over")
            continue
        if time == last:
            remarks.add(rows.line_num, "time stands still - the row is passed over")
            continue
        if time < last:
            remarks.add(rows.line_num, "time goes back - the recognizer starts again here")
            first, count = time, 0
        first = time if count == 0 else first
        last, count = time, count + 1
        yield HeadPose(time, math.radians(pitch), math.radians(yaw), math.radians(roll))
    if last == -math.inf:
        raise HriError(f"{path}: no poses - write a row for each below {','.join(COLUMNS)}")
    if count > 2 and not SLOWEST <= (count - 1) / max(last - first, 1e-9) <= FASTEST:
        rate = (count - 1) / max(last - first, 1e-9)
        remarks.add(2, f"{rate:.3g} poses a second - 10 to 100 are recognized well")


def _numbers(path: Path, line: int, row: list[str], places: list[int]) -> list[float]:
    numbers = []
    for name, place in zip(COLUMNS, places, strict=True):
        text = row[place].strip() if place < len(row) else ""
        try:
            numbers.append(float(text) if text else math.nan)
        except ValueError as error:
            what = f"{name} is {json.dumps(text[:40], ensure_ascii=False)}"  # in one line
            raise AuthoringError(Place(path, line), what, "write a number") from error
    return numbers
