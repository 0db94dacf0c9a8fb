"""Behavior types by name: classes that are declared, and those that a schema file defines."""

from __future__ import annotations

from pathlib import Path

from hri.behavior.behavior import Behavior
from hri.behavior.declaration import Port, Schema
from hri.behavior.ports import ANY, DATATYPES
from hri.behavior.schema import TYPE_NAME, load_schema, subclass
from hri.core import paths, registry
from hri.core.errors import AuthoringError, HriError, Place, did_you_mean
from hri.core.python_file import load_class

GROUP = "hri.behaviors"


def find_behavior(type_name: str) -> type[Behavior]:
    """The class of a behavior type: a declared one, else what `behavior/<NS>/<Name>.xml` defines.

    Raises HriError when there is neither, AuthoringError when the schema is wrong, NotAvailable
    when a package is not installed.
    """
    if registry.canonical(type_name) in registry.known(GROUP):
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
    is_file = schema.library.endswith(".py")
    cls = _class_in_file(schema, path) if is_file else _driver(schema)
    for port in (*schema.inputs, *schema.outputs):
        if port.datatype not in DATATYPES:
            remedy = did_you_mean(port.datatype, DATATYPES, "call declare_datatype in the library")
            raise AuthoringError(port.place, f'the datatype "{port.datatype}"', remedy)
    _check_against(schema, cls)
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
    remedy = registry.meant(GROUP, schema.driver)
    raise HriError(f'unknown driver "{schema.driver}" - {remedy}')


def _check_against(schema: Schema, cls: type[Behavior]) -> None:
    """Refuse a schema that promises what its class does not have. Raises AuthoringError."""
    for kind in ("parameters",) if cls.takes_any_ports else ("parameters", "inputs", "outputs"):
        has = getattr(cls, kind)
        for promised in getattr(schema, kind):
            if promised.name not in has:
                what = f'{cls.__name__} has no {kind[:-1]} "{promised.name}"'
                raise AuthoringError(promised.place, what, did_you_mean(promised.name, has))
            if isinstance(promised, Port):
                declared = has[promised.name].datatype
                if declared not in (promised.datatype, ANY):
                    what = f'the {kind[:-1]} "{promised.name}" of {cls.__name__} is {declared}'
                    raise AuthoringError(promised.place, what, f'write datatype="{declared}"')
