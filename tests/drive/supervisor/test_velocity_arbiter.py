import math

import pytest
from hypothesis import given, settings, strategies as st

from hri.core.signals import Twist
from hri.drive.supervisor.velocity_arbiter import Command, VelocityArbiter
from hri.hal.drive import PATIENCE
from hri.hal.rank import WRITERS, Rank

FASTEST = Twist(0.5, 4.0)


def chosen(arbiter: VelocityArbiter, now: float) -> Rank | None:
    command = arbiter.chosen(now)
    return None if command is None else command.source


def test_the_most_important_source_is_heard_and_the_next_when_it_falls_silent() -> None:
    arbiter = VelocityArbiter(FASTEST)
    for source in reversed(WRITERS):
        assert arbiter.offer(Command(source, Twist(0.1), 0.0)) is None
    assert arbiter.waiting(0.1) == [Rank.TELEOP, Rank.BEHAVIORS, Rank.TASKS]
    arbiter.offer(Command(Rank.TASKS, Twist(0.1), 0.1))
    assert chosen(arbiter, 0.19) is Rank.TELEOP
    assert chosen(arbiter, 0.25) is Rank.TASKS
    assert chosen(arbiter, 0.35) is None


@pytest.mark.parametrize("source", WRITERS)
def test_no_source_counts_for_longer_than_the_patience(source) -> None:
    arbiter = VelocityArbiter(FASTEST)
    arbiter.offer(Command(source, Twist(0.1), 1.0))
    assert chosen(arbiter, 1.0 + PATIENCE - 0.001) is source
    assert arbiter.silent(1.0) is None
    assert chosen(arbiter, 1.0 + PATIENCE + 0.001) is None
    assert arbiter.silent(1.0 + PATIENCE + 0.001) is source


def test_a_source_can_take_back_what_it_said() -> None:
    arbiter = VelocityArbiter(FASTEST)
    arbiter.offer(Command(Rank.BEHAVIORS, Twist(0.1), 0.0))
    arbiter.offer(Command(Rank.TASKS, Twist(0.2), 0.0))
    arbiter.offer(Command(Rank.BEHAVIORS, None, 0.0))
    assert chosen(arbiter, 0.0) is Rank.TASKS


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 0.51, -0.6, 1e300])
def test_nonsense_is_refused_with_a_message_and_silences_its_source(value) -> None:
    arbiter = VelocityArbiter(FASTEST)
    arbiter.offer(Command(Rank.TASKS, Twist(0.1), 0.0))
    refusal = arbiter.offer(Command(Rank.TASKS, Twist(value), 0.0))
    assert refusal is not None
    assert refusal.startswith("tasks: ")
    assert " - " in refusal
    assert chosen(arbiter, 0.0) is None


@pytest.mark.parametrize("level", [Rank.LATCH, Rank.REFLEX, Rank.NOBODY])
def test_nobody_outside_speaks_for_the_latch_or_the_reflex(level) -> None:
    assert "may not command" in (VelocityArbiter(FASTEST).offer(Command(level, Twist(), 0.0)) or "")


@settings(deadline=None, max_examples=50)
@given(st.lists(st.tuples(st.sampled_from(WRITERS), st.floats(), st.floats(), st.floats(0, 5))))
def test_what_is_chosen_is_finite_fresh_and_in_range(said) -> None:
    arbiter = VelocityArbiter(FASTEST)
    for source, linear, angular, time in said:
        arbiter.offer(Command(source, Twist(linear, angular), time))
    command = arbiter.chosen(2.0)
    if command is not None:
        assert command.twist is not None
        assert abs(command.twist.linear) <= 0.501
        assert abs(command.twist.angular) <= 4.01
        assert 0 <= 2.001 - command.time <= PATIENCE + 0.001
