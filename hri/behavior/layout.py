"""Where the behaviors of a network stand in a drawing: in layers, from left to right.

A behavior stands one layer right of the last one it depends on (longest path). A link that passes
layers gets a bend in each, so that it runs between the boxes. Within a layer all is ordered by the
mean height of its neighbors, to and fro a few times (Sugiyama, Tagawa and Toda 1981, section 3).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from itertools import pairwise
from statistics import fmean

from hri.behavior.behavior import Behavior
from hri.behavior.network import Link, Network

LETTER = 7.0
"""Width of a letter in pixels."""
LINE = 18.0
TITLE = 44.0
PADDING = 12.0
BETWEEN_LAYERS = 90.0
BETWEEN_BOXES = 26.0
BEND = 6.0
"""Height that a link takes up where it passes a layer."""
MARGIN = 24.0
SWEEPS = 8
MOST_PORTS = 6
"""A side with more ports shows the linked ones alone."""


@dataclass(eq=False)
class Node:
    """A box, or the bend of a link; `x` and `y` are its upper left corner in pixels."""

    layer: int
    behavior: Behavior | None = None
    inputs: list[str] = field(default_factory=list)
    outputs: list[str] = field(default_factory=list)
    width: float = 0.0
    height: float = BEND
    x: float = 0.0
    y: float = 0.0
    before: list[Node] = field(default_factory=list)
    after: list[Node] = field(default_factory=list)

    @property
    def middle(self) -> float:
        return self.y + self.height / 2

    def port(self, name: str, ports: list[str]) -> float:
        """The height of a port."""
        return self.y + TITLE + (ports.index(name) + 0.5) * LINE


@dataclass
class Wire:
    """A link: the points it runs through, from port to port."""

    link: Link
    bends: list[Node]
    points: list[tuple[float, float]] = field(default_factory=list)


@dataclass
class Layout:
    """A drawing: boxes, wires and its size in pixels."""

    boxes: list[Node]
    wires: list[Wire]
    width: float
    height: float


def lay_out(network: Network, type_names: dict[str, str]) -> Layout:
    """Place all behaviors; `type_names` are the second lines of the boxes by id."""
    boxes = {behavior.id: _box(behavior, network, type_names) for behavior in network.behaviors}
    for behavior in network.behaviors:
        feeding = [link.source.id for link in network.links if link.target is behavior]
        boxes[behavior.id].layer = max((boxes[id].layer + 1 for id in feeding), default=0)
    wires = [_wire(link, boxes) for link in network.links]
    count = max((box.layer for box in boxes.values()), default=0) + 1
    layers: list[list[Node]] = [[] for _ in range(count)]
    for node in (*boxes.values(), *(bend for wire in wires for bend in wire.bends)):
        layers[node.layer].append(node)
    _order(layers)
    width = _place(layers)
    for wire in wires:
        wire.points = _points(wire, boxes)
    height = max((node.y + node.height for layer in layers for node in layer), default=0.0)
    return Layout(list(boxes.values()), wires, width + MARGIN, height + MARGIN)


def _box(behavior: Behavior, network: Network, type_names: dict[str, str]) -> Node:
    outputs = _shown(
        behavior.outputs, {link.output for link in network.links if link.source is behavior}
    )
    inputs = _shown(
        behavior.inputs, {link.input for link in network.links if link.target is behavior}
    )
    longest = [max(map(len, ports), default=0) for ports in (inputs, outputs)]
    letters = max(sum(longest) + 4, len(behavior.id) + 2, len(type_names[behavior.id]))
    height = TITLE + max(len(inputs), len(outputs)) * LINE + PADDING / 2
    width = letters * LETTER + 2 * PADDING
    return Node(0, behavior, inputs, outputs, width=width, height=height)


def _shown(ports: Iterable[str], linked: set[str]) -> list[str]:
    names = list(ports)
    return names if len(names) <= MOST_PORTS else [name for name in names if name in linked]


def _wire(link: Link, boxes: dict[str, Node]) -> Wire:
    source, target = boxes[link.source.id], boxes[link.target.id]
    bends = [Node(layer) for layer in range(source.layer + 1, target.layer)]
    path = [source, *bends, target]
    for left, right in pairwise(path):
        left.after.append(right)
        right.before.append(left)
    return Wire(link, bends)


def _order(layers: list[list[Node]]) -> None:
    """Sort each layer by the mean place of its neighbors, from the left, then from the right."""
    for sweep in range(SWEEPS):
        is_forward = sweep % 2 == 0
        for layer in layers if is_forward else reversed(layers):
            _stack(layer)
            means = {
                node: fmean(other.middle for other in near) if near else node.middle
                for node in layer
                for near in [node.before if is_forward else node.after]
            }
            layer.sort(key=means.__getitem__)
            _stack(layer)


def _stack(layer: list[Node]) -> None:
    y = MARGIN
    for node in layer:
        node.y = y
        y += node.height + BETWEEN_BOXES


def _place(layers: list[list[Node]]) -> float:
    """Give each layer its column and its middle to the height of all; returns the right edge."""
    heights = [_height(layer) for layer in layers]
    x = MARGIN
    for layer, height in zip(layers, heights, strict=True):
        width = max((node.width for node in layer), default=0.0)
        for node in layer:
            node.width = width if node.behavior is None else node.width
            node.x = x + (width - node.width) / 2
            node.y += (max(heights) - height) / 2
        x += width + BETWEEN_LAYERS
    return x - BETWEEN_LAYERS


def _height(layer: list[Node]) -> float:
    return sum(node.height + BETWEEN_BOXES for node in layer)


def _points(wire: Wire, boxes: dict[str, Node]) -> list[tuple[float, float]]:
    source, target = boxes[wire.link.source.id], boxes[wire.link.target.id]
    return [
        (source.x + source.width, source.port(wire.link.output, source.outputs)),
        *((x, bend.middle) for bend in wire.bends for x in (bend.x, bend.x + bend.width)),
        (target.x, target.port(wire.link.input, target.inputs)),
    ]
