"""The emergency stop: once it is closed, only someone who releases it lets the base move."""

from __future__ import annotations

from hri.drive.supervisor.cause import POWER_UP, Cause


class Latch:
    """Closed from the beginning; time and commands never open it, `release` does."""

    def __init__(self, cause: Cause = POWER_UP) -> None:
        self._cause: Cause | None = cause

    @property
    def is_closed(self) -> bool:
        return self._cause is not None

    @property
    def cause(self) -> Cause | None:
        """Why it was closed last; None while it is open."""
        return self._cause

    def trip(self, cause: Cause) -> bool:
        """Close it; whether that, or its cause, is news."""
        is_news, self._cause = cause != self._cause, cause
        return is_news

    def release(self) -> None:
        """Let the base move again. For people; nothing in the supervisor calls this by itself."""
        self._cause = None
