"""The types of the topics in the two languages that other programs read: JSON Schema, TypeScript.

`python -m hri.studio.type_export` prints `page/src/topics.ts`.
"""

from __future__ import annotations

import inspect
import json
from types import NoneType, UnionType
from typing import Any, Literal, get_args, get_origin, get_type_hints

from hri.studio.topics import TOPICS, RobotEvent, types

_SCHEMAS: dict[Any, str] = {
    str: "string",
    float: "number",
    int: "integer",
    bool: "boolean",
    NoneType: "null",
}
_TYPESCRIPT: dict[Any, str] = {
    str: "string",
    float: "number",
    int: "number",
    bool: "boolean",
    NoneType: "null",
    Any: "unknown",
}


def schemas() -> dict[str, Any]:
    """A schema for each type, for all topics at once, and for what the WebSocket sends as text."""
    found = {name: _record_schema(type) for name, type in types().items()}
    topics = [
        _object({"topic": {"const": name}, "value": schema_of(type)})
        for name, type in TOPICS.items()
    ]
    event = _object({"event": schema_of(RobotEvent)})
    answer = {"$ref": "#/components/schemas/Answer"}
    state = {**_object({name: schema_of(type) for name, type in TOPICS.items()}), "required": []}
    return {**found, "State": state, "LiveMessage": {"oneOf": [*topics, event, answer]}}


def schema_of(type: Any) -> dict[str, Any]:
    """The JSON Schema of a type that `topics` uses."""
    kind, parts = get_origin(type), get_args(type)
    if type is Any:
        return {}
    if type in _SCHEMAS:
        return {"type": _SCHEMAS[type]}
    if kind is Literal:
        return {"enum": list(parts)}
    if kind is list:
        return {"type": "array", "items": schema_of(parts[0])}
    if kind is dict:
        return {"type": "object", "additionalProperties": schema_of(parts[1])}
    if kind is UnionType:
        return {"anyOf": [schema_of(part) for part in parts]}
    return {"$ref": f"#/components/schemas/{type.__name__}"}


def _record_schema(type: Any) -> dict[str, Any]:
    properties = {key: schema_of(part) for key, part in get_type_hints(type).items()}
    found = _object(properties)
    return {
        "description": inspect.getdoc(type),
        **found,
        "additionalProperties": type is RobotEvent,
    }


def _object(properties: dict[str, Any]) -> dict[str, Any]:
    return {
        "type": "object",
        "properties": properties,
        "required": list(properties),
        "additionalProperties": False,
    }


def typescript() -> str:
    """The types as TypeScript has them."""
    lines = ["// Written by `python -m hri.studio.type_export` from hri/studio/topics.py."]
    for name, type in types().items():
        lines += ["", f"/** {' '.join(str(inspect.getdoc(type)).split())} */"]
        lines += [f"export interface {name} {{"]
        for key, part in get_type_hints(type).items():
            lines.append(f"  {key}: {typescript_of(part)};")
        if type is RobotEvent:
            lines.append("  [key: string]: unknown;")
        lines.append("}")
    values = [f"  {name}?: {typescript_of(type)};" for name, type in TOPICS.items()]
    return "\n".join([*lines, "", "export interface Values {", *values, "}", ""])


def typescript_of(type: Any) -> str:
    """A type that `topics` uses, as TypeScript has it."""
    kind, parts = get_origin(type), get_args(type)
    if type in _TYPESCRIPT:
        return _TYPESCRIPT[type]
    if kind is Literal:
        return " | ".join(map(json.dumps, parts))
    if kind is list:
        item = typescript_of(parts[0])
        return f"({item})[]" if "|" in item else f"{item}[]"
    if kind is dict:
        return f"Record<string, {typescript_of(parts[1])}>"
    if kind is UnionType:
        return " | ".join(map(typescript_of, parts))
    return str(type.__name__)


if __name__ == "__main__":
    print(typescript(), end="")
