"""`hri face sheet`: all looks of a face, with labels."""

from __future__ import annotations

import argparse
from pathlib import Path

from hri.cli.face.options import FACE
from hri.face import load_face
from hri.hal.drivers.image_size import write_picture


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--face", default="robot", metavar="NAME", help=FACE)
    parser.add_argument("--out", required=True, type=Path, metavar="FILE.png")


def run(options: argparse.Namespace) -> int:
    from hri.face.renderers.contact_sheet import draw_sheet

    write_picture(options.out, draw_sheet(load_face(options.face)))
    return 0
