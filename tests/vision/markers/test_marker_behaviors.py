"""Markers in networks: events, outputs, and that codes are only texts."""

import math

import numpy as np
import pytest

from benchmarks.vision.marker_scenes import SIDE, Condition, shown
from hri.core.errors import HriError
from hri.core.signals import Frame
from hri.testing import context
from hri.vision.markers.families import FAMILIES
from hri.vision.markers.marker_behaviors import MarkerFinder
from tests.behavior.library.ticking import tick
from tests.vision.markers.rendering import ground


@pytest.fixture
def lent():
    made = context()
    yield made
    made.resources.close()


@pytest.fixture
def card():
    draw = np.random.default_rng(4)
    return shown(FAMILIES["apriltag_36h11"], 7, ground(3), Condition(90.0, (20, 20)), draw)


def played(lent, pictures, **parameters):
    """What a finder sends for pictures, ten a second, and the events that it raises."""
    raised, sent = [], []
    lent.events.subscribe("*", raised.append)
    finder = MarkerFinder("finder", latency=0.05, **parameters)
    finder.check()
    finder.start(lent)
    for number, picture in enumerate(pictures):
        lent.clock.advance(0.1)
        frame = None if picture is None else Frame(picture, lent.clock.now(), number)
        sent.append(tick(finder, now=lent.clock.now(), image=frame))
    finder.stop()
    return sent, raised


def test_a_card_that_is_shown_raises_one_event_and_one_when_it_is_gone(lent, card):
    sent, raised = played(lent, [card.picture] * 30 + [ground(3)] * 40)
    assert [event.name for event in raised] == ["marker.seen", "marker.lost"]
    seen, lost = raised
    assert seen.properties["marker"] == lost.properties["marker"] == "apriltag_36h11:7"
    assert seen.properties["id"] == 7
    assert seen.properties["distance"] == pytest.approx(np.linalg.norm(card.place), rel=0.02)
    assert 0.2 < seen.time < 1.0
    assert 1.7 < lost.time - 3.0 < 2.6
    last = [one for one in sent if "range" in one][-1]
    assert (last["marker_id"], last["name"]) == (7.0, "apriltag_36h11:7")
    assert last["range"] == pytest.approx(np.linalg.norm(card.place), rel=0.02)
    assert math.degrees(last["tilt"]) == pytest.approx(20, abs=3)
    x, _, z = card.place.tolist()
    assert (last["pose"].x, last["pose"].y) == pytest.approx((z, -x), abs=0.02)
    assert sent[-1]["is_seen"] is False


def test_what_is_in_one_picture_only_raises_nothing(lent, card):
    _, raised = played(lent, ([card.picture] * 2 + [ground(3)] * 40) * 2, interval=0.5)
    assert raised == []


def test_without_pictures_a_marker_is_lost(lent, card):
    _, raised = played(lent, [card.picture] * 15 + [None] * 30)
    assert [event.name for event in raised] == ["marker.seen", "marker.lost"]


def test_the_same_pictures_give_the_same_events(card):
    runs = []
    for _ in range(2):
        lent = context()
        _, raised = played(lent, [card.picture] * 10 + [ground(3)] * 30)
        runs.append([(event.name, event.time, dict(event.properties)) for event in raised])
        lent.resources.close()
    assert runs[0] == runs[1]


def test_the_side_of_the_card_scales_the_distance(lent, card):
    _, raised = played(lent, [card.picture] * 10, side=SIDE / 2)
    away = float(np.linalg.norm(card.place)) / 2
    assert raised[0].properties["distance"] == pytest.approx(away, rel=0.02)


def test_an_unknown_family_is_refused_before_the_start():
    with pytest.raises(HriError, match="did you mean"):
        MarkerFinder("finder", families="apriltag_36h10").check()
