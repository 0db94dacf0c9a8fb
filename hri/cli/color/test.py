"""`hri color test`: which blobs of colors are in pictures."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from hri.cli.terminal.progress_line import progress
from hri.cli.vision.stills import color_finder, color_rows
from hri.core.errors import HriError
from hri.hal.drivers.still_image import read_still


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("images", nargs="+", type=Path, metavar="FILE", help="pictures")
    about = "names of colors, or paths of their files, with commas between (all)"
    parser.add_argument("--colors", default="", metavar="NAMES", help=about)
    parser.add_argument("--json", action="store_true", help="one JSON object a picture")


def run(options: argparse.Namespace) -> int:
    """Exit status 1 when a picture could not be read."""
    status = 0
    find = color_finder(options.colors)
    for path in progress(options.images, len(options.images), "looking"):
        try:
            still = read_still(path)
        except HriError as error:
            print(error, file=sys.stderr)
            status = 1
            continue
        rows = color_rows(still, find(still.image))
        if options.json:
            print(json.dumps({"file": str(path), "colors": rows}))
            continue
        found = [f"{row['name']} at ({row['x']:g}, {row['y']:g})" for row in rows]
        print(f"{path}: {', '.join(found) or 'none of the colors'}")
    return status
