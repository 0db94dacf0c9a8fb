"""Learned objects are found in pictures, and nothing else is taken for one."""

import math
from functools import cache

import cv2
import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.reading import require_file
from hri.hal.drivers.still_image import read_still
from hri.vision.objects.learning import view_of
from hri.vision.objects.local_features import METHODS, ORB, SIFT
from hri.vision.objects.object_model import ModelSet, ObjectModel
from hri.vision.objects.recognizer import ObjectRecognizer
from tests.recorded import SHARED, picture
from tests.vision.objects.pictures import VIEW, away, learned, noisy, room, standing

NAMES = ("cup", "key", "book", "glasses", "medicine")


@cache
def recognizer(method=SIFT) -> ObjectRecognizer:
    return ObjectRecognizer(learned(*NAMES, method=method), VIEW)


def names(image, method=SIFT):
    return [one.name for one in recognizer(method).recognize(image)]


@pytest.mark.proves("R08")
@settings(max_examples=12)
@given(
    st.sampled_from(NAMES),
    st.floats(0.5, 1.4),
    st.floats(-0.15, 0.15),
    st.floats(-0.5, 0.5),
    st.floats(-0.5, 0.5),
    st.integers(0, 99),
)
def test_an_object_is_found_however_it_is_turned_with_its_place_and_distance(
    name, distance, x, tilt, roll, seed
):
    image = standing(name, distance, x, 0.02, tilt, roll, room(seed))
    (found,) = recognizer().recognize(noisy(image, seed))
    focal = VIEW.focal_length((640, 480))
    assert found.name == name
    assert found.x == pytest.approx(320 + focal * x / distance, abs=3)
    assert found.y == pytest.approx(240 + focal * 0.02 / distance, abs=3)
    assert found.distance == pytest.approx(away(distance, x, 0.02), rel=0.05)
    assert found.bearing == pytest.approx(-math.atan2(x, distance), abs=0.01)
    assert 0.3 < found.confidence <= 1
    assert cv2.pointPolygonTest(np.float32(found.outline), (found.x, found.y), False) > 0


def test_several_objects_are_found_at_once_the_surest_first():
    image = standing("cup", 1.0, -0.3)
    image = standing("key", 0.9, 0.0, image=image)
    image = standing("book", 1.1, 0.35, image=image)
    found = recognizer().recognize(noisy(image))
    assert {one.name for one in found} == {"cup", "key", "book"}
    assert [one.confidence for one in found] == sorted((o.confidence for o in found), reverse=True)


def test_two_of_a_kind_are_both_found():
    image = standing("cup", 0.9, -0.25)
    found = recognizer().recognize(standing("cup", 0.9, 0.25, image=image))
    assert [one.name for one in found] == ["cup", "cup"]
    assert sorted(round(one.x) for one in found) == pytest.approx([166, 474], abs=4)


@pytest.mark.parametrize("shift", [60, 100])
def test_a_thing_with_depth_is_one_thing(shift):
    """From the side its nearer half has moved against the farther one: two maps, one thing."""
    photograph = picture("chelsea")
    flat = np.float32([[0, 0], [photograph.shape[1], 0], photograph.shape[1::-1]])
    flat = np.vstack([flat, [[0, photograph.shape[0]]]]).astype(np.float32)
    known = ObjectModel("cat", (view_of(photograph, flat, SIFT),))
    image = room(2)
    height, width = photograph.shape[:2]
    image[60 : 60 + height, 60 : 60 + width] = photograph
    middle = width // 2
    image[60 : 60 + height, 60 + middle + shift : 60 + width + shift] = photograph[:, middle:]
    found = ObjectRecognizer(ModelSet(SIFT, (known,)), VIEW).recognize(noisy(image))
    assert [one.name for one in found] == ["cat"]


def test_a_third_of_an_object_may_be_hidden():
    image = standing("cup", 0.6)
    image[:, 340:] = room(3)[:, 340:]
    assert names(image) == ["cup"]


