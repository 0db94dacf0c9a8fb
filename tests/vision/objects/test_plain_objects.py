"""Objects without texture are known by color and silhouette, or not named."""

import math
from functools import cache

import cv2
import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.errors import HriError
from hri.vision.objects.embedding import Embedding
from hri.vision.objects.learning import ObjectLearner, view_of
from hri.vision.objects.local_features import SIFT
from hri.vision.objects.object_model import ModelSet, ObjectModel
from hri.vision.objects.plain_objects import PlainRecognizer
from hri.vision.objects.recognizer import ObjectRecognizer
from tests.vision.objects.onnx_file import mean_color_network
from tests.vision.objects.pictures import VIEW, noisy

SIDE = 200
"""Pixels of the picture that an object is learned from."""
METERS = 0.2 / SIDE


def star(points, inner=0.45):
    angles = np.arange(2 * points) * math.pi / points
    radii = np.where(np.arange(2 * points) % 2, inner, 1.0)
    return np.stack([radii * np.sin(angles), radii * np.cos(angles)], axis=1)


def mug():
    return np.array([(-0.6, -0.9), (0.4, -0.9), (0.4, -0.4), (1, -0.4), (1, 0.5), (0.4, 0.5),
                     (0.4, 0.9), (-0.6, 0.9)])  # fmt: skip


SHAPES = {"red mug": (mug(), (190, 40, 40)), "blue star": (star(5), (40, 70, 180)),
          "yellow sun": (star(8, 0.7), (225, 190, 30)), "green mug": (mug(), (50, 150, 60)),
          "red star": (star(4, 0.6), (190, 40, 40))}  # fmt: skip


def drawn(name, image, center, radius, turn=0.0):
    """The picture with a shape in it."""
    outline, color = SHAPES[name]
    cos, sin = math.cos(turn), math.sin(turn)
    points = radius * outline @ np.array([[cos, sin], [-sin, cos]]) + center
    cv2.fillPoly(image, [np.rint(points * 16).astype(np.int32)], color, cv2.LINE_AA, 4)
    return image, np.asarray(points, np.float32)


def view(name):
    image = np.full((SIDE, SIDE, 3), 235, np.uint8)
    image, outline = drawn(name, image, (SIDE / 2, SIDE / 2), 80)
    return image, outline


def model(name):
    return ObjectModel(name, (view_of(*view(name), SIFT, METERS),))


@cache
def known():
    return PlainRecognizer([model(name) for name in SHAPES], VIEW)


@pytest.fixture
def recognizer():
    return known()


def wall(light=1.0):
    gray = np.linspace(120, 190, 640)[None, :, None] * np.array([1.0, 0.98, 0.93])
    return np.clip(np.broadcast_to(gray * light, (480, 640, 3)), 0, 255).astype(np.uint8)


@pytest.mark.proves("R08")
@settings(max_examples=12)
@given(
    st.sampled_from(sorted(SHAPES)),
    st.integers(60, 110),
    st.floats(0, math.tau),
    st.floats(0.75, 1.1),
    st.integers(0, 99),
)
def test_a_plain_object_has_the_right_name_and_distance_or_none(name, radius, turn, light, seed):
    image, outline = drawn(name, wall().copy(), (300, 230), radius, turn)
    lit = np.clip(image * light, 0, 255).astype(np.uint8)
    found = known().recognize(noisy(lit, seed, 4.0))
    assert [one.name for one in found] in ([name], [])
    for one in found:
        assert (one.x, one.y) == pytest.approx(tuple(outline_center(outline)), abs=4)
        away = VIEW.focal_length((640, 480)) * METERS * 80 / radius
        assert one.distance == pytest.approx(away, rel=0.12)


def outline_center(outline):
    moments = cv2.moments(outline)
    return moments["m10"] / moments["m00"], moments["m01"] / moments["m00"]


@pytest.mark.proves("R08")
@pytest.mark.parametrize("name", sorted(SHAPES))
def test_each_is_found_on_a_gray_wall(recognizer, name):
    image, _ = drawn(name, wall().copy(), (350, 260), 90, 0.3)
    assert [one.name for one in recognizer.recognize(noisy(image, 1, 4.0))] == [name]


def test_two_that_look_the_same_are_not_named():
    twins = [model("red mug"), ObjectModel("another mug", model("red mug").views)]
    image, _ = drawn("red mug", wall().copy(), (300, 240), 90)
    assert PlainRecognizer(twins, VIEW).recognize(image) == ()


def test_another_shape_or_color_is_not_named(recognizer):
    image = cv2.circle(wall().copy(), (300, 240), 80, (190, 40, 40), -1, cv2.LINE_AA)
    assert recognizer.recognize(image) == ()
    green = PlainRecognizer([model("green mug")], VIEW)
    assert green.recognize(drawn("red mug", wall().copy(), (300, 240), 90)[0]) == ()


@pytest.mark.parametrize("shape", [(1, 1), (31, 400), (40, 33), (480, 640)])
@pytest.mark.parametrize("level", [0, 255])
def test_covered_cameras_of_any_size_show_nothing(recognizer, shape, level):
    assert recognizer.recognize(np.full((*shape, 3), level, np.uint8)) == ()


def test_a_learner_takes_a_plain_object_that_has_a_color():
    learner = ObjectLearner("mug", ModelSet(SIFT))
    shown = learner.show(*view("red mug"), METERS)
    assert (shown.is_new, shown.reason) == (True, "plain, known by color and shape")
    again = learner.show(noisy(view("red mug")[0], 1, 3.0), view("red mug")[1], METERS)
    assert (again.is_new, again.reason) == (False, "looks like a view before")
    both = ObjectRecognizer(ModelSet(SIFT, (learner.model(""), model("blue star"))), VIEW)
    image, _ = drawn("blue star", wall().copy(), (450, 240), 80)
    image, _ = drawn("red mug", image, (150, 240), 80)
    assert {one.name for one in both.recognize(noisy(image, 2, 4.0))} == {"mug", "blue star"}


@pytest.fixture(scope="module")
def network(tmp_path_factory):
    path = tmp_path_factory.mktemp("network") / "colors.onnx"
    path.write_bytes(mean_color_network())
    return path


def test_a_network_that_is_plugged_in_judges_in_place_of_color(network):
    embedding = Embedding(network)
    red, blue = (np.full((50, 80, 3), color, np.uint8) for color in ((200, 30, 30), (30, 30, 200)))
    assert embedding.describe(red) @ embedding.describe(red) == pytest.approx(1.0)
    assert embedding.describe(red) @ embedding.describe(blue) < 0.5
    recognizer = PlainRecognizer([model(name) for name in SHAPES], VIEW, embedding)
    image, _ = drawn("green mug", wall().copy(), (350, 260), 90, 0.3)
    assert [one.name for one in recognizer.recognize(noisy(image, 1, 4.0))] == ["green mug"]


@pytest.mark.parametrize("content", [b"", b"junk" * 100, None])
def test_a_file_that_is_not_a_network_is_refused_in_a_line(tmp_path, content):
    path = tmp_path / "junk.onnx"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(HriError, match=r"junk\.onnx: not (found|a network)") as refused:
        Embedding(path)
    assert "\n" not in str(refused.value)
