"""The behaviors to build with, and the problems of a network, as plain values for the page.

Behaviors of your own are Python that is imported here: it runs in a separate process
(`workshop`), never in the server.
"""

from __future__ import annotations

import inspect
import math
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from hri.behavior.behavior import Behavior
from hri.behavior.board import DECLARED
from hri.behavior.catalog import GROUP, find_behavior, find_schema
from hri.behavior.declaration import Parameter, Schema
from hri.behavior.network import Network, Remark
from hri.behavior.network_file import read_network
from hri.behavior.ports import GENERIC
from hri.behavior.schema import schema_of, write_schema
from hri.core import paths, registry
from hri.core.errors import AuthoringError, AuthoringErrors, HriError
from hri.core.xml import Element, parse_xml

Json = dict[str, Any]

_UNIT = re.compile(
    r"\b((meters|radians|degrees|times) a second( squared)?|"
    r"seconds|meters|radians|degrees|pixels)\b",
    re.IGNORECASE,
)
_DEVICE = "_id"
"""The end of the name of a parameter that takes the id of a device."""


def palette() -> Json:
    """All behavior types by name, older names, the slots of the board, and what cannot be used."""
    behaviors, broken = [], []
    for name in _type_names():
        try:
            behaviors.append(_described(find_behavior(name), name))
        except (HriError, ImportError) as error:
            broken.append({"type": name, "what": str(error)})
    slots = [
        {"name": one.name, "datatype": one.datatype, "semantic": GENERIC, "about": one.about}
        for one in DECLARED.values()
    ]
    known = registry.known(GROUP)
    older = {*registry.ALIASES, *(f"Evolution.{name.partition('.')[2]}" for name in known)}
    today = {old: registry.canonical(old) for old in sorted(older)}
    aliases = {old: name for old, name in today.items() if name in known}
    return {"behaviors": behaviors, "aliases": aliases, "slots": slots, "broken": broken}


def _type_names() -> list[str]:
    declared = {name for name in registry.known(GROUP) if not name.startswith("_")}
    return sorted(declared | {type_of_file(path) for path in schema_files()})


def schema_files() -> Iterator[Path]:
    """The schema files on the configuration path, `config/behavior/<NS>/<Name>.xml`."""
    for folder in paths.search_folders():
        for base in (folder / "config" / "behavior", folder / "behavior"):
            yield from sorted(base.rglob("*.xml"))


def type_of_file(path: Path) -> str:
    """The type that a schema file defines, by its place."""
    parts = path.with_suffix("").parts
    last = len(parts) - 1 - parts[::-1].index("behavior")
    return ".".join(parts[last + 1 :])


def _described(cls: type[Behavior], name: str) -> Json:
    schema = schema_of(cls, name)
    about = inspect.getdoc(cls) or ""
    return {
        "type": name,
        "category": schema.category,
        "display_name": schema.display_name,
        "about": about.split("\n\n")[0].replace("\n", " "),
        "is_sensor": cls.is_sensor,
        "library": schema.library,
        "parameters": [_parameter(one) for one in schema.parameters],
        "inputs": _ports(schema, cls, "inputs"),
        "outputs": _ports(schema, cls, "outputs"),
    }


def _parameter(one: Parameter) -> Json:
    unit = _UNIT.search(one.description)
    is_number = one.type in ("number", "integer")
    return {
        "name": one.name,
        "type": one.type,
        "default": one.default,
        "description": one.description,
        "minimum": one.minimum if math.isfinite(one.minimum) else None,
        "maximum": one.maximum if math.isfinite(one.maximum) else None,
        "choices": list(one.choices),
        "unit": unit[0].lower() if unit and is_number else "",
        # Devices have the id of their kind, where there is one of it.
        "interface": one.default if one.name.endswith(_DEVICE) else None,
    }


def _ports(schema: Schema, cls: type[Behavior], kind: str) -> list[Json]:
    declared = getattr(cls, kind)
    return [
        {
            "name": port.name,
            "datatype": port.datatype,
            "semantic": port.semantic_type,
            "description": port.description,
            "is_optional": getattr(declared.get(port.name), "is_optional", True),
        }
        for port in getattr(schema, kind)
    ]


def schema(type_name: str) -> Json:
    """The schema of a type as XML, and the file it is from. Raises HriError."""
    cls = find_behavior(type_name)
    is_file = cls.schema is not None
    path = str(find_schema(type_name)) if is_file else None
    return {"text": write_schema(schema_of(cls, type_name)), "path": path}


def check(text: str, path: str) -> Json:
    """What `hri network check` finds in a text, and of a text that can be read the order in which
    its behaviors run, and the datatypes of outputs that parameters decide.
    """
    file = Path(path)
    try:
        network = read_network(text, file)
    except AuthoringErrors as several:
        return _refused([_mistake(error, text) for error in several.errors])
    except AuthoringError as error:
        return _refused([_mistake(error, text)])
    except HriError as error:
        return _refused([_problem(str(error), "", "error")])
    return {
        "problems": _remarks(network),
        "order": [one.id for one in network.authored],
        "datatypes": dict(_decided(network.authored)),
    }


def _refused(problems: list[Json]) -> Json:
    return {"problems": problems, "order": [], "datatypes": None}


def _decided(behaviors: Iterable[Behavior]) -> Iterator[tuple[str, str]]:
    """Outputs with another datatype than their type declares, as of a constant."""
    for behavior in behaviors:
        declared = type(behavior).outputs
        for name, output in behavior.outputs.items():
            if name in declared and output.datatype != declared[name].datatype:
                yield f"{behavior.id}.{name}", output.datatype


def _remarks(network: Network) -> list[Json]:
    found = [_remark(one, network) for one in (*network.warnings, *network.loose_ends())]
    for behavior in network.authored:
        try:
            behavior.check()
        except HriError as error:
            what, _, remedy = str(error).partition(" - ")
            place = network.place_of(behavior)
            found.append(
                _problem(what, remedy, "error", place.line, place.column)
                | {"behavior": behavior.id}
            )
    return found


def _remark(remark: Remark, network: Network) -> Json:
    place = remark.place
    problem = _problem(remark.what, "", "warning", place.line, place.column)
    return problem | _where(network.document, place.line, place.column)


def _mistake(error: AuthoringError, text: str) -> Json:
    place = error.place
    problem = _problem(error.what, error.remedy, "error", place.line, place.column)
    try:
        root = parse_xml(text.encode("utf-8"), place.path)
    except AuthoringError:
        return problem
    return problem | _where(root, place.line, place.column)


def _problem(what: str, remedy: str, grave: str, line: int = 1, column: int = 1) -> Json:
    return {
        "line": line,
        "column": column,
        "what": what,
        "remedy": remedy,
        "grave": grave,
        "behavior": None,
        "parameter": None,
        "link": None,
    }


def _where(root: Element | None, line: int, column: int) -> Json:
    """The behavior and parameter, or the link, at a place."""
    found: Json = {}
    for element in root or ():
        if (element.place.line, element.place.column) > (line, column):
            break
        found = {}
        if element.tag == "Behavior":
            found["behavior"] = element.get("id", "") or None
            for child in element:
                if (child.place.line, child.place.column) <= (line, column):
                    found["parameter"] = child.get("name", "") or None
        elif element.tag == "Link":
            found["link"] = {end: element.get(end, "") for end in ("from", "to")}
    return found
