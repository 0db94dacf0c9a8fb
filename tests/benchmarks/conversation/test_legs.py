import math

from benchmarks.conversation.legs import legs
from hri.core.signals import Pose2D


def way(*steps: tuple[int, float, float]) -> list[tuple[float, Pose2D]]:
    """Samples each tenth of a second: so many steps of so many meters and radians."""
    pose, samples = Pose2D(), [(0.0, Pose2D())]
    for count, ahead, turn in steps:
        for _ in range(count):
            heading = pose.heading + turn
            x = pose.x + ahead * math.cos(heading)
            pose = Pose2D(x, pose.y + ahead * math.sin(heading), heading)
            samples.append((len(samples) / 10, pose))
    return samples


def test_a_way_is_told_leg_by_leg():
    quarter = math.radians(9)
    steps = way((10, 0.05, 0), (15, 0, 0), (10, 0, quarter), (20, 0, -quarter), (5, -0.05, 0))
    assert list(map(str, legs(steps))) == [
        "drove forward 0.50 m",
        "turned left 90 degrees",
        "turned right 180 degrees",
        "drove back 0.25 m",
    ]


def test_a_base_that_stands_or_trembles_made_no_way():
    assert legs(way((50, 0, 0))) == []
    assert legs(way((3, 0.001, 0.001), (20, 0, 0))) == []


def test_a_short_stop_is_part_of_the_way():
    assert list(map(str, legs(way((5, 0.1, 0), (4, 0, 0), (5, 0.1, 0))))) == [
        "drove forward 1.00 m"
    ]
    assert len(legs(way((5, 0.1, 0), (14, 0, 0), (5, 0.1, 0)))) == 2
