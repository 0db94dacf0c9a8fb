"""The camera of this machine, with a film in place of the hardware."""

import os
import threading
import time

import cv2
import numpy as np
import pytest

from hri.core.clock import RealClock
from hri.core.errors import AuthoringError, NotAvailable
from hri.hal.camera import Camera
from hri.hal.configuration import load_configuration
from hri.hal.drivers.webcam import Webcam
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager


class Film:
    """Gives the nearest of three sizes, one picture for each time it is let."""

    SIZES = ((320, 240), (640, 480), (1280, 720))

    def __init__(self, wanted):
        self.size = min(self.SIZES, key=lambda size: abs(size[0] - wanted[0]))
        self.let = threading.Semaphore(1)
        self.is_over = False

    def read(self):
        self.let.acquire()
        if self.is_over:
            return False, None
        return True, np.full((self.size[1], self.size[0], 3), (255, 0, 0), np.uint8)

    def release(self):
        """Nothing is held."""


class FilmedWebcam(Webcam):
    def _find(self):
        self.film = Film(self._wanted)
        return self.film

    def _close(self):
        self.film.is_over = True
        self.film.let.release()
        super()._close()


@pytest.mark.proves("H17")
@pytest.mark.parametrize(
    ("parameters", "size"),
    [
        ({}, (320, 240)),
        ({"hres": 640, "vres": 480}, (640, 480)),
        ({"width": 640, "height": 480, "hres": 320, "vres": 240}, (640, 480)),
        ({"width": 1200, "height": 700}, (1280, 720)),
    ],
)
def test_it_has_the_size_of_what_it_really_gives(open_driver, parameters, size):
    camera = open_driver(FilmedWebcam, **parameters)
    assert (camera.width, camera.height) == size


def test_the_newest_picture_is_given_once_in_rgb(open_driver):
    camera = open_driver(FilmedWebcam)
    assert camera.read(0.0) is None
    camera.film.let.release()
    while (frame := camera.read(0.0)) is None:
        pass
    assert tuple(frame.image[0, 0]) == (0, 0, 255)
    assert (frame.width, frame.height, frame.sequence) == (320, 240, 0)
    assert camera.read(0.0) is None


@pytest.mark.proves("H11", "H16", "H17")
@pytest.mark.parametrize("type", ["Hri.Webcam", "Evolution.LinuxCamera", "Evolution.DirectXCamera"])
def test_the_spec_gives_320_by_240_and_the_device_overrides_it(tmp_path, type):
    path = tmp_path / "c.xml"
    plain = f'<Resources><Devices><Device id="c" type="{type}"/></Devices></Resources>'
    path.write_text(plain)
    device = load_configuration(path).devices[0]
    assert (device.number("hres", 0), device.number("vres", 0)) == (320, 240)
    larger = '><Parameter name="hres" value="640"/></Device>'
    path.write_text(plain.replace("/></Devices>", f"{larger}</Devices>"))
    device = load_configuration(path).devices[0]
    assert (device.number("hres", 0), device.number("vres", 0)) == (640, 240)


@pytest.mark.parametrize(("name", "value"), [("hres", "0"), ("height", "9000"), ("vres", "2.5")])
def test_a_size_out_of_range_is_refused(manager, name, value):
    camera = Webcam(Description("camera", "Hri.Webcam", {name: value}), manager)
    with pytest.raises(AuthoringError, match=f"{name}: .* write a whole number from 16 to 8192"):
        camera.activate()


def missing(device):
    camera = Description("camera0", "Evolution.LinuxCamera", {"device": str(device)})
    with pytest.raises(NotAvailable) as error:
        ResourceManager([camera], RealClock()).obtain("camera0", Camera)
    return str(error.value)


def test_a_camera_that_is_not_there_is_one_line():
    assert missing(63) == "camera0: no camera /dev/video63 - plug one in, or `hri doctor --choose`"


@pytest.mark.proves("D04")
def test_a_camera_that_may_not_be_opened_is_one_line(tmp_path, monkeypatch):
    device = tmp_path / "video0"
    device.write_bytes(b"")
    assert missing(device) == f"Failure opening {device} - see what else uses it, or replug it"
    monkeypatch.setattr(os, "access", lambda path, mode: False)  # root may open all
    assert missing(device) == f"Failure opening {device} - check permissions"


