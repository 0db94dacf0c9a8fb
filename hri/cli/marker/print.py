"""`hri marker print`: a card with a marker or a QR code."""

from __future__ import annotations

import argparse
from pathlib import Path

from hri.cli.terminal.messages import Within
from hri.core.errors import HriError
from hri.core.quoting import report
from hri.vision.markers.families import DEFAULT, FAMILIES
from hri.vision.markers.marker_card import code_card, marker_card, write_card
from hri.vision.markers.marker_reader import SIDE


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("id", nargs="?", type=Within(int, 0, 9999), metavar="ID", help="of the marker, such as 7")
    add("--text", metavar="TEXT", help="a QR code with this text instead")
    add("--family", default=DEFAULT, choices=FAMILIES, help="(%(default)s)")
    add(
        "--size",
        type=Within(float, 10, 1000),
        default=SIDE * 1000,
        metavar="MM",
        help="millimeters of the black square (%(default)g)",
    )
    add("--out", type=Path, default=Path("card.pdf"), metavar="F.pdf", help="or .png (%(default)s)")


def run(options: argparse.Namespace) -> int:
    if (options.id is None) == (options.text is None):
        raise HriError("which card is not clear - give the ID of a marker, or --text TEXT")
    if options.text is None:
        card = marker_card(options.family, options.id, options.size)
    else:
        card = code_card(options.text, options.size)
    write_card(options.out, card)
    width, height = card.size_mm
    report(f"wrote {options.out}: {width} x {height} mm, {card.caption}")
    report(f"print it at 100 %; then the black square is {options.size:g} mm wide: measure it")
    return 0
