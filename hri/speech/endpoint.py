"""Where a voice begins and ends: the interface, samples in, finished pieces of speech out."""

from __future__ import annotations

from typing import Protocol

from hri.core.signals import Samples
from hri.hal.recognizer import Segment


class Endpointer(Protocol):
    """Cuts a stream of sound into pieces of speech; cheap enough for the robot loop."""

    @property
    def is_hearing(self) -> bool:
        """True while a voice is going on."""
        ...

    def listen(self, samples: Samples, end: float) -> list[Segment]:
        """Take the sound up to time `end`, in seconds; the pieces that ended in it."""

    def flush(self) -> list[Segment]:
        """The piece that is still open; the next sound starts anew."""
