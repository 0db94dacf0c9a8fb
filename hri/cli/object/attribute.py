"""`hri object attribute`: what is noted of an object beside its name."""

from __future__ import annotations

import argparse
from dataclasses import replace

from hri.cli.object.options import add_set, loaded, object_of, set_path
from hri.core.errors import HriError
from hri.core.quoting import escaped
from hri.vision.objects.model_file import save_models
from hri.vision.objects.object_attributes import Attributes, with_changes

EPILOG = """\
Numbers and texts that a program reads when the object is recognized:
`hri object attribute cup owner=Ann price=3.5`. Without a value, `owner=`, one is taken away;
without any, they are listed."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = EPILOG
    add_set(parser)
    parser.add_argument("name", metavar="NAME", help="the object")
    parser.add_argument("changes", nargs="*", metavar="KEY=VALUE", help="what to set")


def run(options: argparse.Namespace) -> int:
    models = loaded(options)
    model = object_of(models, options.name)
    if options.changes:
        changes = dict(map(_pair, options.changes))
        # Not `with_object`, which keeps the attributes of an object that is learned again.
        changed = replace(model, attributes=with_changes(model.attributes, changes))
        objects = tuple(changed if one is model else one for one in models.objects)
        save_models(set_path(options), replace(models, objects=objects))
        model = changed
    for line in attribute_lines(model.attributes):
        print(line)
    return 0


def attribute_lines(attributes: Attributes) -> list[str]:
    """A line for each attribute, `name=value`."""
    return [
        escaped(f"{name}={value if isinstance(value, str) else format(value, 'g')}")
        for name, value in attributes.items()
    ]


def _pair(text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not equals:
        raise HriError(f'"{text}" is not an attribute - write KEY=VALUE, or KEY= to take it away')
    return name, value
