"""`hri color test`: which blobs of colors are in pictures."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from hri.cli.vision.stills import color_finder, color_rows, look_through
from hri.hal.drivers.still_image import StillImage


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("images", nargs="+", type=Path, metavar="FILE", help="pictures")
    about = "names of colors, or paths of their files, with commas between (all)"
    parser.add_argument("--colors", default="", metavar="NAMES", help=about)
    parser.add_argument("--json", action="store_true", help="one JSON object a picture")


def run(options: argparse.Namespace) -> int:
    """Exit status 1 when a picture could not be read."""
    find = color_finder(options.colors)

    def report(still: StillImage, path: Path) -> str:
        rows = color_rows(still, find(still.image))
        if options.json:
            return json.dumps({"file": str(path), "colors": rows})
        found = [f"{row['name']} at ({row['x']:g}, {row['y']:g})" for row in rows]
        return f"{path}: {', '.join(found) or 'none of the colors'}"

    return look_through(options.images, "looking", report)
