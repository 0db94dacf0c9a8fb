"""Faces that are wrong are refused with the place and the remedy."""

import shutil
from pathlib import Path

import numpy as np
import pytest

from hri.core.errors import AuthoringError, HriError
from hri.face import load_face, render_face
from hri.face.drawing import load_drawing
from hri.face.outline import parse_path, parse_transform
from hri.face.vocabulary import ARKIT, REQUIRED, VISEMES
from tests.face.pixels import MODEL

ROBOT = Path(__file__).resolve().parents[2] / "faces" / "robot"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A copy of the default face to spoil."""
    return Path(shutil.copytree(ROBOT, tmp_path / "mine"))


def spoil(file: Path, old: str, new: str) -> None:
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))


def refusal(folder: Path) -> str:
    with pytest.raises(HriError) as caught:
        load_face(folder)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_the_default_face_has_what_it_must() -> None:
    assert len(ARKIT) == 52
    assert set(REQUIRED) <= set(MODEL.expressions)
    assert set(MODEL.visemes) == set(VISEMES)
    assert "mouthSmileLeft" in MODEL.channels
    assert "mouthSmile" not in MODEL.channels


def test_both_sides_of_a_drawing_add_up_to_it() -> None:
    whole, _ = MODEL.blend(MODEL.vector({"mouthSmile": 1.0}))
    halves, _ = MODEL.blend(MODEL.vector({"mouthSmileLeft": 1.0, "mouthSmileRight": 1.0}))
    assert np.array_equal(whole, halves)


def test_a_changed_drawing_is_read_anew(folder: Path) -> None:
    before = render_face(load_face(folder), size=(80, 60))
    for file in (folder / "face.toml",):
        spoil(file, 'middle = "#7fb0bd"', 'middle = "#ffffff"')
    assert not np.array_equal(before, render_face(load_face(folder), size=(80, 60)))


def test_other_nodes_than_in_neutral_are_counted(folder: Path) -> None:
    file = folder / "targets" / "pupilWide.svg"
    text = file.read_text()
    start = text.index('id="pupilLeft"')
    path = text.index(' d="', start) + 4
    end = text.index('"', path)
    file.write_text(text[:path] + "M 0,0 C 1,1 2,2 3,3 C 4,4 5,5 6,6 Z" + text[end:])
    message = refusal(folder)
    assert "pupilWide.svg:" in message
    assert '"pupilLeft" has 3 nodes (closed) here, but 8 nodes (closed) in neutral.svg' in message


@pytest.mark.parametrize(
    ("file", "old", "new", "message"),
    [
        ("targets/tear.svg", 'id="tear"', 'id="taer"', 'did you mean "tear"'),
        ("targets/eyeWide.svg", 'fill="#4a2a2b"', 'fill="#00ff00"', "colors do not morph"),
        ("targets/tear.svg", 'viewBox="0 0 480 480"', 'viewBox="0 0 100 100"', "viewBox"),
        ("neutral.svg", 'viewBox="0 0 480 480"', 'viewBox="huge"', "viewBox"),
        ("neutral.svg", 'id="gPlate"', 'id="gPlaet"', 'there is no "gPlate"'),
        (
            "neutral.svg",
            '<path id="neck"',
            '<image href="http://x/y.png"/><path id="neck"',
            "<image> is not supp",
        ),
        (
            "neutral.svg",
            '<path id="neck"',
            '<text id="t">a</text><path id="neck"',
            "<text> is not supported",
        ),
        ("neutral.svg", "<path ", '<path filter="url(#a)" ', '"filter" is not supported'),
        ("neutral.svg", 'fill="url(#gPlate)"', 'fill="url(http://x#a)"', "in this file"),
        ("neutral.svg", 'd="M ', 'd="M A ', "2 numbers"),
        ("neutral.svg", 'd="M ', 'd="M 0,0 A 1,1 0 0 0 5,5 M ', "elliptical arc"),
        ("neutral.svg", 'd="M ', 'd="M 1e999,0 L ', "outside of any picture"),
        ("neutral.svg", 'd="M ', 'd="M nan,0 L ', "needs 2 numbers|no path command"),
        ("neutral.svg", "<svg ", "<!DOCTYPE svg><svg ", "DOCTYPE"),
        ("neutral.svg", "</svg>", "", "no element|not well|unclosed|mend|close"),
        ("neutral.svg", 'id="shell"', 'id="plate"', "used twice"),
        ("face.toml", "mouthSmile = 1.0", "mouthSmlie = 1.0", 'did you mean "mouthSmile'),
        ("face.toml", "mouthSmile = 1.0", "mouthSmile = nan", "mouthSmile"),
        ("face.toml", "[visemes.PP]", "[visemes.PQ]", "PP"),
        ("face.toml", "[expressions.sad]", "[expressions.sda]", 'did you mean "sad"'),
        ("face.toml", 'afraid = "scared"', 'afraid = "scarred"', 'did you mean "scared"'),
        ("face.toml", 'middle = "#7fb0bd"', 'middle = "blueish"', "no color"),
        ("face.toml", "pivot = [240, 400]", "pivot = [240]", "pivot"),
    ],
)
def test_mistakes_are_named_with_their_place(
    folder: Path, file: str, old: str, new: str, message: str
) -> None:
    spoil(folder / file, old, new)
    with pytest.raises(AuthoringError, match=message) as caught:
        load_face(folder)
    assert caught.value.place.path.name == Path(file).name
    assert caught.value.place.line >= 1


def test_a_face_needs_its_files(tmp_path: Path, folder: Path) -> None:
    assert "is no face" in refusal(tmp_path)
    (folder / "neutral.svg").unlink()
    assert "neutral.svg" in refusal(folder)
    with pytest.raises(HriError, match='no "nobody" in faces'):
        load_face("nobody")


def test_a_drawing_of_a_million_nodes_is_refused_fast(tmp_path: Path) -> None:
    file = tmp_path / "bomb.svg"
    line = "L 1,1 " * 500_000
    file.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">'
        f'<path id="a" d="M 0,0 {line}"/></svg>'
    )
    with pytest.raises(HriError, match=r"nodes"):
        load_drawing(file)


INKSCAPE = """<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<svg viewBox="0 0 100 100" xmlns="http://www.w3.org/2000/svg"
     xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
     xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd"
     xmlns:xlink="http://www.w3.org/1999/xlink">
  <sodipodi:namedview id="namedview1" pagecolor="#ffffff"/>
  <defs id="defs1">
    <linearGradient id="stops"><stop style="stop-color:#ff0000;stop-opacity:1" offset="0"/>
      <stop style="stop-color:#0000ff;stop-opacity:0.5" offset="1"/></linearGradient>
    <linearGradient xlink:href="#stops" id="used" x1="0" y1="0" x2="10" y2="0"
        gradientUnits="userSpaceOnUse" gradientTransform="translate(5)"/>
    <clipPath clipPathUnits="userSpaceOnUse" id="clip1"><rect id="hole" x="1" y="2" width="3"
        height="4"/></clipPath>
  </defs>
  <g inkscape:groupmode="layer" id="layer1" transform="translate(10,20)" style="opacity:0.5">
    <path id="smooth" style="fill:url(#used);stroke:#000;stroke-width:2"
        d="m 0,0 c 1,1 2,2 3,3 s 1,1 2,2 h 4 v 5 q 1,1 2,2 t 3,3 z"/>
    <g id="seen" clip-path="url(#clip1)"><circle id="ball" cx="5" cy="5" r="5" fill="#123"/></g>
    <ellipse id="hidden" rx="3" ry="4" style="display:none"/>
  </g>
