"""Obeys the most important of the recent writers."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hri.core.signals import Twist
from hri.hal.drive import PATIENCE
from hri.hal.manner import FREELY, Manner
from hri.hal.motion import REST
from hri.hal.rank import WRITERS, Rank

TOLERANCE = 1.001
"""A command may exceed what the base can do by so much, which is how numbers are rounded."""


@dataclass(frozen=True, slots=True)
class Command:
    """What a source wants; a twist of None takes back what it said before."""

    source: Rank
    twist: Twist | None
    time: float
    """Seconds, the latest at which the source can have said it."""
    manner: Manner = FREELY


class VelocityArbiter:
    """Keeps the last word of each source, and drops it when it is too old."""

    def __init__(self, fastest: Twist) -> None:
        """`fastest`: what the base can do at all, m/s and rad/s; what asks for more is refused."""
        self._fastest = fastest
        self._heard: dict[Rank, Command] = {}

    def offer(self, command: Command) -> str | None:
        """Take a command; why it was refused, in which case its source counts as silent."""
        self._heard.pop(command.source, None)
        if command.source not in WRITERS:
            return f'"{command.source}" may not command - use one of {", ".join(WRITERS)}'
        if command.twist is None:
            return None
        refusal = self._refusal(command.twist)
        if refusal is not None:
            return f"{command.source}: {refusal}"
        self._heard[command.source] = command
        return None

    def chosen(self, now: float) -> Command | None:
        """The command that counts; None when nobody has one."""
        return next((c for c in map(self._heard.get, WRITERS) if c and _counts(c, now)), None)

    def waiting(self, now: float) -> list[Rank]:
        """All sources whose commands are fresh, the most important first."""
        return [c.source for c in map(self._heard.get, WRITERS) if c and _counts(c, now)]

    def silent(self, now: float) -> Rank | None:
        """The first source that asked for motion and has said nothing more since its timeout."""
        for source in WRITERS:
            command = self._heard.get(source)
            if command and command.twist != REST and not _counts(command, now):
                return source
        return None

    def clear(self) -> None:
        """Forget all commands."""
        self._heard.clear()

    def _refusal(self, twist: Twist) -> str | None:
        for name, value, limit, unit in (
            ("linear", twist.linear, self._fastest.linear, "m/s"),
            ("angular", twist.angular, self._fastest.angular, "rad/s"),
        ):
            if not math.isfinite(value):
                return f"the {name} velocity is {value} - give a finite number of {unit}"
            if abs(value) > limit * TOLERANCE:
                return f"{value:g} {unit} is out of range - the base does {limit:g} {unit} at most"
        return None


def _counts(command: Command, now: float) -> bool:
    # A time that has not come yet belongs to another clock.
    return -0.001 <= now - command.time <= PATIENCE
