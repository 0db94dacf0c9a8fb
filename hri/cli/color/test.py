"""`hri color test`: which blobs of colors are in pictures."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from hri.cli.vision.stills import Row, color_finder, color_rows, look_through
from hri.hal.drivers.still_image import StillImage


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("images", nargs="+", type=Path, metavar="FILE", help="pictures")
    about = "names of colors, or paths of their files, with commas between (all)"
    parser.add_argument("--colors", default="", metavar="NAMES", help=about)
    parser.add_argument("--json", action="store_true", help="one JSON object a picture")


def run(options: argparse.Namespace) -> int:
    """Exit status 1 when a picture could not be read."""
    find = color_finder(options.colors)

    def look(still: StillImage) -> Row:
        return {"colors": color_rows(still, find(still.image))}

    return look_through(options.images, "looking", look, json.dumps if options.json else _line)


def _line(row: Row) -> str:
    found = [f"{one['name']} at ({one['x']:g}, {one['y']:g})" for one in row.get("colors", ())]
    return row.get("error") or f"{row['file']}: {', '.join(found) or 'none of the colors'}"
