"""A drawing: parts with ids, read from an SVG file that any SVG editor can save.

Understood are paths without arcs, rectangles, circles, ellipses, polygons, groups, transforms,
fills, strokes (drawn with round ends), linear and radial gradients, opacity and clip paths.
Anything else is refused by name.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from hri.core.errors import did_you_mean
from hri.core.xml import Element, load_xml
from hri.face.drawing import outline as shapes
from hri.face.drawing.outline import IDENTITY, Matrix, Outline, OutlineError
from hri.face.drawing.paint import Gradient, Paint, Solid, parse_color, read_gradient

MOST_PARTS, MOST_NODES = 2000, 20_000
"""No drawing may have more."""

STROKE = ":stroke"
"""Ends the id of the stroke of a shape that is filled as well."""
IGNORED = ("title", "desc", "metadata", "defs", "linearGradient", "radialGradient", "clipPath")
_EDITORS = ("sodipodi:", "inkscape:", "rdf:", "cc:", "dc:")
_STYLES = (
    "fill", "fill-opacity", "stroke", "stroke-opacity", "stroke-width", "opacity", "clip-path",
    "display",
)  # fmt: skip
_REFUSED = ("filter", "mask", "stroke-dasharray", "mix-blend-mode", "marker-end", "marker-start")


@dataclass(frozen=True, eq=False)
class Part:
    """One shape: filled, or stroked when `stroke_width` is above 0."""

    id: str
    outline: Outline
    paint: Paint
    element: Element
    opacity: float = 1.0
    stroke_width: float = 0.0
    is_clip: bool = False
    """Whether it is an opening that others are seen through, so that its color is not seen."""


@dataclass(frozen=True, eq=False)
class Group:
    """Parts seen through an opening."""

    id: str
    clip: Part
    content: tuple[Part | Group, ...]


@dataclass(frozen=True)
class Drawing:
    """What one file draws, back to front."""

    path: Path
    width: float
    height: float
    content: tuple[Part | Group, ...]
    parts: Mapping[str, Part] = field(default_factory=dict)
    """All parts by id, those that clip too."""


def load_drawing(path: Path) -> Drawing:
    """Read a drawing. Raises AuthoringError with the place, HriError when it is unreadable."""
    return _SvgReader(path, load_xml(path, "drawing")).read()


@dataclass(frozen=True)
class _State:
    """Properties that groups hand down to their content."""

    matrix: Matrix = field(default_factory=lambda: IDENTITY)
    opacity: float = 1.0
    styles: Mapping[str, str] = field(default_factory=dict)


class _SvgReader:
    def __init__(self, path: Path, root: Element) -> None:
        self.path = path
        self.root = root
        self.parts: dict[str, Part] = {}
        self.nodes = 0
        self.named = {e.attributes["id"]: e for e in _walk(root) if "id" in e.attributes}

    def read(self) -> Drawing:
        if _tag(self.root) != "svg":
            raise self.root.error(f"the root is <{self.root.tag}>", "save it as an SVG file")
        _, _, width, height = self._view_box()
        # Clip paths of a drawing without the group they clip are redrawn by targets.
        content = self._children(self.root, _State())
        for element in _walk(self.root):
            if _tag(element) == "style" and element.text.strip():
                remedy = "give each shape its own fill and stroke (plain SVG, no style sheet)"
                raise element.error("<style> is not supported", remedy)
            is_clip = _tag(element) == "clipPath"
            if is_clip and all(shape.get("id", "") not in self.parts for shape in element):
                self._clip_shape(element, _State())
        return Drawing(self.path, width, height, content, self.parts)

    def _view_box(self) -> tuple[float, float, float, float]:
        text = self.root.get("viewBox")
        try:
            x, y, width, height = (float(word) for word in text.replace(",", " ").split())
        except ValueError:
            x, y, width, height = 1.0, 0.0, 0.0, 0.0
        if x or y or not 1 <= width <= 10_000 or not 1 <= height <= 10_000:
            remedy = 'write "0 0 WIDTH HEIGHT", such as "0 0 480 480"'
            raise self.root.error(f'the viewBox is "{text}"', remedy, "viewBox")
        return x, y, width, height

    def _children(self, parent: Element, state: _State) -> tuple[Part | Group, ...]:
        return tuple(item for child in parent for item in self._item(child, state))

    def _item(self, element: Element, state: _State) -> Iterator[Part | Group]:
        tag = _tag(element)
        if _is_silent(tag):
            return
        if tag != "g" and tag not in _SHAPES:
            known = ", ".join(sorted(_SHAPES))
            raise element.error(f"<{tag}> is not supported", f"draw it with {known}")
        styles = _styles(element)
        if styles.get("display") == "none":
            return
        inner = self._enter(element, styles, state)
        clip = styles.get("clip-path", "none")
        if tag == "g":
            content = self._children(element, inner)
        else:
            content = tuple(self._parts(element, inner))
        if clip == "none":
            yield from content
        else:
            yield Group(element.get("id", clip), self._clip(element, clip, inner), content)

    def _enter(self, element: Element, styles: Mapping[str, str], state: _State) -> _State:
        try:
            matrix = shapes.parse_transform(element.get("transform", ""))
        except ValueError as error:
            remedy = "write translate, scale, rotate or matrix"
            raise element.error(f"transform: {error}", remedy, "transform") from error
        opacity = self._number(element, styles, "opacity", 1.0, 1.0)
        return _State(
            shapes.compose(state.matrix, matrix),
            state.opacity * opacity,
            {**state.styles, **styles},
        )

    def _parts(self, element: Element, state: _State) -> Iterator[Part]:
        """A part for the fill and one for the stroke."""
        outline = self._outline(element, state.matrix)
        fill = self._paint(element, state, "fill", "#000000", outline)
        stroke = self._paint(element, state, "stroke", "none", outline)
        id = self._id(element, fill is not None or stroke is not None)
        if fill is not None:
            yield self._keep(Part(id, outline, fill, element, state.opacity))
        if stroke is not None:
            scale = float(np.sqrt(abs(np.linalg.det(state.matrix[:, :2]))))
            width = scale * self._number(element, state.styles, "stroke-width", 1.0, 1000.0)
            name = id + STROKE if fill is not None else id
            yield self._keep(Part(name, outline, stroke, element, state.opacity, width))

    def _id(self, element: Element, is_needed: bool) -> str:
        if is_needed and "id" not in element.attributes:
            raise element.error(f"this <{_tag(element)}> has no id", 'add id="..." to it')
        return element.get("id", "")

    def _keep(self, part: Part) -> Part:
        if part.id in self.parts:
            raise part.element.error(f'the id "{part.id}" is used twice', "rename one", "id")
        if len(self.parts) >= MOST_PARTS:
            what = f"the drawing has more than {MOST_PARTS} shapes"
            raise part.element.error(what, "draw a simpler face")
        self.nodes += part.outline.nodes
        if self.nodes > MOST_NODES:
            what = f"the drawing has more than {MOST_NODES} nodes"
            raise part.element.error(what, "simplify its paths")
        self.parts[part.id] = part
        return part

    def _outline(self, element: Element, matrix: Matrix) -> Outline:
        try:
            outline = _SHAPES[_tag(element)](element).transformed(matrix)
            if not np.all(np.abs(outline.points) <= shapes.FARTHEST):
                raise OutlineError("its transforms take it out of any picture", "apply them to it")
            return outline
        except OutlineError as error:
            name = element.get("id", _tag(element))
            remedy = error.remedy
            attribute = "d" if "d" in element.attributes else ""
            raise element.error(f'"{name}": {error}', remedy, attribute) from error

    def _clip(self, element: Element, reference: str, state: _State) -> Part:
        target = self._referred(element, reference, "clip-path")
        if _tag(target) != "clipPath":
            raise element.error(f"{reference} is not a clipPath", "clip with a path", "clip-path")
        return self._clip_shape(target, state)

    def _clip_shape(self, target: Element, state: _State) -> Part:
        drawn = [child for child in target if not _is_silent(_tag(child))]
        for child in drawn:
            if _tag(child) not in _SHAPES:
                raise child.error(f"<{_tag(child)}> is not supported", "clip with one path")
        if len(drawn) != 1:
            raise target.error(f"the clipPath holds {len(drawn)} shapes", "give it one path")
        inner = self._enter(drawn[0], _styles(drawn[0]), state)
        outline = self._outline(drawn[0], inner.matrix)
        white = Solid((255, 255, 255))
        id = self._id(drawn[0], True)
        if id in self.parts:
            what = f'"{id}" clips a second time'
            raise target.error(what, "put what it clips into one group, and clip that", "id")
        return self._keep(Part(id, outline, white, drawn[0], is_clip=True))

    def _paint(
        self, element: Element, state: _State, kind: str, default: str, outline: Outline
    ) -> Paint | None:
        text = state.styles.get(kind, default)
        opacity = self._number(element, state.styles, f"{kind}-opacity", 1.0, 1.0)
        if text == "none":
            return None
        if text.startswith("url("):
            target = self._referred(element, text, kind)
            return self._gradient(target, opacity, outline, state.matrix)
        try:
            return replace(parse_color(text), opacity=opacity)
        except ValueError as error:
            remedy = "write #rrggbb or url(#gradient)"
            raise element.error(f"{kind}: {error}", remedy, kind) from error

    def _gradient(
        self, element: Element, opacity: float, outline: Outline, matrix: Matrix
    ) -> Gradient:
        stops = element
        for _ in range(8):
            link = stops.attributes.get("xlink:href", stops.attributes.get("href", ""))
            if any(_tag(child) == "stop" for child in stops) or not link:
                break
            stops = self._referred(stops, f"url({link})", "xlink:href")
        return read_gradient(element, stops, opacity, outline, matrix)

    def _referred(self, element: Element, reference: str, attribute: str) -> Element:
        match = re.fullmatch(r"url\(\s*['\"]?#([^'\")]+)['\"]?\s*\)", reference.strip())
        if match is None:
            what = f"{attribute} refers to {reference[:60]}"
            raise element.error(what, "refer to something in this file, url(#id)", attribute)
        if match[1] not in self.named:
            remedy = did_you_mean(match[1], self.named, "draw it in this file")
            raise element.error(f'there is no "{match[1]}" in this file', remedy, attribute)
        return self.named[match[1]]

    def _number(
        self, element: Element, styles: Mapping[str, str], name: str, default: float, most: float
    ) -> float:
        text = styles.get(name, str(default)).removesuffix("px")
        try:
            value = float(text[:-1]) / 100 if text.endswith("%") else float(text)
        except ValueError:
            value = -1.0
        if not 0 <= value <= most:
            raise element.error(f'{name} is "{text}"', f"write a number from 0 to {most:g}", name)
        return value


def _tag(element: Element) -> str:
    return element.tag.removeprefix("svg:")


def _is_silent(tag: str) -> bool:
    """Whether it draws nothing by itself, or speaks to an editor only."""
    return tag in IGNORED or tag.startswith(_EDITORS)


def _walk(element: Element) -> Iterator[Element]:
    yield element
    for child in element:
        yield from _walk(child)


def _styles(element: Element) -> dict[str, str]:
    """Presentation attributes, overruled by the style attribute."""
    found = {name: element.attributes[name] for name in _STYLES if name in element.attributes}
    given = {name: element.attributes[name] for name in _REFUSED if name in element.attributes}
    for entry in element.get("style", "").split(";"):
        name, _, value = entry.partition(":")
        name, value = name.strip(), value.strip()
        if name in _STYLES:
            found[name] = value
        elif name in _REFUSED:
            given[name] = value
    for name, value in given.items():
        if value not in ("none", "normal"):
            raise element.error(f'"{name}" is not supported', "take it off the shape", name)
    return found


def _numbers(element: Element, *names: str) -> list[float]:
    values = []
    for name in names:
        text = element.get(name, "0")
        try:
            values.append(float(text))
        except ValueError:
            raise OutlineError(f'{name} is "{text}", no number', "write units only") from None
        if not abs(values[-1]) <= shapes.FARTHEST:
            raise OutlineError(f"{name} is {text}, outside of any picture")
    return values


def _rect(element: Element) -> Outline:
    if element.get("rx", "0") not in ("0", "") or element.get("ry", "0") not in ("0", ""):
        raise OutlineError("its corners are arcs, which cannot morph", shapes.TO_CURVES)
    return shapes.rectangle(*_numbers(element, "x", "y", "width", "height"))


def _circle(element: Element) -> Outline:
    x, y, radius = _numbers(element, "cx", "cy", "r")
    return shapes.ellipse(x, y, radius, radius)


def _polyline(element: Element) -> Outline:
    words = element.get("points").replace(",", " ").split()
    if len(words) < 4 or len(words) % 2 or len(words) > 2 * shapes.MOST_NODES:
        raise OutlineError(f"it has {len(words)} coordinates")
    try:
        corners = np.array([float(word) for word in words]).reshape(-1, 2)
    except ValueError as error:
        raise OutlineError("its points are not numbers") from error
    if not np.all(np.abs(corners) <= shapes.FARTHEST):
        raise OutlineError("it leaves any picture")
    return shapes.polygon(corners, _tag(element) == "polygon")


_SHAPES = {
    "path": lambda element: shapes.parse_path(element.get("d")),
    "rect": _rect,
    "circle": _circle,
    "ellipse": lambda element: shapes.ellipse(*_numbers(element, "cx", "cy", "rx", "ry")),
    "polygon": _polyline,
    "polyline": _polyline,
}
