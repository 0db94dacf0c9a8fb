"""Where `now` comes from.

Nothing else reads the wall clock. All waiting goes through one heap of timers, so that real and
fake time run the same code: the real clock sleeps until the next timer is due, the fake clock
jumps there. On the fake clock everything that wakes does so one at a time, in the order it was
asked, and only when all that woke before has settled; that is what makes two runs equal.
"""

from __future__ import annotations

import heapq
import itertools
import math
import sys
import threading
import time
import uuid
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Generic, TypeVar

import trio

from hri.core.realtime import join_realtime
from hri.core.service import InlineService, ProcessService, Service

T = TypeVar("T")
Q = TypeVar("Q")
A = TypeVar("A")

NAP = 0.005
"""Seconds; how often a program without a robot loop looks whether what it waits for is there."""
POLL = 0.001
"""Seconds; the step in which the system counts the time that a program waits for anything."""
SWITCH_INTERVAL = 0.0005
"""Seconds that a busy thread may keep the robot loop waiting; Python's own is 5 ms."""
CLUTTER = 100
"""Timers that may wait before those that were cancelled are cleared away."""
FAKE_MORNING = datetime(2003, 6, 18, 10, 0)
"""What a fake clock shows when it starts."""


@dataclass(frozen=True, slots=True)
class Uptime:
    """Seconds that go on whatever the wall clock is set to, also while the machine sleeps."""

    seconds: float
    boot: str
    """The start of the machine from which they count; only those of one start compare."""


@dataclass(order=True, slots=True)
class Timer:
    """A call that is due at a time; equal times run in the order they were asked for."""

    time: float
    order: int
    callback: Callable[[], object] = field(compare=False)
    is_cancelled: bool = field(default=False, compare=False)

    def cancel(self) -> None:
        self.is_cancelled = True


class Worker(ABC, Generic[T]):
    """Runs one job at a time off the robot loop, so that `compute` never blocks."""

    def __init__(self) -> None:
        self.is_busy = False

    @abstractmethod
    def submit(self, job: Callable[[], T]) -> None:
        """Start a job. Raises RuntimeError while another one runs (see `is_busy`)."""

    @abstractmethod
    def poll(self) -> list[T]:
        """The result of the job if it has finished since the last call, else nothing.

        An exception of the job is raised here.
        """

    @abstractmethod
    def close(self) -> None:
        """Wait for the running job and end the worker; a second call does nothing."""

    def _claim(self) -> None:
        if self.is_busy:
            raise RuntimeError("this worker is busy - poll() it before you submit() again")
        self.is_busy = True


