"""`hri object split`: some objects of a set in a separate file."""

from __future__ import annotations

import argparse
from pathlib import Path

from hri.cli.object.options import add_set, loaded, object_of
from hri.core.quoting import report
from hri.vision.objects.model_file import save_models
from hri.vision.objects.object_model import ModelSet


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_set(parser)
    parser.add_argument("names", nargs="+", metavar="NAME", help="the objects")
    parser.add_argument("--out", type=Path, required=True, metavar="NEW.mdl", help="the new set")


def run(options: argparse.Namespace) -> int:
    models = loaded(options)
    chosen = tuple(object_of(models, name) for name in options.names)
    save_models(options.out, ModelSet(models.method, chosen))
    report(f"{options.out}: {len(chosen)} objects")
    return 0
