"""Reads networks from XML.

<BehaviorNetwork invocation_interval="0.1">
  <Behavior id="three" type="Hri.Constant"><Parameter name="parsed_value" value="3"/></Behavior>
  <Behavior id="show" type="Hri.InputCollector"/>
  <Link from="three.value" to="show.input"/>
</BehaviorNetwork>
"""

from __future__ import annotations

from pathlib import Path

from hri.behavior.behavior import Behavior
from hri.behavior.catalog import find_behavior
from hri.behavior.network import DEFAULT_INTERVAL, Network
from hri.behavior.network_check import check_together
from hri.core import paths
from hri.core.errors import AuthoringError, HriError, NotAvailable, did_you_mean
from hri.core.xml import Element, load_xml

SHORTEST_INTERVAL = 0.001
LONGEST_INTERVAL = 3600


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
    check_together([network])
    return network


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