class Clock(ABC):
    """Seconds as a float, ways to wait for them, and workers whose results take time."""

    is_fake = False

    def __init__(self) -> None:
        self._timers: list[Timer] = []
        self._room = CLUTTER
        self._lock = threading.Lock()
        self._order = itertools.count()
        self._changed = trio.Event()
        self.is_driven = False
        """True while a robot loop runs the timers."""
        self._driver = 0
        self._token: trio.lowlevel.TrioToken | None = None

    @abstractmethod
    def now(self) -> float:
        """Seconds since the clock was made; never goes back."""

    @abstractmethod
    def wall(self) -> datetime:
        """Date and time of day on the wall clock. For words, and for how long the robot was
        switched off; never for arithmetic within a run.
        """

    @abstractmethod
    def uptime(self) -> Uptime:
        """For arithmetic on what is kept from one run to the next."""

    async def drive(self) -> None:
        """Run the timers, for ever; started once, in the nursery of the robot loop."""
        self._driver, self._token = threading.get_ident(), trio.lowlevel.current_trio_token()
        self.is_driven = True
        try:
            await self._drive()
        finally:
            self.is_driven = False
            self._token = None

    @abstractmethod
    async def _drive(self) -> None:
        """Run the timers, for ever."""

    @abstractmethod
    def advance_until(self, is_over: Callable[[], bool], timeout: float = math.inf) -> bool:
        """Let time pass, running the timers, until something holds or `timeout` seconds are over.

        For programs without a robot loop. Returns whether it holds. Raises RuntimeError where a
        robot loop runs real time, or nothing is left that could happen in fake time.
        """

    def advance(self, seconds: float) -> None:
        """Let some seconds pass, running the timers; for programs without a robot loop."""
        self.advance_until(lambda: False, seconds)

    @abstractmethod
    def worker(self, latency: float) -> Worker[T]:
        """A worker. On the fake clock a result shows up `latency` seconds after its job began."""

    @abstractmethod
    def service(self, factory: Callable[[], Callable[[Q], A]], latency: float) -> Service[Q, A]:
        """The object made by `factory()`, in a separate process, which answers one question at a
        time.

        For work that needs a memory and much time, such as following people through pictures. The
        factory must be a function or class of a module (or a `partial` of one), and questions and
        answers must pickle. On the fake clock it answers within this process, each time `latency`
        seconds after it was asked.
        """

    def call_at(self, when: float, callback: Callable[[], object]) -> Timer:
        """Call back at a time, from the robot loop; a time that has passed means now.

        May be used from any thread.
        """
        if not math.isfinite(when):
            raise ValueError(f"a timer needs a finite time, not {when}")
        timer = Timer(max(when, self.now()), next(self._order), callback)
        self._push(timer)
        self._wake()
        return timer

    def soon(self, callback: Callable[[], object]) -> Timer:
        """Call back at once, but after whatever runs now has settled."""
        return self.call_at(self.now(), callback)

    async def sleep_until(self, when: float) -> None:
        """Wait for a time; one that has passed is over after a breath."""
        due = trio.Event()
        timer = self.call_at(when, due.set)
        try:
            await due.wait()
        finally:
            timer.cancel()

    async def sleep(self, seconds: float) -> None:
        """Wait."""
        await self.sleep_until(self.now() + seconds)

    @contextmanager
    def move_on_after(self, seconds: float) -> Iterator[trio.CancelScope]:
        """Cancel the body when it takes longer; see `scope.cancelled_caught`. inf: no limit."""
        with trio.CancelScope() as scope:
            timer = None
            if seconds != math.inf:
                timer = self.call_at(self.now() + seconds, scope.cancel)
            try:
                yield scope
            finally:
                if timer is not None:
                    timer.cancel()

    def _push(self, timer: Timer) -> None:
        with self._lock:
            if len(self._timers) >= self._room:
                self._clear_away()
            heapq.heappush(self._timers, timer)

    def _clear_away(self) -> None:
        """Drop cancelled timers, which otherwise stay until they are due.

        Not again before there are twice as many as are left, so that it costs next to nothing.
        """
        self._timers = [timer for timer in self._timers if not timer.is_cancelled]
        heapq.heapify(self._timers)
        self._room = max(CLUTTER, 2 * len(self._timers))

    def _pop_timer(self) -> Timer | None:
        """Take the earliest timer that still counts off the heap."""
        with self._lock:
            while self._timers:
                timer = heapq.heappop(self._timers)
                if not timer.is_cancelled:
                    return timer
        return None

    def _wake(self) -> None:
        """Let the robot loop look at its timers again."""
        token = self._token
        if token is None or threading.get_ident() == self._driver:
            self._changed.set()
            return
        try:
            token.run_sync_soon(lambda: self._changed.set())
        except trio.RunFinishedError:
            return  # the loop has ended meanwhile


def since_1970(clock: Clock) -> float:
    """Seconds since 1970, for people and other programs, as `Clock.wall` has them."""
    return stamp_of(clock, clock.wall())


def stamp_of(clock: Clock, wall: datetime) -> float:
    """Seconds since 1970 at a time of the wall clock."""
    # What a fake clock shows is the same everywhere on earth.
    return (wall.replace(tzinfo=UTC) if clock.is_fake else wall).timestamp()


def wall_of(clock: Clock, stamp: float) -> datetime:
    """What the wall clock shows at a time in seconds since 1970."""
    return datetime.fromtimestamp(stamp, UTC if clock.is_fake else None).replace(tzinfo=None)


def _boot_id() -> str:
    """The id of this start of the machine; where the system has none, of this clock."""
    with suppress(OSError):
        return Path("/proc/sys/kernel/random/boot_id").read_text("ascii").strip()
    return uuid.uuid4().hex


class RealClock(Clock):
    """Monotonic seconds of this machine, from 0 when the clock is made."""

    def __init__(self, source: Callable[[], float] = time.perf_counter) -> None:
        """`source` gives monotonic seconds; tests put trio's own clock in its place."""
        super().__init__()
        self._source = source
        self._origin = source()
        self._boot = _boot_id()
        # Only the time that passes by itself can be slept through.
        self._is_exact = source is time.perf_counter

    def now(self) -> float:
        return self._source() - self._origin

    def wall(self) -> datetime:
        return datetime.now()  # noqa: TID251 - this is the clock

    def uptime(self) -> Uptime:
        if hasattr(time, "CLOCK_BOOTTIME"):
            return Uptime(time.clock_gettime(time.CLOCK_BOOTTIME), self._boot)
        return Uptime(time.monotonic(), self._boot)  # noqa: TID251 - this is the clock

    def worker(self, latency: float) -> Worker[T]:
        return _ThreadWorker()

    def service(self, factory: Callable[[], Callable[[Q], A]], latency: float) -> Service[Q, A]:
        return ProcessService(factory, self.now)

    def advance_until(self, is_over: Callable[[], bool], timeout: float = math.inf) -> bool:
        if self.is_driven:
            raise RuntimeError("a robot loop runs this clock - await, instead of waiting")
        end = self.now() + timeout
        while not is_over():
            timer = self._pop_timer()
            # Short naps, since what is waited for may happen in a thread of a device.
            wait = min(end, self.now() + NAP, math.inf if timer is None else timer.time)
            if timer is not None and timer.time <= self.now():
                timer.callback()
                continue
            if timer is not None:
                self._push(timer)
            if self.now() >= end:
                return False
            time.sleep(max(0.0, wait - self.now()))  # noqa: TID251 - this is the clock
        return True

    async def _drive(self) -> None:
        before = sys.getswitchinterval()
        sys.setswitchinterval(min(before, SWITCH_INTERVAL))
        try:
            await self._run_timers()
        finally:
            sys.setswitchinterval(before)

    async def _run_timers(self) -> None:
        while True:
            self._changed = trio.Event()
            timer = self._pop_timer()
            if timer is None:
                await self._changed.wait()
                continue
            wait = timer.time - self.now()
            if wait <= 0:
                timer.callback()
                await trio.lowlevel.checkpoint()
                continue
            self._push(timer)
            if not self._is_exact:
                with trio.move_on_after(wait):
                    await self._changed.wait()
            elif wait > POLL:
                # epoll counts in milliseconds, rounded up: it may come back that much later.
                with trio.move_on_after(wait - POLL):
                    await self._changed.wait()
            else:
                await trio.lowlevel.checkpoint()
                # Holds the loop for less than a millisecond, but ends on time.
                time.sleep(max(0.0, timer.time - self.now()))  # noqa: ASYNC251, TID251


