"""`hri marker list`: which families there are."""

from __future__ import annotations

import argparse
import json

from hri.core.quoting import report
from hri.vision.markers.families import DEFAULT, FAMILIES, QR
from hri.vision.markers.qr_codes import LONGEST


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--json", action="store_true", help="one JSON object")


def run(options: argparse.Namespace) -> int:
    if options.json:
        rows = [{"family": name, "markers": family.count} for name, family in FAMILIES.items()]
        print(json.dumps({"families": [*rows, {"family": QR, "markers": None}]}))
        return 0
    for name, family in FAMILIES.items():
        usual = ", used unless another is named" if name == DEFAULT else ""
        report(f"{name}: {family.count} markers, 0 to {family.count - 1}{usual}")
    report(f"{QR}: codes with a text of up to {LONGEST} characters")
    return 0
