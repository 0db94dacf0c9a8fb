"""What `obtain` hands out for a name of 2003."""

from __future__ import annotations

import math
from collections.abc import Iterator

import pytest

from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError, HriError
from hri.hal.camera import Camera
from hri.hal.drive import DriveSystem, Odometry, Stop
from hri.hal.resource import Description, Resource
from hri.hal.resource_manager import ResourceManager

WORLD = Description("world", "Hri.SimulatedWorld", {"voice": "mute"})
MUTE = Description("mute", "Hri.EspeakVoice")
ODOMETRY = Description("odometry", "Hri.SimulatedOdometry")
CAMERA = Description("camera", "Hri.SimulatedCamera")


def made(**parameters: str) -> ResourceManager:
    drive = Description("drive", "Hri.SimulatedDrive", parameters)
    return ResourceManager([WORLD, MUTE, drive, ODOMETRY, CAMERA], FakeClock())


@pytest.fixture
def resources() -> Iterator[ResourceManager]:
    with made() as resources:
        yield resources


def x_of(resources: ResourceManager) -> float:
    return resources.obtain("odometry", Odometry).pose(resources.clock.now()).x


@pytest.mark.parametrize("name", ["IDriveSystem", "Evolution.IDriveSystem"])
def test_the_drive_of_2003_takes_the_numbers_of_the_guide_for_centimeters(
    resources: ResourceManager, name: str
) -> None:
    drive = resources.obtain("drive", name)
    drive.set_idle_power(60).wait()
    drive.set_move_power(100).wait()
    drive.move_delta(50, 20, 40).wait()
    assert x_of(resources) == pytest.approx(0.5, abs=0.002)
    assert resources.clock.now() == pytest.approx(50 / 20 + 20 / 40, abs=0.1)


def test_the_drive_of_2003_drives_freely_in_centimeters_and_stops(
    resources: ResourceManager,
) -> None:
    drive = resources.obtain("drive", "IDriveSystem")
    odometry = resources.obtain("odometry", Odometry)
    drive.turn_delta(math.pi / 2, math.pi / 6, math.pi / 3).wait()
    assert odometry.pose(resources.clock.now()).heading == pytest.approx(math.pi / 2, abs=0.01)
    drive.move_and_turn(20, 40, 0, 1)
    resources.clock.advance(1.0)
    assert odometry.velocity(resources.clock.now()).linear == pytest.approx(0.2, abs=0.005)
    drive.stop().wait()
    drive.move_and_turn(-20, 40, 0, 1)
    resources.clock.advance(1.0)
    drive.stop(Stop.ABRUPT).wait()
    assert odometry.velocity(resources.clock.now()).linear == pytest.approx(0.0, abs=1e-9)


def test_what_was_obtained_by_name_is_given_back_as_any_other(resources: ResourceManager) -> None:
    drive = resources.obtain("drive", DriveSystem)
    by_name = resources.obtain("drive", "IDriveSystem")
    assert drive.reservations == 2
    resources.release(by_name)
    resources.release(drive)
    assert not drive.is_active


def test_a_camera_is_the_same_under_both_names(resources: ResourceManager) -> None:
    assert resources.obtain("camera", "ICamera") is resources.obtain("camera", Camera)


@pytest.mark.parametrize(
    ("id", "name", "message"),
    [
        ("drive", "IDriveSytem", 'did you mean "IDriveSystem"?'),
        ("drive", "Evolution.IRangeSensor", "known are: ICamera, IDriveSystem, IStream"),
        ("drive", "", "no interface of 2003"),
        ("camera", "IDriveSystem", '"camera" is a SimulatedCamera'),
        ("drve", "IDriveSystem", 'no device "drve"'),
    ],
)
def test_another_name_is_one_line_and_opens_nothing(
    resources: ResourceManager, id: str, name: str, message: str
) -> None:
    with pytest.raises(HriError) as error:
        resources.obtain(id, name)
    assert message in str(error.value)
    assert "\n" not in str(error.value)
    camera = resources.obtain("camera", Camera)
    assert camera.reservations == 1


def test_the_guides_numbers_given_to_the_drive_in_meters_are_refused_with_both_readings(
    resources: ResourceManager,
) -> None:
    drive = resources.obtain("drive", DriveSystem)
    with pytest.raises(HriError) as error:
        drive.move_delta(50, 20, 40)
    words = str(error.value)
    assert "a move of 50 m is longer than longest_move (20 m)" in words
    assert "if you meant 50 cm, give 0.5" in words
    assert 'obtain("drive", "IDriveSystem")' in words
    assert "\n" not in words
    resources.clock.advance(1.0)
    assert x_of(resources) == 0.0


def test_the_drive_of_2003_has_the_same_longest_move_and_says_it_in_both_units(
    resources: ResourceManager,
) -> None:
    drive = resources.obtain("drive", "IDriveSystem")
    drive.move_delta(2000, 20, 40).cancel()
    with pytest.raises(HriError, match=r"a move of -2500 cm \(-25 m\) is longer than longest_move"):
        drive.move_delta(-2500, 20, 40)


@pytest.mark.parametrize(("longest", "distance", "goes"), [("60", 50, True), ("0.4", 0.5, False)])
def test_the_longest_move_is_a_parameter_of_the_drive(
    longest: str, distance: float, goes: bool
) -> None:
    with made(longest_move=longest) as resources:
        resources.check()
        drive = resources.obtain("drive", DriveSystem)
        if goes:
            drive.move_delta(distance, 0.2, 0.4)
        else:
            with pytest.raises(HriError, match=r"longest_move \(0.4 m\)"):
                drive.move_delta(distance, 0.2, 0.4)


def test_a_longest_move_that_is_none_is_refused_at_load() -> None:
    with made(longest_move="-1") as resources, pytest.raises(AuthoringError, match="longest_move"):
        resources.check()


class ICompass:
    """An interface of one's own, beside the base of drivers."""

    INTERFACE_ID = "Examples.ICompass"


class INorth(Resource):
    """Another, which derives from it."""

    INTERFACE_ID = "Examples.INorth"


class Compass(ICompass, INorth):
    """A driver of both."""


class OwnStream(Resource):
    """As the tutorial of the guide has it: not the stream of the library."""

    INTERFACE_ID = "Examples.IStream"


@pytest.fixture
def own(resources: ResourceManager) -> ResourceManager:
    for id, driver in (("c0", Compass), ("output", OwnStream)):
        resources.substitute(id, driver(Description(id, "Mine.Driver"), resources))
    return resources


@pytest.mark.proves("H18")
@pytest.mark.parametrize("name", ["Examples.ICompass", "Examples.INorth"])
def test_an_interface_of_ones_own_is_obtained_by_its_id(own: ResourceManager, name: str) -> None:
    compass = own.obtain("c0", name)
    assert isinstance(compass, Compass)
    assert compass.reservations == 1
    own.release(compass)
    assert not compass.is_active


@pytest.mark.proves("H18")
def test_an_id_of_ones_own_goes_before_that_of_the_library(own: ResourceManager) -> None:
    assert isinstance(own.obtain("output", "Examples.IStream"), OwnStream)
    with pytest.raises(HriError, match='"output" is a OwnStream, not a Stream'):
        own.obtain("output", "Evolution.IStream")


def test_a_misspelt_id_of_ones_own_is_told_the_right_one(own: ResourceManager) -> None:
    with pytest.raises(HriError, match=r'did you mean "Examples\.ICompass"\?'):
        own.obtain("c0", "Examples.IKompass")
    assert not own.opened(Compass)
