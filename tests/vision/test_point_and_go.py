"""Going where somebody points in the picture of a camera."""

import pytest

from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.registry import canonical
from hri.core.signals import Pose2D
from hri.hal.camera import Camera
from hri.hal.resource import Description
from hri.simulation.world import SimulatedWorld
from hri.task import find_task, get_task_manager, use
from hri.testing import context
from hri.vision.point_and_go import PointAndGo
from tests.behavior.library.ticking import tick

HEIGHT_CM = "40"


@pytest.fixture
def pointer():
    lent = context(
        Description("world", "Hri.SimulatedWorld", {"voice": "mute"}),
        Description("camera", "Hri.SimulatedCamera", {"z": HEIGHT_CM}, bus="world"),
        Description("odometry", "Hri.SimulatedOdometry", bus="world"),
    )
    lent.resources.declare(Description("mute", "Hri.EspeakVoice"))
    lent.resources.obtain("world", SimulatedWorld).people = ()  # the camera looks straight ahead
    made = PointAndGo("point")
    made.start(lent)
    yield made
    lent.resources.close()


def test_a_pixel_becomes_a_goal_that_stays_until_another_comes(pointer) -> None:
    assert tick(pointer) == {}
    first = tick(pointer, x=160, y=220)["goal"]
    assert isinstance(first, Pose2D)
    assert (first.x, first.y) == pytest.approx((2.07, 0.0), abs=0.01)  # 0.4 m * 517 / 100 pixels
    assert tick(pointer) == {"goal": first}
    assert tick(pointer, x=60, y=220)["goal"].y > 0.3
    assert tick(pointer, reset=True) == {}
    assert tick(pointer) == {}


def test_a_pixel_above_the_horizon_leaves_the_goal_as_it_was(pointer) -> None:
    first = tick(pointer, x=160, y=220)
    with pytest.raises(HriError, match="shows no floor"):
        tick(pointer, x=160, y=50)
    assert tick(pointer) == first


def test_the_task_drives_to_the_spot_of_the_picture_in_a_plain_script() -> None:
    assert canonical("Evolution.PointAndGo") == "Hri.PointAndGo"
    use("simulated", FakeClock())
    try:
        resources = get_task_manager().context.resources
        world = resources.obtain("world", SimulatedWorld)
        world.people = ()
        start = world.base.pose
        camera = resources.obtain("camera", Camera)
        find_task("Evolution.PointAndGo")(camera.width / 2, camera.height - 5)
        far = 0.4 * 517 / 115
        assert (world.base.pose.x - start.x, world.base.pose.y - start.y) == pytest.approx(
            (far, 0.0), abs=0.2
        )
        with pytest.raises(HriError, match="point at the floor"):
            find_task("Hri.PointAndGo")(10, 10)
    finally:
        get_task_manager().shutdown()
        use()
