"""Told and reported motion, compared in time, for bases with motors of many kinds."""

from __future__ import annotations

import random
from collections import deque
from dataclasses import dataclass, field

import pytest
from hypothesis import given, settings, strategies as st

from hri.core.signals import Twist
from hri.drive.supervisor.lag import MOST_LAG, Lag
from hri.drive.supervisor.limiter import Limiter
from hri.drive.velocity_limits import BaseLimits
from hri.hal.motion import REST, Way

HALF_TRACK = 0.12
TURN, PERIOD = 0.01, 0.015
COUNT = 0.0005
"""Meters for each count of a wheel."""
CAP = BaseLimits().cap(is_near=False)


@dataclass
class Base:
    """Motors that follow late and slowly, not as far as they are told, or not at all when slow."""

    late: float = 0.0
    """Seconds that its reports take."""
    dead_time: float = 0.03
    """Seconds until the motors hear a command."""
    slowness: float = 0.05
    """Seconds in which they do two thirds of what they are told."""
    gain: float = 1.0
    stiction: float = 0.0
    """Meters a second below which they do not turn."""
    jitter: float = 0.0
    """Seconds that a report may be later than others."""
    goes: Twist = REST
    way: Way = field(default_factory=Way)
    commands: deque[tuple[float, Twist]] = field(default_factory=deque)
    heard: Twist = REST

    def step(self, now: float, told: Twist) -> Way:
        """What its wheels have rolled after a turn."""
        self.commands.append((now + self.dead_time, told))
        while self.commands and self.commands[0][0] <= now:
            self.heard = self.commands.popleft()[1]
        stands = max(abs(self.heard.linear), abs(self.heard.angular) * HALF_TRACK) < self.stiction
        wanted = REST if stands else self.heard
        share = TURN / (self.slowness + TURN)
        self.goes = Twist(
            self.goes.linear + share * (self.gain * wanted.linear - self.goes.linear),
            self.goes.angular + share * (self.gain * wanted.angular - self.goes.angular),
        )
        self.way = Way(
            self.way.linear + TURN * self.goes.linear, self.way.angular + TURN * self.goes.angular
        )
        return self.counted()

    def counted(self) -> Way:
        left, right = (
            COUNT * round((self.way.linear + side * self.way.angular) / COUNT)
            for side in (-HALF_TRACK, HALF_TRACK)
        )
        return Way((left + right) / 2, (right - left) / (2 * HALF_TRACK))


def found(base: Base, seed: int = 0, seconds: float = 20.0) -> float | None:
    """The lag that shows while somebody drives about at random; None when none does."""
    chance, lag, limiter = random.Random(seed), Lag(HALF_TRACK), Limiter(BaseLimits())
    told, target, until, due, now = REST, REST, 0.0, 0.0, 0.0
    reports: deque[tuple[float, Way]] = deque()
    for _ in range(round(seconds / TURN)):
        now += TURN
        lag.tell(now, told)
        while reports and reports[0][0] <= now:
            seen = lag.hear(now, reports.popleft()[1])
            if seen is not None:
                return seen
        if now >= until:
            until = now + chance.uniform(0.2, 3.0)
            target = Twist(chance.choice((0.0, 0.3, -0.15)), chance.choice((0.0, 1.0, -0.5)))
            if chance.random() < 0.2:
                limiter.halt()
        told = limiter.step(target, CAP, TURN)
        way = base.step(now, told)
        if now >= due:
            due += PERIOD
            reports.append((now + base.late + chance.uniform(0.0, base.jitter), way))
    return None


@settings(deadline=None, max_examples=15)
@given(
    st.integers(0, 1000),
    st.builds(
        Base,
        late=st.floats(0.0, 0.04),
        dead_time=st.floats(0.01, 0.05),
        slowness=st.floats(0.0, 0.1),
        gain=st.floats(0.6, 1.1),
        stiction=st.floats(0.0, 0.06),
        jitter=st.floats(0.0, 0.04),
    ),
)
def test_motors_that_are_slow_weak_or_stuck_at_low_speeds_are_not_late(seed, base) -> None:
    assert found(base, seed) is None


@settings(deadline=None, max_examples=15)
@given(
    st.integers(0, 1000),
    st.builds(
        Base,
        late=st.floats(0.3, 0.8),
        slowness=st.floats(0.0, 0.05),
        gain=st.floats(0.8, 1.1),
    ),
)
def test_reports_that_are_late_but_steady_are_found_and_the_lag_is_told(seed, base) -> None:
    seen = found(base, seed)
    assert seen is not None
    assert seen > MOST_LAG
    assert seen == pytest.approx(base.late + base.dead_time + base.slowness, abs=0.15)


def test_wheels_that_are_blocked_are_not_called_late() -> None:
    assert found(Base(gain=0.0)) is None


def test_at_a_constant_speed_nothing_shows_and_nothing_is_claimed() -> None:
    lag, way = Lag(HALF_TRACK), 0.0
    for number in range(1000):
        now = number * TURN
        lag.tell(now, Twist(0.3))
        way += 0.3 * TURN
        assert lag.hear(now, Way(way, 0.0)) is None


def test_a_way_that_is_no_number_is_left_out() -> None:
    lag = Lag(HALF_TRACK)
    for number in range(50):
        lag.tell(number * TURN, Twist(0.3))
        assert lag.hear(number * TURN, Way(float("nan"), 0.0)) is None
