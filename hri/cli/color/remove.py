"""`hri color remove`: colors that are not needed any more."""

from __future__ import annotations

import argparse

from hri.core.errors import HriError, did_you_mean
from hri.core.quoting import report
from hri.core.writing import delete
from hri.vision.color.color_model import own_color_files


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("names", nargs="+", metavar="NAME", help="colors of your own")


def run(options: argparse.Namespace) -> int:
    own = {file.stem: file for file in own_color_files()}
    for name in options.names:
        if name not in own:
            raise HriError(f'no color "{name}" of your own - {did_you_mean(name, own)}')
    delete(*(own[name] for name in options.names))
    report(f"removed {', '.join(options.names)}")
    return 0
