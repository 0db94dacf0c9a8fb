"""What a view of a base that is driven by hand has to offer, and what it is given to show."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

from hri.core.signals import Pose2D, Twist
from hri.drive.supervisor.link import State


@dataclass(frozen=True, slots=True)
class Snapshot:
    """All that there is to see of a base at a time."""

    state: State
    pose: Pose2D
    asked: Twist
    """What the keys ask for."""
    share: float
    """Part of the allowed speed that the keys ask for, 0 to 1."""
    time: float


class View(ABC):
    """Gives keys, and shows the base."""

    @abstractmethod
    def read_keys(self) -> Sequence[str]:
        """What was pressed since the last call, by the names of `keys`."""

    @abstractmethod
    def show(self, moment: Snapshot) -> None:
        """Show the base instead of what was shown before."""
