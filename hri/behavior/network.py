"""Networks: behaviors and the links between them, read from XML and checked as a whole.

<BehaviorNetwork invocation_interval="0.1">
  <Behavior id="three" type="Hri.Constant"><Parameter name="parsed_value" value="3"/></Behavior>
  <Behavior id="show" type="Hri.InputCollector"/>
  <Link from="three.value" to="show.input"/>
</BehaviorNetwork>
"""

from __future__ import annotations

import heapq
import logging
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from hri.behavior.behavior import Behavior
from hri.behavior.catalog import find_behavior
from hri.behavior.ports import ANY, GENERIC, Input, Output
from hri.core import paths
from hri.core.errors import AuthoringError, HriError, NotAvailable, Place, did_you_mean
from hri.core.xml import Element, load_xml

log = logging.getLogger("hri.network")

DEFAULT_INTERVAL = 0.10
SHORTEST_INTERVAL = 0.001
LONGEST_INTERVAL = 3600
MOST_BEHAVIORS = 2000


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
        """The type of what it carries."""
        return self.source.outputs[self.output].datatype

    def __str__(self) -> str:
        return f"{self.source.id}.{self.output} -> {self.target.id}.{self.input}"


@dataclass
class Network:
    """Behaviors in the order in which they run, and what is told about the whole."""

    name: str
    interval: float = DEFAULT_INTERVAL
    """Seconds between ticks."""
    behaviors: list[Behavior] = field(default_factory=list)
    links: list[Link] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    path: Path = Path("-")
    document: Element | None = None
    """What it was read from: comments, order, and numbers as they were written."""
    types: dict[str, str] = field(default_factory=dict)
    """By id, the types of behaviors as they were written: what messages call them."""

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

    def connect(self, source: str, target: str, place: Place | None = None) -> None:
        """Wire `behavior.output` to `behavior.input`.

        Raises AuthoringError on a misfit, and when they are linked already.
        """
        place = place or Place(self.path)
        sender, output = self._port(source, "outputs", place)
        receiver, input = self._port(target, "inputs", place)
        sends: Output[Any] = sender.outputs[output]
        takes: Input[Any] = receiver.inputs[input]
        if sends.datatype != takes.datatype and ANY not in (sends.datatype, takes.datatype):
            what = f"{source} is {sends.datatype}, but {target} takes {takes.datatype}"
            raise AuthoringError(place, what, "link ports of the same datatype")
        if sends.semantic != takes.semantic and GENERIC not in (sends.semantic, takes.semantic):
            self.warnings.append(
                f"{place}: {source} means {sends.semantic}, {target} wants {takes.semantic}"
            )
        if sender.output_port(output) in getattr(receiver, input).sources:
            what = f"the link {source} -> {target} is there twice"
            raise AuthoringError(place, what, "take one of them out")
        self.links.append(Link(sender, output, receiver, input, place))
        log.debug("link %s (%s)", self.links[-1], sends.datatype)
        getattr(receiver, input).sources.append(sender.output_port(output))

    def place_of(self, behavior: Behavior) -> Place:
        """Where a behavior stands in the file; the file itself where it stands in none."""
        for element in self.document or ():
            if element.tag == "Behavior" and element.get("id") == behavior.id:
                return element.place
        return Place(self.path)

    def loose_ends(self) -> list[str]:
        """A sentence for each behavior that takes something, but that no link reaches."""
        fed = {link.target.id for link in self.links}
        return [
            f"nothing reaches {behavior.id} ({', '.join(behavior.inputs)})"
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
        waits = dict.fromkeys((behavior.id for behavior in self.behaviors), 0)
        fed: dict[str, list[str]] = {id: [] for id in waits}
        for link in self.links:
            waits[link.target.id] += 1
            fed[link.source.id].append(link.target.id)
        rank = {b.id: (not b.is_sensor, place, b) for place, b in enumerate(self.behaviors)}
        ready = [rank[id] for id, count in waits.items() if not count]
        heapq.heapify(ready)
        order: list[Behavior] = []
        while ready:
            *_, behavior = heapq.heappop(ready)
            order.append(behavior)
            for id in fed[behavior.id]:
                waits[id] -= 1
                if not waits[id]:
                    heapq.heappush(ready, rank[id])
        if len(order) < len(self.behaviors):
            cycle = self._cycle({id for id, count in waits.items() if count})
            what = f"these links run in a circle: {', '.join(map(str, cycle))}"
            raise AuthoringError(cycle[0].place, what, "take one of them out")
        self.behaviors = order

    def _cycle(self, stuck: set[str]) -> list[Link]:
        """One circle among the behaviors that wait for each other."""
        links = {link.target.id: link for link in self.links if link.source.id in stuck}
        id = next(behavior.id for behavior in self.behaviors if behavior.id in stuck)
        walked: list[str] = []
        while id not in walked:
            walked.append(id)
            id = links[id].source.id
        circle = walked[walked.index(id) :]
        return [links[id] for id in reversed(circle)]

    def _port(self, text: str, kind: str, place: Place) -> tuple[Behavior, str]:
        id, _, port = text.partition(".")
        behavior = next((known for known in self.behaviors if known.id == id), None)
        if behavior is None:
            remedy = did_you_mean(id, [known.id for known in self.behaviors])
            raise AuthoringError(place, f'no behavior "{id}" for the link "{text}"', remedy)
        ports = getattr(behavior, kind)
        if port not in ports:
            written = self.types.get(id, type(behavior).__name__)
            what = f'{written} "{id}" has no {kind[:-1]} "{port}"'
            raise AuthoringError(place, what, did_you_mean(port, ports))
        return behavior, port


def load_network(name: str | Path) -> Network:
    """Read a network by path or by name over the search folders, checked and in order.

    Raises AuthoringError with the place of the first mistake.
    """
    path = name if isinstance(name, Path) else paths.find("config", name)
    root = load_xml(path, "behavior network")
    if root.tag != "BehaviorNetwork":
        raise root.error(f"the root is <{root.tag}>", "write <BehaviorNetwork> around it all")
    root.check(("Behavior", "Link"), ("invocation_interval", "name"))
    network = Network(root.get("name", path.stem), _interval(root), path=path, document=root)
    for element in root:
        if element.tag == "Behavior":
            _add(network, element)
    for element in root:
        if element.tag == "Link":
            element.check((), ("from", "to"))
            network.connect(element.get("from"), element.get("to"), element.place)
    network.sort()
    refuse_second_writers([network])
    return network


def refuse_second_writers(networks: Iterable[Network]) -> None:
    """Raise AuthoringError where two behaviors steer one drive with the same rank."""
    steering: dict[tuple[str, str], str] = {}
    for network in networks:
        for behavior in network.behaviors:
            if behavior.steers is None:
                continue
            place = f'"{behavior.id}" ({network.place_of(behavior)})'
            other = steering.setdefault(behavior.steers, place)
            if other != place:
                drive, rank = behavior.steers
                what = f'"{behavior.id}" steers "{drive}" with the rank "{rank}", as {other} does'
                remedy = "take one out, put an Hri.PriorityArbiter before one, or change its rank"
                raise AuthoringError(network.place_of(behavior), what, remedy)


def _interval(root: Element) -> float:
    interval = root.number("invocation_interval", DEFAULT_INTERVAL)
    if not SHORTEST_INTERVAL <= interval <= LONGEST_INTERVAL:
        remedy = f"write seconds from {SHORTEST_INTERVAL} to {LONGEST_INTERVAL}"
        raise root.error(f"an interval of {interval:g} s", remedy, "invocation_interval")
    return interval


def _find(element: Element) -> type[Behavior]:
    try:
        return find_behavior(element.get("type"))
    except (NotAvailable, AuthoringError):
        raise
    except HriError as error:
        what, _, remedy = str(error).partition(" - ")
        raise element.error(what, remedy, "type") from error


def _add(network: Network, element: Element) -> None:
    element.check(("Parameter",), ("id", "type"))
    cls = _find(element)
    parameters = {}
    for child in element:
        child.check((), ("name", "value"))
        name = child.get("name")
        if name not in cls.parameters:
            what = f'{element.get("type")} has no parameter "{name}"'
            raise child.error(what, did_you_mean(name, cls.parameters))
        if name in parameters:
            raise child.error(f'"{name}" is set twice', "take one of them out", "name")
        try:
            parameters[name] = cls.parameters[name].parse(child.get("value"))
        except ValueError as error:
            what, _, remedy = str(error).partition(" - ")
            raise child.error(f"{name}: {what}", remedy, "value") from error
    behavior = cls(**parameters)
    behavior.id = element.get("id")
    network.types[behavior.id] = element.get("type")
    try:
        network.add(behavior)
    except HriError as error:
        what, _, remedy = str(error).partition(" - ")
        raise element.error(what, remedy, "id") from error
