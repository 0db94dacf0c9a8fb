"""The drive as a behavior: it takes velocities from any source that may steer the base."""

from __future__ import annotations

import logging
import math
from dataclasses import replace
from typing import Any

from hri.behavior.behavior import Context
from hri.behavior.device import DeviceBehavior
from hri.behavior.effects import Effect
from hri.behavior.ports import ANGULAR_VELOCITY, LINEAR_VELOCITY, Input, InputPort, Param
from hri.core.clock import Timer
from hri.core.errors import HriError
from hri.core.quoting import quoted
from hri.core.signals import Event, Twist
from hri.hal.drive import PATIENCE, DriveSystem
from hri.hal.rank import WRITERS, Outranked, Rank, Writer

log = logging.getLogger("hri.behavior")

STEERING_RANKS = tuple(rank.value for rank in WRITERS)


class DriveCommand(DeviceBehavior):
    """Passes velocities on to the drive, and stops it when they end.

    A velocity that rests on the word of someone outside, such as a peer over the network, counts
    for `PATIENCE` seconds after that word. While nothing comes in it leaves the drive alone, so
    that someone else may use it. Several that write one drive need different ranks; while one of
    a higher rank steers, the others wait, and raise `drive.refused` (`words`) once. With the rank
    "teleop", a velocity of 0 counts as nothing: it is that of a stick at rest. While any network is
    paused, whatever that one would have said, it keeps the drive at rest.
    """

    may_do = frozenset({Effect.MOVES})
    drive_id = Param("drive", "id of the drive system")
    rank = Param(
        "behaviors", "what its commands are worth, where no task gave them", among=STEERING_RANKS
    )
    velocity = Input[Twist]("twist", "what to drive with; goes before the other two")
    linear_velocity = Input[float]("double", "cm/s, 0 when only the other comes", LINEAR_VELOCITY)
    angular_velocity = Input[float](
        "double", "rad/s to the left, 0 when only the other comes", ANGULAR_VELOCITY
    )

    def start(self, context: Context) -> None:
        super().start(context)
        self._drive = self.obtain(self.drive_id, DriveSystem)
        self._writer = Writer(self, f'the behavior "{self.id}"', Rank(self.rank))
        try:
            self._drive.claim(self._writer)
        except HriError:
            self._give_back()
            raise
        self._clock, self._events, self._paused = context.clock, context.events, context.paused
        self._is_driving = self._is_waiting = self._must_let_go = False
        self._repetition: Timer | None = None
        self._subscription = context.events.subscribe("drive.halt", self._halt)

    @property
    def steers(self) -> tuple[str, str]:
        return self.drive_id, self.rank

    def compute(self, now: float, dt: float) -> None:
        self._end_repetition()
        velocity, until = (None, math.inf) if self._paused else self._asked()
        if self._must_let_go:
            self._must_let_go = velocity not in (None, Twist()) and now <= until
            velocity = None
        if velocity is not None and now <= until:
            self._steer(velocity, now, until)
            self._repeat(velocity, now, until, now + dt)
        elif self._is_driving:
            if velocity is not None:
                log.warning("%s stops: whoever steers it from outside fell silent", self.drive_id)
            self._drive.let_go(self._writer, now)
            self._is_driving = False

    def stop(self) -> None:
        self._end_repetition()
        self._subscription.cancel()
        self._drive.leave(self._writer, self._clock.now())
        super().stop()

    def _halt(self, event: Event) -> None:
        self._end_repetition()
        self._drive.stop(self._clock.now())
        self._must_let_go = True
        if self._is_driving:
            reason = quoted(str(event.properties.get("because", "I was told to")))
            what = "%s stops: %s - who steers is heard again after a velocity of 0"
            log.warning(what, self.drive_id, reason)

    def _steer(self, velocity: Twist, now: float, until: float) -> None:
        rank = Rank(self.velocity.rank or self.rank)
        try:
            writer = replace(self._writer, rank=rank)
            self._drive.set_velocity(velocity, now, until, writer, self.velocity.manner)
        except Outranked as error:
            if not self._is_waiting:
                log.warning("%s", error)
                self._events.raise_event("drive.refused", words=str(error))
                self._is_waiting = True
            self._is_driving = False
        else:
            self._is_driving, self._is_waiting = rank is not Rank.NOBODY, False

    def _repeat(self, velocity: Twist, now: float, until: float, end: float) -> None:
        """Say it again until the next tick of a slow network: a word counts for PATIENCE alone."""
        due = now + PATIENCE / 2

        def again() -> None:
            self._steer(velocity, due, until)
            self._repeat(velocity, due, until, end)

        if self._is_driving and due < min(end, until):
            self._repetition = self._clock.call_at(due, again)

    def _end_repetition(self) -> None:
        if self._repetition is not None:
            self._repetition.cancel()
            self._repetition = None

    def _asked(self) -> tuple[Twist | None, float]:
        """The velocity and until when it counts."""
        velocity, until = self._wish()
        if velocity == Twist() and self.rank == Rank.TELEOP:
            velocity = None
        return velocity, until

    def _wish(self) -> tuple[Twist | None, float]:
        if (velocity := self.velocity.value) is not None:
            return velocity, counts_until(self.velocity)
        linear, angular = self.linear_velocity.value, self.angular_velocity.value
        if linear is None and angular is None:
            return None, math.inf
        until = min(counts_until(self.linear_velocity), counts_until(self.angular_velocity))
        return Twist((linear or 0.0) / 100, angular or 0.0), until


def counts_until(port: InputPort[Any]) -> float:
    """Until when what a port carries may move the base; infinity for what no outsider said."""
    return math.inf if port.spoken is None else port.spoken + PATIENCE
