"""A robot loop in a separate thread, so that scripts that are not async can call into it."""

from __future__ import annotations

import threading
from collections.abc import Awaitable, Callable
from contextlib import suppress
from typing import Any

import trio

from hri.core.clock import Clock, FakeClock

_LOOK = 0.05
"""Seconds; how often a script that waits looks whether the loop still runs."""

Loop = Callable[[Callable[[], None]], object]
"""Runs a trio loop until it is over; calls what it is given once, from inside, when it is ready."""


class LoopThread:
    """Runs a loop beside the script. On a fake clock time passes only inside of `run`."""

    def __init__(self, clock: Clock, name: str, loop: Loop) -> None:
        self._clock = clock
        self._name = name
        self._loop = loop
        self._is_ready = threading.Event()
        self._token: trio.lowlevel.TrioToken | None = None
        self._thread = threading.Thread(target=self._run_loop, name=name, daemon=True)
        self.failure: BaseException | None = None
        """What the loop ended with, if it ended badly."""

    def start(self) -> None:
        """Start the loop and wait until it is ready; raises what it fails with."""
        if isinstance(self._clock, FakeClock):
            self._clock.hold()
        self._thread.start()
        self._is_ready.wait()
        if self.failure is not None:
            self.join()
            raise self.failure

    def join(self) -> None:
        """Wait until the loop has ended; the caller has asked it to."""
        self._thread.join()
        if isinstance(self._clock, FakeClock):
            self._clock.release()

    @property
    def is_alive(self) -> bool:
        return self._thread.is_alive()

    @property
    def is_here(self) -> bool:
        """Whether the caller runs inside of the loop."""
        if not trio.lowlevel.in_trio_run():
            return False
        return trio.lowlevel.current_trio_token() is self._token

    def call(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """Call a function inside of the loop. Raises RuntimeError when the loop is over."""
        if self.is_here:
            return function(*arguments)
        try:
            return trio.from_thread.run_sync(function, *arguments, trio_token=self._token)
        except trio.RunFinishedError:
            raise self._over() from self.failure

    def run(self, job: Callable[..., Awaitable[Any]], *arguments: Any) -> Any:
        """Run a coroutine function in the loop, block until it is done, and give its result.

        Inside of the loop: what to await. Raises RuntimeError when the loop is over or ends. What
        interrupts the script, such as Ctrl-C, cancels the job and is raised when that has ended.
        """
        if self.is_here:
            return job(*arguments)
        scope, ended = trio.CancelScope(), threading.Event()

        async def run() -> Any:
            try:
                with scope:
                    return await self._held(job, arguments)
            finally:
                ended.set()

        try:
            return trio.from_thread.run(run, trio_token=self._token)
        except BaseException as error:
            if _is_end_of_loop(error):
                raise self._over() from self.failure
            self._cancel(scope, ended)
            raise

    def _cancel(self, scope: trio.CancelScope, ended: threading.Event) -> None:
        """Cancel a job and wait for its end; does nothing when it has ended."""
        assert self._token is not None
        with suppress(trio.RunFinishedError):
            self._token.run_sync_soon(scope.cancel)
        while not ended.wait(_LOOK) and self.is_alive:
            pass

    async def _held(self, job: Callable[..., Awaitable[Any]], arguments: tuple[Any, ...]) -> Any:
        if not isinstance(self._clock, FakeClock):
            return await job(*arguments)
        self._clock.release()
        try:
            return await job(*arguments)
        finally:
            self._clock.hold()

    def _run_loop(self) -> None:
        try:
            self._loop(self._ready)
        except BaseException as error:
            self.failure = error
        finally:
            self._is_ready.set()

    def _ready(self) -> None:
        self._token = trio.lowlevel.current_trio_token()
        self._is_ready.set()

    def _over(self) -> RuntimeError:
        why = f": {self.failure}" if self.failure is not None else ""
        return RuntimeError(f"the {self._name} has ended{why}")


def _is_end_of_loop(error: BaseException) -> bool:
    """Whether a job came to nothing because the loop ended; nurseries of it make groups."""
    if isinstance(error, BaseExceptionGroup):
        return error.split(trio.Cancelled)[1] is None
    return isinstance(error, (trio.RunFinishedError, trio.Cancelled))
