"""Faces that are wrong are refused with the place and the remedy."""

import os
import time
import tracemalloc
from pathlib import Path

import numpy as np
import pytest

from hri.core.errors import AuthoringError, HriError
from hri.face import load_face, render_face
from hri.face.drawing.outline import parse_path, parse_transform
from hri.face.drawing.svg import load_drawing
from hri.face.vocabulary import AFFECT, ARKIT, EXPRESSIONS, LABELS, RHUBARB, VISEMES
from tests.face.small_face import HEAD, write_face, write_target


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A small face to spoil, and an empty cache."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return write_face(tmp_path / "mine")


def spoil(file: Path, old: str, new: str) -> None:
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))


def refusal(folder: Path) -> str:
    with pytest.raises(HriError) as caught:
        load_face(folder)
    assert "\n" not in str(caught.value)
    assert " - " in str(caught.value)
    return str(caught.value)


def test_the_names_are_those_that_everybody_uses() -> None:
    assert len(ARKIT) == 52
    assert len(EXPRESSIONS) == 25
    assert len(VISEMES) == 15
    assert len(LABELS) == 28


def test_rhubarb_shapes_stand_for_visemes(folder: Path) -> None:
    face = load_face(folder)
    for shape in "ABCDFGHX":
        assert face.viseme(shape) == face.viseme(RHUBARB[shape])
    assert face.viseme("E") == face.visemes["E"]
    with pytest.raises(HriError, match='no viseme "Q"'):
        face.viseme("Q")


def test_a_changed_file_is_read_anew(folder: Path) -> None:
    before = render_face(folder, size=(80, 60))
    spoil(folder / "face.toml", 'middle = "#ffffff"', 'middle = "#00ff00"')
    middle = render_face(folder, size=(80, 60))
    spoil(folder / "neutral.svg", 'r="40"', 'r="30"')
    after = render_face(folder, size=(80, 60))
    assert not np.array_equal(before, middle)
    assert not np.array_equal(middle, after)


def test_settings_have_defaults_and_can_be_told(folder: Path) -> None:
    settings = load_face(folder).settings
    assert settings.timing["surprised"].onset_s == 0.1
    assert settings.timing["surprised"].offset_s == settings.timing["glad"].offset_s == 0.8
    assert set(settings.timing) == set(settings.expressions)
    assert settings.affect["happy"] == (0.5, 0.25)
    assert set(settings.affect) == set(AFFECT)
    assert settings.gaze.degrees == (25, 18)
    assert settings.gaze.head_share == 0.3
    assert settings.head is not None
    assert (settings.head.yaw, settings.head.pitch, settings.head.depth) == (25, 15, 40)


def test_other_nodes_than_in_neutral_are_counted(folder: Path) -> None:
    spoil(folder / "targets" / "jawOpen.svg", "Q 50,94 35,70 Z", "L 50,94 L 50,80 Z")
    message = refusal(folder)
    assert "jawOpen.svg:2:" in message
    assert '"lips" has 4 nodes (closed) here, but 2 nodes (closed) in neutral.svg' in message
    assert "copy it from neutral.svg and move its nodes" in message


