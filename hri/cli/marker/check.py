"""`hri marker check`: whether a table of cards is whole, and what each card starts."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from hri.core.quoting import report
from hri.vision.markers.card_table import load_cards


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", type=Path, metavar="cards.toml", help="the table")
    parser.add_argument("--json", action="store_true", help="one JSON object")


def run(options: argparse.Namespace) -> int:
    cards = load_cards(options.file)
    if options.json:
        print(json.dumps({"cards": dict(cards)}))
        return 0
    for name, say in cards.items():
        report(f"{name}: {say}")
    return 0