class Gone(Film):
    """Gives a picture each time it is let, until it is pulled out."""

    is_gone = False
    is_released = False

    def read(self):
        return (False, None) if self.is_gone else super().read()

    def release(self):
        self.is_released = True


def test_a_camera_that_is_pulled_out_is_released_and_found_again(open_driver, monkeypatch):
    monkeypatch.setattr("hri.hal.drivers.webcam.FIRST_PAUSE", 0.001)
    found = []
    is_back = threading.Event()

    class Pulled(FilmedWebcam):
        def _find(self):
            if found and not is_back.is_set():
                return None
            self.film = Gone(self._wanted)
            found.append(self.film)
            return self.film

    camera = open_driver(Pulled)
    found[0].is_gone = True
    found[0].let.release()
    while not found[0].is_released:
        camera.read(0.0)
    is_back.set()
    while (frame := camera.read(1.0)) is None:
        if len(found) == 2:
            found[1].let.release()
    assert (frame.width, frame.height) == (320, 240)


def test_off_releases_the_device_and_on_finds_it_again(open_driver):
    films = []

    class Switched(FilmedWebcam):
        def _find(self):
            self.film = Gone(self._wanted)
            films.append(self.film)
            return self.film

    camera = open_driver(Switched)
    camera.switch(False)
    assert films[0].is_released
    assert camera.read(0.0) is None
    camera.switch(True)
    assert len(films) == 2
    assert not films[1].is_released


PICTURE = (True, np.full((48, 64, 3), (255, 0, 0), np.uint8))
FAILED = (False, None)


class Stranger:
    """A camera that gives these readings, and then the last one for ever."""

    def __init__(self, *readings, then=PICTURE):
        self.readings, self.then = list(readings), then
        self.releases = 0

    def read(self):
        reading = self.readings.pop(0) if self.readings else self.then
        return reading() if callable(reading) else reading

    def release(self):
        self.releases += 1


class Hang:
    """Never answers."""

    def __init__(self):
        self.has_begun = threading.Event()

    def __call__(self):
        self.has_begun.set()
        threading.Event().wait()


@pytest.fixture
def strange(open_driver, manager, monkeypatch):
    """Opens a webcam of these captures, one after the other; None is one that is not found."""
    for name in ("FIRST_PAUSE", "TRY_AGAIN", "FAREWELL"):
        monkeypatch.setattr(f"hri.hal.drivers.webcam.{name}", 0.001)
    told = []
    manager.notice = told.append

    def opened(*captures):
        left = list(captures)

        class Strange(Webcam):
            notices = told

            def _find(self):
                capture = left.pop(0) if left else Stranger()
                return capture() if callable(capture) else capture

        return open_driver(Strange)

    return opened


def next_frame(camera, clock):
    """The next picture; the time stands still while it is waited for."""
    clock.advance(0.1)
    deadline = time.perf_counter() + 20.0
    while (frame := camera.read(clock.now())) is None:
        assert time.perf_counter() < deadline, "no picture"
    return frame


ODD = {
    "empty": np.zeros((0, 0, 3), np.uint8),
    "no rows": np.zeros((0, 64, 3), np.uint8),
    "two channels": np.zeros((48, 64, 2), np.uint8),
    "five channels": np.zeros((48, 64, 5), np.uint8),
    "one dimension": np.zeros(48, np.uint8),
    "four dimensions": np.zeros((1, 48, 64, 3), np.uint8),
    "fractions": np.zeros((48, 64, 3), np.float64),
    "negative": np.zeros((48, 64, 3), np.int16),
    "objects": np.full((48, 64, 3), None),
    "a tuple": (1, 2),
    "a text": "picture",
    "a number": 3,
}


@pytest.mark.parametrize("count", [1, 5, 40])
def test_first_readings_that_fail_are_tried_again(strange, clock, count):
    camera = strange(Stranger(*[FAILED] * count))
    assert (camera.width, camera.height) == (64, 48)
    assert next_frame(camera, clock).width == 64
    assert camera.notices == []


def test_a_camera_that_is_found_but_gives_nothing_is_one_line(strange):
    with pytest.raises(NotAvailable, match="Strange: it gives no picture - see what else uses it"):
        strange(*[Stranger(then=FAILED)] * 1000)


