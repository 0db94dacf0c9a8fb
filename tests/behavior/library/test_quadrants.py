import math

import pytest
from hypothesis import assume, given, strategies as st

from hri.behavior.library.quadrants import Quadrant, clearance, quadrants
from hri.core.geometry import Pose3D
from hri.hal.shape import Shape

FRONT, LEFT, BACK, RIGHT = Quadrant
BODY = Shape(lx=0.48, ly=0.38, lz=0.5)
LENGTHS = st.floats(-1, 1)
YAWS = st.floats(-7, 7)


def mount(x, y, yaw, pitch=0.0):
    """As in a configuration: centimeters and radians."""
    return Pose3D(x / 100, y / 100, 0.2, 0.0, pitch, yaw)


@pytest.mark.proves("B21")
@pytest.mark.parametrize(
    ("x", "y", "yaw", "sides"),
    [
        (20, 0, 0, {FRONT}),
        (20, 0, math.pi / 4, {FRONT}),
        (20, 10, math.pi / 4, {FRONT, LEFT}),
        (20, -10, -math.pi / 4, {FRONT, RIGHT}),
        (-20, 10, 3 * math.pi / 4, {BACK, LEFT}),
        (-20, -10, 5 * math.pi / 4, {BACK, RIGHT}),
        (0, 0, math.pi / 4, {FRONT, LEFT}),
        (0, 20, math.pi / 4, {LEFT}),
        (0, 20, 0, {FRONT}),
        (20, 0, math.pi / 2, {LEFT}),
        (20, 0, math.pi, {BACK}),
        (20, 0, -math.pi / 2, {RIGHT}),
        (20, 10, math.pi / 4 + 0.01, {LEFT}),
        (20, 10, math.pi / 4 - 0.01, {FRONT}),
    ],
)
def test_a_sensor_covers_the_side_it_looks_at_and_both_on_a_border(x, y, yaw, sides):
    assert quadrants(mount(x, y, yaw), BODY) == sides


@pytest.mark.proves("B21")
@given(x=LENGTHS, y=LENGTHS, yaw=YAWS, quarters=st.integers(1, 3))
def test_turning_the_robot_by_quarters_turns_the_quadrants_too(x, y, yaw, quarters):
    edge = math.remainder(yaw - math.pi / 4, math.pi / 2)
    assume(abs(edge) > 1e-4)
    turn = quarters * math.pi / 2
    turned = quadrants(Pose3D(x, y, yaw=yaw + turn), BODY)
    assert turned == {Quadrant((q + quarters) % 4) for q in quadrants(Pose3D(x, y, yaw=yaw), BODY)}
    assert len(turned) == 1


def test_a_sensor_that_looks_at_the_floor_covers_no_side():
    assert quadrants(mount(20, 0, 0, pitch=math.pi / 2), BODY) == set()
    assert quadrants(mount(20, 0, 0, pitch=0.2), BODY) == {FRONT}


@pytest.mark.proves("B21")
def test_the_distance_counts_from_the_edge_of_the_box():
    sensor = mount(20, 0, 0)
    plain = clearance(sensor, 0.5, BODY)
    assert plain == pytest.approx(0.46)
    longer = Shape(lx=0.68, ly=0.38)
    assert clearance(sensor, 0.5, longer) == pytest.approx(plain - 0.10)
    farther_back = Shape(lx=0.48, ly=0.38, x=-0.10)
    assert clearance(sensor, 0.5, farther_back) == pytest.approx(plain + 0.10)


@given(x=LENGTHS, y=LENGTHS, yaw=YAWS, reading=st.floats(0, 10), more=st.floats(0.001, 1))
def test_a_larger_box_is_never_farther_away(x, y, yaw, reading, more):
    sensor = Pose3D(x, y, yaw=yaw)
    larger = Shape(lx=BODY.lx + more, ly=BODY.ly + more)
    distance = clearance(sensor, reading, BODY)
    assert 0 <= clearance(sensor, reading, larger) <= distance <= reading + math.hypot(x, y)


@given(x=LENGTHS, y=LENGTHS, yaw=YAWS, reading=st.floats(0, 10), box_x=LENGTHS, box_yaw=YAWS)
def test_the_distance_is_the_least_one_to_any_point_of_the_box(x, y, yaw, reading, box_x, box_yaw):
    box = Shape(lx=0.48, ly=0.38, x=box_x, yaw=box_yaw)
    distance = clearance(Pose3D(x, y, yaw=yaw), reading, box)
    seen = (x + reading * math.cos(yaw), y + reading * math.sin(yaw))
    for u, v in [(0, 0), (1, 0), (0, 1), (1, 1), (-1, 1), (1, -1), (-1, -1), (0.5, 1)]:
        ahead, left = u * box.lx / 2, v * box.ly / 2
        corner = (
            box.x + math.cos(box_yaw) * ahead - math.sin(box_yaw) * left,
            math.sin(box_yaw) * ahead + math.cos(box_yaw) * left,
        )
        assert distance <= math.dist(seen, corner) + 1e-9


def test_nothing_in_range_is_infinitely_far():
    assert clearance(mount(20, 0, 0), math.inf, BODY) == math.inf
