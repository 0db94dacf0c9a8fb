"""`hri object remove`: objects that are not to be recognized any more."""

from __future__ import annotations

import argparse

from hri.cli.object.options import add_set, loaded, object_of, set_path
from hri.core.quoting import report
from hri.vision.objects.model_file import save_models


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_set(parser)
    parser.add_argument("names", nargs="+", metavar="NAME", help="the objects")


def run(options: argparse.Namespace) -> int:
    models = loaded(options)
    for name in options.names:
        object_of(models, name)
    for name in options.names:
        models = models.without(name)
    save_models(set_path(options), models)
    report(f"removed {', '.join(options.names)}; {len(models.objects)} left")
    return 0
