"""Requests of the system to end: Ctrl-C, `kill`, a closed terminal. A program started with `nohup`
outlives its terminal.
"""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from queue import Empty, SimpleQueue
from types import FrameType

import trio

_HANGUP = (signal.SIGHUP,) if hasattr(signal, "SIGHUP") else ()
ASKING = (signal.SIGINT, signal.SIGTERM, *_HANGUP)
"""Signals that ask a program to end; Windows has no SIGHUP."""
_AT_ONCE = (signal.SIGTERM, *_HANGUP)
"""Signals that would end a program that has no handler yet; Ctrl-C raises an exception instead."""


class Ending:
    """Remembers a request to end during startup."""

    def __init__(self) -> None:
        self.is_asked = False
        self._asked: SimpleQueue[int] = SimpleQueue()  # unlike an Event, for signal handlers, too

    def pause(self, seconds: float) -> None:
        """Wait, but not longer than until the program is asked to end."""
        with suppress(Empty):
            self._asked.get(timeout=seconds)

    @contextmanager
    def kept_for_later(self) -> Iterator[None]:
        """While the block runs, a request to end is remembered and does not end the program."""
        before = {number: signal.signal(number, self._ask) for number in _heeded(_AT_ONCE)}
        try:
            yield
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)

    def _ask(self, number: int, frame: FrameType | None) -> None:
        self.is_asked = True
        self._asked.put(number)

    async def wait(self, end: Callable[[], object]) -> None:
        """Call `end` each time the program is asked to end, also if it was before."""
        with trio.open_signal_receiver(*_heeded(ASKING)) as signals:
            if self.is_asked:
                end()
            async for _ in signals:
                end()


def _heeded(numbers: tuple[signal.Signals, ...]) -> list[signal.Signals]:
    def is_ignored(number: signal.Signals) -> bool:
        return number in _HANGUP and signal.getsignal(number) is signal.SIG_IGN  # by `nohup`

    return [number for number in numbers if not is_ignored(number)]