</svg>
"""


def test_what_inkscape_saves_is_read(tmp_path: Path) -> None:
    file = tmp_path / "drawn.svg"
    file.write_text(INKSCAPE)
    drawing = load_drawing(file)
    assert set(drawing.parts) == {"smooth", "smooth:stroke", "ball", "hole"}
    smooth = drawing.parts["smooth"]
    assert smooth.opacity == 0.5
    assert smooth.outline.nodes == 7
    assert smooth.paint.anchors.tolist() == [[15, 20], [25, 20]]  # type: ignore[union-attr]
    assert smooth.paint.stops[1].opacity == 0.5  # type: ignore[union-attr]
    assert drawing.parts["smooth:stroke"].stroke_width == 2
    assert drawing.parts["hole"].outline.points.min(axis=0).tolist() == [11, 22]
    assert drawing.parts["ball"].paint.color == (0x11, 0x22, 0x33)  # type: ignore[union-attr]


def test_transforms_follow_the_order_of_svg() -> None:
    moved = parse_path("M 1,0 L 2,0").transformed(parse_transform("translate(5,0) rotate(90)"))
    assert np.allclose(moved.points[0], [5, 1])
    assert np.allclose(parse_transform("scale(2) matrix(1 0 0 1 3 4)")[:, 2], [6, 8])
    with pytest.raises(ValueError, match="skewX"):
        parse_transform("skewX(3)")
