"""Breakpoints: a network pauses after the tick in which a condition on one of its outputs holds."""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from hri.behavior.behavior import Behavior
from hri.behavior.board import BOARD, BoardSink, BoardSource
from hri.behavior.network import Network
from hri.behavior.ports import ANY, OutputPort
from hri.behavior.runner import Runner
from hri.core.errors import HriError, did_you_mean
from hri.core.expression import evaluate

Comparison = Callable[[Any, Any], bool]
COMPARISONS: Mapping[str, Comparison] = {
    "<=": operator.le,
    ">=": operator.ge,
    "==": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    ">": operator.gt,
}
SENT, CHANGES = "sent", "changes"
"""Conditions without a value: anything was sent; something else was sent than before."""
LONGEST = 100
"""Letters of a condition."""
_WRITTEN = re.compile(r"\s*(<=|>=|==|!=|<|>)\s*(\S.*?)\s*")
_WORDS = {"true": True, "false": False}
_DATATYPES: Mapping[type, str] = {float: "double", bool: "boolean", str: "string"}
"""What an output must be for its values to be compared with a number, true or false, or a text."""
_REMEDY = "write < 30, >= 0.5, == true, != hello, sent, or changes"


@dataclass(frozen=True)
class Condition:
    """What must hold for a value that an output sent."""

    text: str
    """As it was written."""
    comparison: Comparison | None = None
    operand: Any = None

    def check(self, port: str, datatype: str) -> None:
        """Raise HriError where no value of this datatype could ever fit."""
        wanted = _DATATYPES[type(self.operand)] if self.comparison else ANY
        if ANY not in (wanted, datatype) and wanted != datatype:
            fitting = {"double": "< 30", "boolean": "== true", "string": "== hello"}
            remedy = f"write {fitting.get(datatype, CHANGES)}, or sent"
            raise HriError(f'"{self.text}" fits no {datatype}, which {port} is - {remedy}')

    def holds(self, value: Any, before: Any) -> bool:
        """Whether it holds; `before` is what was sent last. What cannot be compared never does."""
        if self.text == SENT:
            return True
        if self.text == CHANGES:
            return before is not None and bool(_differ(value, before))
        try:
            assert self.comparison is not None, "parse_condition sets it"
            return bool(self.comparison(value, self.operand))
        except (TypeError, ValueError):
            return False


def _differ(value: Any, before: Any) -> bool:
    try:
        return bool(value != before)
    except ValueError:  # arrays
        return value is not before


def parse_condition(text: str) -> Condition:
    """Read `< 30`, `== true`, `changes`, or `sent`. Raises HriError."""
    if text.strip() in (SENT, CHANGES):
        return Condition(text.strip())
    found = _WRITTEN.fullmatch(text)
    if found is None or len(text) > LONGEST:
        raise HriError(f'"{text[:LONGEST]}" is not a condition - {_REMEDY}')
    sign, written = found.groups()
    operand = _operand(written)
    if sign in ("<", ">", "<=", ">=") and not isinstance(operand, float):
        raise HriError(f'"{written}" is not a number - {_REMEDY}')
    return Condition(f"{sign} {written}", COMPARISONS[sign], operand)


def _operand(written: str) -> Any:
    if written.lower() in _WORDS:
        return _WORDS[written.lower()]
    try:
        return float(evaluate(written))
    except ValueError:
        return written.strip("\"'")


class Breakpoint:
    """Pauses a runner when a condition holds for what an output sent."""

    def __init__(self, runner: Runner, port: str, condition: str) -> None:
        """`port` is `behavior.output`, or `board.slot` for what the network writes or reads there.

        Raises HriError for one that is not there, or for which the condition makes no sense.
        """
        self.port, self.condition = port, parse_condition(condition)
        behavior, output = _sender(runner.network, port)
        self.condition.check(port, behavior.output_named(output).datatype)
        self._output: OutputPort[Any] = behavior.output_port(output)
        self._runner, self._before = runner, None
        self._runner.after_tick.append(self._look)

    def cancel(self) -> None:
        """End it; a second call does nothing."""
        if self._look in self._runner.after_tick:
            self._runner.after_tick.remove(self._look)

    def _look(self, now: float) -> None:
        value = self._output.value
        if value is None:
            return
        before, self._before = self._before, value
        if self.condition.holds(value, before):
            words = _in_words(value)
            self._runner.pause(f"{self.port} {self.condition.text}: {words}", self.port, words)


def _sender(network: Network, port: str) -> tuple[Behavior, str]:
    """The behavior that sends it, and the name of its output. Raises HriError."""
    id, _, name = port.partition(".")
    if id != BOARD or any(one.id == BOARD for one in network.authored):
        return network[id], name
    slots: dict[str, tuple[Behavior, str]] = {}
    for link in network.links:
        if isinstance(link.source, BoardSource):
            slots.setdefault(link.output, (link.source, link.output))
        if isinstance(link.target, BoardSink):
            slots[link.input] = link.source, link.output
    if name not in slots:
        what = f"network {network.name} neither reads nor writes {port}"
        raise HriError(f"{what} - {did_you_mean(name, slots, 'name an output')}")
    return slots[name]


def _in_words(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else f"{value!r:.60}"
