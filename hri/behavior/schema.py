"""Schemas: what a behavior declares, as XML, for tools and for behaviors that have no code.

<BehaviorSchema type="Examples.Numbers" driver="Evolution.MalleableBehavior"
                display_name="Numbers" library="libevobeutil" category="sample_code">
  <Parameter name="tcp_port" type="number" default="25000"/>
  <Inputs>
    <Port name="numbers" datatype="doublearray" description="Numbers to send."
          semantic_type="Evolution.Generic"/>
  </Inputs>
</BehaviorSchema>

A Python class is the source of truth for its schema. Where a schema defines a behavior, its
`driver` names the class that does the work.
"""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

from hri.behavior.behavior import Behavior
from hri.behavior.declaration import TYPES, Parameter, Port, Schema
from hri.behavior.ports import DATATYPES, GENERIC, Input, Output, Param
from hri.behavior.schema_match import type_of_parameter
from hri.core import registry
from hri.core.errors import AuthoringError, did_you_mean
from hri.core.xml import Element, format_xml, load_xml

NAME = re.compile(r"[A-Za-z]\w*", re.ASCII)
"""Of ports and parameters; what begins with _ is the driver's own."""
TYPE_NAME = re.compile(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)+", re.ASCII)


def schema_of(cls: type[Behavior], type_name: str = "") -> Schema:
    """The schema of a class; `type_name` is the name that files use, where it is not declared."""
    if cls.schema is not None:
        return cls.schema
    name = type_name or registry.name_of("hri.behaviors", cls) or cls.__name__
    return Schema(
        type=name,
        driver=name,
        display_name=re.sub(r"(?<=[a-z0-9])(?=[A-Z])", " ", name.rpartition(".")[2]),
        library=cls.__module__,
        category=cls.category,
        parameters=tuple(_parameter(param) for param in cls.parameters.values()),
        inputs=tuple(_port(port) for port in cls.inputs.values()),
        outputs=tuple(_port(port) for port in cls.outputs.values()),
    )


def subclass(driver: type[Behavior], schema: Schema) -> type[Behavior]:
    """A class with the ports and parameters of a schema, and the code of its driver.

    `hri.behavior.schema_match.check_match` has compared the two. Raises AuthoringError when the
    driver uses the name of a new part for something else.
    """
    for kind in ("parameters", "inputs", "outputs"):
        for part in getattr(schema, kind):
            if hasattr(driver, part.name) and part.name not in getattr(driver, kind):
                what = f'{driver.__name__} uses the name "{part.name}" for something else'
                raise AuthoringError(part.place, what, "choose another word")
    members: dict[str, Any] = {"__doc__": f"{schema.display_name}, defined by its schema."}
    for parameter in schema.parameters:
        members[parameter.name] = _declare(parameter, driver.parameters.get(parameter.name))
    for port in schema.inputs:
        members[port.name] = _declare_input(port, driver.inputs.get(port.name))
    for port in schema.outputs:
        is_shared = port.name in driver.inputs or port.name in members
        attribute = f"{port.name} (output)" if is_shared else port.name
        if own := driver.outputs.get(port.name):
            attribute = own.attribute
        meaning = _meaning(port, own)
        members[attribute] = Output(port.datatype, port.description, meaning, name=port.name)
    members["category"] = schema.category
    cls: type[Behavior] = type(schema.type.rpartition(".")[2], (driver,), members)
    whole = schema_of(cls, schema.type)
    cls.schema = replace(
        whole,
        driver=schema.driver,
        display_name=schema.display_name,
        library=schema.library,
    )
    return cls


def _declare(parameter: Parameter, inherited: Param[Any] | None) -> Param[Any]:
    """A parameter as the schema has it; one of the driver keeps its type and range."""
    if inherited is None:
        return parameter.declare()
    return Param(
        inherited.parse(parameter.default),
        parameter.description or inherited.doc,
        minimum=inherited.minimum,
        maximum=inherited.maximum,
        among=inherited.among,
    )


def _declare_input(port: Port, inherited: Input[Any] | None) -> Input[Any]:
    is_optional = inherited is not None and inherited.is_optional
    meaning = _meaning(port, inherited)
    return Input(port.datatype, port.description, meaning, is_optional=is_optional)


def _meaning(port: Port, inherited: Input[Any] | Output[Any] | None) -> str:
    """What the schema says that a port means; where that is generic, what the driver says."""
    if inherited is None or port.semantic_type != GENERIC:
        return port.semantic_type
    return inherited.semantic


