"""What an asynchronous call returns: a result that can be awaited, waited for, or called back."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Generator
from concurrent.futures import Future, InvalidStateError
from typing import Any, Generic, TypeVar

import trio

from hri.core.clock import Clock, FakeClock
from hri.core.errors import HriError

T = TypeVar("T")

_LOOK = 0.05
"""Seconds; how often a waiting thread looks whether the robot loop still runs."""


class Interrupted(HriError):
    """The call did not run to its end: it was cancelled, or another one took its place."""


class Pending(Generic[T]):
    """The result of a call that goes on; every method may be used from any thread.

    The caller looks, waits or is called back. Who does the work says `complete` or `fail`; the
    first of these counts, and so does a `cancel` before them.
    """

    def __init__(self, clock: Clock, on_cancel: Callable[[], object] | None = None) -> None:
        """`on_cancel` ends the work itself when the caller cancels."""
        self._clock = clock
        self._on_cancel = on_cancel
        self._future: Future[T] = Future()

    @property
    def is_done(self) -> bool:
        """Whether it has ended, well or not."""
        return self._future.done()

    def result(self) -> T:
        """The result; raises what the work failed with, RuntimeError while it still goes on."""
        if not self.is_done:
            raise RuntimeError("there is no result yet - wait() for it, or await it")
        return self._future.result()

    def wait(self, timeout: float = math.inf) -> T:
        """The result, once it is there; raises what the work failed with.

        For scripts and threads. Where no robot loop runs, or fake time is held, time passes
        meanwhile. Raises TimeoutError after `timeout` seconds, RuntimeError inside of the robot
        loop, which it would block.
        """
        if not self.is_done and trio.lowlevel.in_trio_run():
            raise RuntimeError("waiting would block the robot loop - await it")
        end = self._clock.now() + timeout
        if not self.is_done and self._clock.is_driven:
            self._wait_beside_the_loop(end)
        if not self.is_done and not self._clock.is_driven:
            self._clock.advance_until(lambda: self.is_done, end - self._clock.now())
        if not self.is_done:
            raise TimeoutError(f"no result within {timeout:g} s")
        return self._future.result()

    def __await__(self) -> Generator[Any, Any, T]:
        return self._awaited().__await__()

    def on_done(self, callback: Callable[[Pending[T]], object]) -> None:
        """Call back once when it has ended, at once if it has; from the thread that ended it."""
        self._future.add_done_callback(lambda _: callback(self))

    def cancel(self, reason: str = "it was cancelled - start it again") -> bool:
        """End it with Interrupted; whether it still went on."""
        was_running = self.fail(Interrupted(reason))
        if was_running and self._on_cancel is not None:
            self._on_cancel()
        return was_running

    def complete(self, result: T) -> bool:
        """End it with a result; False when it had ended before."""
        try:
            self._future.set_result(result)
        except InvalidStateError:
            return False
        return True

    def fail(self, error: BaseException) -> bool:
        """End it with an exception; False when it had ended before."""
        try:
            self._future.set_exception(error)
        except InvalidStateError:
            return False
        return True

    def _wait_beside_the_loop(self, end: float) -> None:
        """Wait in another thread than the loop's; held time is held again from the very moment."""
        clock, over, once = self._clock, threading.Event(), threading.Lock()
        held = clock if isinstance(clock, FakeClock) and clock.is_held else None

        def finish(_: object = None) -> None:
            if once.acquire(blocking=False):
                if held is not None:
                    held.hold()
                over.set()

        self._future.add_done_callback(finish)
        if end < math.inf:
            clock.call_at(end, finish)
        if held is not None:
            held.release()
        while not over.wait(_LOOK) and clock.is_driven:
            pass

    async def _awaited(self) -> T:
        token, ended = trio.lowlevel.current_trio_token(), trio.Event()

        def wake(_: object) -> None:
            try:
                token.run_sync_soon(ended.set)
            except trio.RunFinishedError:
                return  # nobody is left to be woken

        self._future.add_done_callback(wake)
        await ended.wait()
        return self._future.result()


def completed(clock: Clock, result: T) -> Pending[T]:
    """A call that had nothing to wait for."""
    pending: Pending[T] = Pending(clock)
    pending.complete(result)
    return pending
