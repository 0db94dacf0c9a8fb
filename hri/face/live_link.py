"""Weights over time as CSV with the columns of Live Link Face, to record and to replay.

Timecode, BlendShapeCount, ARKit's 52 targets with a capital letter, nine angles in radians
(HeadYaw, HeadPitch, HeadRoll and six of the eyes), then what a face has beside, by its own names.
The eyes' angles are 0 when written and left out when read: EyeLook... says the same. A timecode is
hours:minutes:seconds:frames, 60 frames a second, with thousandths of a frame.
"""

from __future__ import annotations

import csv
import logging
import math
import re
from array import array
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from hri.core.errors import AuthoringError, Place
from hri.core.growing_files import GrowingFile
from hri.core.reading import read_lines
from hri.face.drawing.baking import Vector
from hri.face.model import FaceModel
from hri.face.motion.gesture_tracks import Track

log = logging.getLogger("hri.face")

_EYE = ("Blink", "LookDown", "LookIn", "LookOut", "LookUp", "Squint", "Wide")
TARGETS = (
    *(f"Eye{what}{side}" for side in ("Left", "Right") for what in _EYE),
    "JawForward", "JawRight", "JawLeft", "JawOpen", "MouthClose", "MouthFunnel", "MouthPucker",
    "MouthRight", "MouthLeft", "MouthSmileLeft", "MouthSmileRight", "MouthFrownLeft",
    "MouthFrownRight", "MouthDimpleLeft", "MouthDimpleRight", "MouthStretchLeft",
    "MouthStretchRight", "MouthRollLower", "MouthRollUpper", "MouthShrugLower", "MouthShrugUpper",
    "MouthPressLeft", "MouthPressRight", "MouthLowerDownLeft", "MouthLowerDownRight",
    "MouthUpperUpLeft", "MouthUpperUpRight", "BrowDownLeft", "BrowDownRight", "BrowInnerUp",
    "BrowOuterUpLeft", "BrowOuterUpRight", "CheekPuff", "CheekSquintLeft", "CheekSquintRight",
    "NoseSneerLeft", "NoseSneerRight", "TongueOut",
)  # fmt: skip
"""In the order of the app's files."""
HEAD = ("HeadYaw", "HeadPitch", "HeadRoll")
EYES = tuple(
    f"{side}Eye{angle}" for side in ("Left", "Right") for angle in ("Yaw", "Pitch", "Roll")
)
COLUMNS = (*TARGETS, *HEAD, *EYES)
TIMECODE, COUNT = "Timecode", "BlendShapeCount"

FRAMES = 60
"""A second, in a timecode."""
DAY = 86_400.0
LONGEST = 3600.0
"""Seconds of a recording."""
MOST_ROWS = int(LONGEST * FRAMES) + 1
MOST_COLUMNS = 400
MOST_BYTES = 200_000_000
LONGEST_LINE = 20_000
"""Characters: four hundred cells fit."""
LARGEST = 10.0
"""Of a value in a file: a weight, or radians."""

_TIME = re.compile(r"(\d{1,2}):(\d{1,2}):(\d{1,2})(?::|;)(\d{1,3}(?:\.\d{1,6})?)", re.ASCII)


class WeightWriter:
    """Writes the weights of a face to a file while they come."""

    def __init__(self, path: Path, model: FaceModel) -> None:
        """Raises HriError when the file cannot be written."""
        self._model = model
        self._angles = _angles(model)
        arkit, named = [_channel(column) for column in TARGETS], model.index
        self._numbers = [named.get(channel) for channel in arkit]
        taken = {*arkit, *self._angles}
        self._extras = [channel for channel in model.channels if channel not in taken]
        self._extra_numbers = [named[channel] for channel in self._extras]
        self._head = [(named.get(channel), radians) for channel, radians in self._angles.items()]
        self._begin: float | None = None
        self._file = GrowingFile(path)
        self._write([TIMECODE, COUNT, *COLUMNS, *self._extras])

    def write(self, now: float, vector: Vector) -> None:
        """Add the weights of all channels at a time; the first time becomes 0."""
        self._begin = now if self._begin is None else self._begin
        values = [0.0 if number is None else vector[number] for number in self._numbers]
        angles = [0.0 if n is None else radians * vector[n] for n, radians in self._head]
        extras = [vector[number] for number in self._extra_numbers]
        row = [*values, *angles, *(0.0 for _ in EYES), *extras]
        self._write(
            [timecode(now - self._begin), str(len(COLUMNS)), *(f"{float(v):.6g}" for v in row)]
        )

    def close(self) -> None:
        """End the file; a second call does nothing."""
        self._file.close()

    def _write(self, cells: Sequence[str]) -> None:
        self._file.append((",".join(cells) + "\n").encode())


def read_weights(path: Path, model: FaceModel) -> Track:
    """The recording of a file, to be played on a face; columns the face lacks are left out.

    Raises AuthoringError with the place of what is wrong, HriError for a file that cannot be read.
    """
    with read_lines(path, "recording of a face", MOST_BYTES, LONGEST_LINE) as lines:
        return _track(path, csv.reader(lines), model)


