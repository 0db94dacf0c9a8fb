"""The interface of a view of a teleoperated base, and the values it shows."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

from hri.core.signals import Pose2D, Twist
from hri.drive.supervisor.link import State


@dataclass(frozen=True, slots=True)
class Snapshot:
    """Everything a view shows of a base at a moment."""

    state: State
    pose: Pose2D
    asked: Twist
    """The velocity that the keys request."""
    share: float
    """Share of the speed limit that the keys request, 0 to 1."""
    time: float


class View(ABC):
    """Gives keys, and shows the base."""

    @abstractmethod
    def read_keys(self) -> Sequence[str]:
        """Keys pressed since the last call, by the names of `keys`."""

    @abstractmethod
    def show(self, moment: Snapshot) -> None:
        """Redraw with a new state of the base."""
