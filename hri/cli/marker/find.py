"""`hri marker find`: which markers are in pictures, and where."""

from __future__ import annotations

import argparse
import json
import math
from pathlib import Path

from hri.cli.terminal.messages import Within
from hri.cli.vision.stills import Row, look_through
from hri.cli.vision.watching import VIEWS
from hri.core.quoting import quoted
from hri.core.signals import Marker
from hri.hal.drivers.still_image import StillImage
from hri.vision.camera_view import CameraView
from hri.vision.markers.families import NAMES
from hri.vision.markers.marker_reader import SIDE, MarkerReader


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("images", nargs="+", type=Path, metavar="FILE", help="pictures")
    about = "look for this family only; may be repeated"
    add("--family", action="append", choices=NAMES, help=about)
    add(
        "--size",
        type=Within(float, 5, 5000),
        default=SIDE * 1000,
        metavar="MM",
        help="millimeters of the black square (%(default)g)",
    )
    about = "horizontal field of view of the camera"
    add("--view", type=Within(float, *VIEWS), metavar="DEGREES", help=about)
    add("--json", action="store_true", help="one JSON object a picture")


def run(options: argparse.Namespace) -> int:
    """Exit status 1 when a picture could not be read."""
    view = CameraView() if options.view is None else CameraView(math.radians(options.view))
    reader = MarkerReader(options.family or NAMES, options.size / 1000, view)

    def look(still: StillImage) -> Row:
        return {"markers": [_row(still, one) for one in reader.find(still.image)]}

    return look_through(options.images, "looking", look, json.dumps if options.json else _line)


def _row(still: StillImage, one: Marker) -> Row:
    """A marker for JSON, in pixels of the picture as it is stored."""
    corners = [still.stored(x, y) for x, y in one.outline]
    across, down = still.stored(one.x, one.y)
    return {
        "family": one.family,
        "id": one.id if one.id >= 0 else None,
        "text": one.text if one.id < 0 else None,
        "x": round(across, 1),
        "y": round(down, 1),
        "outline": [[round(x, 1), round(y, 1)] for x, y in corners],
        "distance_m": round(one.distance, 3),
        "bearing_deg": round(math.degrees(one.bearing), 1),
        "elevation_deg": round(math.degrees(one.elevation), 1),
        "tilt_deg": round(math.degrees(one.tilt), 1),
        "is_tilt_sure": one.is_sure,
    }


def _line(row: Row) -> str:
    if "error" in row:
        return str(row["error"])
    found = [
        f"{one['family']} {quoted(one['text'] or str(one['id']))},"
        f" {one['distance_m']:.2f} m, {one['bearing_deg']:+.0f} degrees, tilt {one['tilt_deg']:.0f}"
        for one in row["markers"]
    ]
    return f"{row['file']}: {'; '.join(found) or 'no markers'}"
