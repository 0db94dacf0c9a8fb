"""Colors are learned from boxes, kept as numbers, and nothing damaged is believed."""

import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.errors import HriError
from hri.core.signals import FaceBox
from hri.vision.color.color_constancy import chromaticity
from hri.vision.color.color_model import (
    find_color,
    learn_color,
    load_color,
    own_colors,
    save_color,
)
from hri.vision.color.segmentation import LIKELY, ColorSegmenter, tables_of
from hri.vision.color.skin import skin_samples, skin_table
from tests.recorded import picture
from tests.vision.color.test_segmentation import BLUE, RED, drawn

BOXES = {"red": (65, 85, 30, 30), "blue": (220, 50, 20, 20)}
IMAGE = drawn((RED, (80, 100), 30), (BLUE, (230, 60), 20))


@pytest.fixture(scope="module")
def red(tmp_path_factory):
    path = tmp_path_factory.mktemp("colors") / "red.color"
    save_color(path, learn_color("red", [(IMAGE, [BOXES["red"]])], "2026-11-23"))
    return path


@pytest.mark.proves("R10")
def test_what_is_learned_from_a_box_is_found_after_it_was_written_and_read(red):
    (blob,) = ColorSegmenter(tables_of([red])).segment(drawn((RED, (200, 150), 25), seed=9))
    assert blob.name == "red"
    assert (blob.x, blob.y) == pytest.approx((200, 150), abs=1)
    assert blob.area == pytest.approx(np.pi * 25**2, rel=0.08)
    assert load_color(red).learned == "2026-11-23"


def test_a_color_of_the_format_before_is_found(tmp_path):
    """Its chroma was that of the picture; it was learned from a red ball in a gray room."""
    old = {
        "format": 1,
        "learned": "2026-11-23",
        "color": {
            "weights": [1.0],
            "means": [[206.0, 99.5]],
            "covariances": [[[60.0, -12.0], [-12.0, 26.0]]],
        },
        "background": {
            "weights": [1.0],
            "means": [[128.0, 126.0]],
            "covariances": [[[20.0, 0.0], [0.0, 20.0]]],
        },
    }
    path = tmp_path / "old.color"
    path.write_text(json.dumps(old))
    for light in (1.0, 0.5):
        image = (drawn((RED, (200, 150), 25), seed=9) * light).astype(np.uint8)
        (blob,) = ColorSegmenter(tables_of([path])).segment(image)
        assert blob.confidence > 0.5
        assert blob.area == pytest.approx(np.pi * 25**2, rel=0.15)
    save_color(path, load_color(path))
    assert json.loads(path.read_text())["format"] == 2


def test_a_component_that_hardly_counts_is_written_so_that_it_can_be_read(red, tmp_path):
    model = load_color(red)
    color = replace(model.color, weights=np.array([1e-9, 1 - 1e-9]))
    save_color(tmp_path / "red.color", replace(model, color=color))
    assert load_color(tmp_path / "red.color").color.weights == pytest.approx([0, 1], abs=1e-4)


def test_several_colors_are_told_apart(tmp_path):
    files = []
    for name, box in BOXES.items():
        files.append(tmp_path / f"{name}.color")
        save_color(files[-1], learn_color(name, [(IMAGE, [box])]))
    assert [one.name for one in ColorSegmenter(tables_of(files)).segment(IMAGE)] == ["red", "blue"]


@pytest.mark.parametrize("gain", [(1.15, 1.0, 0.85), (0.85, 1.0, 1.12)])
def test_a_light_that_changes_slowly_is_followed(red, gain):
    """From daylight to a lamp: the color is still found where a fixed table has lost it."""
    segmenter, found = ColorSegmenter(tables_of([red])), []
    for step in range(61):
        tint = 1 + (np.array(gain) - 1) * step / 60 * 1.6
        image = drawn((RED, (80, 100), 30), seed=step) * tint
        found = segmenter.segment(np.clip(image, 0, 255).astype(np.uint8))
        assert [one.name for one in found] == ["red"]
    assert found[0].area == pytest.approx(np.pi * 30**2, rel=0.15)


def test_following_the_light_ends_before_another_color(red):
    segmenter = ColorSegmenter(tables_of([red]))
    for step in range(200):
        turned = np.array(RED) + (np.array((40, 160, 40)) - RED) * step / 199
        found = segmenter.segment(drawn((tuple(map(int, turned)), (80, 100), 30), seed=step))
    assert found == ()


