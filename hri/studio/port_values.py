"""What the outputs of a running network sent, for the page: the newest since it looked last.

Between two looks a fast network ticks several times: what was sent once is shown all the same. The
robot's loop keeps references alone; the thread that writes to the page's server makes text of them.
"""

from __future__ import annotations

import base64
import dataclasses
import json
import math
from collections import deque
from collections.abc import Sequence
from typing import Any

import cv2
import numpy as np

from hri.behavior.board import BOARD, BoardSink
from hri.behavior.ports import OutputPort
from hri.behavior.runner import Runner
from hri.core.signals import Frame, Image

LONGEST_TEXT = 80
"""Letters."""
MOST_NUMBERS = 8
"""Of an array."""
MOST_FIELDS = 4
"""Of anything else."""
THUMBNAIL = 96
"""Pixels of width."""
MOST_TICKS = 64
"""Ticks that are kept until the next look; older ones are forgotten."""
COST_EVERY = 0.5
"""Seconds after which the costs are told again."""
_QUALITY = (cv2.IMWRITE_JPEG_QUALITY, 70)

Row = tuple[float, Sequence[Any]]
"""The time of a tick, seconds, and what each output sent in it, None for nothing."""


class PortSampler:
    """Follows a runner from its next tick on, until `close`; used in the robot's loop."""

    def __init__(self, runner: Runner) -> None:
        self._runner = runner
        self._names, self._ports = _ports_of(runner)
        self._rows: deque[Row] = deque(maxlen=MOST_TICKS)
        self._teller = _Teller(list(self._names), list(self._names.values()), runner)
        runner.after_tick.append(self._take)

    def close(self) -> None:
        """Follow it no more; a second call does nothing."""
        if self._take in self._runner.after_tick:
            self._runner.after_tick.remove(self._take)

    def _take(self, now: float) -> None:
        # All that being watched costs a tick.
        self._rows.append((now, [port.value for port in self._ports]))

    def look(self) -> Sample | None:
        """What was sent since the last look; None where nothing has ticked."""
        if not self._rows:
            return None
        rows, self._rows = self._rows, deque(maxlen=MOST_TICKS)
        ticks = self._runner.statistics.ticks
        return Sample(self._teller, rows, ticks, self._runner.resting)

    def picture(self, port: str) -> Frame | None:
        """The newest picture of an output since the last look; None where it sent none."""
        for _, values in reversed(self._rows):
            for index in self._names.get(port, ()):
                if isinstance(values[index], Frame):
                    found: Frame = values[index]
                    return found
        return None


class Sample:
    """What a network sent between two looks."""

    def __init__(
        self, teller: _Teller, rows: Sequence[Row], ticks: int, resting: list[str]
    ) -> None:
        self._teller, self._rows, self._ticks, self._resting = teller, rows, ticks, resting
        self._text = ""

    def written(self) -> str:
        """As JSON has a `PortValues`; made once, in the thread that writes."""
        if not self._text:
            self._text = self._teller.told(self._rows, self._ticks, self._resting)
            self._rows = ()
        return self._text


class _Teller:
    """Writes the samples of one network."""

    def __init__(self, names: list[str], places: list[list[int]], runner: Runner) -> None:
        """`places`: where in a row stands what may be the value of each name, the first counts."""
        self._heads = [
            (f"{json.dumps(name)}:", place) for name, place in zip(names, places, strict=True)
        ]
        self._timings = [(json.dumps(id), t) for id, t in runner.statistics.behaviors.items()]
        self._cost, self._cost_until = "", -math.inf

    def told(self, rows: Sequence[Row], ticks: int, resting: list[str]) -> str:
        """A `PortValues` as JSON."""
        newest = list(reversed(rows))
        now = newest[0][0]
        if now >= self._cost_until:
            self._cost, self._cost_until = self._costs(), now + COST_EVERY
        values = ",".join(head + written(_newest(newest, place)) for head, place in self._heads)
        return (
            f'{{"t":{now:.3f},"tick":{ticks},"values":{{{values}}},"cost":{{{self._cost}}},'
            f'"resting":{json.dumps(resting)}}}'
        )

    def _costs(self) -> str:
        return ",".join(
            f"{id}:[{1e6 * one.last:.1f},{1e6 * one.mean:.1f},{1e6 * one.longest:.1f},{one.missed}]"
            for id, one in self._timings
        )


def _newest(rows: Sequence[Row], places: list[int]) -> Any:
    """What was sent last; `rows` begin with the newest."""
    for _, values in rows:
        for index in places:
            if values[index] is not None:
                return values[index]
    return None


def _ports_of(runner: Runner) -> tuple[dict[str, list[int]], list[OutputPort[Any]]]:
    """All outputs, and by `behavior.output` and `board.slot` where they stand among them."""
    names: dict[str, list[int]] = {}
    ports: list[OutputPort[Any]] = []
    for behavior in runner.network.behaviors:
        for name in behavior.outputs:
            names[f"{behavior.id}.{name}"] = [len(ports)]
            ports.append(behavior.output_port(name))
    places = {id(port): index for index, port in enumerate(ports)}
    slots: dict[str, list[int]] = {}
    for link in runner.network.links:
        if isinstance(link.target, BoardSink):
            sent = link.source.output_port(link.output)
            slots.setdefault(f"{BOARD}.{link.input}", []).append(places[id(sent)])
    return names | slots, ports  # the value that it writes to a slot goes first


def written(value: Any) -> str:
    """A value as JSON; whatever it is, this raises nothing."""
    # Plain numbers first: they are most of what flows, twenty times a second.
    if type(value) is float:
        return f"{value:.6g}" if math.isfinite(value) else f'"{value}"'
    if value is None:
        return "null"
    try:
        return json.dumps(shown(value), allow_nan=False)
    except Exception:  # what an author's own value does when it is looked at
        return json.dumps({"kind": "value", "text": type(value).__name__[:LONGEST_TEXT]})


def shown(value: Any) -> Any:
    """A value of plain types, and not longer than a person reads on a wire."""
    if value is None or isinstance(value, (bool, int)):
        return value
    if isinstance(value, float):
        return float(f"{value:.6g}") if math.isfinite(value) else str(value)
    if isinstance(value, str):
        return value[:LONGEST_TEXT]
    if isinstance(value, Frame):
        height, width = value.image.shape[:2]
        return {"kind": "image", "width": width, "height": height}
    if isinstance(value, np.ndarray):
        head = [shown(float(one)) for one in value.flat[:MOST_NUMBERS]]
        return {"kind": "array", "shape": list(value.shape), "head": head}
    if isinstance(value, tuple) and _is_numbers(value):
        head = [shown(float(one)) for one in value[:MOST_NUMBERS]]
        return {"kind": "array", "shape": [len(value)], "head": head}
    return {"kind": "value", "text": _in_words(value)[:LONGEST_TEXT]}


def _is_numbers(value: tuple[Any, ...]) -> bool:
    is_plain = not hasattr(value, "_fields")
    return is_plain and all(isinstance(one, (float, int)) for one in value[:MOST_NUMBERS])


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


def thumbnail(image: Image) -> str:
    """A picture, at most `THUMBNAIL` pixels wide, as base64 of a JPEG."""
    height, width = image.shape[:2]
    wide = min(width, THUMBNAIL)
    size = (wide, max(1, round(wide * height / width)))
    small = cv2.cvtColor(cv2.resize(image, size, interpolation=cv2.INTER_AREA), cv2.COLOR_RGB2BGR)
    _, data = cv2.imencode(".jpg", small, _QUALITY)
    return base64.b64encode(data.tobytes()).decode()
