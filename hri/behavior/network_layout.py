"""Where the behaviors of a network stand in a drawing: in layers, from left to right.

A behavior stands one layer right of the last one it depends on (longest path). A link that passes
layers gets a bend in each, so that it runs between the boxes. Within a layer all is ordered by the
mean height of its neighbors, to and fro a few times (Sugiyama, Tagawa and Toda 1981, section 3).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
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
HEADING = 14.0
"""Height above a network that its name takes, where there are several."""
SWEEPS = 8
MOST_PORTS = 6
"""A side with more ports shows the linked ones alone."""


@dataclass(eq=False)
class Node:
    """A box, or the bend of a link; `x` and `y` are its upper left corner in pixels."""

    layer: int
    behavior: Behavior | None = None
    kind: str = ""
    """The line below the behavior's id."""
    inputs: list[str] = field(default_factory=list)
    outputs: list[str] = field(default_factory=list)
    width: float = 0.0
    height: float = BEND
    x: float = 0.0
    y: float = 0.0
    before: list[Node] = field(default_factory=list)
    after: list[Node] = field(default_factory=list)
    shade: str = ""
    """What it is in a comparison: a key of `network_svg.SHADES`; empty elsewhere."""

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
    shade: str = ""


@dataclass
class Layout:
    """A drawing: boxes, wires and its size in pixels."""

    boxes: list[Node]
    wires: list[Wire]
    width: float
    height: float
    headings: list[tuple[str, float, float]] = field(default_factory=list)
    """Names of networks with the lower left corner of each."""


def lay_out(network: Network, kind_of: Callable[[Behavior], str]) -> Layout:
    """Place all behaviors; `kind_of` gives the second line of a box."""
    boxes = {behavior: _box(behavior, network, kind_of(behavior)) for behavior in network.behaviors}
    for behavior in network.behaviors:
        feeding = [link.source for link in network.links if link.target is behavior]
        boxes[behavior].layer = max((boxes[one].layer + 1 for one in feeding), default=0)
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
    heading = (network.name, MARGIN / 2, MARGIN - 6)
    return Layout(list(boxes.values()), wires, width + MARGIN, height + MARGIN, [heading])


def stacked(layouts: list[Layout]) -> Layout:
    """Drawings below each other, each below the name of its network; one alone has no heading."""
    if len(layouts) == 1:
        return replace(layouts[0], headings=[])
    return titled(layouts)


def titled(layouts: list[Layout]) -> Layout:
    """Drawings below each other, each below its heading."""
    down = 0.0
    whole = Layout([], [], max((one.width for one in layouts), default=0.0), 0.0)
    for one in layouts:
        down += HEADING
        for node in {*one.boxes, *(bend for wire in one.wires for bend in wire.bends)}:
            node.y += down
        for wire in one.wires:
            wire.points = [(x, y + down) for x, y in wire.points]
        whole.boxes += one.boxes
        whole.wires += one.wires
        whole.headings += [(name, x, y + down) for name, x, y in one.headings]
        down += one.height
    whole.height = down
    return whole


def _box(behavior: Behavior, network: Network, kind: str) -> Node:
    outputs = _shown(
        behavior.outputs, {link.output for link in network.links if link.source is behavior}
    )
    inputs = _shown(
        behavior.inputs, {link.input for link in network.links if link.target is behavior}
    )
    longest = [max(map(len, ports), default=0) for ports in (inputs, outputs)]
    letters = max(sum(longest) + 4, len(behavior.id) + 2, len(kind))
    height = TITLE + max(len(inputs), len(outputs)) * LINE + PADDING / 2
    width = letters * LETTER + 2 * PADDING
    return Node(0, behavior, kind, inputs, outputs, width=width, height=height)


def _shown(ports: Iterable[str], linked: set[str]) -> list[str]:
    # In a comparison a link may name a port that its behavior has no more.
    names = list(dict.fromkeys((*ports, *sorted(linked))))
    return names if len(names) <= MOST_PORTS else [name for name in names if name in linked]


def _wire(link: Link, boxes: dict[Behavior, Node]) -> Wire:
    source, target = boxes[link.source], boxes[link.target]
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


def _points(wire: Wire, boxes: dict[Behavior, Node]) -> list[tuple[float, float]]:
    source, target = boxes[wire.link.source], boxes[wire.link.target]
    return [
        (source.x + source.width, source.port(wire.link.output, source.outputs)),
        *((x, bend.middle) for bend in wire.bends for x in (bend.x, bend.x + bend.width)),
        (target.x, target.port(wire.link.input, target.inputs)),
    ]
