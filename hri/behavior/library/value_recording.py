"""Values of a port written to a file while a network runs, and sent again later.

A file has one JSON object a line: `{"t": 0.1, "value": 3.0}`, with `t` in seconds since the
recorder started. Numbers, texts, truths and arrays of numbers can be recorded.
"""

from __future__ import annotations

import json
import logging
import math
from pathlib import Path
from typing import Any

from hri.behavior.behavior import Behavior, Context
from hri.behavior.effects import NOTHING
from hri.behavior.library.timing import TOLERANCE
from hri.behavior.ports import DBL_MAX, Input, Output, Param
from hri.core.errors import AuthoringError, HriError, Place
from hri.core.growing_files import GrowingFile
from hri.core.reading import parse_json, read_text

log = logging.getLogger("hri.behavior")

MOST_LINES = 10_000_000


class ValueRecorder(Behavior):
    """Writes all that comes in to a file, with its time; several links give several lines."""

    may_do = NOTHING
    file = Param("values.jsonl", "file to write; an existing one is overwritten")
    max_lines = Param(100_000, "then it stops recording", minimum=1, maximum=MOST_LINES)
    input = Input[Any]("any", "numbers, texts, truths or arrays")

    def start(self, context: Context) -> None:
        self._file = GrowingFile(Path(self.file))
        self._begin = context.clock.now()
        self._lines = 0

    def compute(self, now: float, dt: float) -> None:
        for value in self.input.values:
            if self._lines < self.max_lines:
                line = json.dumps({"t": round(now - self._begin, 6), "value": _plain(value)})
                self._file.append(f"{line}\n".encode())
                self._lines += 1
                if self._lines == self.max_lines:
                    log.warning("%s: %s is full - raise max_lines", self.id, self.file)

    def stop(self) -> None:
        self._file.close()


class ValuePlayer(Behavior):
    """Sends what a recorder has written, at the same times after its start, then nothing."""

    file = Param("values.jsonl", "a file that a ValueRecorder wrote")
    value = Output[Any]("any", "the recorded value; the newest when several are due at once")

    def check(self) -> None:
        path = Path(self.file)
        lines = read_text(path, "recording").splitlines()
        self._values = [_read(line, Place(path, i)) for i, line in enumerate(lines, 1)]

    def start(self, context: Context) -> None:
        self._begin = context.clock.now()
        self._next = 0

    def compute(self, now: float, dt: float) -> None:
        due = now - self._begin + TOLERANCE
        while self._next < len(self._values) and self._values[self._next][0] <= due:
            self.value.send(self._values[self._next][1])
            self._next += 1


def _plain(value: object) -> object:
    """What JSON can hold; infinity becomes the largest number there is, as when it is printed."""
    match value:
        case bool() | str():
            return value
        case int() | float() if not math.isnan(value):
            return max(-DBL_MAX, min(DBL_MAX, value))
        case tuple():
            return [_plain(element) for element in value]
    kind = type(value).__name__
    raise HriError(f"no value of type {kind} can be recorded - link a number, text or array")


def _read(line: str, place: Place) -> tuple[float, Any]:
    remedy = 'write {"t": 0.1, "value": 3}, with a number, text, truth or array'
    value: Any
    try:
        match parse_json(line):
            case {"t": int() | float() as time, "value": bool() | str() as word, **rest}:
                value = word
            case {"t": int() | float() as time, "value": int() | float() as number, **rest}:
                value = float(number)
            case {"t": int() | float() as time, "value": list() as elements, **rest}:
                value = tuple(map(float, elements))
            case _:
                raise AuthoringError(place, "this is not a recorded value", remedy)
    except (ValueError, TypeError, OverflowError) as error:
        raise AuthoringError(place, "this is not a recorded value", remedy) from error
    if rest:
        raise AuthoringError(place, f'"{next(iter(rest))}" has no place here', remedy)
    return float(time), value
