"""Hands and forearms are cut away from the thing that they hold."""

import cv2
import numpy as np
import pytest

from hri.vision.objects.holding_hands import HandFinder, outlines_of
from tests.vision.hands.test_hand_shape import drawn
from tests.vision.objects.pictures import noisy, room, standing


@pytest.mark.parametrize("degrees", range(0, 360, 45))
def test_all_of_a_hand_is_within_its_outline_and_the_forearm_is_behind_the_wrist(degrees):
    turn = cv2.getRotationMatrix2D((0.0, 0.0), degrees, 1.0)[:, :2]
    points = drawn(0, 1, 2, 3, 4, size=50)[:, :2] @ turn.T + (320, 240)
    hand, forearm = outlines_of(points, 800)
    for point in points.tolist():
        assert cv2.pointPolygonTest(hand, point, False) > 0
    wrist, knuckle = points[0], points[9]
    behind, before = wrist + 3 * (wrist - knuckle), knuckle
    assert cv2.pointPolygonTest(forearm, behind.tolist(), False) > 0
    assert cv2.pointPolygonTest(forearm, before.tolist(), False) < 0


def test_a_label_in_a_room_has_no_hands():
    assert HandFinder().find(noisy(standing("cup", 0.6, image=room(3)))) == []


@pytest.mark.parametrize("shape", [(1, 1, 3), (480, 2, 3), (2, 640, 3)])
def test_a_picture_of_any_shape_can_be_searched(shape):
    assert HandFinder().find(np.zeros(shape, np.uint8)) == []
