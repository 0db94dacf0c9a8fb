"""`hri object test`: which objects are in pictures."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from hri.cli.object.options import add_set, loaded
from hri.cli.vision.stills import Row, look_through, object_rows
from hri.hal.drivers.still_image import StillImage
from hri.vision.objects.embedding import Embedding
from hri.vision.objects.recognizer import ObjectRecognizer


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_set(parser)
    parser.add_argument("images", nargs="+", type=Path, metavar="FILE", help="pictures")
    parser.add_argument(
        "--embedding",
        type=Path,
        metavar="FILE.onnx",
        help="a network that describes pictures, for plain objects",
    )
    parser.add_argument("--json", action="store_true", help="one JSON object a picture")


def run(options: argparse.Namespace) -> int:
    """Exit status 1 when a picture could not be read."""
    embedding = None if options.embedding is None else Embedding(options.embedding)
    recognizer = ObjectRecognizer(loaded(options), embedding=embedding)

    def look(still: StillImage) -> Row:
        return {"objects": object_rows(still, recognizer.recognize(still.image))}

    return look_through(options.images, "recognizing", look, json.dumps if options.json else _line)


def _line(row: Row) -> str:
    names = [f"{one['name']} ({one['confidence']:.2f})" for one in row.get("objects", ())]
    return row.get("error") or f"{row['file']}: {', '.join(names) or 'nothing known'}"
