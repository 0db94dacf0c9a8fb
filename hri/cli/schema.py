"""`hri schema export`: writes the schemas of behaviors as XML for tools."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from hri.behavior.catalog import GROUP, find_behavior
from hri.behavior.declaration import Schema
from hri.behavior.schema import schema_of, write_schema
from hri.core import registry
from hri.core.errors import HriError, NotAvailable
from hri.core.quoting import report
from hri.core.writing import make_folder, write_text


def add_arguments(parser: argparse.ArgumentParser) -> None:
    commands = parser.add_subparsers(dest="action", required=True)
    about = "write schemas as XML: to the screen, or to DIR/behavior/Namespace/Name.xml"
    export = commands.add_parser("export", help=about, description=about)
    export.add_argument("types", nargs="*", metavar="TYPE", help="behavior types: Hri.Constant")
    export.add_argument("--all", action="store_true", help="all declared types")
    export.add_argument("--to", type=Path, metavar="DIR", help="a search folder to write to")


def run(options: argparse.Namespace) -> int:
    if bool(options.types) == options.all:
        raise HriError("no behavior types to export - name some, or say --all")
    types = registry.known(GROUP) if options.all else options.types
    status = 0
    for type_name in types:
        try:
            schema = schema_of(find_behavior(type_name), registry.canonical(type_name))
        except NotAvailable as error:
            print(error, file=sys.stderr)
            status = 1
            continue
        _export(schema, options.to)
    return status


def _export(schema: Schema, folder: Path | None) -> None:
    if folder is None:
        print(write_schema(schema), end="")
        return
    path = folder / "behavior" / f"{schema.type.replace('.', '/')}.xml"
    make_folder(path.parent)
    write_text(path, write_schema(schema))
    report(str(path))
