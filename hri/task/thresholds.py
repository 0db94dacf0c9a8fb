"""Events on the values of ports: `front.distance < 30 for 0.5 s` raises an event of your choice.

[network:]behavior.port[.field] < number [for number unit]

The comparisons are < <= > >= == !=. `field` is one of the port's value, such as `distance` of a
range reading; numbers are in the port's own units. The event is raised once when the comparison
has held for so long, and again only after it has failed meanwhile. A tick in which the port sends
nothing changes nothing.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, get_type_hints

from hri.behavior.ports import DATATYPES, Output
from hri.core.errors import AuthoringError, HriError, Place, did_you_mean
from hri.core.quantities import Quantity, factor
from hri.task.context import TaskContext

LONGEST = 500
"""Characters of a text."""

_COMPARISONS: dict[str, Callable[[Any, float], bool]] = {
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "==": operator.eq,
    "!=": operator.ne,
}
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_PORT = r"(?:(?P<network>[\w-]+):)?(?P<behavior>[\w-]+)\.(?P<port>\w+)(?:\.(?P<field>\w+))?"
_STEPS = {
    "a port": (re.compile(rf"\s*{_PORT}", re.ASCII), "write behavior.port"),
    "a comparison": (re.compile(r"\s*(?P<sign>[<>]=?|[=!]=)"), "write < <= > >= == or !="),
    "a number": (re.compile(rf"\s*(?P<limit>{_NUMBER})(?![\w.])", re.ASCII), "write such as 30"),
}
_FOR = re.compile(rf"\s+for\s+(?P<time>{_NUMBER})\s*(?P<unit>[a-z]+)\s*", re.ASCII)


@dataclass(frozen=True)
class Threshold:
    """A comparison of what a port sends with a number."""

    network: str
    """Empty: the only network with such a behavior."""
    behavior: str
    port: str
    field: str
    """Of the value; empty: the value itself."""
    sign: str
    limit: float
    seconds: float
    """For how long it must hold."""

    def holds(self, value: Any) -> bool:
        """Whether a value fits. Raises HriError for one that cannot be compared."""
        if self.field:
            self._check_field(value)
            value = getattr(value, self.field)
        self._check_number(type(value))
        return _COMPARISONS[self.sign](value, self.limit)

    def check(self, output: Output[Any]) -> None:
        """Check that an output can be compared, as far as declared. Raises HriError."""
        kind = DATATYPES[output.datatype]
        if self.field and kind is not object:
            self._check_field(kind)
            kind = get_type_hints(kind).get(self.field, object)
        # Values that may be numbers, and properties, are checked when they are sent.
        if isinstance(kind, type) and kind is not object:
            self._check_number(kind)

    def _check_field(self, owner: object) -> None:
        """`owner`: a value, or its type."""
        known = getattr(owner, "__dataclass_fields__", ())
        is_there = self.field in known or hasattr(owner, self.field)
        if not is_there or self.field.startswith("_"):
            what = f'{self.behavior}.{self.port} has no field "{self.field}"'
            raise HriError(f"{what} - {did_you_mean(self.field, known)}")

    def _check_number(self, kind: type) -> None:
        if not issubclass(kind, (int, float)):
            what = f"{self.behavior}.{self.port} sends a {kind.__name__}"
            raise HriError(f"{what} - compare a number of it")


def parse_threshold(text: str, path: Path = Path("-"), line: int = 1) -> Threshold:
    """Read one. Raises AuthoringError with its place."""
    if len(text) > LONGEST:
        what = f"{len(text)} characters for one threshold"
        raise AuthoringError(Place(path, line), what, f"write at most {LONGEST}")
    found: dict[str, str] = {}
    at = 0
    for wanted, (pattern, remedy) in _STEPS.items():
        step = pattern.match(text, at)
        if step is None:
            what = f'"{text[at:].strip()[:40]}" is not {wanted}'
            raise AuthoringError(Place(path, line, at + 1), what, remedy)
        found.update(step.groupdict())
        at = step.end()
    seconds = _seconds(text, at, path, line)
    limit = float(found.pop("limit"))
    words = {name: word or "" for name, word in found.items()}
    return Threshold(**words, limit=limit, seconds=seconds)


def _seconds(text: str, at: int, path: Path, line: int) -> float:
    if not text[at:].strip():
        return 0.0
    found = _FOR.fullmatch(text, at)
    place = Place(path, line, at + 1)
    if found is None:
        what = f'"{text[at:].strip()[:40]}" is not understood'
        raise AuthoringError(place, what, "write such as `for 0.5 s`")
    try:
        scale = factor(Quantity.TIME, found["unit"])
    except HriError as error:
        what, _, remedy = str(error).partition(" - ")
        raise AuthoringError(place, what, remedy) from error
    return max(0.0, float(found["time"]) * scale)


class Edge:
    """Turns "it holds" into one moment: when it has held for long enough."""

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self._since: float | None = None
        self._was_told = False

    def update(self, holds: bool, now: float) -> bool:
        """Whether this is the moment; `now` in seconds."""
        if not holds:
            self._since, self._was_told = None, False
            return False
        if self._since is None:
            self._since = now
        # Half a microsecond for the sum of many ticks.
        if self._was_told or now - self._since < self._seconds - 5e-7:
            return False
        self._was_told = True
        return True


@contextmanager
def raising(context: TaskContext, threshold: str | Threshold, name: str) -> Iterator[None]:
    """Raise an event of that name whenever a threshold is passed, while the body runs.

    Its property `value` is what the port sent. Raises HriError when no such port runs, or what it
    sends cannot be compared with a number. Ends, like every watch, when the network is swapped.
    """
    if isinstance(threshold, str):
        threshold = parse_threshold(threshold)
    limit, edge = threshold, Edge(threshold.seconds)

    def look(value: Any, now: float) -> None:
        if edge.update(limit.holds(value), now):
            number = getattr(value, limit.field) if limit.field else value
            context.events.raise_event(name, value=number)

    network = limit.network or _network_of(context, limit.behavior)
    watch = context.networks.watch(network, limit.behavior, limit.port, look)
    try:
        behavior = context.networks.runners[network].network[limit.behavior]
        limit.check(behavior.outputs[limit.port])
        yield
    finally:
        watch.cancel()


def _network_of(context: TaskContext, behavior: str) -> str:
    ids = {
        name: [behavior.id for behavior in runner.network.behaviors]
        for name, runner in context.networks.runners.items()
    }
    having = [name for name, known in ids.items() if behavior in known]
    if len(having) == 1:
        return having[0]
    if having:
        raise HriError(f'"{behavior}" is in {" and ".join(having)} - write {having[0]}:{behavior}')
    every = [id for known in ids.values() for id in known]
    raise HriError(f'no behavior "{behavior}" runs - {did_you_mean(behavior, every)}')
