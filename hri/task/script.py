"""The task manager of plain scripts, made when the first task is called.

use(config="simulated")  # before the first task; else the default configuration
speech.Speak("Hello.")
get_task_manager().shutdown()  # or leave it to the end of the program

Inside of `with Robot() as robot:` tasks run on that robot.
"""

from __future__ import annotations

import atexit
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

import trio

from hri.behavior.behavior import Context
from hri.behavior.doors import Doors
from hri.core.clock import Clock, RealClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.core.quoting import report
from hri.core.signals import Event
from hri.hal.resource_manager import ResourceManager
from hri.hal.speaker import Speaker
from hri.task.blocking_calls import here
from hri.task.context import TaskContext
from hri.task.task import run_scripts_on
from hri.task.task_manager import TaskManager
from hri.task.thread import LoopThread

_lock = threading.RLock()
_current: TaskManager | None = None
_has_robot = False
_make: Callable[[], TaskManager]


class _Stage:
    """Resources, networks and tasks with no app around them."""

    def __init__(self, config: str, clock: Clock, doors: Doors) -> None:
        resources = ResourceManager.load(config, clock)
        self._context = Context(clock, EventBus(clock), resources, doors=doors)
        self._finished = trio.Event()
        self.manager = TaskManager(self._context)
        print_what_nobody_hears(self.manager.context)
        self._thread = LoopThread(clock, "task manager", self._run)

    def start(self) -> None:
        self.manager.thread = self._thread
        self.manager.on_shutdown = self._end
        self._thread.start()
        atexit.register(self.manager.shutdown)

    def _run(self, ready: Callable[[], None]) -> None:
        trio.run(self._live, ready)

    async def _live(self, ready: Callable[[], None]) -> None:
        try:
            async with trio.open_nursery() as nursery:
                nursery.start_soon(self._context.clock.drive)
                nursery.start_soon(self.manager.networks.run)
                self.manager.live_in(nursery)
                ready()
                await self._finished.wait()
                nursery.cancel_scope.cancel()
        finally:
            self.manager.networks.close()
            self._context.resources.close()

    def _end(self) -> None:
        atexit.unregister(self.manager.shutdown)
        leave(self.manager)
        if not self._thread.is_alive:
            return
        self._thread.call(self._finished.set)
        if not self._thread.is_here:
            self._thread.join()


def use(
    config: str = "resource-config", clock: Clock | None = None, doors: Doors | None = None
) -> None:
    """Choose the configuration and the clock of scripts, before their first task.

    `doors` admits more from the network than the configuration does.

    Raises RuntimeError when tasks run already.
    """
    global _make
    with _lock:
        _refuse_second()
        _make = partial(_started, config, clock, doors)


def print_what_nobody_hears(context: TaskContext) -> None:
    """Print what is said while no real speaker plays it; not on fake time, where nobody waits."""

    def show(event: Event) -> None:
        speakers = context.resources.opened(Speaker)
        if not any(speaker.is_hardware for speaker in speakers):
            report(f"said: {event.properties['text']}", flush=True)

    if not context.clock.is_fake:
        context.events.subscribe("speech.said", show)


def get_task_manager() -> TaskManager:
    """The task manager of this process: the running robot's, else one made now.

    In a function that `TaskContext.blocking` runs, that of the task which runs it. Raises HriError
    when the configuration is wrong.
    """
    if (aside := here()) is not None:
        assert isinstance(aside.manager, TaskManager)
        return aside.manager
    with _lock:
        if _current is None:
            if _has_robot:
                what = "a robot runs in this process, and this thread does not belong to it"
                raise HriError(f"{what} - run the function by `await context.blocking(function)`")
            enter(_make())
        assert _current is not None
        return _current


@contextmanager
def robot_lives() -> Iterator[None]:
    """While the body runs, no thread may start a second task manager beside the robot's."""
    global _has_robot
    _has_robot = True
    try:
        yield
    finally:
        _has_robot = False


def enter(manager: TaskManager) -> None:
    """Run the tasks of scripts on this manager, until `leave`. Raises RuntimeError."""
    global _current
    with _lock:
        _refuse_second()
        _current = manager


def leave(manager: TaskManager) -> None:
    """Undo `enter`; a second call does nothing."""
    global _current
    with _lock:
        if _current is manager:
            _current = None


def _started(config: str, clock: Clock | None, doors: Doors | None) -> TaskManager:
    stage = _Stage(config, clock or RealClock(), doors or Doors())
    stage.start()
    return stage.manager


def _refuse_second() -> None:
    if _current is not None:
        raise RuntimeError(
            "a robot or a task manager runs already - leave its `with`, or call"
            " get_task_manager().shutdown() first"
        )


_make = partial(_started, "resource-config", None, None)
run_scripts_on(get_task_manager)
