"""Writes networks in canonical form: a file that is read and written again stays the same, byte for
byte.

First the behaviors, then the links, then the layout, each in the order of the file; attributes in
the order below; comments and single blank lines stay where the author put them; a number keeps its
spelling, `1/30`, until a program changes its value. One changed attribute is one changed line.
"""

from __future__ import annotations

from pathlib import Path

from hri.behavior.behavior import Behavior
from hri.behavior.catalog import type_of
from hri.behavior.network import DEFAULT_INTERVAL, Box, Link, Network
from hri.behavior.ports import Param
from hri.core.writing import write_text
from hri.core.xml import EDITOR_PREFIXES, Element, format_xml

ATTRIBUTES = {
    "BehaviorNetwork": ("name", "invocation_interval"),
    "Behavior": ("id", "type"),
    "Parameter": ("name", "value"),
    "Link": ("from", "to"),
    "Layout": (),
    "Box": ("id", "x", "y"),
}
"""The order of the attributes of each element."""


def write_network(network: Network, path: Path | None = None) -> str:
    """The canonical text of a network, for the file it came from or the one of `path`.

    A network that is named after its file needs no other name. Raises HriError for a behavior whose
    type has no name.
    """
    root = network.document or Element("BehaviorNetwork", {})
    behaviors = {element.get("id"): element for element in root if element.tag == "Behavior"}
    links = {_ends(element): element for element in root if element.tag == "Link"}
    known = {behavior.id: behavior for behavior in network.authored}
    ids = [id for id in behaviors if id in known]
    ids += [id for id in known if id not in behaviors]
    children = [_behavior(known[id], behaviors.get(id)) for id in ids]
    children += [_link(link, links.get(str(link))) for link in network.links]
    children += _layout(network, root)
    return format_xml(_element(root, _heading(network, root, path or network.path), children))


def save_network(network: Network, path: Path) -> None:
    """Write a network to a file, whole or not at all. Raises HriError when it cannot be written."""
    write_text(path, write_network(network, path))


def _element(authored: Element, attributes: dict[str, str], children: list[Element]) -> Element:
    """An element with what the author wrote around it, and its attributes in order."""
    for_editors = {
        name: text for name, text in authored.attributes.items() if name.startswith(EDITOR_PREFIXES)
    }
    order = ATTRIBUTES[authored.tag]
    ordered = {name: attributes[name] for name in order if name in attributes}
    return Element(
        authored.tag,
        for_editors | ordered,
        children=children,
        leading=authored.leading,
        trailing=authored.trailing,
    )


def _heading(network: Network, root: Element, path: Path) -> dict[str, str]:
    attributes = dict(root.attributes)
    if "name" in attributes or network.name != path.stem:
        attributes["name"] = network.name
    if root.number("invocation_interval", DEFAULT_INTERVAL) != network.interval:
        attributes["invocation_interval"] = Param.text(network.interval)
    return attributes


def _behavior(behavior: Behavior, authored: Element | None) -> Element:
    attributes = {"id": behavior.id, "type": type_of(behavior)}
    if authored is None:
        authored = Element("Behavior", attributes)
    parameters = {element.get("name"): element for element in authored}
    children = []
    for name in (*parameters, *(name for name in behavior.parameters if name not in parameters)):
        declared, value = behavior.parameters[name], getattr(behavior, name)
        written = parameters.get(name)
        if written is None and value == declared.default:
            continue
        if written is None or declared.parse(written.get("value")) != value:
            leading = [] if written is None else written.leading
            text = {"name": name, "value": declared.text(value)}
            written = Element("Parameter", text, leading=leading)
        children.append(_element(written, written.attributes, []))
    return _element(authored, attributes | authored.attributes, children)


def _link(link: Link, authored: Element | None) -> Element:
    if authored is None:
        source, _, target = str(link).partition(" -> ")
        authored = Element("Link", {"from": source, "to": target})
    return _element(authored, authored.attributes, [])


def _layout(network: Network, root: Element) -> list[Element]:
    """The places of parts, if there are any; those of the file in its order."""
    authored = next((element for element in root if element.tag == "Layout"), None)
    if not network.boxes and authored is None:
        return []
    authored = authored or Element("Layout", {})
    boxes = {element.get("id"): element for element in authored}
    ids = [id for id in boxes if id in network.boxes]
    ids += [id for id in network.boxes if id not in boxes]
    return [_element(authored, {}, [_box(id, network.boxes[id], boxes.get(id)) for id in ids])]


def _box(id: str, box: Box, authored: Element | None) -> Element:
    attributes = {"id": id, "x": str(box.x), "y": str(box.y)}
    return _element(authored or Element("Box", attributes), attributes, [])


def _ends(element: Element) -> str:
    return f"{element.get('from')} -> {element.get('to')}"