def timecode(seconds: float) -> str:
    """hours:minutes:seconds:frames.thousandths of a frame."""
    thousandths = round(seconds % DAY * FRAMES * 1000)
    frames, rest = divmod(thousandths, 1000)
    whole, frame = divmod(frames, FRAMES)
    minutes, second = divmod(whole, 60)
    hour, minute = divmod(minutes, 60)
    return f"{hour:02}:{minute:02}:{second:02}:{frame:02}.{rest:03}"


def _track(path: Path, lines: Iterator[list[str]], model: FaceModel) -> Track:
    times: list[float] = []
    weights = array("f")
    number, header = 1, tuple[str, ...]()
    places: list[tuple[int, int, float]] = []
    try:
        header = tuple(cell.strip() for cell in next(lines, []))
        places = _places(path, header, model)
        at = header.index(TIMECODE)
        for number, cells in enumerate(lines, start=2):
            if not any(cells):
                continue
            if len(cells) != len(header):
                what = f"{len(cells)} cells in a row"
                raise _wrong(path, number, what, f"write {len(header)}, as in the first line")
            time = _seconds(path, number, cells[at])
            if times and time < times[0] - DAY / 2:  # it went past midnight
                time += DAY
            if times and time <= times[-1]:
                if time == times[-1]:  # the app repeats a frame when it is late
                    continue
                raise _wrong(path, number, "the time goes back", "sort the rows by Timecode")
            times.append(time)
            if len(times) > MOST_ROWS or time - times[0] > LONGEST:
                what = f"longer than {LONGEST:g} s at {FRAMES} frames a second"
                raise _wrong(path, number, what, "cut it into parts")
            weights.extend(_row(path, number, header, cells, places, len(model.channels)))
    except csv.Error as error:
        raise _wrong(path, number, str(error), "save it as plain CSV") from error
    if len(times) < 2:
        raise _wrong(path, number, f"{len(times)} rows of weights", "record two at least")
    moments = np.array(times) - times[0]
    size = len(model.channels)
    # What is recorded is the whole face: it owns every channel from begin to end.
    rows = np.frombuffer(weights, np.float32).reshape(-1, size)
    gaze = np.zeros((len(rows), 2), np.float32)
    return Track(moments, rows, gaze, np.ones(size), fade=0.0)


def _places(path: Path, header: Sequence[str], model: FaceModel) -> list[tuple[int, int, float]]:
    """Columns to read, the channels they feed, and by what they are multiplied."""
    if TIMECODE not in header:
        what = "no column Timecode"
        raise _wrong(path, 1, what, "write the names of the columns into the first line")
    if len(header) > MOST_COLUMNS:
        raise _wrong(path, 1, f"{len(header)} columns", f"keep to {MOST_COLUMNS}")
    twice = {name for name in header if name and header.count(name) > 1}
    if twice:
        raise _wrong(path, 1, f"the column {min(twice)} is there twice", "delete one")
    angles, named = _angles(model), model.index
    found = []
    for column, name in enumerate(header):
        channel = _channel(name)
        if channel in named and name not in EYES:
            radians = angles.get(channel, 1.0)
            found.append((column, named[channel], 1 / radians if radians else 0.0))
    if not found:
        what = f"no column for the face {model.name}"
        raise _wrong(path, 1, what, "write some of Live Link's, such as JawOpen")
    return found


def _row(
    path: Path,
    number: int,
    header: Sequence[str],
    cells: Sequence[str],
    places: Sequence[tuple[int, int, float]],
    size: int,
) -> list[float]:
    row = [0.0] * size
    for column, channel, factor in places:
        try:
            value = float(cells[column] or 0.0)
        except ValueError:
            value = math.nan
        if not abs(value) <= LARGEST:  # also NaN
            what = f"{header[column]} is {cells[column]:.40}"
            raise _wrong(path, number, what, f"write a number from -{LARGEST:g} to {LARGEST:g}")
        row[channel] = value * factor
    return row


def _seconds(path: Path, number: int, text: str) -> float:
    match = _TIME.fullmatch(text.strip())
    if match is None:
        what = f'"{text:.40}" is not a timecode'
        raise _wrong(path, number, what, "write hours:minutes:seconds:frames, as 00:00:01:30.000")
    hours, minutes, seconds, frames = (float(part) for part in match.groups())
    return hours * 3600 + minutes * 60 + seconds + frames / FRAMES


def _angles(model: FaceModel) -> dict[str, float]:
    """Radians that the turns of the head are when their weight is 1."""
    head = model.settings.head
    yaw, pitch = (0.0, 0.0) if head is None else (head.yaw, head.pitch)
    degrees = {"headYaw": yaw, "headPitch": pitch, "headRoll": model.settings.motion.roll}
    return {channel: math.radians(angle) for channel, angle in degrees.items()}


def _channel(column: str) -> str:
    """Ours for a name of Live Link's."""
    return column[:1].lower() + column[1:]


def _wrong(path: Path, line: int, what: str, remedy: str) -> AuthoringError:
    return AuthoringError(Place(path, line, 1), what, remedy)
