"""Networks: behaviors and the links between them."""

from __future__ import annotations

import heapq
import logging
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from hri.behavior.behavior import Behavior
from hri.behavior.board import BOARD, BoardSink, BoardSource
from hri.behavior.ports import ANY, Input, InputPort, Output, OutputPort, means_same
from hri.core.errors import AuthoringError, HriError, Place, did_you_mean
from hri.core.xml import Element

log = logging.getLogger("hri.network")

DEFAULT_INTERVAL = 0.10
MOST_BEHAVIORS = 2000
_SLOT = re.compile(r"([a-z][a-z0-9_-]*/)?\w+([.-]\w+)*")


@dataclass(frozen=True)
class Remark:
    """Something that may be wrong with a network: a warning, and where it is."""

    place: Place
    what: str

    def __str__(self) -> str:
        return f"{self.place}: {self.what}"


@dataclass(frozen=True)
class Box:
    """Where a part stands in an editor: its upper left corner, in whole pixels."""

    x: int
    y: int


@dataclass(frozen=True)
class Link:
    """A wire from an output to an input."""

    source: Behavior
    output: str
    target: Behavior
    input: str
    place: Place

    @property
    def datatype(self) -> str:
        """The type of what it carries: that of its source, where that has one."""
        sent = self.source.outputs[self.output].datatype
        return self.target.inputs[self.input].datatype if sent == ANY else sent

    def __str__(self) -> str:
        return f"{self.source.id}.{self.output} -> {self.target.id}.{self.input}"