@pytest.mark.parametrize("number", range(8))
def test_nearly_half_of_an_object_may_be_hidden_from_any_side(number):
    image = standing("cup", 0.6)
    toward = number * math.tau / 8
    down, across = np.indices(image.shape[:2])
    depth = (across - 320) * math.cos(toward) + (down - 252) * math.sin(toward)
    image[depth > 5] = room(3)[depth > 5]
    assert names(noisy(image)) == ["cup"]


@pytest.mark.parametrize("number", range(4))
def test_a_magazine_is_not_taken_for_another_issue_of_it(number):
    """They share the title, the colors, and the places of everything else."""
    dice = np.random.default_rng(number)
    issue, other = np.full((2, 360, 270, 3), 230, np.uint8)
    for page, word in ((issue, "alpine"), (other, "harbor")):
        cv2.putText(page, "WEEKLY", (10, 60), cv2.FONT_HERSHEY_TRIPLEX, 1.9, (30, 30, 90), 3)
        picture = dice.integers(0, 256, (7, 12, 3)).repeat(20, axis=0).repeat(20, axis=1)
        page[90:230, 15:255] = cv2.GaussianBlur(picture.astype(np.uint8), (0, 0), 2.0)
        cv2.putText(page, word, (20, 290), cv2.FONT_HERSHEY_DUPLEX, 1.7, (0, 0, 0), 2)
    flat = np.float32([[0, 0], [270, 0], [270, 360], [0, 360]])
    known = ObjectModel("magazine", (view_of(issue, flat, SIFT),))
    recognizer = ObjectRecognizer(ModelSet(SIFT, (known,)), VIEW)

    def found(page):
        image = room(number)
        image[60:420, 180:450] = page
        return [one.name for one in recognizer.recognize(noisy(image))]

    assert found(issue) == ["magazine"]
    assert found(other) == []


@settings(max_examples=20)
@given(st.integers(0, 10_000), st.sampled_from(("dog", "car", "flower", "")))
def test_what_is_not_in_the_set_has_no_name(seed, stranger):
    image = room(seed)
    if stranger:
        image = standing(stranger, 0.6, image=image)
    assert names(noisy(image, seed)) == []


@pytest.mark.parametrize(
    "path", sorted((SHARED / "vision" / "stills").glob("*.[jp][pn]g")), ids=str
)
def test_photographs_show_none_of_the_objects(path):
    require_file(path, "picture")
    assert names(read_still(path).image) == []


def test_a_mirrored_object_is_another_one():
    assert names(np.ascontiguousarray(standing("cup", 0.6)[:, ::-1])) == []


@pytest.mark.parametrize("method", METHODS)
def test_the_same_pictures_give_the_same(method):
    images = [noisy(standing(name, 0.8, seed / 20), seed) for seed, name in enumerate(NAMES)]
    once, again = (
        [ObjectRecognizer(learned(*NAMES, method=method), VIEW).recognize(one) for one in images]
        for _ in range(2)
    )
    assert once == again
    assert any(once)


def test_weak_machines_find_near_objects_by_orb():
    assert names(standing("book", 0.6, 0.05, tilt=0.2), ORB) == ["book"]


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("shape", [(1, 1), (3, 900), (17, 17), (481, 639)])
@pytest.mark.parametrize("gray", [0, 255])
def test_a_covered_camera_of_any_size_shows_nothing(method, shape, gray):
    assert names(np.full((*shape, 3), gray, np.uint8), method) == []


def test_a_picture_of_noise_shows_nothing():
    assert names(np.random.default_rng(0).integers(0, 256, (480, 640, 3)).astype(np.uint8)) == []


def test_an_empty_set_knows_nothing():
    assert ObjectRecognizer(ModelSet(SIFT)).recognize(standing("cup", 0.6)) == ()


def test_an_object_alone_in_its_set_is_not_seen_everywhere():
    alone = ObjectRecognizer(learned("cup"), VIEW)
    assert [one.name for one in alone.recognize(standing("cup", 1.0))] == ["cup"]
    assert [alone.recognize(noisy(room(seed), seed)) for seed in range(10)] == [()] * 10
