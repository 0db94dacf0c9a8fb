"""Colors in networks: a red ball is found and followed in the simulated room."""

import math

import numpy as np
import pytest

from hri.behavior.network_file import load_network
from hri.core import paths
from hri.core.errors import HriError
from hri.core.signals import ColorBlob, ColorBlobs, FaceBox, Frame, HeadPose, People, Person
from hri.hal.camera import Camera
from hri.hal.resource import Description
from hri.simulation.world import SimulatedWorld
from hri.testing import context
from hri.vision.color.color_behaviors import ColorSegmentation
from tests.behavior.library.ticking import tick
from tests.recorded import picture
from tests.robot.test_finding import Room


@pytest.fixture
def lent():
    made = context(Description("world", "Hri.SimulatedWorld", {"voice": "mute"}))
    made.resources.declare(Description("mute", "Hri.EspeakVoice"))
    made.resources.declare(Description("camera", "Hri.SimulatedCamera", bus="world"))
    yield made
    made.resources.close()


def started(lent, **parameters):
    made = ColorSegmentation("colors", **parameters)
    made.check()
    made.start(lent)
    return made


def looked(behavior, lent, people=None):
    """What it sends for the next picture."""
    camera = lent.resources.obtain("camera", Camera)
    lent.clock.advance(0.1)
    frame = camera.read(lent.clock.now())
    more = {} if people is None else {"people": people}
    return tick(behavior, now=lent.clock.now(), image=frame, **more)


@pytest.mark.proves("R10")
def test_the_red_ball_has_a_place_a_size_and_a_distance(lent):
    world = lent.resources.obtain("world", SimulatedWorld)
    behavior = started(lent, colors="red_ball", width=0.3, looks_ahead=True)
    assert looked(behavior, lent)["area"] == 0.0
    world.place("ball", 1.5, 0.3, "red")
    world.place("other", 1.5, -0.3, "blue")
    sent = looked(behavior, lent)
    assert sent["name"] == "red_ball"
    assert sent["bearing"] == pytest.approx(math.atan2(0.3, 1.5), abs=0.02)
    assert sent["range"] == pytest.approx(math.hypot(0.3, 1.5), rel=0.06)
    assert len(sent["blobs"].found) == 1
    assert 0.001 < sent["area"] < 0.2


def test_the_largest_that_is_likely_goes_before_what_is_larger():
    wall, ball, far = (
        ColorBlob("red", 0, 0, 9, 9, area, (), confidence=sure)
        for area, sure in ((900, 0.1), (80, 0.9), (40, 0.95))
    )
    assert ColorBlobs(0.0, (wall, ball, far)).largest() is ball
    assert ColorBlobs(0.0, (wall,)).largest("red") is wall
    assert ColorBlobs(0.0, (wall,)).largest("blue") is None


@pytest.mark.parametrize("shape", [(1, 1), (7, 333), (481, 641)])
def test_a_covered_camera_shows_no_color(lent, shape):
    behavior = started(lent, colors="red_ball")
    frame = Frame(np.zeros((*shape, 3), np.uint8), 0.0, 0)
    assert tick(behavior, image=frame)["blobs"].found == ()


@pytest.mark.parametrize("colors", ["", "nocolor"])
def test_a_network_without_a_known_color_is_refused(colors):
    with pytest.raises(HriError, match="no color"):
        ColorSegmentation("colors", colors=colors).check()


@pytest.mark.proves("R10")
@pytest.mark.parametrize(
    ("name", "face"),
    [("biden", FaceBox(390, 230, 260, 330)), ("obama", FaceBox(170, 120, 200, 260))],
)
def test_skin_of_whoever_is_seen_becomes_a_color(lent, name, face):
    image = picture(name)
    behavior = started(lent, colors="", skin=True)
    pose = HeadPose(0.0, 0.0, 0.0, 0.0, _within(face, image))
    people = People(0.0, (Person("p1", pose),))
    frame = Frame(image, 0.0, 0)
    assert tick(behavior, image=frame, people=people)["blobs"].found == ()
    lent.clock.advance(0.2)
    sent = tick(behavior, now=lent.clock.now(), image=frame, people=people)
    assert sent["name"] == "skin"


def _within(face, image):
    height, width = image.shape[:2]
    return FaceBox(min(face.x, width / 3), min(face.y, height / 4), width / 3, height / 2)


@pytest.mark.proves("R10")
def test_the_network_follows_a_red_ball_that_rolls_away(tmp_path):
    room = Room(
        tmp_path, networks=[load_network(paths.find("config/networks", "follow_color.xml"))]
    )

    def put(x, y):
        room.things = {"ball": (x, y)}
        room.world.place("ball", x, y, "red")

    put(2.4, 2.1)
    for number in range(24):
        x = 2.4 + 0.06 * number
        room.clock.call_at(2.0 + 0.3 * number, lambda x=x: put(x, 2.1 - 0.2 * (x - 2.4)))

    async def watch(context):
        await context.clock.sleep(16.0)
        return room.from_robot("ball")

    bearing, distance = room.run(watch)
    assert distance == pytest.approx(0.9, abs=0.25)
    assert abs(bearing) < 0.2
    assert room.world.base.pose.x > 2.0
    assert not room.world.base.is_touching
