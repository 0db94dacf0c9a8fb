import itertools
import math

import pytest
from hypothesis import given, settings, strategies as st

from hri.drive.profile import velocity_for


@settings(deadline=None)
@given(
    goal=st.floats(-20, 20),
    max_velocity=st.floats(0.05, 1.0),
    deceleration=st.floats(0.1, 2.0),
)
def test_it_arrives_without_going_too_far(
    goal: float, max_velocity: float, deceleration: float
) -> None:
    dt, position, ticks = 0.05, 0.0, 0
    while abs(goal - position) > 0.005:
        velocity = velocity_for(goal - position, max_velocity, deceleration, dt)
        assert abs(velocity) <= max_velocity
        position += velocity * dt
        ticks += 1
    assert abs(position) <= abs(goal) + 1e-9
    ideal = abs(goal) / max_velocity + max_velocity / deceleration
    assert ticks * dt <= ideal + 1.0


def test_it_slows_down_evenly() -> None:
    dt, position, passed = 0.01, 0.0, []
    for _ in range(1000):
        passed.append(velocity_for(2.0 - position, 0.4, 0.5, dt))
        position += passed[-1] * dt
    steps = [before - after for before, after in itertools.pairwise(passed)]
    assert max(steps) == pytest.approx(0.5 * dt, rel=0.02)


def test_it_goes_where_the_goal_is() -> None:
    assert velocity_for(-3.0, 0.3, 0.5, 0.05) == -0.3
    assert velocity_for(0.0, 0.3, 0.5, 0.05) == 0.0
    assert math.isnan(velocity_for(math.nan, 0.3, 0.5, 0.05))
