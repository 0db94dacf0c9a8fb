"""`hri object test`: which objects are in pictures."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from hri.cli.object.options import add_set, loaded
from hri.cli.terminal.progress_line import progress
from hri.cli.vision.stills import object_rows
from hri.core.errors import HriError
from hri.hal.drivers.still_image import read_still
from hri.vision.objects.recognizer import ObjectRecognizer


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_set(parser)
    parser.add_argument("images", nargs="+", type=Path, metavar="FILE", help="pictures")
    parser.add_argument("--json", action="store_true", help="one JSON object a picture")


def run(options: argparse.Namespace) -> int:
    """Exit status 1 when a picture could not be read."""
    recognizer = ObjectRecognizer(loaded(options))
    status = 0
    for path in progress(options.images, len(options.images), "recognizing"):
        try:
            still = read_still(path)
        except HriError as error:
            print(error, file=sys.stderr)
            status = 1
            continue
        rows = object_rows(still, recognizer.recognize(still.image))
        if options.json:
            print(json.dumps({"file": str(path), "objects": rows}))
            continue
        names = [f"{row['name']} ({row['confidence']:.2f})" for row in rows]
        print(f"{path}: {', '.join(names) or 'nothing known'}")
    return status
