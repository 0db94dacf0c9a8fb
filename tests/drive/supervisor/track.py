"""A supervisor with a base that does as it is told: what the tests of decisions measure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from hri.core.signals import Twist
from hri.drive.bases.protocol import BaseReport, Sensors
from hri.drive.supervisor.base_rules import Rules
from hri.drive.supervisor.decision import Decision
from hri.drive.supervisor.supervisor import Supervisor
from hri.drive.supervisor.velocity_arbiter import Command
from hri.hal.motion import Way
from hri.hal.rank import Rank

STEP = 0.01
PLACES = ("left", "front_left", "front_right", "right")
SENSORS = Sensors(
    bumps=("left", "right"),
    cliffs=PLACES,
    cliff_signals=PLACES,
    wheel_drops=("left", "right"),
    buttons=("clean", "dock"),
)
FLOOR = 1500


class Track:
    """Steps every 10 ms with a fresh report, unless the base is told to be silent."""

    def __init__(self, **rules: Any) -> None:
        given: dict[str, Any] = {"fastest": Twist(0.5, 4.0), "sensors": SENSORS} | rules
        self.supervisor = Supervisor(Rules(**given))
        self.now = 0.0
        self.report = BaseReport(
            0.0,
            Way(),
            Twist(),
            bumps={"left": False, "right": False},
            cliffs=dict.fromkeys(PLACES, False),
            cliff_signals=dict.fromkeys(PLACES, FLOOR),
            wheel_drops={"left": False, "right": False},
            buttons={"clean": False, "dock": False},
            mode="safe",
        )
        self.is_silent = False
        self.follows = True
        """Whether the wheels do as they are told."""
        self.measured: Twist | None = None
        """What the wheels say that they do, where that is not what they do."""
        self.decision = self.supervisor.step(self.now, self.report)
        self.stops: list[str] = []
        """Names of the causes of all stops."""
        self.wakes = 0
        self._grain = 0

    def released(self) -> Track:
        self.supervisor.release(self.now)
        return self

    def feel(self, **changes: Any) -> None:
        """Change what the sensors of the next reports say."""
        self.report = replace(self.report, **changes)

    def step(self, commands: Sequence[Command] = ()) -> Decision:
        self.now += STEP
        if not self.is_silent:
            self._roll()
        self.decision = self.supervisor.step(self.now, self.report, commands)
        if self.decision.stop is not None:
            self.stops.append(self.decision.stop.name)
        self.wakes += self.decision.must_wake
        return self.decision

    def run(
        self, seconds: float, twist: Twist | None = None, source: Rank = Rank.TASKS
    ) -> Decision:
        """Let time pass, with a source that repeats its command."""
        for _ in range(round(seconds / STEP)):
            self.step(() if twist is None else (Command(source, twist, self.now),))
        return self.decision

    def _roll(self) -> None:
        went = self.decision.twist if self.follows else Twist()
        rolled = self.report.rolled
        self._grain = (self._grain + 1) % 7
        self.report = replace(
            self.report,
            time=self.now,
            velocity=went if self.measured is None else self.measured,
            rolled=Way(rolled.linear + went.linear * STEP, rolled.angular + went.angular * STEP),
            # Light flickers; a signal that never does is stuck.
            cliff_signals={
                place: signal + (self._grain if signal == FLOOR else 0)
                for place, signal in self._signals.items()
            },
        )

    @property
    def _signals(self) -> dict[str, int]:
        return {
            place: FLOOR if FLOOR <= signal < FLOOR + 7 else signal
            for place, signal in self.report.cliff_signals.items()
        }
