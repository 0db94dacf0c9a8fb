"""`hri object merge`: several sets in one file."""

from __future__ import annotations

import argparse
from pathlib import Path

from hri.core.errors import HriError
from hri.core.quoting import report
from hri.vision.objects.model_file import find_models, load_models, save_models


def add_arguments(parser: argparse.ArgumentParser) -> None:
    about = "the sets; of two objects of one name the last one is taken"
    parser.add_argument("sets", nargs="+", metavar="SET.mdl", help=about)
    parser.add_argument("--out", type=Path, required=True, metavar="NEW.mdl", help="the new set")


def run(options: argparse.Namespace) -> int:
    loaded = [load_models(find_models(name)) for name in options.sets]
    merged = loaded[0]
    for name, models in zip(options.sets[1:], loaded[1:], strict=True):
        if models.method != merged.method:
            what = f"{name} has features of {models.method}, {options.sets[0]} of {merged.method}"
            raise HriError(f"{what} - learn one of them again")
        for model in models.objects:
            merged = merged.with_object(model)
    save_models(options.out, merged)
    report(f"{options.out}: {len(merged.objects)} objects")
    return 0
