"""How often something may happen: a number of times at once, then a number of times a second."""

from __future__ import annotations

import trio


class Rate:
    """A token bucket. Times are seconds of any clock, always of the same one."""

    def __init__(self, burst: float, a_second: float) -> None:
        self._burst, self._a_second = burst, a_second
        self._left, self._since = burst, 0.0

    def take(self, now: float) -> bool:
        """Whether one more may happen now; then it has."""
        self._fill(now)
        if self._left < 1:
            return False
        self._left -= 1
        return True

    async def turn(self) -> None:
        """Wait until one more may happen, in real time."""
        self._fill(trio.current_time())
        self._left -= 1
        if self._left < 0:
            await trio.sleep(-self._left / self._a_second)

    def _fill(self, now: float) -> None:
        self._left = min(self._burst, self._left + (now - self._since) * self._a_second)
        self._since = now