class FakeClock(Clock):
    """Time that jumps to the next timer as soon as all tasks wait; starts at 0.

    An hour passes in seconds. Jobs of workers run at once, while time stands still, and their
    results show up after their modeled latency: no measured time can enter what happens.
    """

    is_fake = True

    def __init__(self) -> None:
        super().__init__()
        self._now, self._boot = 0.0, uuid.uuid4().hex
        self._holds = 0

    def now(self) -> float:
        return self._now

    def wall(self) -> datetime:
        return FAKE_MORNING + timedelta(seconds=self._now)

    def uptime(self) -> Uptime:
        return Uptime(self._now, self._boot)

    def worker(self, latency: float) -> Worker[T]:
        return _InlineWorker(self, latency)

    def service(self, factory: Callable[[], Callable[[Q], A]], latency: float) -> Service[Q, A]:
        worker: _InlineWorker[A] = _InlineWorker(self, latency)
        return InlineService(factory, worker.submit, worker.poll)

    def advance_until(self, is_over: Callable[[], bool], timeout: float = math.inf) -> bool:
        # Not refused inside a robot loop: so a test lets a tick take its time.
        end = self._now + timeout
        while not is_over():
            timer = self._pop_timer()
            if timer is None and end == math.inf:
                raise RuntimeError("nothing is left that could happen - give a timeout")
            if timer is None or timer.time > end:
                if timer is not None:
                    self._push(timer)
                self._now = end
                return False
            self._now = timer.time
            timer.callback()
        return True

    @property
    def is_held(self) -> bool:
        """Whether time stands still."""
        return self._holds > 0

    def hold(self) -> None:
        """Let time stand still until `release`; calls count."""
        self._holds += 1

    def release(self) -> None:
        self._holds -= 1
        self._wake()

    async def _drive(self) -> None:
        # Imported here, since it is slow to import and real time never needs it.
        from trio.testing import wait_all_tasks_blocked

        while True:
            await wait_all_tasks_blocked()
            self._changed = trio.Event()
            timer = None if self._holds > 0 else self._pop_timer()
            if timer is None:
                await self._changed.wait()
                continue
            self._now = timer.time
            timer.callback()


class _ThreadWorker(Worker[T]):
    def __init__(self) -> None:
        super().__init__()
        self._pool = ThreadPoolExecutor(1, initializer=join_realtime)
        self._future: Future[T] | None = None

    def submit(self, job: Callable[[], T]) -> None:
        self._claim()
        self._future = self._pool.submit(job)

    def poll(self) -> list[T]:
        if self._future is None or not self._future.done():
            return []
        future, self._future = self._future, None
        self.is_busy = False
        return [future.result()]

    def close(self) -> None:
        self._pool.shutdown(wait=True, cancel_futures=True)


class _InlineWorker(Worker[T]):
    def __init__(self, clock: FakeClock, latency: float) -> None:
        super().__init__()
        self._clock = clock
        self._latency = latency
        self._future: Future[T] = Future()
        self._ready_at = math.inf

    def submit(self, job: Callable[[], T]) -> None:
        self._claim()
        self._future = Future()
        try:
            self._future.set_result(job())
        except Exception as error:
            self._future.set_exception(error)
        self._ready_at = self._clock.now() + self._latency

    def poll(self) -> list[T]:
        if not self.is_busy or self._clock.now() < self._ready_at:
            return []
        self.is_busy = False
        return [self._future.result()]

    def close(self) -> None:
        self.is_busy = False
