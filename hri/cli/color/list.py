"""`hri color list`: the colors that can be found by name."""

from __future__ import annotations

import argparse
import json

from hri.core.errors import HriError
from hri.core.quoting import report
from hri.vision.color.color_model import color_names, find_color, load_color


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--json", action="store_true", help="as JSON")


def run(options: argparse.Namespace) -> int:
    """Exit status 1 when one is damaged."""
    rows, status = [], 0
    for name in color_names():
        path = find_color(name)
        row = {"name": name, "file": str(path)}
        try:
            row["learned"] = load_color(path).learned
        except HriError as error:
            row["error"], status = str(error), 1
        rows.append(row)
    if options.json:
        print(json.dumps(rows))
        return status
    for row in rows:
        report(row.get("error") or f"{row['name']:20} {row['learned']:10}  {row['file']}")
    return status
