"""`hri watch --stills`: what is in pictures, each by itself, as JSON."""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from hri.cli.terminal.progress_line import progress
from hri.core.errors import HriError
from hri.core.quoting import report
from hri.core.signals import ColorBlob, FaceBox, FoundObject, Image, Person
from hri.hal.drivers.still_image import StillImage, read_still

Row = dict[str, Any]
Look = Callable[[StillImage], list[Row]]

BODY_HEIGHT = 1.7
"""Meters, of an adult's body."""


def run(options: argparse.Namespace) -> int:
    """Exit status 1 when a picture could not be read."""
    looks = _looks(options)

    def look(still: StillImage) -> Row:
        return {name: look(still) for name, look in looks.items()}

    return look_through(options.stills, "looking", look, json.dumps if options.json else _line)


def look_through(
    paths: Sequence[Path],
    doing: str,
    look: Callable[[StillImage], Row],
    tell: Callable[[Row], str],
) -> int:
    """Print a row for each picture as soon as it was looked at.

    One that cannot be read has its `error` as a row, and on standard error. Exit status 1 when
    there was one.
    """
    status = 0
    for path in progress(paths, len(paths), doing):
        row: Row = {"file": str(path)}
        try:
            row |= look(read_still(path))
        except HriError as error:
            print(error, file=sys.stderr)
            row["error"], status = str(error), 1
        report(tell(row), flush=True)
    return status


def _looks(options: argparse.Namespace) -> dict[str, Look]:
    """What is looked for: what was asked for, else people."""
    looks: dict[str, Look] = {}
    if options.people or (options.objects is None and options.colors is None):
        looks["people"] = _people(options)
    if options.objects is not None:
        looks["objects"] = _objects(options)
    if options.colors is not None:
        looks["colors"] = _colors(options)
    return looks


def _people(options: argparse.Namespace) -> Look:
    from hri.vision.detectors.detector_choice import load_detectors
    from hri.vision.tracking.still import see_still

    detectors = load_detectors(options.detector)
    for problem in detectors.problems:
        print(problem, file=sys.stderr)
    view = _view(options)

    def look(still: StillImage) -> list[Row]:
        seen = see_still(detectors, still.image, view)
        rows = [_person_row(still, person, seen.confidence(person)) for person in seen.persons]
        return rows + _bodies(still, seen.persons, view)

    return look


def _bodies(still: StillImage, persons: Iterable[Person], view: Any) -> list[Row]:
    """Those whose face is not seen."""
    from hri.vision.detectors.body import find_bodies

    faces = [person.pose.box for person in persons]
    height, width = still.image.shape[:2]
    rows = []
    for box, confidence in find_bodies(still.image):
        if any(_has_inside(box, face) for face in faces if face is not None):
            continue
        distance = view.focal_length((width, height)) * BODY_HEIGHT / box.height
        rows.append(
            _box_row(still, box)
            | {
                "distance_m": round(distance, 3),
                "yaw_deg": None,
                "pitch_deg": None,
                "roll_deg": None,
                "confidence": round(confidence, 3),
            }
        )
    return rows


def _has_inside(body: FaceBox, face: FaceBox) -> bool:
    x, y = face.x + face.width / 2, face.y + face.height / 2
    return body.x <= x <= body.x + body.width and body.y <= y <= body.y + body.height


def _objects(options: argparse.Namespace) -> Look:
    from hri.vision.objects.model_file import find_models, load_models
    from hri.vision.objects.recognizer import ObjectRecognizer

    recognizer = ObjectRecognizer(load_models(find_models(options.objects)), _view(options))
    return lambda still: object_rows(still, recognizer.recognize(still.image))


def _colors(options: argparse.Namespace) -> Look:
    find = color_finder(options.colors)
    return lambda still: color_rows(still, find(still.image))


def color_finder(names: str) -> Callable[[Image], tuple[ColorBlob, ...]]:
    """Finds the colors of these names, commas between; of none all that are known.

    Each picture by itself: the light of one is not that of the next. Raises HriError.
    """
    from hri.vision.color.segmentation import ColorSegmenter

    tables = color_tables(names)
    return lambda image: ColorSegmenter(tables).segment(image)


