"""Whom or what the base goes to: how it is seen, and how near it may come."""

from __future__ import annotations

from abc import ABC, abstractmethod

from hri.core.latest import Latest
from hri.core.signals import People, Pose2D
from hri.drive.avoidance import PERSON_RADIUS, Manner
from hri.drive.following import STAND, Following, sight_of
from hri.drive.goal_behaviors import PEOPLE
from hri.task.context import TaskContext


class Target(ABC):
    """Whom or what the base goes to."""

    clearance: float
    """Meters between it and the robot's body at least."""
    remedy: str
    """What to do when it is not seen."""

    @abstractmethod
    def is_seen(self, now: float) -> bool:
        """Whether it is in sight."""

    @abstractmethod
    def look(self, following: Following, now: float, pose: Pose2D) -> float | None:
        """Take in what has been seen since the last look; meters to it, None where nothing has."""


class Someone(Target):
    """A person by their id; without one whoever is attended to."""

    clearance = PERSON_RADIUS + Manner().person_gap
    remedy = STAND

    def __init__(self, context: TaskContext, id: str) -> None:
        self._slot: Latest[People] = context.board.slot(PEOPLE)
        self._id = id

    def is_seen(self, now: float) -> bool:
        return sight_of(self._slot.value, self._id, now) is not None

    def look(self, following: Following, now: float, pose: Pose2D) -> float | None:
        seen = following.look(now, pose, self._slot.value, self._id)
        return None if seen is None else seen.distance
