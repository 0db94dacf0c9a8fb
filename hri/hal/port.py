"""The interface of a line to a device: bytes out, bytes in."""

from __future__ import annotations

from abc import ABC, abstractmethod

CHUNK = 4096
"""Bytes that are read at once at most; the kernel keeps no more of a port."""


class Port(ABC):
    """A line to a device: bytes out, bytes in, as they are ready."""

    @property
    @abstractmethod
    def is_open(self) -> bool:
        """Whether it can be read and written."""

    @abstractmethod
    def open(self, now: float) -> bool:
        """Open it, when it is time for another attempt; whether it is open now.

        `reason` says why it is not. Opening an open port does nothing.
        """

    @property
    @abstractmethod
    def reason(self) -> str:
        """Why it is closed: problem - remedy; empty while nothing is wrong."""

    @abstractmethod
    def read(self, now: float) -> bytes:
        """What has come since the last call, perhaps nothing; at most CHUNK bytes.

        Raises NotAvailable, and is closed, when the device has gone.
        """

    @abstractmethod
    def write(self, data: bytes, now: float) -> bool:
        """Send these bytes; false when the line is full and some, or all, did not fit.

        What did not fit is forgotten: after false, begin with what ends half a command, such as
        the emergency stop of a base. Raises NotAvailable, and is closed, when the device has gone.
        """

    def discard(self) -> None:  # noqa: B027 - many keep nothing
        """Forget what was written and is not on the line yet, such as old velocities."""

    def set_rts(self, is_on: bool) -> None:  # noqa: B027 - many have no such wire
        """Assert the wire "request to send", as it is from the opening on, or let it go."""

    @abstractmethod
    def close(self) -> None:
        """Let it go; a second call does nothing."""