@pytest.mark.parametrize(
    ("file", "old", "new", "message"),
    [
        ("targets/tear.svg", 'id="tear"', 'id="taer"', 'did you mean "tear"'),
        ("targets/tear.svg", "#8cf", "#00ff00", "colors do not morph"),
        ("targets/tear.svg", '"0 0 100 100"', '"0 0 10 10"', "viewBox differs"),
        ("targets/browInnerUp.svg", 'fill="none" ', "", "has another color"),
        ("neutral.svg", '"0 0 100 100"', '"huge"', "viewBox"),
        ("neutral.svg", '"0 0 100 100"', '"0 0 nan 100"', "viewBox"),
        ("neutral.svg", "url(#skin)", "url(#sikn)", 'did you mean "skin"'),
        ("neutral.svg", "url(#skin)", "url(http://x#a)", "in this file"),
        ("neutral.svg", 'cx="50" cy="40" r="50"', 'cx="nan" cy="40" r="50"', "write a number"),
        ("neutral.svg", 'offset="1"', 'offset="7"', "between 0 and 1"),
        ("neutral.svg", "<rect", '<image id="i" href="http://x/y.png"/><rect', "<image> is not"),
        ("neutral.svg", "<rect", '<use id="i" xlink:href="y.svg#a"/><rect', "<use> is not"),
        ("neutral.svg", "<rect", '<text id="t">a</text><rect', "<text> is not supported"),
        ("neutral.svg", "<rect", "<script>a()</script><rect", "<script> is not supported"),
        ("neutral.svg", "<defs>", "<defs><style>.a{fill:red}</style>", "<style> is not supported"),
        ("neutral.svg", "<rect ", '<rect filter="url(#a)" ', '"filter" is not supported'),
        ("neutral.svg", "<rect ", '<rect style="mask:url(#a)" ', '"mask" is not supported'),
        ("neutral.svg", "<rect ", '<rect rx="3" ', "Object to Path"),
        ("neutral.svg", 'width="20"', 'width="20mm"', "no number - write units only"),
        ("neutral.svg", 'width="20"', 'width="1e9"', "outside of any picture"),
        ("neutral.svg", "<rect ", '<rect opacity="nan" ', "opacity"),
        ("neutral.svg", "<rect ", '<rect transform="translate(nan)" ', "leaves any picture"),
        ("neutral.svg", "<rect ", '<rect transform="scale(9e4)" ', "out of any picture"),
        ("neutral.svg", "<rect ", '<rect transform="skewX(3)" ', "translate, scale, rotate"),
        ("neutral.svg", 'd="M ', 'd="M A ', "2 numbers"),
        ("neutral.svg", 'd="M ', 'd="M 0,0 A 1,1 0 0 0 5,5 M ', "elliptical arc"),
        ("neutral.svg", 'd="M ', 'd="M 1e999,0 L ', "outside of any picture"),
        ("neutral.svg", 'd="M ', 'd="M nan,0 L ', "needs 2 numbers|no path command"),
        ("neutral.svg", 'd="M 28,35 L 72,35"', 'd=""', "draws nothing"),
        ("neutral.svg", 'fill="#123"', 'fill="red"', "write #rrggbb"),
        ("neutral.svg", ' id="neck"', "", "has no id"),
        ("neutral.svg", 'id="neck"', 'id="head"', "used twice"),
        ("neutral.svg", "</clipPath>", "<use/></clipPath>", "clip with one path"),
        ("neutral.svg", '<g id="mouth"', '<rect id="r" clip-path="url(#clipMouth)"/><g', "second"),
        ("neutral.svg", "<svg ", "<!DOCTYPE svg><svg ", "DOCTYPE"),
        ("neutral.svg", "</svg>", "", "no element|not well|unclosed|mend|close"),
        ("face.toml", "mouthSmile = 0.0", "mouthSmlie = 1.0", 'did you mean "mouthSmile'),
        ("face.toml", "mouthSmile = 0.0", '"mouthSmile*jawOpen" = 1.0', "no target"),
        ("face.toml", "mouthSmile = 0.0", "mouthSmile = nan", "from -1.5 to 1.5"),
        ("face.toml", "mouthSmile = 0.0", "mouthSmile = 7", "from -1.5 to 1.5"),
        ("face.toml", "[visemes.PP]", "[visemes.PQ]", "PP"),
        ("face.toml", "[expressions.sad]", "[expressions.sda]", 'did you mean "sad"'),
        ("face.toml", 'glad = "happy"', 'glad = "hapy"', 'did you mean "happy"'),
        ("face.toml", 'glad = "happy"', 'bored = "happy"', "an expression itself"),
        ("face.toml", 'middle = "#ffffff"', 'middle = "blueish"', "is not a color"),
        ("face.toml", "pivot = [50, 90]", "pivot = [240]", "pivot"),
        ("face.toml", "pivot = [50, 90]", "pivot = [1e300, 0]", "two numbers from"),
        ("face.toml", "radius = [40, 40]", "radius = [0, 40]", "two numbers from"),
        ("face.toml", "happy = [0.5, 0.25]", "happy = [0.5, 25]", "two numbers from -1 to 1"),
        ("face.toml", "happy = [0.5, 0.25]", "hpapy = [0.5, 0.25]", 'did you mean "happy"'),
        ("face.toml", "[timing.surprised]", "[timing.suprised]", 'did you mean "surprised"'),
        ("face.toml", "onset_s = 0.1", "onset_s = -1", "onset_s"),
        ("face.toml", "onset_s = 0.1", "onest_s = 0.1", 'did you mean "onset_s"'),
        ("face.toml", '"eye*" = 5', '"eye*" = 5000', "write a number"),
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
    assert caught.value.remedy


def test_a_face_without_a_head_table_says_how_to_turn_it(folder: Path) -> None:
    text = (folder / "face.toml").read_text()
    start, end = text.index("[head]"), text.index("[timing")
    spoil(folder / "face.toml", text[start:end], "")
    assert "headYaw" not in load_face(folder).channels
    spoil(folder / "face.toml", "up = {}", "up = { headPitch = 1 }")
    assert "add a [head] table" in refusal(folder)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("mouthSmileLeft", "mouthSmileLeft is drawn by mouthSmile.svg already"),
        ("headYaw", "a motion of the whole head"),
        ("two words", "is not a valid target name"),
        ("bad\nname", "is not a valid target name"),
        ("mouthSmile+mouthSmile", "does not name two targets"),
        ("mouthSmile+jawOpen+tear", "does not name two targets"),
        ("mouthSmile+jawOpne", 'did you mean "jawOpen"'),
        ("jawOpen+mouthSmile", "is drawn by jawOpen+mouthSmile.svg already"),
        ("mouthSmileLeft+jawOpen", "is drawn by mouthSmile+jawOpen.svg already"),
    ],
)
def test_names_of_drawings_that_nobody_could_use_are_refused(
    folder: Path, name: str, message: str
) -> None:
    write_target(folder, name, "")
    assert message in refusal(folder)


