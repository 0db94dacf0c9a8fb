"""Whatever a camera does, seeing goes on, and sees the person again afterwards."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from hri.core.clock import FakeClock
from hri.core.signals import Frame
from hri.hal.camera import Camera
from hri.hal.picture import oriented
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.simulation.people.actors import Appearance, render_people
from hri.simulation.world import SimulatedWorld
from hri.testing.cameras import FAULTS, Fault, FaultyCamera
from hri.vision.detectors.detector_choice import load_detectors
from hri.vision.gestures.gesture_behaviors import PeopleGestures
from hri.vision.gestures.gesture_patterns import answer_patterns
from hri.vision.tracking.people import PeopleTracker

PICTURE = render_people([Appearance(center=(160, 120), height=120)], (320, 240))
RATE = 10.0


@pytest.mark.parametrize("kind", FAULTS)
def test_a_fault_of_the_camera_costs_a_moment(kind):
    manager = ResourceManager((), FakeClock(), lambda _: None)
    camera = FaultyCamera(lambda time: PICTURE, [Fault(kind, 0.8, 1.1)], manager, RATE)
    camera.activate()
    tracker = PeopleTracker(load_detectors("haar"))
    seen = []
    for _ in range(20):
        manager.clock.advance(1 / RATE)
        if (frame := camera.read(manager.clock.now())) is not None:
            seen.append(tracker.see(frame))
    assert all(a.time <= b.time for a, b in pairwise(seen))
    assert [person.is_visible for person in seen[-1].persons] == [True]


@pytest.mark.parametrize("size", [(1, 1), (1, 640), (480, 1), (4320, 7680)])
@pytest.mark.parametrize("setting", ["auto", "haar"])
def test_no_size_of_a_picture_is_too_much(size, setting):
    tracker = PeopleTracker(load_detectors(setting))
    image = np.full((*size, 3), 90, np.uint8)
    for number in range(2):
        assert tracker.see(Frame(image, number / 10, number)).persons == ()


def test_a_mirrored_view_does_not_swap_gestures():
    devices = Description("camera", "Hri.SimulatedCamera", {"rate": "15"})
    with ResourceManager([devices], FakeClock()) as resources:
        camera = resources.obtain("camera", Camera)
        person = resources.obtain("world", SimulatedWorld).person
        person.nod(at=1.5)
        person.shake(at=3.5)
        tracker, gestures = PeopleTracker(load_detectors()), PeopleGestures(answer_patterns())
        told = []
        while resources.clock.now() < 5.5:
            resources.clock.advance(1 / 60)
            if (frame := camera.read(resources.clock.now())) is not None:
                people = tracker.see(replace(frame, image=oriented(frame.image, "0", True)))
                told += gestures.update(people)
    assert [gesture.kind for gesture in told] == ["nod", "shake"]
