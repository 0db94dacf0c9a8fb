"""A display list as plain values, which JSON can hold, and back.

The disk cache keeps its structure this way, and `hri face export` all of it, for whoever draws the
same shapes elsewhere: `numbers = neutral + sum of weight * row`, points first (x, y each), then for
each shape its opacity and the width of its stroke.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hri.face.drawing.baking import DisplayList, Item, Opening, Shape, Vector
from hri.face.drawing.paint import Gradient, Paint, Solid, Stop

UNIT = 0.01
"""What 1 means in exported numbers."""

Plain = dict[str, Any]
"""Names with texts, numbers, true, false, lists and further such dictionaries."""


def exported(display: DisplayList) -> Plain:
    """All of a display list.

    `rows` has, by channel and by "first*second" for a product of two, `at`: the numbers that
    change, and `by`: how much they change for a weight of 1, both in hundredths of a unit or of
    an opacity.
    """
    names = [*display.channels, *("*".join(pair) for pair in display.products)]
    rows = zip(names, display.rows, strict=True)
    plain = structure(display)
    plain["unit"] = UNIT
    plain["neutral"] = _hundredths(display.neutral)
    plain["rows"] = {name: _sparse(row) for name, row in rows}
    return plain


def _sparse(row: Vector) -> Plain:
    at = np.flatnonzero(np.rint(row / UNIT))
    return {"at": at.tolist(), "by": _hundredths(row[at])}


def _hundredths(numbers: Vector) -> list[int]:
    return [int(number) for number in np.rint(numbers / UNIT)]


def structure(display: DisplayList) -> Plain:
    """All but the numbers."""
    return {
        "width": display.width,
        "height": display.height,
        "points": display.points,
        "channels": list(display.channels),
        "products": [list(pair) for pair in display.products],
        "items": [_plain_item(item) for item in display.items],
    }


def restored(plain: Mapping[str, Any], neutral: Vector, rows: Vector) -> DisplayList:
    """A display list from its structure and its numbers.

    Raises KeyError, TypeError or ValueError when that is not a structure of ours.
    """
    return DisplayList(
        float(plain["width"]),
        float(plain["height"]),
        tuple(_item(item) for item in plain["items"]),
        tuple(plain["channels"]),
        tuple((first, second) for first, second in plain["products"]),
        int(plain["points"]),
        neutral,
        rows,
    )


def _plain_item(item: Item) -> Plain:
    if isinstance(item, Opening):
        content = [_plain_item(inner) for inner in item.content]
        return {"clip": _plain_item(item.clip), "content": content}
    return {
        "id": item.id,
        "contours": [list(contour) for contour in item.contours],
        "paint": _plain_paint(item.paint),
        "anchors": list(item.anchors),
        "opacity": item.opacity,
        "is_stroke": item.is_stroke,
        "is_still": item.is_still,
    }


def _plain_paint(paint: Paint) -> Plain:
    if isinstance(paint, Solid):
        return {"color": list(paint.color), "opacity": paint.opacity}
    stops = [[stop.offset, list(stop.color), stop.opacity] for stop in paint.stops]
    return {"stops": stops, "neutral_anchors": paint.anchors.tolist()}


def _item(plain: Mapping[str, Any]) -> Item:
    if "clip" in plain:
        content = tuple(_item(inner) for inner in plain["content"])
        return Opening(_shape(plain["clip"]), content)
    return _shape(plain)


def _shape(plain: Mapping[str, Any]) -> Shape:
    first, last = plain["anchors"]
    return Shape(
        plain["id"],
        tuple((start, stop, is_closed) for start, stop, is_closed in plain["contours"]),
        _paint(plain["paint"]),
        (first, last),
        plain["opacity"],
        plain["is_stroke"],
        plain["is_still"],
    )


def _paint(plain: Mapping[str, Any]) -> Paint:
    if "color" in plain:
        red, green, blue = plain["color"]
        return Solid((red, green, blue), plain["opacity"])
    stops = tuple(
        Stop(offset, (red, green, blue), opacity)
        for offset, (red, green, blue), opacity in plain["stops"]
    )
    return Gradient(np.array(plain["neutral_anchors"], float), stops)
