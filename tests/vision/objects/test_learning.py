"""Views are kept when they show something new of an object."""

import cv2
import numpy as np
import pytest

from hri.core.errors import HriError
from hri.vision.objects.cutout import whole
from hri.vision.objects.learning import (
    MOST_VIEWS,
    ObjectLearner,
    scale_from_distance,
    scale_from_width,
    view_of,
)
from hri.vision.objects.local_features import SIFT
from hri.vision.objects.object_model import ModelSet
from hri.vision.objects.printed_label import printed_label
from hri.vision.objects.recognizer import ObjectRecognizer
from tests.vision.objects.pictures import VIEW, learned, noisy, standing


def shown(learner, image, **more):
    return learner.show(image, whole(image), **more)


def test_a_side_that_is_new_is_kept_and_one_that_was_seen_is_not():
    learner = ObjectLearner("box", ModelSet(SIFT))
    front, back = printed_label("front"), printed_label("back")
    assert shown(learner, front).is_new
    again = shown(learner, noisy(front))
    assert not again.is_new
    assert again.reason == "looks like a view before"
    assert shown(learner, back).is_new
    box = learner.model("2026-11-23")
    assert (box.name, len(box.views), box.learned) == ("box", 2, "2026-11-23")
    recognizer = ObjectRecognizer(ModelSet(SIFT, (box,)), VIEW)
    for side in ("front", "back"):
        assert [one.name for one in recognizer.recognize(standing(side, 0.7))] == ["box"]


def test_views_of_a_thing_that_moves_take_the_place_of_what_was_taken_for_it_before():
    learner = ObjectLearner("cup", ModelSet(SIFT))
    assert shown(learner, printed_label("room")).is_new
    assert shown(learner, printed_label("cup"), has_moved=True).is_new
    assert shown(learner, printed_label("wall")).reason == "stands still"
    assert learner.count == 1


def test_what_looks_like_another_object_is_reported_at_once():
    learner = ObjectLearner("mug", learned("cup", "key"))
    assert shown(learner, noisy(printed_label("cup"))).mistaken == "cup"
    assert shown(learner, printed_label("mug")).mistaken == ""


def test_learning_an_object_anew_does_not_compare_it_with_itself():
    assert shown(ObjectLearner("cup", learned("cup")), printed_label("cup")).mistaken == ""


@pytest.mark.parametrize("image", [np.full((200, 200, 3), 77, np.uint8), np.zeros((1, 1, 3), "u1")])
def test_a_plain_object_is_refused_with_what_to_do(image):
    learner = ObjectLearner("wall", ModelSet(SIFT))
    assert shown(learner, image).reason == "too plain: 0 features"
    with pytest.raises(HriError, match="wall: no picture shows enough of it - show it nearer"):
        learner.model("")


def test_the_number_of_views_is_bounded():
    learner = ObjectLearner("cube", ModelSet(SIFT))
    kept = [shown(learner, printed_label(f"side {n}")) for n in range(MOST_VIEWS + 1)]
    assert [one.is_new for one in kept] == [True] * MOST_VIEWS + [False]


def test_what_is_outside_of_the_outline_is_not_learned():
    image = np.hstack([printed_label("cup"), printed_label("key")])
    outline = whole(printed_label("cup"))
    view = view_of(image, outline, SIFT)
    assert view.picture.shape[0] == view.picture.shape[1]
    assert (view.features.points <= view.outline.max(axis=0)).all()


def test_a_view_outside_of_the_picture_is_cut_at_its_edge():
    view = view_of(printed_label("cup"), np.float32([(-50, -50), (400, -50), (100, 500)]), SIFT)
    assert view.picture.shape == (200, 200, 3)


def test_size_comes_from_the_width_or_from_the_distance():
    outline = np.float32([(10, 0), (110, 0), (110, 50)])
    assert scale_from_width(outline, 0.2) == pytest.approx(0.002)
    assert scale_from_distance(0.5, 500) == pytest.approx(0.001)
    assert scale_from_distance(float("nan"), 500) == 0


def test_the_scale_stays_that_of_the_object_when_its_picture_is_shrunk():
    label = printed_label("cup")
    large = cv2.resize(label, None, fx=5, fy=5)
    view = view_of(large, whole(large), SIFT, 0.3 / large.shape[1])
    assert view.scale * np.ptp(view.outline[:, 0]) == pytest.approx(0.3, rel=0.01)
