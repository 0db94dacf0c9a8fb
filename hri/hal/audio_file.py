"""The interfaces to play a sound file and to record one."""

from __future__ import annotations

from abc import abstractmethod
from pathlib import Path

from hri.hal.pending import Pending
from hri.hal.resource import Resource

LONGEST_RECORDING = 3600.0
"""Seconds; a recording ends by itself then, so that a forgotten one cannot fill the disk."""


class AudioFilePlayer(Resource):
    """Plays one file at a time."""

    @abstractmethod
    def play(self, path: str | Path) -> Pending[None]:
        """Start a file, instead of one that still plays; done when it was heard to its end.

        It fails with HriError when the file cannot be read, with Interrupted when it is stopped.
        """

    @abstractmethod
    def position(self, now: float) -> float | None:
        """Seconds of the file that have been heard; None when nothing plays."""

    @abstractmethod
    def stop(self) -> None:
        """Silence within one block."""


class AudioFileRecorder(Resource):
    """Records into one file at a time."""

    @abstractmethod
    def record(self, path: str | Path, seconds: float = LONGEST_RECORDING) -> Pending[float]:
        """Record again; done after `seconds` or at `stop`, with the seconds that were recorded.

        Raises HriError when the file cannot be written, ValueError for a length that is not above
        0 and at most an hour.
        """

    @abstractmethod
    def stop(self) -> None:
        """End the recording; its file is complete when this returns."""
