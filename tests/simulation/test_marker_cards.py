"""Cards with markers in the simulated room are seen by its camera as they are."""

import math

import numpy as np
import pytest

from hri.core.errors import HriError
from hri.hal.camera import Camera
from hri.hal.resource import Description
from hri.simulation.world_file import load_layout
from hri.testing import context
from hri.vision.camera_view import CameraView
from hri.vision.markers.marker_reader import MarkerReader

ROOM = """
[robot]
start = [0.0, 0.0]

[[object]]
name = "charger"
at = {at}
marker = 7
"""


@pytest.fixture
def seen(tmp_path):
    """What a reader finds in the room's camera, of a card at a place."""
    lent = []

    def look(at, more=""):
        path = tmp_path / "room.toml"
        path.write_text(ROOM.format(at=at) + more)
        made = context(Description("world", "Hri.SimulatedWorld", {"file": str(path)}))
        lent.append(made)
        size = {"width": "640", "height": "480"}
        made.resources.declare(Description("camera", "Hri.SimulatedCamera", size, bus="world"))
        camera = made.resources.obtain("camera", Camera)
        made.clock.advance(0.2)
        return MarkerReader(view=CameraView.of(camera)).find(camera.read(made.clock.now()).image)

    yield look
    for made in lent:
        made.resources.close()


@pytest.mark.parametrize("turn", [-50, -20, 20, 50])
def test_a_card_in_the_room_has_its_place_and_turn(seen, turn):
    heading = math.pi + math.radians(turn)
    (one,) = seen([1.2, 0.2], f"heading = {heading}\n")
    assert one.id == 7
    assert one.point[:2] == pytest.approx((1.2, 0.2), abs=0.03)
    facing = np.degrees(math.remainder(one.pose.heading - heading, math.tau))
    assert facing == pytest.approx(0, abs=3)


def test_without_a_heading_it_is_turned_to_the_camera_and_its_back_shows_nothing(seen):
    (one,) = seen([1.0, -0.2])
    assert math.degrees(one.tilt) < 15
    assert seen([1.0, -0.2], "heading = 0.0\n") == ()


def test_an_id_that_there_is_not_is_refused_with_its_place(tmp_path):
    path = tmp_path / "room.toml"
    path.write_text(ROOM.format(at=[1.0, 0.0]).replace("marker = 7", "marker = 587"))
    with pytest.raises(HriError, match=r"room\.toml:8:1: marker is 587 - write .* 0 to 586"):
        load_layout(path)
