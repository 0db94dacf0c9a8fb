"""`hri object list`: the objects of a set."""

from __future__ import annotations

import argparse
import json

from hri.cli.object.attribute import attribute_lines
from hri.cli.object.options import add_set, loaded
from hri.core.quoting import report


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_set(parser)
    parser.add_argument("--json", action="store_true", help="as JSON")


def run(options: argparse.Namespace) -> int:
    models = loaded(options)
    rows = [
        {
            "name": model.name,
            "views": len(model.views),
            "features": sum(len(view.features) for view in model.views),
            "size_known": any(view.scale > 0 for view in model.views),
            "learned": model.learned,
            "attributes": dict(model.attributes),
        }
        for model in models.objects
    ]
    if options.json:
        print(json.dumps({"method": models.method, "objects": rows}))
        return 0
    for row, model in zip(rows, models.objects, strict=True):
        size = "size known" if row["size_known"] else "size unknown"
        line = (
            f"{row['name']:20} {row['views']:2} views  {row['features']:5} features"
            f"  {size:12}  {row['learned']}".rstrip()
        )
        report(" ".join((line, *attribute_lines(model.attributes))))
    return 0
