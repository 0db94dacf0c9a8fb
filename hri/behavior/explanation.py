"""Why a port of a running network has its value: the way back through the links to what decided.

A behavior that knows which inputs decided says so in `Behavior.explain_output`. For any other, all
inputs that brought something count.
"""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Any

from hri.behavior.behavior import Behavior
from hri.behavior.board import BoardSink, BoardSource
from hri.behavior.network import Network
from hri.behavior.reason import Arrived, Reason
from hri.core.errors import HriError, did_you_mean

log = logging.getLogger("hri.network")

MOST_STEPS = 40
"""Outputs on the way back that are named."""


@dataclass(frozen=True, slots=True)
class Step:
    """One output on the way back."""

    port: str
    """`behavior.output`, or `board.slot`; `behavior.input` for an input that no link reaches."""
    value: Any
    words: str


def why(network: Network, port: str, resting: Collection[str] = ()) -> list[Step]:
    """The way back from an output, an input or a slot, nearest first, by the last tick.

    `resting`: the ids of the behaviors that rest after an error. Raises HriError for a port that
    the network does not have.
    """
    ports = _Ports(network, resting)
    waiting = deque(ports.starts(port))
    if not waiting:
        return [Step(port, None, f"nothing was sent: nothing reaches {port}")]
    steps: dict[str, Step] = {}
    while waiting and len(steps) < MOST_STEPS:
        name = waiting.popleft()
        if name not in steps:
            reason = ports.reason(name)
            steps[name] = Step(name, ports.value(name), reason.words)
            waiting += [one.source for one in reason.decisive]
    return list(steps.values())


class _Ports:
    """The outputs and slots of a network by name, and what leads to them."""

    def __init__(self, network: Network, resting: Collection[str]) -> None:
        self._network, self._resting = network, resting
        behaviors = network.behaviors
        self._outputs = {f"{b.id}.{name}": (b, name) for b in behaviors for name in b.outputs}
        self._inputs = {f"{b.id}.{name}": (b, name) for b in behaviors for name in b.inputs}

    def starts(self, port: str) -> list[str]:
        """The port itself, of an input the outputs that are linked to it. Raises HriError."""
        if port in self._outputs or self._is_slot(port):
            return [port]
        if port in self._inputs:
            return self._sources(port)
        remedy = did_you_mean(port, [*self._outputs, *self._inputs])
        raise HriError(f'network {self._network.name} has no port "{port}" - {remedy}')

    def value(self, port: str) -> Any:
        if port in self._outputs:
            behavior, name = self._outputs[port]
            return behavior.output_port(name).value
        behavior, name = self._inputs[port]
        return behavior.input_port(name).value

    def reason(self, port: str) -> Reason:
        if self._is_slot(port):
            return self._of_slot(port)
        behavior, output = self._outputs[port]
        if behavior.id in self._resting:
            return Reason(f"{behavior.id} rests after an error - the log says which")
        arrived = [
            self._arrived(f"{link.source.id}.{link.output}", link.input)
            for link in self._network.links
            if link.target is behavior
        ]
        value = self.value(port)
        if not arrived:
            return self._alone(behavior, value)
        return self._decided(behavior, output, value, arrived)

    def _is_slot(self, port: str) -> bool:
        known = self._outputs.get(port) or self._inputs.get(port)
        return known is not None and isinstance(known[0], BoardSource | BoardSink)

    def _sources(self, port: str) -> list[str]:
        """The outputs that links lead from to an input, or to a slot."""
        links = self._network.links
        return [f"{o.source.id}.{o.output}" for o in links if f"{o.target.id}.{o.input}" == port]

    def _arrived(self, source: str, input: str) -> Arrived:
        return Arrived(source, input, self.value(source))

    def _of_slot(self, slot: str) -> Reason:
        writers = self._sources(slot)
        if not writers:
            return Reason("read from the board: another network or a task writes it")
        arrived = [self._arrived(writer, slot) for writer in writers]
        return Reason(f"written by {', '.join(writers)}", arrived)

    def _type(self, behavior: Behavior) -> str:
        return self._network.types.get(behavior.id, type(behavior).__name__)

    def _alone(self, behavior: Behavior, value: Any) -> Reason:
        """Of a behavior that no link reaches."""
        kind = self._type(behavior)
        if behavior.is_sensor:
            silent = ": its device sends nothing now" if value is None else ""
            return Reason(f"{kind} senses it{silent}")
        needed = [name for name, one in behavior.inputs.items() if not one.is_optional]
        if value is None and needed:
            ports = ", ".join(f"{behavior.id}.{name}" for name in needed)
            return Reason(f"nothing was sent: nothing reaches {ports}")
        given = ", ".join(
            f"{name} = {getattr(behavior, name)}"
            for name, one in behavior.parameters.items()
            if not behavior.inputs or getattr(behavior, name) != one.default
        )
        return Reason(f"{kind} makes it{f': {given}' if given else ''}")

    def _decided(
        self, behavior: Behavior, output: str, value: Any, arrived: Sequence[Arrived]
    ) -> Reason:
        """Of a behavior that links reach."""
        sent = [one for one in arrived if one.value is not None]
        if value is None and not sent:
            words = f"nothing was sent: nothing came to {behavior.id} in this tick"
            return Reason(words, arrived)
        if (reason := _own_reason(behavior, output, value, arrived)) is not None:
            return reason
        if value is not None:
            return Reason(f"{self._type(behavior)} makes it of its inputs", sent or arrived)
        return self._missing(behavior, arrived)

    def _missing(self, behavior: Behavior, arrived: Sequence[Arrived]) -> Reason:
        """Of one that sends nothing although something came."""
        came = {one.input for one in arrived if one.value is not None}
        inputs = behavior.inputs.items()
        missing = [name for name, one in inputs if not one.is_optional and name not in came]
        if not missing:
            return Reason(f"{self._type(behavior)} sends nothing for what came", arrived)
        silent = [one for one in arrived if one.input in missing]
        linked = {one.input for one in silent}
        words = ", ".join(
            f"nothing {'came to' if name in linked else 'reaches'} {behavior.id}.{name}"
            for name in missing
        )
        return Reason(f"nothing was sent: {words}", silent or arrived)


def _own_reason(
    behavior: Behavior, output: str, value: Any, arrived: Sequence[Arrived]
) -> Reason | None:
    try:
        return behavior.explain_output(output, value, arrived)
    except Exception as error:  # an explanation of an author that fails costs nothing else
        log.debug("%s does not explain %s: %s", behavior.id, output, error, exc_info=error)
        return None
