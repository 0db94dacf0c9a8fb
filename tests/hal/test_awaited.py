"""A service begins without its devices, and takes them when they come."""

import threading
import time

import numpy as np
import pytest

from hri.core.clock import FakeClock, RealClock
from hri.core.errors import NotAvailable
from hri.core.signals import Frame
from hri.hal.camera import Camera
from hri.hal.drivers.memory import MemoryMicrophone, OffscreenScreen, SilentSpeaker
from hri.hal.microphone import Microphone
from hri.hal.range_sensor import RangeSensor
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.screen import Screen
from hri.hal.speaker import Speaker

PICTURE = np.arange(8 * 6 * 3, dtype=np.uint8).reshape(6, 8, 3)


class Late:
    """A device that is there once it was plugged in."""

    is_hardware = True
    is_plugged_in = False
    attempts = 0

    def _open(self):
        self.attempts += 1
        if not self.is_plugged_in:
            raise self.not_available("not there", "plug it in")
        super()._open()


class LateMicrophone(Late, MemoryMicrophone):
    def read(self, now):
        return np.full(160, 7, np.int16)


class LateSpeaker(Late, SilentSpeaker):
    played = 0

    def play(self, samples, rate, now):
        self.played += 1
        super().play(samples, rate, now)


class LateCamera(Late, Camera):
    sequence = 0

    def _read(self, now):
        self.sequence += 1
        return Frame(PICTURE, now, self.sequence)


class LateScreen(Late, OffscreenScreen):
    count = 0


class Stage:
    """A manager as a service has it, with one device that comes late."""

    def __init__(self, driver, clock=None, **parameters):
        self.notices = []
        self.manager = ResourceManager((), clock or RealClock(), self.notices.append)
        self.manager.waits_for_devices = True
        self.late = driver(Description("late", "Test.Late", parameters), self.manager)
        self.manager.substitute("late", self.late)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.manager.close()


WAITING = "late: not there - plug it in (waiting for it)"


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    monkeypatch.setattr("hri.hal.awaited.LOOK_AGAIN", 0.002)
    monkeypatch.setattr("hri.hal.awaited.list_again", lambda: None)


def until(condition):
    deadline = time.perf_counter() + 20.0
    while not condition():
        assert time.perf_counter() < deadline


def use_microphone(microphone, late):
    return microphone.read(0.0).tolist() == [7] * 160


def use_speaker(speaker, late):
    speaker.play(np.zeros(100, np.int16), 16000, 0.0)
    return late.played > 0


def use_camera(camera, late):
    frame = camera.read(camera.manager.clock.now())
    return frame is not None and np.array_equal(frame.image, PICTURE)


def use_screen(screen, late):
    screen.show(PICTURE, 0.0)
    return late.count > 0


KINDS = {
    "microphone": (LateMicrophone, Microphone, use_microphone),
    "speaker": (LateSpeaker, Speaker, use_speaker),
    "camera": (LateCamera, Camera, use_camera),
    "screen": (LateScreen, Screen, use_screen),
}


@pytest.mark.parametrize("kind", KINDS)
def test_a_missing_device_is_waited_for_and_taken_when_it_comes(kind):
    driver, interface, use = KINDS[kind]
    with Stage(driver) as stage:
        device = stage.manager.obtain("late", interface)
        assert stage.manager.obtain("late", interface) is device
        assert stage.manager.stand_in_of("late") is None
        for _ in range(3):
            assert not use(device, stage.late)
        until(lambda: use(device, stage.late) or stage.late.attempts > 4)
        assert stage.notices == [WAITING]
        stage.late.is_plugged_in = True
        until(lambda: use(device, stage.late))
        until(lambda: len(stage.notices) > 1)
        assert stage.notices == [WAITING, "late: is there"]
        assert device.is_hardware
    assert not stage.late.is_active
    assert not device.is_active


@pytest.mark.parametrize("kind", KINDS)
def test_closing_ends_the_search(kind):
    driver, interface, _ = KINDS[kind]
    with Stage(driver) as stage:
        stage.manager.obtain("late", interface)
    assert not [one for one in threading.enumerate() if one.name == "looks for late"]
    stage.late.is_plugged_in = True
    assert not stage.late.is_active


def test_a_device_that_is_there_is_used_as_it_is():
    with Stage(LateCamera) as stage:
        stage.late.is_plugged_in = True
        assert stage.manager.obtain("late", Camera) is stage.late
        assert stage.notices == []


def test_what_is_said_before_the_speaker_comes_takes_its_time_in_silence():
    with Stage(LateSpeaker) as stage:
        speaker = stage.manager.obtain("late", Speaker)
        speaker.play(np.zeros(16000, np.int16), 16000, 5.0)
        assert speaker.position(5.5) == pytest.approx(0.5)
        stage.late.is_plugged_in = True
        until(lambda: speaker.is_there)
        assert speaker.position(5.9) == pytest.approx(0.9)
        assert speaker.position(6.1) is None
        assert stage.late.played == 0


def test_a_late_camera_is_turned_and_mirrored_once():
    with Stage(LateCamera, rotate="90", mirror="true") as stage:
        camera = stage.manager.obtain("late", Camera)
        stage.late.is_plugged_in = True
        until(lambda: camera.is_there)
        image = camera.take().image
    assert np.array_equal(image, np.rot90(PICTURE, -1)[:, ::-1])


def test_a_late_camera_that_is_switched_off_is_let_go_and_found_again():
    with Stage(LateCamera) as stage:
        camera = stage.manager.obtain("late", Camera)
        stage.late.is_plugged_in = True
        until(lambda: camera.is_there)
        camera.switch(False)
        assert not stage.late.is_active
        camera.switch(True)
        until(lambda: use_camera(camera, stage.late))


def test_a_reason_that_changes_is_told_and_a_driver_with_a_mistake_ends_nothing():
    with Stage(LateMicrophone) as stage:
        microphone = stage.manager.obtain("late", Microphone)
        reasons = iter(
            [NotAvailable("late: busy - end the other program"), ZeroDivisionError("oh")]
        )

        def opened():
            if (reason := next(reasons, None)) is not None:
                raise reason

        stage.late._open = opened
        until(lambda: microphone.is_there)
        until(lambda: len(stage.notices) == 4)
        assert stage.notices == [
            WAITING,
            "late: busy - end the other program (waiting for it)",
            "late: its driver failed: ZeroDivisionError('oh') - fix the driver (waiting for it)",
            "late: is there",
        ]


def test_nothing_simulated_stands_in_for_what_a_service_cannot_begin_without():
    class Missing(RangeSensor):
        def _open(self):
            raise self.not_available("not there", "plug it in")

        def read(self, now):
            raise AssertionError

    described = Description("sensor", "Test.Missing", {"stand_in": "simulated"})
    world = Description("world", "Hri.SimulatedWorld")
    simulated = Description("simulated", "Hri.SimulatedRangeSensor", bus="world")
    for is_service in (False, True):
        manager = ResourceManager([world, simulated, described], RealClock(), lambda _: None)
        manager.waits_for_devices = is_service
        manager.substitute("sensor", Missing(described, manager))
        if is_service:
            with pytest.raises(NotAvailable, match="sensor: not there - plug it in"):
                manager.obtain("sensor", RangeSensor)
        else:
            assert manager.obtain("sensor", RangeSensor).id == "simulated"
        manager.close()


def test_on_fake_time_nothing_is_waited_for():
    with Stage(LateCamera, FakeClock()) as stage, pytest.raises(NotAvailable, match="real time"):
        stage.manager.obtain("late", Camera)
