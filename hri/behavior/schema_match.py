"""Whether a schema and the class that does its work declare the same.

A schema that declares nothing takes everything from its class. One that declares anything has
all ports of its class and, where it brings that class in a Python file, all parameters; as a
variant of a behavior of the library it may leave parameters out. Defaults are the schema's own.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from hri.behavior.behavior import Behavior
from hri.behavior.declaration import TYPES, Parameter, Port, Schema
from hri.behavior.ports import ANY, Param, means_same
from hri.core.errors import AuthoringError, did_you_mean

KINDS = {"parameters": "parameter", "inputs": "input", "outputs": "output"}
FORMER = {"integer": "number", "boolean": "string"}
"""How 2003, which knew two types of parameters, writes the others."""


def check_match(schema: Schema, cls: type[Behavior]) -> None:
    """Raise AuthoringError where a schema and its class differ, at the place in the schema."""
    for kind in KINDS:
        if kind == "parameters" or not cls.takes_any_ports:
            for part in getattr(schema, kind):
                _check_part(part, kind, cls)
    for kind in _complete(schema, cls):
        promised = {part.name for part in getattr(schema, kind)}
        for name, declared in getattr(cls, kind).items():
            if name not in promised:
                what = f'the {KINDS[kind]} "{name}" of {cls.__name__} is missing'
                raise AuthoringError(schema.place, what, f"add {_element(kind, name, declared)}")


def _complete(schema: Schema, cls: type[Behavior]) -> tuple[str, ...]:
    """What the schema has to declare in full."""
    has_ports = bool(schema.inputs or schema.outputs)
    if cls.takes_any_ports or not (has_ports or schema.parameters):
        return ()
    ports = ("inputs", "outputs") if has_ports or schema.brings_class else ()
    return ("parameters", *ports) if schema.brings_class else ports


def _check_part(part: Port | Parameter, kind: str, cls: type[Behavior]) -> None:
    declared = getattr(cls, kind).get(part.name)
    if declared is None:
        what = f'{cls.__name__} has no {KINDS[kind]} "{part.name}"'
        raise AuthoringError(part.place, what, _elsewhere(part.name, kind, cls))
    is_port = isinstance(part, Port)
    for difference in (_port_differences if is_port else _parameter_differences)(part, declared):
        if not difference.is_right:
            has = difference.of_class
            what = f'the {KINDS[kind]} "{part.name}" of {cls.__name__} is {has}'
            raise AuthoringError(part.place, what, f'write {difference.attribute}="{has}"')


class _Comparison(NamedTuple):
    """One attribute of a port or parameter."""

    attribute: str
    of_class: str
    is_right: bool
    """Whether the schema may say what it says."""


def _port_differences(port: Any, declared: Any) -> list[_Comparison]:
    datatype, meaning = declared.datatype, declared.semantic
    return [
        _Comparison("datatype", datatype, datatype in (port.datatype, ANY)),
        _Comparison("semantic_type", meaning, means_same(port.semantic_type, meaning)),
    ]


def _parameter_differences(parameter: Any, declared: Param[Any]) -> list[_Comparison]:
    try:
        declared.parse(parameter.default)
    except ValueError as error:
        what, _, remedy = str(error).partition(" - ")
        raise AuthoringError(parameter.place, f"{parameter.name}: {what}", remedy) from error
    kind, among = type_of_parameter(declared), tuple(declared.among)
    lowest, highest = declared.minimum, declared.maximum
    return [
        _Comparison("type", kind, parameter.type in ("", kind, FORMER.get(kind))),
        _Comparison("minimum", Param.text(lowest), parameter.minimum in (-math.inf, lowest)),
        _Comparison("maximum", Param.text(highest), parameter.maximum in (math.inf, highest)),
        _Comparison("choices", " ".join(among), parameter.choices in ((), among)),
    ]


def type_of_parameter(declared: Param[Any]) -> str:
    """The name that schemas use for the type of a parameter."""
    return next(name for name, empty in TYPES.items() if type(empty) is type(declared.default))


def _elsewhere(name: str, kind: str, cls: type[Behavior]) -> str:
    """What to do about a name that the class does not have there."""
    for other, noun in KINDS.items():
        if other != kind and name in getattr(cls, other):
            both = f'{name}_out = Output(..., name="{name}")'
            more = "" if "parameters" in (kind, other) else f", or let the class have both: {both}"
            return f"its {noun} has that name: move it to that{more}"
    return did_you_mean(name, getattr(cls, kind))


def _element(kind: str, name: str, declared: Any) -> str:
    """The element that a schema lacks, to copy."""
    if kind == "parameters":
        default, of_type = Param.text(declared.default), type_of_parameter(declared)
        return f'<Parameter name="{name}" type="{of_type}" default="{default}"/>'
    return f'<Port name="{name}" datatype="{declared.datatype}"/> to <{kind.capitalize()}>'
