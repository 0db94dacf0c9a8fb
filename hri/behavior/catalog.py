"""Behavior types by name: classes that are declared, and those that a schema file defines."""

from __future__ import annotations

import re
from pathlib import Path

from hri.behavior.behavior import Behavior
from hri.behavior.declaration import Schema
from hri.behavior.ports import DATATYPES
from hri.behavior.schema import TYPE_NAME, load_schema, subclass
from hri.behavior.schema_match import check_match
from hri.core import paths, registry
from hri.core.errors import AuthoringError, HriError, Place, did_you_mean
from hri.core.python_file import load_class

GROUP = "hri.behaviors"
COMPILED = re.compile(r"\.(so|dll|dylib)$|^lib\w+$")
"""Libraries of 2003, whose code is not Python."""


def find_behavior(type_name: str) -> type[Behavior]:
    """The class of a behavior type: a declared one, else what `behavior/<NS>/<Name>.xml` defines.

    Raises HriError when there is neither, AuthoringError when the schema is wrong, NotAvailable
    when a package is not installed.
    """
    if registry.canonical(type_name) in registry.known(GROUP) and not _is_exercise(type_name):
        declared: type[Behavior] = registry.find(GROUP, type_name)
        return declared
    path = find_schema(type_name)
    schema = load_schema(path)
    if schema.type != type_name:
        what = f'this is the schema of "{schema.type}", not of "{type_name}"'
        raise AuthoringError(Place(path), what, "rename the file, or fix its type")
    try:
        return _behavior_of(schema, path)
    except AuthoringError:
        raise
    except (HriError, ValueError) as error:
        what, _, remedy = str(error).partition(" - ")
        raise AuthoringError(Place(path), what, remedy or "fix the schema") from error


def _is_exercise(type_name: str) -> bool:
    """Whether someone wrote an example of 2003 that comes with the library, too."""
    if not type_name.startswith("Examples."):
        return False
    try:
        find_schema(type_name)
    except HriError:
        return False
    return True


def find_schema(type_name: str) -> Path:
    """The file `behavior/<NS>/<Name>.xml`, in the first search folder that has one.

    Raises HriError that names the folders when none has.
    """
    if not TYPE_NAME.fullmatch(type_name):
        raise HriError(f'"{type_name}" is not a behavior type - write Namespace.Name')
    file = f"behavior/{type_name.replace('.', '/')}.xml"
    try:
        return paths.find("config", file)
    except HriError as error:
        searched = ", ".join(str(folder) for folder in paths.search_folders())
        otherwise = f"no {file} in {searched}; add it there, or set HRI_PATH"
        remedy = registry.meant(GROUP, type_name, otherwise)
        raise HriError(f'unknown behavior type "{type_name}" - {remedy}') from error


def _behavior_of(schema: Schema, path: Path) -> type[Behavior]:
    cls = _class_in_file(schema, path) if schema.brings_class else _driver(schema)
    for port in (*schema.inputs, *schema.outputs):
        if port.datatype not in DATATYPES:
            remedy = did_you_mean(port.datatype, DATATYPES, "call declare_datatype in the library")
            raise AuthoringError(port.place, f'the datatype "{port.datatype}"', remedy)
    check_match(schema, cls)
    return subclass(cls, schema)


def _class_in_file(schema: Schema, path: Path) -> type[Behavior]:
    cls = load_class(path.parent / schema.library, schema.driver.rpartition(".")[2])
    if not issubclass(cls, Behavior):
        raise HriError(f"{schema.driver} is not a Behavior - derive it from Behavior")
    return cls  # type: ignore[no-any-return]


def type_of(behavior: Behavior) -> str:
    """The name that files use for the type of a behavior. Raises HriError when it has none."""
    cls = type(behavior)
    name = cls.schema.type if cls.schema is not None else registry.name_of(GROUP, cls)
    if not name:
        remedy = "declare it as an entry point, or write a schema for it"
        raise HriError(f"{cls.__name__} has no name that a file could use - {remedy}")
    return name


def _driver(schema: Schema) -> type[Behavior]:
    if registry.canonical(schema.driver) in registry.known(GROUP):
        driver: type[Behavior] = registry.find(GROUP, schema.driver)
        return driver
    compiled = 'write its class in Python, and name that file as the library: library="./name.py"'
    otherwise = compiled if COMPILED.search(schema.library) else ""
    remedy = registry.meant(GROUP, schema.driver, otherwise)
    raise HriError(f'unknown driver "{schema.driver}" - {remedy}')
