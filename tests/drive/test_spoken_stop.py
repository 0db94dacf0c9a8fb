"""A stop that was said is lifted by the next order to move, and no other stop is."""

from __future__ import annotations

import math
from collections.abc import Sequence

import pytest
from hypothesis import given, settings, strategies as st

from hri.core.clock import FakeClock
from hri.core.signals import Twist
from hri.drive.supervisor.base_bus import BaseBus
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager

from .test_supervisor_relay import BASE, DRIVE, WORLD, Guarded

SIMULATED = Description("drive", "Hri.SimulatedDrive")
BASES = {"with a supervisor": (WORLD, BASE, DRIVE), "without one": (WORLD, SIMULATED)}
FIRM = {
    "key": ("drive.halt", {"because": "someone pressed the key"}),
    "halt": ("drive.halt", {}),
    "bump": ("bumper.pressed", {"bumper": "bumper"}),
    "edge": ("cliff.found", {"sensor": "left"}),
}
"""What else stops a base, or what it meets while it stands."""


class Stopped(Guarded):
    """A base that may move, which people stop and send off."""

    def say_stop(self) -> None:
        now = self.clock.now()
        self.events.raise_event("speech.heard", rule="stop", start=now - 0.4, end=now)
        self.wait(0.1)

    def order(self, ago: float = 0.0) -> bool:
        """Whether it may move for an order that somebody began to say so many seconds ago."""
        may = self.guard.lift(self.clock.now() - ago)
        self.wait(0.1)
        return may

    def happen(self, what: str) -> None:
        event, properties = FIRM[what]
        self.events.raise_event(event, **properties)
        self.wait(0.1)


@pytest.fixture(params=BASES.values(), ids=BASES.keys())
def base(request):
    with ResourceManager(request.param, FakeClock()) as resources:
        yield Stopped(resources).released()


def test_an_order_lifts_the_stop_that_was_said_before_it(base: Stopped) -> None:
    base.say_stop()
    base.wait(1.0, Twist(0.2))
    assert base.speed == 0.0
    assert base.order()
    base.wait(1.0, Twist(0.2))
    assert base.speed == pytest.approx(0.2, abs=0.05)
    assert not base.guard.must_wait


@pytest.mark.parametrize("ago", [0.1, 0.3, 60.0, math.inf])
def test_the_stop_wins_over_an_order_that_was_said_before_it(base: Stopped, ago: float) -> None:
    base.say_stop()
    assert not base.order(ago)
    assert base.guard.must_wait
    assert base.guard.explain() == "I stopped because someone said stop"


def test_of_two_stops_that_were_said_the_later_one_counts(base: Stopped) -> None:
    base.say_stop()
    base.wait(1.0)
    base.say_stop()
    assert not base.order(ago=0.8)
    assert base.order()
    base.say_stop()
    assert base.guard.must_wait


@pytest.mark.parametrize("what", FIRM)
def test_what_stops_it_after_that_is_lifted_by_a_release_alone(base: Stopped, what: str) -> None:
    base.say_stop()
    base.happen(what)
    assert not base.order()
    assert base.guard.explain() != "I stopped because someone said stop"
    base.guard.release()
    base.wait(0.1)
    assert base.order()


@pytest.mark.parametrize("what", ["key", "halt"])
def test_who_says_stop_to_a_base_that_was_stopped_otherwise_lifts_nothing(
    base: Stopped, what: str
) -> None:
    base.happen(what)
    base.say_stop()
    assert not base.order()


def test_what_it_meets_while_it_may_move_latches_nothing(base: Stopped) -> None:
    base.happen("bump")
    base.say_stop()
    assert base.order()


deeds = st.lists(st.sampled_from(("stop", "order", "late order", *FIRM)), max_size=10)


@pytest.mark.parametrize("devices", BASES.values(), ids=BASES.keys())
@settings(deadline=None, max_examples=15)
@given(story=deeds)
def test_whatever_is_said_only_spoken_stops_are_lifted(
    devices: Sequence[Description], story: list[str]
) -> None:
    with ResourceManager(devices, FakeClock()) as resources:
        base, state = Stopped(resources).released(), "free"
        for deed in story:
            match deed:
                case "stop":
                    base.say_stop()
                    state = "said" if state == "free" else state
                case "order":
                    state = "free" if state == "said" else state
                    assert base.order() is (state == "free")
                case "late order":
                    assert base.order(ago=0.5) is (state == "free")
                case _:
                    base.happen(deed)
                    meets = deed in ("bump", "edge")
                    state = state if meets and state == "free" else "firm"
            assert base.guard.must_wait is (state != "free")


def test_a_base_that_was_switched_on_just_now_waits_for_its_release() -> None:
    with ResourceManager([WORLD, BASE, DRIVE], FakeClock()) as resources:
        base = Stopped(resources).started()
        assert not base.order()
        base.say_stop()
        assert not base.order()


def test_a_stop_before_the_supervisor_has_answered_to_a_lift_is_not_lost(monkeypatch) -> None:
    with ResourceManager([WORLD, BASE, DRIVE], FakeClock()) as resources:
        base = Stopped(resources).released()
        base.say_stop()
        bus = resources.obtain("base", BaseBus)
        with monkeypatch.context() as late:
            late.setattr(bus._connection, "_hear", lambda state: None)
            assert bus.unlatch_spoken(base.clock.now())
            bus.stop_spoken("someone said stop", base.clock.now() + 0.01)
            assert not bus.unlatch_spoken(base.clock.now() + 0.02)
        base.wait(0.5)
        assert base.guard.must_wait
