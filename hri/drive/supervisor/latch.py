"""The emergency stop: once it is closed, only someone who releases it lets the base move."""

from __future__ import annotations

from dataclasses import replace

from hri.drive.supervisor.cause import POWER_UP, Cause


class Latch:
    """Closed from the beginning; time and commands never open it, `release` does."""

    def __init__(self, cause: Cause = POWER_UP) -> None:
        self._cause: Cause | None = cause

    @property
    def is_closed(self) -> bool:
        return self._cause is not None

    @property
    def is_firm(self) -> bool:
        """Whether it is closed for anything but stops that a person said."""
        return self._cause is not None and self._cause.said is None

    @property
    def cause(self) -> Cause | None:
        """Why it was closed last; None while it is open.

        It has a time `said` only where only spoken stops closed it since it was open.
        """
        return self._cause

    def trip(self, cause: Cause) -> bool:
        """Close it; whether that, or its cause, is news."""
        if self.is_firm:
            cause = replace(cause, said=None)
        is_news = self._cause is None or cause.words != self._cause.words
        self._cause = cause
        return is_news

    def release(self) -> None:
        """Let the base move again. For people; nothing in the supervisor calls this by itself."""
        self._cause = None