def load_schema(path: Path) -> Schema:
    """Read a schema. Raises AuthoringError with the place of the first mistake."""
    root = load_xml(path, "behavior schema")
    if root.tag != "BehaviorSchema":
        raise root.error(f"the root is <{root.tag}>", "write <BehaviorSchema> around it all")
    # The guide itself writes <Output> once.
    root.check(
        ("Parameter", "Inputs", "Outputs", "Output"),
        ("type", "driver", "display_name", "library", "category"),
    )
    name = root.get("type")
    if not TYPE_NAME.fullmatch(name):
        raise root.error(f'"{name}" is not a type', "write Namespace.Name", "type")
    found: dict[str, list[Any]] = {"Parameter": [], "Inputs": [], "Outputs": [], "Output": []}
    inputs: set[str] = set()  # with the parameters, which share no name with any port
    outputs: set[str] = set()
    for element in root:
        if element.tag == "Parameter":
            parameter = _read_parameter(element, inputs | outputs)
            found["Parameter"].append(parameter)
            inputs.add(parameter.name)
            outputs.add(parameter.name)
            continue
        element.check(("Port",))
        seen = inputs if element.tag == "Inputs" else outputs
        found[element.tag].extend(_read_port(child, seen) for child in element)
    return Schema(
        type=name,
        driver=root.get("driver"),
        display_name=root.get("display_name", name.rpartition(".")[2]),
        library=root.get("library", ""),
        category=root.get("category", "util"),
        parameters=tuple(found["Parameter"]),
        inputs=tuple(found["Inputs"]),
        outputs=tuple(found["Outputs"] + found["Output"]),
        place=root.place,
    )


def _read_name(element: Element, seen: set[str]) -> str:
    name = element.get("name")
    if not NAME.fullmatch(name) or hasattr(Behavior, name):
        raise element.error(f'the name "{name}" cannot be used', "choose another word", "name")
    if name in seen:
        raise element.error(f'the name "{name}" is used twice', "rename one of them", "name")
    seen.add(name)
    return name


def _read_parameter(element: Element, seen: set[str]) -> Parameter:
    element.check((), ("name", "type", "default", "description", "minimum", "maximum", "choices"))
    name = _read_name(element, seen)
    kind = element.get("type", "")
    if kind and kind not in TYPES:
        raise element.error(f'the type "{kind}"', did_you_mean(kind, TYPES), "type")
    parameter = Parameter(
        name,
        kind,
        element.get("default", ""),
        element.get("description", ""),
        element.number("minimum", -math.inf),
        element.number("maximum", math.inf),
        tuple(element.get("choices", "").split()),
        element.place,
    )
    try:
        parameter.declare()
    except ValueError as error:
        what, _, remedy = str(error).partition(" - ")
        raise element.error(f"{name}: {what}", remedy, "default") from error
    return parameter


def _read_port(element: Element, seen: set[str]) -> Port:
    element.check((), ("name", "datatype", "description", "semantic_type"))
    datatype = element.get("datatype")
    # One of your own, with a dot in its name, is declared by the library of the schema.
    if datatype not in DATATYPES and "." not in datatype:
        remedy = did_you_mean(datatype, DATATYPES)
        raise element.error(f'the datatype "{datatype}"', remedy, "datatype")
    return Port(
        _read_name(element, seen),
        datatype,
        element.get("description", ""),
        element.get("semantic_type", GENERIC),
        element.place,
    )


def write_schema(schema: Schema) -> str:
    """The canonical text of a schema file."""
    names = ("type", "driver", "display_name", "library", "category")
    root = Element("BehaviorSchema", _attributes(schema, *names))
    root.children.extend(_parameter_element(parameter) for parameter in schema.parameters)
    for tag, ports in (("Inputs", schema.inputs), ("Outputs", schema.outputs)):
        if ports:
            root.children.append(Element(tag, {}, children=[_port_element(p) for p in ports]))
    return format_xml(root)


def _port_element(port: Port) -> Element:
    names = ("name", "datatype", "description", "semantic_type")
    return Element("Port", _attributes(port, *names))


def _attributes(of: Schema | Port | Parameter, *names: str) -> dict[str, str]:
    return {name: getattr(of, name) for name in names}


def _parameter_element(parameter: Parameter) -> Element:
    attributes = _attributes(parameter, "name", "type", "default", "description")
    if parameter.minimum != -math.inf:
        attributes["minimum"] = Param.text(parameter.minimum)
    if parameter.maximum != math.inf:
        attributes["maximum"] = Param.text(parameter.maximum)
    if parameter.choices:
        attributes["choices"] = " ".join(parameter.choices)
    return Element("Parameter", attributes)


def _parameter(declared: Param[Any]) -> Parameter:
    return Parameter(
        declared.name,
        type_of_parameter(declared),
        Param.text(declared.default),
        declared.doc,
        declared.minimum,
        declared.maximum,
        tuple(declared.among),
    )


def _port(declared: Input[Any] | Output[Any]) -> Port:
    return Port(declared.name, declared.datatype, declared.doc, declared.semantic)
