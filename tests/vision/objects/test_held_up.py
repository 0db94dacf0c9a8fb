"""Only what is held up is learned: neither faces nor the room."""

import cv2
import numpy as np
import pytest

from hri.core.signals import FaceBox
from hri.vision.objects.held_up import A_FACE, NOTHING, HeldUpFinder
from hri.vision.objects.moving import MovingThing
from tests.recorded import picture
from tests.vision.objects.pictures import noisy, room, standing


@pytest.fixture(scope="module")
def finder():
    return HeldUpFinder()


def framed(name, top=0.0):
    """A picture as a camera of 640 x 480 pixels has it; `top`: how much is cut off, of 1."""
    image = picture(name)
    scale = 640 / image.shape[1]
    image = cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    first = round(top * max(0, image.shape[0] - 480))
    return np.ascontiguousarray(image[first : first + 480])


@pytest.mark.parametrize("name", ["biden", "obama", "obama2"])
def test_a_portrait_of_someone_who_holds_up_nothing_teaches_nothing(finder, name):
    assert finder.find(framed(name)).outline is None


def test_a_face_in_the_middle_is_the_reason(finder):
    assert finder.find(framed("obama")).reason == A_FACE


def test_with_the_whole_picture_faces_are_refused_too():
    assert HeldUpFinder(is_whole=True).find(framed("obama")).reason == A_FACE
    assert HeldUpFinder(is_whole=True).find(noisy(room())).outline is not None


@pytest.mark.parametrize("name", ["rocket", "brick"])
def test_a_view_of_the_surroundings_teaches_nothing(finder, name):
    assert finder.find(framed(name)).reason == NOTHING


@pytest.mark.parametrize("number", range(6))
def test_what_is_held_up_is_found_in_its_place(finder, number):
    distance, tilt = (0.45, 0.55, 0.7)[number % 3], 0.3 * (number % 3)
    image = noisy(standing("cup", distance, tilt=tilt, roll=0.2 * number, image=room(number)))
    found = finder.find(image)
    assert found.outline is not None, found.reason
    low, high = found.outline.min(axis=0), found.outline.max(axis=0)
    assert (low + high) / 2 == pytest.approx((320, 240), abs=30)


def test_a_face_that_is_known_is_refused_where_it_is_and_not_elsewhere(finder):
    image = noisy(standing("cup", 0.6, image=room(5)))
    assert finder.find(image, [FaceBox(280, 200, 90, 90)]).reason == A_FACE
    assert finder.find(image, [FaceBox(5, 5, 60, 60)]).outline is not None


def turned(number, ground):
    """A label that is turned to and fro before a ground."""
    tilt, aside = 0.6 * np.sin(number), 0.01 * np.sin(number)
    return standing("cup", 0.55, aside, tilt=tilt, image=ground)


@pytest.mark.parametrize("name", ["rocket", "coffee", "biden"])
def test_a_thing_that_is_turned_is_cut_out_of_a_room_that_stands_still(name):
    ground, finder = framed(name, 0.5), HeldUpFinder()
    found = [finder.find(noisy(turned(number, ground), number)) for number in range(8)][-1]
    assert found.outline is not None, found.reason
    assert found.has_moved
    low, high = found.outline.min(axis=0), found.outline.max(axis=0)
    dark, light = (turned(7, np.full_like(ground, level)) for level in (0, 255))
    down, across = np.nonzero((dark == light).all(axis=2))
    assert low == pytest.approx((across.min(), down.min()), abs=16)
    assert high == pytest.approx((across.max(), down.max()), abs=16)


def test_a_face_that_moves_is_no_thing():
    portrait, ground, finder = framed("obama"), room(2), HeldUpFinder()
    for number in range(8):
        image = ground.copy()
        left = 150 + round(8 * np.sin(number))
        image[60:420, left : left + 320] = portrait[60:420, 150:470]
        found = finder.find(noisy(image, number))
        assert found.outline is None


def test_neither_noise_nor_a_camera_that_moves_is_a_thing():
    still, moved, small = MovingThing(), MovingThing(), (160, 120)
    ground = cv2.resize(room(1), small)
    for number in range(10):
        assert still.look(noisy(ground * (0.9 + 0.02 * number), number, 1.5)) is None
        assert moved.look(np.roll(ground, 5 * number, axis=1)) is None