@pytest.mark.parametrize("name", ODD)
def test_an_odd_picture_is_passed_over_at_first_and_later(strange, clock, name):
    capture = Stranger((True, ODD[name]))
    camera = strange(capture)
    assert (camera.width, camera.height) == (64, 48)
    next_frame(camera, clock)
    capture.then = True, ODD[name]
    while not camera.notices:
        clock.advance(1e-6)
        camera.read(clock.now())
    capture.then = PICTURE
    assert next_frame(camera, clock).image.shape == (48, 64, 3)
    (notice,) = camera.notices
    assert "it is passed over; check the device and its settings" in notice
    assert capture.releases == 0


@pytest.mark.parametrize(
    ("kind", "channels"), [(np.uint8, 3), (np.uint8, 4), (np.uint16, 3), (np.uint16, 4)]
)
def test_the_colors_are_in_order_whatever_comes_with_them(strange, clock, kind, channels):
    scale = 1 if kind == np.uint8 else 256
    picture = np.full((48, 64, channels), np.array([255, 9, 3, 0][:channels]) * scale, kind)
    camera = strange(Stranger(then=(True, picture)))
    assert tuple(next_frame(camera, clock).image[0, 0]) == (3, 9, 255)


def broken(words="it broke"):
    raise cv2.error(words)


@pytest.mark.parametrize("capture", [Stranger(then=broken), broken])
def test_an_exception_at_opening_is_one_line(strange, capture):
    with pytest.raises(NotAvailable, match="Strange: error: it broke - see what") as caught:
        strange(*[capture] * 1000)
    assert len(str(caught.value).splitlines()) == 1


def test_a_camera_that_fails_later_is_told_of_once_and_opened_again(strange, clock):
    failing = [Stranger(FAILED, broken) for _ in range(3)]
    first = Stranger()
    camera = strange(first, *failing, None, broken)
    next_frame(camera, clock)
    first.then = broken
    while not failing[-1].releases:
        camera.read(clock.now())
    assert next_frame(camera, clock).width == 64
    assert first.releases == 1
    remedy = "it is opened again; if that goes on, unplug it and plug it in again"
    assert camera.notices == [f"Strange: error: it broke - {remedy}"]


HANGS = "it hangs - unplug it and plug it in again"


@pytest.mark.parametrize("where", ["finding", "reading"])
def test_a_camera_that_hangs_at_opening_is_given_up_and_works_when_it_is_well(
    strange, monkeypatch, where
):
    hang = Hang()
    monkeypatch.setattr("hri.hal.drivers.webcam.PATIENCE", 0.02)
    with pytest.raises(NotAvailable, match=f"Strange: {HANGS}"):
        strange(hang if where == "finding" else Stranger(then=hang))
    monkeypatch.undo()
    assert strange().width == 64


@pytest.mark.parametrize("where", ["finding", "reading"])
def test_a_camera_that_hangs_later_is_told_of_and_opened_anew(strange, clock, where):
    first, hangs = Stranger(), [Hang(), Hang()]
    camera = strange(first, hangs[1] if where == "finding" else Stranger(then=hangs[1]))
    next_frame(camera, clock)
    first.then = hangs[0]
    for hang in hangs:
        assert hang.has_begun.wait(20.0)
        for _ in range(60):
            clock.advance(0.1)
            camera.read(clock.now())
    next_frame(camera, clock)
    silent = f"Strange: no picture for 3 s: {HANGS}"
    assert camera.notices == [silent, "Strange: is back"]


def test_a_camera_that_always_hangs_is_not_asked_by_ever_more_threads(strange, clock):
    first, hangs = Stranger(), [Hang() for _ in range(10)]
    camera = strange(first, *hangs[1:])
    next_frame(camera, clock)
    first.then = hangs[0]
    for hang in hangs[:5]:
        assert hang.has_begun.wait(20.0)
        clock.advance(6.0)
        camera.read(clock.now())
    for _ in range(20):
        clock.advance(6.0)
        camera.read(clock.now())
    assert len(camera._given_up) == 4
    assert not hangs[5].has_begun.is_set()
    assert camera.notices == [f"Strange: no picture for 3 s: {HANGS}"]
    camera.deactivate()