def color_tables(names: str) -> Mapping[str, Any]:
    """The tables of colors of these names. Raises HriError."""
    from hri.vision.color.color_model import color_names, find_color
    from hri.vision.color.segmentation import tables_of

    chosen = [name for name in names.split(",") if name] or color_names()
    if not chosen:
        raise HriError("no color is known - hri color learn NAME --images FILE --box X,Y,W,H")
    return tables_of([find_color(name) for name in chosen])


def color_rows(still: StillImage, found: Iterable[ColorBlob]) -> list[Row]:
    """The blobs of a picture for JSON, in pixels of the picture as it is stored."""
    return [
        {
            "name": one.name,
            **_point(still, one.x, one.y),
            **_size(still, one.width, one.height),
            "area": round(one.area),
            "confidence": round(one.confidence, 3),
            "outline": [[*_point(still, x, y).values()] for x, y in one.outline],
        }
        for one in found
    ]


def _size(still: StillImage, width: float, height: float) -> Row:
    """A size of the upright picture in that which is stored."""
    lies = still.orientation > 4
    across, down = (height, width) if lies else (width, height)
    return {"width": round(across, 1), "height": round(down, 1)}


def _view(options: argparse.Namespace) -> Any:
    from hri.vision.camera_view import CameraView

    return CameraView() if options.view is None else CameraView(math.radians(options.view))


def object_rows(still: StillImage, found: Iterable[FoundObject]) -> list[Row]:
    """The objects of a picture for JSON, in pixels of the picture as it is stored."""
    return [
        {
            "name": one.name,
            **_point(still, one.x, one.y),
            "outline": [[*_point(still, x, y).values()] for x, y in one.outline],
            "distance_m": _number(one.distance),
            "confidence": round(one.confidence, 3),
            "attributes": dict(one.attributes),
        }
        for one in found
    ]


def _person_row(still: StillImage, person: Person, confidence: float) -> Row:
    pose = person.pose
    assert pose.box is not None
    # Only the mesh shows how a head is turned.
    angles = (pose.yaw, pose.pitch, pose.roll) if person.landmarks is not None else (math.nan,) * 3
    yaw, pitch, roll = (_number(math.degrees(angle), 1) for angle in angles)
    return _box_row(still, pose.box) | {
        "distance_m": _number(person.distance),
        "yaw_deg": yaw,
        "pitch_deg": pitch,
        "roll_deg": roll,
        "confidence": _number(min(1.0, confidence)),
    }


def _box_row(still: StillImage, box: FaceBox) -> Row:
    """A box of the upright picture in that which is stored."""
    corners = [still.stored(box.x, box.y), still.stored(box.x + box.width, box.y + box.height)]
    (left, right), (top, bottom) = (sorted(axis) for axis in zip(*corners, strict=True))
    return {
        "x": round(left, 1),
        "y": round(top, 1),
        "width": round(right - left, 1),
        "height": round(bottom - top, 1),
    }


def _point(still: StillImage, x: float, y: float) -> Row:
    across, down = still.stored(x, y)
    return {"x": round(across, 1), "y": round(down, 1)}


def _number(value: float, digits: int = 3) -> float | None:
    """JSON has neither NaN nor infinity."""
    return round(value, digits) if math.isfinite(value) else None


def _line(row: Row) -> str:
    """The same for people to read."""
    parts = [f"{len(found)} {what}" for what, found in row.items() if isinstance(found, list)]
    names = [one["name"] for what in ("objects", "colors") for one in row.get(what, ())]
    told = f" ({', '.join(names)})" if names else ""
    return row.get("error") or f"{row['file']}: {', '.join(parts) + told}"


def check(options: argparse.Namespace) -> None:
    """Raise HriError for options that go with pictures of a camera alone."""
    for name in ("out", "video", "images", "camera"):
        if getattr(options, name) is not None:
            raise HriError(f"--{name} and --stills - give one of them")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--stills", nargs="+", type=Path, metavar="FILE", help="look at pictures one by one")
    add("--people", action="store_true", help="of --stills: report people (without --objects, too)")
    add("--json", action="store_true", help="of --stills: one JSON object a picture")
