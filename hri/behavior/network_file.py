"""Reads networks from XML.

<BehaviorNetwork invocation_interval="0.1">
  <Behavior id="three" type="Hri.Constant"><Parameter name="parsed_value" value="3"/></Behavior>
  <Behavior id="show" type="Hri.InputCollector"/>
  <Link from="three.value" to="show.input"/>
  <Layout>
    <Box id="three" x="40" y="40"/>
  </Layout>
</BehaviorNetwork>

The layout is for editors; nothing that runs depends on it.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from hri.behavior.behavior import Behavior
from hri.behavior.board import BOARD
from hri.behavior.catalog import find_behavior
from hri.behavior.network import DEFAULT_INTERVAL, Box, Network, Remark
from hri.behavior.network_check import check_together
from hri.core import paths
from hri.core.errors import AuthoringError, HriError, Mistakes, NotAvailable, did_you_mean
from hri.core.xml import Element, load_xml, parse_xml

SHORTEST_INTERVAL = 0.001
LONGEST_INTERVAL = 3600
_WHOLE = re.compile(r"-?\d{1,6}", re.ASCII)


def load_network(name: str | Path) -> Network:
    """Read a network by path or by name over the search folders, checked and in order.

    Raises AuthoringError with the place of the mistake, AuthoringErrors for several.
    """
    path = name if isinstance(name, Path) else paths.find("config", name)
    return _network(load_xml(path, "behavior network"), path)


def read_network(text: str, path: Path) -> Network:
    """The same from a text that an editor holds, as if the file of that path had it."""
    return _network(parse_xml(text.encode("utf-8"), path), path)


def _network(root: Element, path: Path) -> Network:
    if root.tag != "BehaviorNetwork":
        raise root.error(f"the root is <{root.tag}>", "write <BehaviorNetwork> around it all")
    mistakes = Mistakes()
    network = Network(root.get("name", path.stem), path=path, document=root)
    mistakes.keep(partial(root.check, tuple(_READERS), ("invocation_interval", "name")))
    interval = mistakes.keep(partial(_interval, root))
    network.interval = DEFAULT_INTERVAL if interval is None else interval
    for tag, read in _READERS.items():
        lost = _lost(network) if tag == "Link" else set()
        for element in root:
            if element.tag == tag and _ends(element).isdisjoint(lost):
                mistakes.keep(partial(read, network, element))
    mistakes.keep(network.sort)
    mistakes.keep(partial(check_together, [network]))
    mistakes.tell()
    return network


def _lost(network: Network) -> set[str]:
    """The ids of behaviors that could not be made; their links are not wrong for that."""
    known = {behavior.id for behavior in network.behaviors}
    written = {
        element.get("id", "") for element in network.document or () if element.tag == "Behavior"
    }
    return written - known


def _ends(element: Element) -> set[str]:
    return {element.get(end, "").partition(".")[0] for end in ("from", "to")}


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


def _read_behavior(network: Network, element: Element) -> None:
    element.check(("Parameter",), ("id", "type"))
    cls = _find(element)
    mistakes = Mistakes()
    parameters: dict[str, Any] = {}
    for child in element:
        mistakes.keep(partial(_read_parameter, cls, element.get("type"), child, parameters))
    behavior = cls(**parameters)
    behavior.id = element.get("id")
    network.types[behavior.id] = element.get("type")
    try:
        network.add(behavior)
    except HriError as error:
        what, _, remedy = str(error).partition(" - ")
        mistakes.add(element.error(what, remedy, "id"))
    mistakes.tell()


def _read_parameter(
    cls: type[Behavior], type_name: str, element: Element, parameters: dict[str, Any]
) -> None:
    element.check((), ("name", "value"))
    name = element.get("name")
    if name not in cls.parameters:
        what = f'{type_name} has no parameter "{name}"'
        raise element.error(what, did_you_mean(name, cls.parameters))
    if name in parameters:
        raise element.error(f'"{name}" is set twice', "take one of them out", "name")
    try:
        parameters[name] = cls.parameters[name].parse(element.get("value"))
    except ValueError as error:
        what, _, remedy = str(error).partition(" - ")
        raise element.error(f"{name}: {what}", remedy, "value") from error


def _read_link(network: Network, element: Element) -> None:
    element.check((), ("from", "to"))
    source, target = element.get("from"), element.get("to")
    network.connect(source, target, element.place)


def _read_layout(network: Network, element: Element) -> None:
    element.check(("Box",))
    if network.boxes:
        raise element.error("a second <Layout>", "take one of them out")
    for box in element:
        box.check((), ("id", "x", "y"))
        id = box.get("id")
        network.boxes[id] = Box(_pixels(box, "x"), _pixels(box, "y"))
        if not id.startswith(f"{BOARD}.") and all(one.id != id for one in network.authored):
            network.warnings.append(
                Remark(box.place, f'<Layout> places "{id}", which is not there')
            )


def _pixels(box: Element, attribute: str) -> int:
    text = box.get(attribute)
    if not _WHOLE.fullmatch(text):
        raise box.error(f'{attribute} "{text}"', "write whole pixels, such as 120", attribute)
    return int(text)


_READERS: dict[str, Callable[[Network, Element], None]] = {
    "Behavior": _read_behavior,
    "Link": _read_link,
    "Layout": _read_layout,
}
"""By tag, in the order in which they are read."""
