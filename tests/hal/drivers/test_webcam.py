"""The camera of this machine, with a film in place of the hardware."""

import os
import threading

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
