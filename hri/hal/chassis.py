"""What all drives of one physical base have in common: who steers it, and what it is doing."""

from __future__ import annotations

import math
import threading
from dataclasses import dataclass
from typing import TYPE_CHECKING

from hri.core.clock import Timer
from hri.hal.helm import Helm
from hri.hal.motion import Motion, Way
from hri.hal.pending import Pending

if TYPE_CHECKING:
    from hri.hal.drive import DriveSystem


@dataclass(eq=False)
class Run:
    """A motion on its way."""

    motion: Motion
    pending: Pending[None]
    began: float
    due: float
    """When its next command is sent."""
    origin: Way
    """What the wheels had rolled when it began."""
    timer: Timer | None = None


class Chassis:
    """One for a base, however many drives the configuration has on it; use it under its lock."""

    def __init__(self, drive: str) -> None:
        """`drive` is the id of one of them, for messages."""
        self.helm = Helm(drive)
        self.lock = threading.RLock()
        self.driven_by: DriveSystem | None = None
        """The drive that gave the last command."""
        self.run: Run | None = None
        self.until = math.inf
        """When the velocity that was sent last counts no more."""
        self.expiry: Timer | None = None
        self.is_latched = False
        self.because = ""
        """Why it was stopped last."""
        self.said: float | None = None
        """When the last stop was said, in seconds; None where anything else has latched it."""