def test_the_shipped_color_is_found_by_its_name():
    assert load_color(find_color("red_ball")).name == "red_ball"


def test_an_own_color_goes_before_a_shipped_one(tmp_path, monkeypatch, red):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    save_color(own_colors() / "red_ball.color", load_color(red))
    assert find_color("red_ball") == own_colors() / "red_ball.color"


def test_a_misspelt_color_is_refused_with_the_nearest():
    with pytest.raises(HriError, match='no color "redball" - did you mean "red_ball"'):
        find_color("redball")


@pytest.mark.parametrize("box", [(400, 0, 5, 5), (0, 0, 0, 5), (-1, 0, 5, 5)])
def test_a_box_outside_of_the_picture_is_refused(box):
    with pytest.raises(HriError, match="is outside of a picture of 320 x 240"):
        learn_color("red", [(IMAGE, [box])])


def test_a_box_of_the_whole_picture_leaves_no_background():
    with pytest.raises(HriError, match="too few"):
        learn_color("red", [(IMAGE, [(0, 0, 320, 240)])])


DAMAGE = {
    "another format": lambda data: data.update(format=3),
    "no mixture": lambda data: data.pop("color"),
    "text for numbers": lambda data: data["color"].update(weights=["a", "b"]),
    "a ragged list": lambda data: data["color"].update(means=[[1], [2, 3]]),
    "parts that do not fit": lambda data: data["color"].update(means=[[1, 2]]),
    "a negative variance": lambda data: data["background"].update(
        covariances=[[[-1, 0], [0, 1]]] * 4
    ),
    "a variance that no number can square": lambda data: data["color"].update(
        covariances=[[[1e300, 0], [0, 1e300]]] * 2
    ),
    "a variance far below a level": lambda data: data["color"].update(
        covariances=[[[1e-300, 0], [0, 1e-300]]] * 2
    ),
    "covariances that no color has": lambda data: data["color"].update(
        covariances=[[[10, 20], [20, 10]]] * 2
    ),
    "a weight that is next to nothing": lambda data: data["color"].update(weights=[5e-324, 1]),
    "no brightness": lambda data: data.pop("brightness"),
    "a brightness that no pixel has": lambda data: data.update(brightness=1000),
    "no weight": lambda data: data["color"].update(weights=[0, 0]),
    "infinity": lambda data: data["color"].update(weights=[1e999, 1]),
    "a day of a thousand letters": lambda data: data.update(learned="x" * 1000),
}


@pytest.mark.parametrize("what", DAMAGE)
def test_every_damage_is_refused_in_a_line(red, tmp_path, what):
    data = json.loads(red.read_text())
    DAMAGE[what](data)
    path = tmp_path / "bad.color"
    path.write_text(json.dumps(data))
    with pytest.raises(HriError, match=r"bad\.color: this color is damaged: [^\n]+$"):
        load_color(path)


@given(st.binary(max_size=200))
def test_foreign_bytes_are_refused(tmp_path_factory, raw):
    path = tmp_path_factory.getbasetemp() / "foreign.color"
    path.write_bytes(raw)
    with pytest.raises(HriError, match=r"foreign\.color"):
        load_color(path)


FACES = {
    "biden": "light",
    "obama": "dark",
    "obama2": "dark",
}
"""Skin of those in the pictures."""


@pytest.mark.proves("R10")
@pytest.mark.parametrize("name", FACES)
def test_skin_is_learned_from_the_face_that_is_seen(name, faces_of):
    image = picture(name)
    (face,) = faces_of(image)
    table = skin_table(*skin_samples(image, [face]))
    levels = chromaticity(image).chroma
    is_skin = table.ratios[levels[..., 0], levels[..., 1]] >= LIKELY
    center = FaceBox(
        face.x + face.width * 0.2, face.y + face.height * 0.2, face.width * 0.6, face.height * 0.6
    )
    rows = slice(int(center.y), int(center.y + center.height))
    columns = slice(int(center.x), int(center.x + center.width))
    assert is_skin[rows, columns].mean() > 0.75
    assert is_skin.mean() < 0.35


@pytest.fixture
def faces_of():
    from hri.vision.detectors.haar import HaarDetector

    def find(image):
        found = HaarDetector().find(image)
        return [max((one.box for one in found), key=lambda box: box.width)]

    return find


def test_without_faces_there_is_no_skin():
    skin, background = skin_samples(IMAGE, [])
    assert len(skin) == 0
    assert len(background) > 1000
    with pytest.raises(HriError, match="too few"):
        skin_table(skin, background)
