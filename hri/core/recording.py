"""The log of what happened: one JSON object a line."""

from __future__ import annotations

import contextlib
import json
import logging
import math
from collections.abc import Collection, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from hri.core.errors import HriError
from hri.core.events import EventBus
from hri.core.signals import Event

NOTHING: Mapping[str, Collection[str]] = MappingProxyType({})

log = logging.getLogger("hri.recording")


class EventLog:
    """Writes every event to a file: `t` in seconds, `event`, and the event's properties."""

    def __init__(
        self, path: Path, events: EventBus, withheld: Mapping[str, Collection[str]] = NOTHING
    ) -> None:
        """`withheld` names properties that are written empty, by the name of the event.

        Raises HriError when the file cannot be written.
        """
        self._withheld = withheld
        try:
            self._file = path.open("w", encoding="utf-8")
        except OSError as error:
            raise HriError(f"{path}: cannot write: {error.strerror} - check the folder") from error
        self._subscription = events.subscribe("*", self.write)

    def write(self, event: Event) -> None:
        withheld = self._withheld.get(event.name, ())
        told = {key: "" if key in withheld else value for key, value in event.properties.items()}
        line = {"t": round(event.time, 4), "event": event.name, **told}
        try:
            self._file.write(json.dumps(_plain(line), ensure_ascii=False, allow_nan=False) + "\n")
            self._file.flush()
        except OSError as error:
            self._subscription.cancel()
            log.error("the log of events ends here: %s", error.strerror)

    def close(self) -> None:
        """Stop listening; a second call does nothing."""
        self._subscription.cancel()
        with contextlib.suppress(OSError):  # a full disk was told about when it filled up
            self._file.close()


def read_events(path: Path) -> list[dict[str, Any]]:
    """The lines of a log, oldest first."""
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]


def _plain(value: Any) -> Any:
    """JSON knows no infinity and no tuples of ours."""
    if isinstance(value, float) and not math.isfinite(value):
        return None
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    return value