@dataclass
class Network:
    """Behaviors in the order in which they run, and the parameters of the network."""

    name: str
    interval: float = DEFAULT_INTERVAL
    """Seconds between ticks."""
    behaviors: list[Behavior] = field(default_factory=list)
    """Among them the ends of the board, where links name a slot of it."""
    links: list[Link] = field(default_factory=list)
    warnings: list[Remark] = field(default_factory=list)
    boxes: dict[str, Box] = field(default_factory=dict)
    """By the id of a behavior, or `board.slot`: the places that an editor gave them."""
    path: Path = Path("-")
    document: Element | None = None
    """What it was read from: comments, order, and numbers as they were written."""
    types: dict[str, str] = field(default_factory=dict)
    """By id, the types of behaviors as they were written: what messages call them."""

    @property
    def authored(self) -> list[Behavior]:
        """The behaviors without the ends of the board."""
        return [one for one in self.behaviors if not isinstance(one, BoardSource | BoardSink)]

    def __getitem__(self, id: str) -> Behavior:
        for behavior in self.behaviors:
            if behavior.id == id:
                return behavior
        remedy = did_you_mean(id, [behavior.id for behavior in self.behaviors])
        raise HriError(f'network {self.name} has no behavior "{id}" - {remedy}')

    def add(self, behavior: Behavior) -> Behavior:
        """Add a behavior. Raises HriError when its id is not new, or has a dot in it."""
        if not behavior.id or "." in behavior.id:
            raise HriError(f'the id "{behavior.id}" cannot be linked to - take a word without dots')
        if any(known.id == behavior.id for known in self.behaviors):
            raise HriError(f'the id "{behavior.id}" is used twice - rename one of them')
        if len(self.behaviors) >= MOST_BEHAVIORS:
            raise HriError(f"more than {MOST_BEHAVIORS} behaviors in a network - split it")
        self.behaviors.append(behavior)
        return behavior

    def connect(
        self,
        source: str | OutputPort[Any],
        target: str | InputPort[Any],
        place: Place | None = None,
    ) -> None:
        """Wire an output to an input: as ports, or as text `behavior.output`, `board.slot`.

        Raises AuthoringError on a misfit, and when they are linked already; HriError for a port of
        a behavior that is not in the network.
        """
        place = place or Place(self.path)
        source = source if isinstance(source, str) else self._name_of(source, "outputs")
        target = target if isinstance(target, str) else self._name_of(target, "inputs")
        sender, output = self._port(source, "outputs", place)
        receiver, input = self._port(target, "inputs", place)
        if isinstance(sender, BoardSource) and not isinstance(receiver, BoardSink):
            sender.add(output, receiver.inputs[input].datatype)
        sends: Output[Any] = sender.outputs[output]
        takes: Input[Any] = receiver.inputs[input]
        if sends.datatype != takes.datatype and ANY not in (sends.datatype, takes.datatype):
            what = f"{source} is {sends.datatype}, but {target} takes {takes.datatype}"
            raise AuthoringError(place, what, "link ports of the same datatype")
        if not means_same(sends.semantic, takes.semantic):
            what = f"{source} means {sends.semantic}, {target} wants {takes.semantic}"
            self.warnings.append(Remark(place, what))
        port = sender.output_port(output)
        fed = receiver.input_port(input).sources
        if port in fed:
            what = f"the link {source} -> {target} is there twice"
            raise AuthoringError(place, what, "take one of them out")
        if isinstance(receiver, BoardSink):
            receiver.name_writer(port, f"{self.name}.{source}")
        self.links.append(Link(sender, output, receiver, input, place))
        log.debug("link %s (%s)", self.links[-1], sends.datatype)
        fed.append(port)

    def place_of(self, behavior: Behavior) -> Place:
        """Where a behavior stands in the file; the file itself where it stands in none."""
        for element in self.document or ():
            if element.tag == "Behavior" and element.get("id") == behavior.id:
                return element.place
        return Place(self.path)

    def loose_ends(self) -> list[Remark]:
        """A remark for each behavior that takes something, but that no link reaches."""
        fed = {link.target.id for link in self.links}
        return [
            Remark(
                self.place_of(behavior),
                f"nothing reaches {behavior.id} ({', '.join(behavior.inputs)})",
            )
            for behavior in self.behaviors
            if behavior.id not in fed
            and any(not input.is_optional for input in behavior.inputs.values())
        ]

    def check(self) -> None:
        """Let each behavior read its authored files, once. Raises HriError."""
        if not self._is_checked:
            for behavior in self.behaviors:
                behavior.check()
            self._is_checked = True

    _is_checked = False

    def sort(self) -> None:
        """Put the behaviors in dependency order: sensors first, then the file's order.

        What a behavior depends on runs before it always, sensor or not. Raises AuthoringError that
        names a cycle link by link.
        """
        waits = dict.fromkeys(self.behaviors, 0)
        fed: dict[Behavior, list[Behavior]] = {behavior: [] for behavior in waits}
        for link in self.links:
            waits[link.target] += 1
            fed[link.source].append(link.target)
        rank = {b: (not b.is_sensor, place, b) for place, b in enumerate(self.behaviors)}
        ready = [rank[behavior] for behavior, count in waits.items() if not count]
        heapq.heapify(ready)
        order: list[Behavior] = []
        while ready:
            *_, behavior = heapq.heappop(ready)
            order.append(behavior)
            for next_one in fed[behavior]:
                waits[next_one] -= 1
                if not waits[next_one]:
                    heapq.heappush(ready, rank[next_one])
        if len(order) < len(self.behaviors):
            cycle = self._cycle({behavior for behavior, count in waits.items() if count})
            what = f"these links run in a circle: {', '.join(map(str, cycle))}"
            raise AuthoringError(cycle[0].place, what, "take one of them out")
        self.behaviors = order

    def _cycle(self, stuck: set[Behavior]) -> list[Link]:
        """One circle among the behaviors that wait for each other."""
        links = {link.target: link for link in self.links if link.source in stuck}
        behavior = next(one for one in self.behaviors if one in stuck)
        walked: list[Behavior] = []
        while behavior not in walked:
            walked.append(behavior)
            behavior = links[behavior].source
        circle = walked[walked.index(behavior) :]
        return [links[one] for one in reversed(circle)]

    def _name_of(self, port: OutputPort[Any] | InputPort[Any], kind: str) -> str:
        """`behavior.port` of a port. Raises HriError when none of the behaviors has it."""
        for behavior in self.behaviors:
            for name in getattr(behavior, kind):
                port_of = behavior.input_port if kind == "inputs" else behavior.output_port
                if port_of(name) is port:
                    return f"{behavior.id}.{name}"
        what = f"the {kind[:-1]} belongs to no behavior of the network {self.name}"
        raise HriError(f"{what} - add its behavior first")

    def _port(self, text: str, kind: str, place: Place) -> tuple[Behavior, str]:
        id, _, port = text.partition(".")
        behavior = next((known for known in self.authored if known.id == id), None)
        if behavior is None and id == BOARD:
            return self._board_end(port, kind, place), port
        if behavior is None:
            remedy = did_you_mean(id, [known.id for known in self.authored])
            raise AuthoringError(place, f'no behavior "{id}" for the link "{text}"', remedy)
        ports = getattr(behavior, kind)
        if port not in ports:
            written = self.types.get(id, type(behavior).__name__)
            what = f'{written} "{id}" has no {kind[:-1]} "{port}"'
            raise AuthoringError(place, what, did_you_mean(port, ports))
        return behavior, port

    def _board_end(self, slot: str, kind: str, place: Place) -> Behavior:
        """The end of the board that reads or writes a slot, made on first use."""
        if not _SLOT.fullmatch(slot):
            what = f'"{BOARD}.{slot}" is not a slot of the board'
            raise AuthoringError(place, what, f"write {BOARD}.name, such as {BOARD}.speech")
        wanted = BoardSource if kind == "outputs" else BoardSink
        end = next((known for known in self.behaviors if isinstance(known, wanted)), None)
        if end is None:
            end = wanted()
            self.behaviors.append(end)
        if isinstance(end, BoardSource):
            end.add(slot, ANY)
        else:
            end.add(slot)
        return end
