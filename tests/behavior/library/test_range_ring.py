import math
import sys

import pytest

from hri.behavior.behavior import Context
from hri.behavior.library.range_ring import FuzzyRangeSensorRing
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.core.signals import RangeReading
from hri.hal.range_sensor import RangeSensor
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.shape import Shape
from tests.behavior.library.ticking import tick

pytestmark = pytest.mark.proves("B21")

NONE = sys.float_info.max
MOUNTS = {
    "front": {"x": "20"},
    "front_high": {"x": "20", "z": "40"},
    "corner": {"x": "20", "y": "10", "yaw": "pi/4"},
    "back": {"x": "-20", "yaw": "pi"},
    "spare": {"x": "-20", "yaw": "-pi/2"},
    "floor": {"x": "20", "pitch": "pi/2"},
    "on_front": {"link": "front", "y": "-5", "yaw": "-pi/2"},
}


class Told(RangeSensor):
    """Reads what it was told, in meters."""

    distance = math.inf

    def read(self, now):
        return RangeReading(self.id, self.distance, now)


@pytest.fixture
def lent():
    clock = FakeClock()
    parameters = {id: dict(mount) for id, mount in MOUNTS.items()}
    parameters["back"]["stand_in"] = "spare"
    devices = [Description(id, "Hri.SimulatedRangeSensor", p) for id, p in parameters.items()]
    resources = ResourceManager(devices, clock, shapes=[Shape(lx=0.48, ly=0.38)])
    for device in devices:
        resources.substitute(device.id, Told(device, resources))
    return Context(clock, EventBus(clock), resources)


def ranges(lent, sensor_ids="", **distances):
    for id, distance in distances.items():
        lent.resources.obtain(id, Told).distance = distance
    ring = FuzzyRangeSensorRing("ring", sensor_ids=sensor_ids)
    ring.start(lent)
    sent = tick(ring)["ranges"]
    ring.stop()
    return sent


def test_nothing_in_range_is_the_largest_number_on_each_side(lent):
    assert ranges(lent) == (NONE, NONE, NONE, NONE)


def test_the_shortest_reading_of_a_side_counts(lent):
    assert ranges(lent, front=0.5, front_high=0.3) == pytest.approx((26, NONE, NONE, NONE))


def test_a_sensor_on_a_border_counts_for_both_sides(lent):
    front, left, back, right = ranges(lent, corner=1.0)
    assert front == left == pytest.approx(100 * math.hypot(0.9071 - 0.24, 0.8071 - 0.19), abs=0.1)
    assert (back, right) == (NONE, NONE)


def test_sides_come_in_the_order_front_left_back_right(lent):
    # The last one is fixed to the front sensor: it sits at (20, -5) and looks to the right.
    sent = ranges(lent, front=0.5, corner=math.inf, back=0.5, on_front=0.5)
    assert sent == pytest.approx((46, NONE, 46, 36))


def test_only_the_named_sensors_count(lent):
    sent = ranges(lent, "front_high back", front=0.3, front_high=0.5, back=0.4)
    assert sent == pytest.approx((46, NONE, 36, NONE))


def test_a_ring_that_cannot_start_keeps_no_sensor_open(lent):
    with pytest.raises(HriError, match='no device "frnt"'):
        ranges(lent, "back frnt")
    assert not any(lent.resources.obtain(id, Told).reservations > 1 for id in ("back", "front"))


def test_a_stand_in_and_a_sensor_that_looks_at_the_floor_do_not_count(lent):
    assert ranges(lent, spare=0.3, floor=0.2) == (NONE, NONE, NONE, NONE)
