"""Photographs and films of real people, and pictures without anybody."""

from collections import Counter

import numpy as np
import pytest

from hri.core.signals import FaceBox, Frame, HeadGesture, HeadPose, Image
from hri.vision.detectors.blazeface import BlazeFace
from hri.vision.detectors.detector_choice import Detectors
from hri.vision.detectors.face import FaceFinder
from hri.vision.detectors.haar import HaarDetector
from hri.vision.gestures.gesture_patterns import answer_patterns
from hri.vision.gestures.gesture_recognizer import GestureRecognizer
from hri.vision.tracking.people import PeopleTracker
from tests.recorded import HERE, picture

PORTRAITS = {"biden": (0.59, 0.18), "obama": (0.54, 0.23), "obama2": (0.53, 0.36)}
"""Where the middle of the face is: shares of the width and of the height."""
EMPTY = ("brick", "chelsea", "coffee", "rocket")
RATE = 30
"""Pictures a second of the films."""
DEPTH = 0.75
"""How far the tip of the nose is before the ears, in distances of one ear to the other."""


def middle(box: FaceBox, image: Image) -> tuple[float, float]:
    height, width = image.shape[:2]
    return (box.x + box.width / 2) / width, (box.y + box.height / 2) / height


def check_finds_one(finder: FaceFinder, name: str) -> None:
    image = picture(name)
    surest = finder.find(image)[0]
    assert middle(surest.box, image) == pytest.approx(PORTRAITS[name], abs=0.05)


@pytest.mark.parametrize("name", PORTRAITS)
def test_the_network_finds_the_face_of_a_portrait(name: str, blazeface: BlazeFace) -> None:
    check_finds_one(blazeface, name)


@pytest.mark.parametrize("name", PORTRAITS)
def test_the_cascade_finds_the_face_of_a_portrait(name: str) -> None:
    check_finds_one(HaarDetector(), name)


def test_the_network_finds_a_face_in_profile(blazeface: BlazeFace) -> None:
    assert len(blazeface.find(picture("photographer"))) == 1


def counted(image: Image, detectors: Detectors) -> int:
    """How many people are seen while the picture stays, until all of it was searched."""
    tracker = PeopleTracker(detectors)
    return max(len(tracker.see(Frame(image, n / 10, n)).persons) for n in range(60))


@pytest.mark.parametrize("name", PORTRAITS)
def test_a_portrait_is_one_person(name: str, detectors: Detectors) -> None:
    assert counted(picture(name), detectors) == 1


@pytest.mark.parametrize("name", EMPTY)
def test_an_empty_picture_is_nobody(name: str, detectors: Detectors) -> None:
    assert counted(picture(name), detectors) == 0


@pytest.mark.parametrize("name", EMPTY)
def test_nobody_is_where_nobody_is(name: str, blazeface: BlazeFace) -> None:
    finders: tuple[FaceFinder, ...] = (blazeface, HaarDetector())
    assert [finder.find(picture(name)) for finder in finders] == [[], []]


def gestures(film: str) -> list[HeadGesture]:
    """The gestures of a film that nobody asked for; its head is turned as its points lie."""
    with np.load(HERE / "heads" / "landmarks.npz") as file:
        points = dict(zip(file["feature_names"].tolist(), file[film].T, strict=True))
    head = points["LEFT_EAR_X"] - points["RIGHT_EAR_X"]
    across = points["NOSE_X"] - (points["LEFT_EAR_X"] + points["RIGHT_EAR_X"]) / 2
    # The height of a picture is three quarters of its width.
    down = 0.75 * (points["NOSE_Y"] - (points["LEFT_EAR_Y"] + points["RIGHT_EAR_Y"]) / 2)
    aside = 0.75 * (points["LEFT_EYE_Y"] - points["RIGHT_EYE_Y"])
    pitch = np.arctan2(down, DEPTH * head)
    yaw = np.arcsin(np.clip(across / (DEPTH * head), -1, 1))
    roll = np.arctan2(aside, points["LEFT_EYE_X"] - points["RIGHT_EYE_X"])
    recognizer = GestureRecognizer(answer_patterns(), again=1.0)
    poses = np.stack([np.arange(len(head)) / RATE, pitch, yaw, roll], axis=1)
    found = (recognizer.update(HeadPose(*pose)) for pose in poses.tolist())
    return [gesture for gesture in found if gesture is not None]


def told(film: str) -> Counter[str]:
    return Counter(gesture.kind for gesture in gestures(film))


def test_nods_are_seen_from_the_beginning() -> None:
    times = [0.0, *(nod.time for nod in gestures("nodding"))]
    assert max(np.diff(times)) <= 2.0, "the first nods are the widest and slowest"


def test_a_person_who_nods_for_half_a_minute_is_seen_to() -> None:
    counts = told("nodding")
    assert counts["nod"] >= 15
    assert set(counts) == {"nod"}


def test_a_person_who_shakes_the_head_is_seen_to() -> None:
    counts = told("turning")
    assert counts["shake"] >= 8
    assert set(counts) == {"shake"}


def test_a_person_who_moves_about_says_nothing_by_it() -> None:
    assert told("stationary") == {}
