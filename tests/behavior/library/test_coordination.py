import math

import pytest
from hypothesis import given, strategies as st

from hri.behavior.library.coordination import Inhibit, PriorityArbiter, VelocityMixer
from hri.core.signals import Twist
from tests.behavior.library.ticking import Links, tick

pytestmark = pytest.mark.proves("B29")

TWISTS = st.builds(Twist, st.floats(-10, 10), st.floats(-10, 10))


@given(st.lists(st.none() | TWISTS, max_size=5))
def test_the_first_link_that_has_something_wins(wishes):
    winner = next((wish for wish in wishes if wish is not None), None)
    sent = tick(PriorityArbiter(), input=Links(wishes))
    assert sent == ({} if winner is None else {"winner": winner})


@given(first=TWISTS, second=TWISTS, third=TWISTS, weight=st.floats(-5, 5))
def test_a_mix_stays_within_the_limits_and_keeps_the_curve(first, second, third, weight):
    mixer = VelocityMixer(second_weight=weight, max_linear=0.4, max_angular=1.2)
    mixed = tick(mixer, first=first, second=second, third=third)["velocity"]
    linear = first.linear + weight * second.linear + third.linear
    angular = first.angular + weight * second.angular + third.angular
    assert abs(mixed.linear) <= 0.4
    assert abs(mixed.angular) <= 1.2
    assert mixed.linear * angular == pytest.approx(mixed.angular * linear, rel=1e-6, abs=1e-9)
    if abs(linear) <= 0.4 and abs(angular) <= 1.2:
        assert (mixed.linear, mixed.angular) == pytest.approx((linear, angular))


def test_a_mix_of_what_came_in_skips_the_rest():
    assert tick(VelocityMixer()) == {}
    assert tick(VelocityMixer(), second=Twist(0.1, 0.2)) == {"velocity": Twist(0.1, 0.2)}
    assert tick(VelocityMixer(), first=Twist(math.nan)) == {"velocity": Twist()}


def test_a_lower_wish_is_held_back_while_the_inhibitor_is_active_and_a_while_longer():
    inhibit = Inhibit(hold_s=0.2)
    actives = [None, False, True, True, None, None, None, None]
    sent = [
        tick(inhibit, now=k * 0.1, input="wander", inhibitor=active).get("output")
        for k, active in enumerate(actives)
    ]
    assert sent == ["wander", "wander", None, None, None, None, "wander", "wander"]


def test_a_replacement_takes_the_place_of_what_is_held_back():
    inhibit = Inhibit(hold_s=0.0)
    avoid = Twist(0.0, 1.0)
    ports = {"input": Twist(0.3), "replacement": avoid}
    assert tick(inhibit, now=0.0, inhibitor=avoid, **ports) == {"output": avoid}
    assert tick(inhibit, now=0.1, **ports) == {"output": Twist(0.3)}
