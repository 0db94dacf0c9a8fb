"""What the outputs of a running network sent, for the page: the newest since it looked last.

Between two looks a fast network ticks several times: what was sent once is shown all the same.
"""

from __future__ import annotations

import base64
import dataclasses
import math
from typing import Any

import cv2
import numpy as np

from hri.behavior.board import BOARD, BoardSink, BoardSource
from hri.behavior.ports import OutputPort
from hri.behavior.runner import Runner
from hri.core.signals import Frame
from hri.studio.topics import PortValues

LONGEST_TEXT = 80
"""Letters."""
MOST_NUMBERS = 8
"""Of an array."""
MOST_FIELDS = 4
"""Of anything else."""
THUMBNAIL = 96
"""Pixels of width."""
DIGITS = 6
_QUALITY = (cv2.IMWRITE_JPEG_QUALITY, 70)


class PortSampler:
    """Follows a runner from its next tick on, until `close`."""

    def __init__(self, runner: Runner) -> None:
        self._runner = runner
        self._ports = _ports_of(runner)
        self._sent: dict[str, Any] = {}
        self._told: PortValues | None = None
        self._images: dict[str, Frame] = {}
        runner.after_tick.append(self._take)

    def close(self) -> None:
        """Follow it no more; a second call does nothing."""
        if self._take in self._runner.after_tick:
            self._runner.after_tick.remove(self._take)

    def _take(self, now: float) -> None:
        # The inner loop of all that is watched: references alone are kept here.
        sent = self._sent
        for name, port in self._ports:
            if port.value is not None:
                sent[name] = port.value
        self._now = now

    def look(self) -> PortValues | None:
        """What was sent since the last look; the same as then while it has not ticked."""
        statistics = self._runner.statistics
        if self._told is not None and self._told["tick"] == statistics.ticks:
            return self._told
        if statistics.ticks == 0:
            return None
        sent, self._sent = self._sent, {}
        self._images |= {name: value for name, value in sent.items() if isinstance(value, Frame)}
        self._told = {
            "t": round(self._now, 3),
            "tick": statistics.ticks,
            "values": {name: shown(sent.get(name)) for name, _ in self._ports},
            "cost": {
                id: [
                    round(1e6 * timing.last, 1),
                    round(1e6 * timing.mean, 1),
                    round(1e6 * timing.longest, 1),
                    timing.missed,
                ]
                for id, timing in statistics.behaviors.items()
            },
            "resting": self._runner.resting,
        }
        return self._told

    _now = 0.0

    def thumbnail(self, port: str) -> str | None:
        """The newest picture of an output as base64 of a JPEG; None where it sent none."""
        frame = self._images.get(port)
        return None if frame is None else _small(frame.image)


def _ports_of(runner: Runner) -> list[tuple[str, OutputPort[Any]]]:
    """All outputs by `behavior.output`, and the slots that the network uses by `board.slot`."""
    ports: dict[str, OutputPort[Any]] = {}
    for behavior in runner.network.behaviors:
        if not isinstance(behavior, BoardSink):
            for name in behavior.outputs:
                ports[f"{behavior.id}.{name}"] = behavior.output_port(name)
    for link in runner.network.links:
        if isinstance(link.target, BoardSink) and not isinstance(link.source, BoardSource):
            ports[f"{BOARD}.{link.input}"] = link.source.output_port(link.output)
    return list(ports.items())


def shown(value: Any) -> Any:
    """A value as JSON has it, and not longer than a person reads on a wire."""
    if value is None or isinstance(value, (bool, int)):
        return value
    if isinstance(value, float):
        return float(f"{value:.{DIGITS}g}") if math.isfinite(value) else str(value)
    if isinstance(value, str):
        return value[:LONGEST_TEXT]
    if isinstance(value, Frame):
        height, width = value.image.shape[:2]
        return {"kind": "image", "width": width, "height": height}
    if isinstance(value, np.ndarray) or (isinstance(value, tuple) and _is_numbers(value)):
        array = np.asarray(value)
        head = [shown(float(one)) for one in array.ravel()[:MOST_NUMBERS]]
        return {"kind": "array", "shape": list(array.shape), "head": head}
    return {"kind": "value", "text": _in_words(value)[:LONGEST_TEXT]}


def _is_numbers(value: tuple[Any, ...]) -> bool:
    return not hasattr(value, "_fields") and all(isinstance(one, float) for one in value[:2])


def _in_words(value: Any) -> str:
    """The first plain fields of what has fields, else its type: its whole text may be very long."""
    if dataclasses.is_dataclass(value):
        names = [field.name for field in dataclasses.fields(value)]
    else:
        names = list(getattr(value, "_fields", ()))
    plain = [(name, shown(getattr(value, name))) for name in names[: 2 * MOST_FIELDS]]
    plain = [(name, one) for name, one in plain if isinstance(one, (bool, int, float, str))]
    words = ", ".join(f"{name} {one}" for name, one in plain[:MOST_FIELDS])
    count = f"{len(value)} of them" if isinstance(value, (tuple, list)) and not names else ""
    return words or count or type(value).__name__


def _small(image: np.ndarray) -> str:
    height, width = image.shape[:2]
    size = (THUMBNAIL, max(1, round(THUMBNAIL * height / width)))
    small = cv2.cvtColor(cv2.resize(image, size, interpolation=cv2.INTER_AREA), cv2.COLOR_RGB2BGR)
    _, data = cv2.imencode(".jpg", small, _QUALITY)
    return base64.b64encode(data.tobytes()).decode()
