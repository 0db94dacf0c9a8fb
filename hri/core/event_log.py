"""The log of what happened: one JSON object a line."""

from __future__ import annotations

import json
import logging
import math
from collections.abc import Collection, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from hri.core.errors import AuthoringError, Place
from hri.core.event_bus import EventBus
from hri.core.growing_files import GrowingFile
from hri.core.reading import parse_json, read_lines
from hri.core.signals import Event

log = logging.getLogger("hri.recording")

NOTHING: Mapping[str, Collection[str]] = MappingProxyType({})

LARGEST_LOG = 25_000_000
"""Bytes of a log of events: some hours of a busy robot."""
LONGEST_LINE = 1_000_000
"""Characters of an event."""
_REMEDY = "delete this line, or record again"


class EventLog:
    """Writes every event to a file: `t` in seconds, `event`, and the event's properties.

    What JSON does not have is written as text; of an event beyond LONGEST_LINE, `omitted` has the
    characters that were left out. An event that was caused from outside has an `origin`, one that
    another program raised also `"outside": true`.
    """

    def __init__(
        self, path: Path, events: EventBus, withheld: Mapping[str, Collection[str]] = NOTHING
    ) -> None:
        """`withheld` names properties that are written empty, by the name of the event.

        Raises HriError when the file cannot be written, or another program writes it now.
        """
        self._withheld = withheld
        self._file = GrowingFile(path)
        self._subscription = events.subscribe("*", self.write)

    def write(self, event: Event) -> None:
        withheld = self._withheld.get(event.name, ())
        told = {key: "" if key in withheld else value for key, value in event.properties.items()}
        own = {"t": round(event.time, 4), "event": event.name}
        if event.is_from_outside:
            own["outside"] = True
        if event.origin:
            own["origin"] = event.origin
        line = _line({**own, **told, **own})
        if len(line) >= LONGEST_LINE - 1:  # no reader would take the log any more
            log.warning("%s of %d characters is recorded without properties", event.name, len(line))
            line = _line({**own, "omitted": len(line)})
        if not self._file.append(f"{line}\n".encode()):
            self._subscription.cancel()

    def close(self) -> None:
        """Stop listening; a second call does nothing."""
        self._subscription.cancel()
        self._file.close()


def read_events(path: Path) -> list[dict[str, Any]]:
    """The lines of a log, oldest first.

    A last line that has no end was cut off, and is left out. Raises HriError for a file that cannot
    be read, AuthoringError for a line that is not an event.
    """
    # A last line may have been cut off in the middle of a letter.
    with read_lines(
        path, "log of events", LARGEST_LOG, LONGEST_LINE, errors="surrogateescape"
    ) as lines:
        return [
            _read(line, path, number)
            for number, line in enumerate(lines, 1)
            if line.endswith("\n") and line.strip()
        ]


def _read(line: str, path: Path, number: int) -> dict[str, Any]:
    if not _is_text(line):
        raise AuthoringError(Place(path, number), "not UTF-8 text", _REMEDY)
    try:
        found = parse_json(line)
    except ValueError as error:
        raise AuthoringError(Place(path, number), f"not JSON: {error}", _REMEDY) from error
    if not (isinstance(found, dict) and "event" in found and "t" in found):
        raise AuthoringError(Place(path, number), "not an event", _REMEDY)
    return found


def _line(values: dict[str, Any]) -> str:
    line = json.dumps(_plain(values), ensure_ascii=False, allow_nan=False)
    # Halves of letters, which UTF-8 does not have, are spelled out as JSON can.
    return line if _is_text(line) else json.dumps(_plain(values), allow_nan=False)


def _is_text(line: str) -> bool:
    try:
        line.encode("utf-8")
    except UnicodeEncodeError:
        return False
    return True


def _plain(value: Any) -> Any:
    """JSON knows no infinity, no tuples of ours, and nothing of an app's."""
    if isinstance(value, float) and not math.isfinite(value):
        return None
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if isinstance(value, np.generic):
        return _plain(value.item())
    return value if value is None or isinstance(value, (str, int, float)) else str(value)
