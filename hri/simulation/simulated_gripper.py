"""A simulated gripper."""

from __future__ import annotations

from typing import ClassVar

from hri.core.clock import Timer
from hri.hal.gripper import Gripper
from hri.hal.pending import Interrupted, Pending, completed

TRAVEL = 1.0
"""Seconds from closed to open."""
THICKNESS = 0.4
"""How far the fingers stay apart around an object."""


class SimulatedGripper(Gripper):
    """Two fingers that take a second to open; it starts open, with nothing between them."""

    parameters: ClassVar[tuple[str, ...]] = ("address",)

    def _open(self) -> None:
        super()._open()
        self.is_object_there = False
        """Whether someone has put something between the fingers."""
        self._from, self._goal, self._began = 1.0, 1.0, 0.0
        self._pending: Pending[None] = completed(self.manager.clock, None)
        self._timer: Timer | None = None

    def _close(self) -> None:
        self._replace("the gripper was switched off - obtain it again")

    def open(self) -> Pending[None]:
        return self._travel(1.0)

    def close(self) -> Pending[None]:
        return self._travel(THICKNESS if self.is_object_there else 0.0)

    def opening(self, now: float) -> float:
        way = max(0.0, now - self._began) / TRAVEL
        if self._goal > self._from:
            return min(self._goal, self._from + way)
        return max(self._goal, self._from - way)

    def has_object(self, now: float) -> bool:
        return self.is_object_there

    def _travel(self, goal: float) -> Pending[None]:
        clock = self.manager.clock
        with self._lock:
            now = clock.now()
            self._replace("another command took its place - wait for the one before")
            self._from, self._goal, self._began = self.opening(now), goal, now
            pending: Pending[None] = Pending(clock)
            self._pending = pending
            end = now + abs(goal - self._from) * TRAVEL
            self._timer = clock.call_at(end, lambda: pending.complete(None))
        return pending

    def _replace(self, reason: str) -> None:
        if self._timer is not None:
            self._timer.cancel()
        self._pending.fail(Interrupted(f"{self.id}: {reason}"))