def test_a_face_needs_its_files(tmp_path: Path, folder: Path) -> None:
    assert "is not a face" in refusal(tmp_path)
    (folder / "neutral.svg").unlink()
    assert "neutral.svg" in refusal(folder)
    with pytest.raises(HriError, match='no "nobody" in faces'):
        load_face("nobody")


def test_an_empty_drawing_is_refused(folder: Path) -> None:
    (folder / "neutral.svg").write_text(f'{HEAD} viewBox="0 0 9 9"></svg>')
    for file in (folder / "targets").iterdir():
        file.unlink()
    spoil(folder / "face.toml", "{ eyeBlink = 1.0 }", "{}")
    text = (folder / "face.toml").read_text()
    lines = [line for line in text.splitlines() if not line.startswith(("mouth", "jaw"))]
    (folder / "face.toml").write_text("\n".join(lines))
    assert "draws nothing" in refusal(folder)


def picture(inside: str) -> str:
    return f'{HEAD} viewBox="0 0 9 9">{inside}</svg>'


def shared_stops() -> str:
    stops = '<stop offset="0"/>' * 15_000
    shapes = "".join(
        f'<path id="p{n}" fill="url(#a)" d="M 0,0 L 1,1 L 2,2 Z"/>' for n in range(1900)
    )
    return f'<defs><linearGradient id="a">{stops}</linearGradient></defs>{shapes}'


BOMBS = {
    "entities": '<!DOCTYPE a [<!ENTITY b "bb"><!ENTITY c "&b;&b;">]>' + picture("&c;"),
    "a path of a million nodes": picture(f'<path id="a" d="M 0,0 {"L 1,1 " * 1_000_000}"/>'),
    "a path as long as allowed": picture(f'<path id="a" d="M 0,0 {"L 1,1 " * 90_000}"/>'),
    "a path of short steps": picture(f'<path id="a" d="M 0,0 {"h1" * 290_000}"/>'),
    "a polygon of many corners": picture(f'<polygon id="a" points="{"1,1 " * 140_000}"/>'),
    "many shapes": picture(
        "".join(f'<path id="p{n}" d="M 0,0 L 1,1 L 2,2 Z"/>' for n in range(11_000))
    ),
    "deep groups": picture("<g>" * 5000 + "</g>" * 5000),
    "deep transforms": picture('<g transform="scale(1e4)">' * 20 + '<rect id="r" x="1"/>')[:-6]
    + "</g>" * 20
    + "</svg>",
    "a gradient that refers to itself": picture(
        '<linearGradient id="a" xlink:href="#a"/><circle id="c" r="1" fill="url(#a)"/>'
    ),
    "a thousand stops for a thousand shapes": picture(shared_stops()),
    "thirty megabytes": picture(" " * 30_000_000),
    "another encoding": "\0" * 4000,
}


@pytest.mark.parametrize("bomb", BOMBS)
def test_a_bomb_is_refused_fast_and_within_bounds(folder: Path, bomb: str) -> None:
    (folder / "neutral.svg").write_text(BOMBS[bomb])
    begun = time.process_time()
    refusal(folder)
    assert time.process_time() - begun < 2


def test_a_bomb_takes_no_memory(folder: Path) -> None:
    (folder / "neutral.svg").write_text(BOMBS["a path as long as allowed"])
    tracemalloc.start()
    try:
        refusal(folder)
        assert tracemalloc.get_traced_memory()[1] < 50e6
    finally:
        tracemalloc.stop()


def test_too_many_drawings_are_refused(folder: Path) -> None:
    for number in range(301):
        (folder / "targets" / f"t{number}.svg").touch()
    assert "keep to 300" in refusal(folder)


def test_too_large_faces_are_refused(folder: Path) -> None:
    for number in range(8):
        write_target(folder, f"t{number}", "<desc>" + "x" * 550_000 + "</desc>")
    assert "too much for a face" in refusal(folder)


@pytest.mark.parametrize("name", ["neutral.svg", "face.toml", "targets/loop.svg", "targets"])
def test_links_that_lead_nowhere_are_refused(folder: Path, name: str) -> None:
    file = folder / name
    if file.is_dir():
        for inner in file.iterdir():
            inner.unlink()
        file.rmdir()
    elif file.exists():
        file.unlink()
    file.symlink_to(file.name)
    refusal(folder)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="pipes are files on POSIX only")
def test_a_pipe_is_no_drawing(folder: Path) -> None:
    os.mkfifo(folder / "targets" / "pipe.svg")
    assert "not a regular file" in refusal(folder)


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
