"""Tasks: what they are called, how they are called, and one run of one.

@task("Examples.Greet")
async def greet(context: TaskContext, name: str = "you") -> int:
    \"\"\"Say hello; how many words that took.\"\"\"
    await speak(context, f"Hello {name}")
    return 2

Inside of a task `await greet(context, "Ann")` runs it as a part of that task. In a plain script
`greet("Ann")` blocks until it is done and returns 2.
"""

from __future__ import annotations

import inspect
import logging
from collections import Counter
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import replace
from enum import Enum
from functools import cached_property, partial, update_wrapper
from typing import TYPE_CHECKING, Any, get_args, get_origin

import trio

from hri.core import registry
from hri.core.errors import HriError, first_of
from hri.core.event_bus import Subscription, matches
from hri.core.signals import Event
from hri.hal.pending import Interrupted
from hri.task.claims import Leave
from hri.task.context import TaskContext
from hri.task.hold_up import CURRENT
from hri.task.queue import EventQueue

if TYPE_CHECKING:
    from hri.task.task_manager import TaskManager

log = logging.getLogger("hri.task")

Job = Callable[..., Awaitable[Any]]
"""A coroutine function that takes a TaskContext and its arguments; every TaskType is one."""


class TaskStatus(Enum):
    """How a task is doing."""

    READY = "ready"
    """Not started yet."""
    RUNNING = "running"
    SUCCESS = "success"
    FAILURE = "failure"
    CANCELLED = "cancelled"


class Task:
    """One run of a job; made by a TaskManager or a Parallel."""

    def __init__(self, manager: TaskManager, job: Job, arguments: tuple[Any, ...]) -> None:
        self.name = name_of(job)
        self.status = TaskStatus.READY
        self.result: Any = None
        """What the job returned; None before, and without success."""
        self.error: Exception | None = None
        """Why it has failed; Interrupted when another task took what it had claimed."""
        self.termination_requested = False
        self.leave = Leave()
        self._manager = manager
        self._job = job
        self._arguments = arguments
        self._scope = trio.CancelScope()
        self._ended = trio.Event()
        self._queue = EventQueue(manager.clock)
        self._enabled: Counter[str] = Counter()
        self._subscription: Subscription | None = None

    def __repr__(self) -> str:
        return f"<Task {self.name} {self.status.value}>"

    @property
    def is_over(self) -> bool:
        return self.status not in (TaskStatus.READY, TaskStatus.RUNNING)

    def cancel(self) -> None:
        """End it at the next point where it waits; from any thread, and more than once."""
        self.termination_requested = True
        if not self.is_over:
            self._manager.call(self._cancel)

    def wait(self) -> Any:
        """Wait until it is over; its status. Raises nothing when it failed: see `error`.

        In a task it is awaited, in a script it blocks.
        """
        return self._manager.await_or_block(self._wait)

    async def run(self, context: TaskContext) -> None:
        """Run the job to its end; called once, by whoever made it.

        A failure is kept in `error`, told to the log and raised as the event `task.failed`.
        """
        try:
            await self.run_through(context)
        except Interrupted as error:
            log.info("%s was interrupted: %s", self.name, error)
        except Exception as error:
            log.error("%s failed: %s", self.name, error, exc_info=_surprise(error))
            self._manager.events.raise_event("task.failed", task=self.name, error=str(error))

    async def run_through(self, context: TaskContext) -> Any:
        """Run the job to its end and give its result; its failure is raised here, too."""
        if self.is_over:
            return None
        self.status, outcome = TaskStatus.RUNNING, TaskStatus.CANCELLED
        outer = CURRENT.set(self.name)
        try:
            with self._scope:
                self.result = await self._job(replace(context, task=self), *self._arguments)
                outcome = TaskStatus.SUCCESS
        except Exception as raised:
            self.error = error = _unwrapped(raised)
            if not isinstance(error, Interrupted):
                outcome = TaskStatus.FAILURE
            elif self._scope.cancel_called:
                return None
            if error is not raised:
                raise error from raised
            raise
        finally:
            CURRENT.reset(outer)
            self._end(outcome)
        return self.result

    async def _wait(self) -> TaskStatus:
        await self._ended.wait()
        return self.status

    def _cancel(self) -> None:
        if self.status is TaskStatus.READY:
            self._end(TaskStatus.CANCELLED)
        self._scope.cancel()

    def _end(self, outcome: TaskStatus) -> None:
        self.status = outcome
        self._enabled.clear()
        self._listen()
        # Through the clock, so that on fake time those who wait wake one after the other.
        self._manager.clock.soon(self._ended.set)

    # --- events ---

    def enable_event(self, pattern: str) -> None:
        """Keep the events that fit from now on, until as many `disable_event` were called."""
        self._enabled[pattern] += 1
        self._listen()

    def disable_event(self, pattern: str) -> None:
        """Take one `enable_event` back; what then nobody wants is forgotten. Raises HriError."""
        if not self._enabled[pattern]:
            raise HriError(f'{self.name}: "{pattern}" is not enabled - call enable_event first')
        self._enabled[pattern] -= 1
        self._enabled += Counter()  # leaves out what counts zero
        self._listen()
        self._queue.keep(*self._enabled)

    async def wait_for_event(self, pattern: str, timeout: float = float("inf")) -> Event | None:
        """The next event that fits, kept or still to come; None after `timeout` seconds.

        What is raised while nobody waits and no `enable_event` asked for is lost.
        """
        self.enable_event(pattern)
        try:
            with self._manager.clock.move_on_after(timeout):
                return await self._queue.get(pattern)
        finally:
            self.disable_event(pattern)
        return None

    def _listen(self) -> None:
        """Listen on the bus as long as anything is enabled."""
        if self._enabled and self._subscription is None:
            self._subscription = self._manager.events.subscribe("*", self._hear)
        elif not self._enabled and self._subscription is not None:
            self._subscription.cancel()
            self._subscription = None

    def _hear(self, event: Event) -> None:
        if any(matches(pattern, event.name) for pattern in self._enabled):
            self._queue.put(event)


class TaskType:
    """A task that can be run by name: `find_task("Hri.Speak")`, or decorated with `@task`."""

    def __init__(
        self, id: str, function: Job, arguments_of: Callable[..., Any] | None = None
    ) -> None:
        """`arguments_of`: takes what `function` takes, where that does not tell it itself."""
        self.id = id
        self.function = function
        self._arguments_of = arguments_of or function
        update_wrapper(self, function)

    def __repr__(self) -> str:
        return f"<TaskType {self.id}{self._signature}>"

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        """With a TaskContext first: what to await. Without, in a script: blocks, and returns.

        Raises HriError for arguments that do not fit, and whatever the task fails with;
        RuntimeError where it would block the robot loop.
        """
        if arguments and isinstance(arguments[0], TaskContext):
            context, *rest = arguments
            return self.function(context, *self.bound(*rest, **named))
        if trio.lowlevel.in_trio_run():
            raise RuntimeError(f"{self.id} inside of a task - await it with the context first")
        from hri.task.script import get_task_manager

        return get_task_manager().run(self, *self.bound(*arguments, **named))

    def bound(self, *arguments: Any, **named: Any) -> tuple[Any, ...]:
        """The arguments in order, numbers and arrays as the task takes them. Raises HriError."""
        try:
            bound = self._signature.bind(*arguments, **named)
        except TypeError as error:
            raise HriError(f"{self.id}: {error} - it takes {self._signature}") from None
        bound.apply_defaults()
        given = dict(bound.arguments)
        for name, value in given.items():
            if name in self._types:
                bound.arguments[name] = self._fitted(name, value)
        if bound.kwargs:
            raise HriError(f"{self.id}: named arguments need names of their own - use positions")
        return bound.args

    def _fitted(self, name: str, value: Any) -> Any:
        wanted, is_number = self._types[name], isinstance(value, (int, float))
        if isinstance(value, (list, tuple)) and wanted is tuple:
            if get_args(self.parameters[name].annotation)[:1] == (str,):
                return tuple(value)  # a list of texts, as the tags of a grammar collect
            try:
                return tuple(float(element) for element in value)
            except (TypeError, ValueError) as error:
                raise HriError(f"{self.id}: {name} is no array - give numbers") from error
        if wanted is float and is_number and not isinstance(value, bool):
            return float(value)
        if wanted is int and isinstance(value, float) and value.is_integer():
            return int(value)  # numbers of grammars and files are floats
        if not isinstance(value, wanted) or (isinstance(value, bool) and wanted is not bool):
            what = f"{name} is {value!r:.60}"
            raise HriError(f"{self.id}: {what} - give {_KINDS[wanted]}")
        return value

    @property
    def parameters(self) -> Mapping[str, inspect.Parameter]:
        """What it takes after the context, by name."""
        return self._signature.parameters

    def with_those_it_takes(self, values: Mapping[str, Any]) -> Job:
        """The task with those of these values that it has a parameter for; others are left out."""
        taken = {name: value for name, value in values.items() if name in self.parameters}
        return partial(self, **taken)

    @cached_property
    def _signature(self) -> inspect.Signature:
        """What it takes after the context."""
        try:
            signature = inspect.signature(self._arguments_of, eval_str=True)
        except NameError:  # an annotation that is imported for type checkers only
            signature = inspect.signature(self._arguments_of)
        return signature.replace(parameters=list(signature.parameters.values())[1:])

    @cached_property
    def _types(self) -> dict[str, type]:
        """By parameter: the types that are checked; others are taken as they come."""
        parameters = self._signature.parameters.values()
        hints = {p.name: get_origin(p.annotation) or p.annotation for p in parameters}
        return {name: hint for name, hint in hints.items() if hint in _KINDS}


_KINDS: dict[Any, str] = {
    float: "a number",
    int: "a whole number",
    str: "a text",
    bool: "True or False",
    tuple: "an array, such as [10, 0, 5]",
}


_declared: dict[str, TaskType] = {}
"""The tasks that modules which are imported by now have declared, by name."""


def task(id: str) -> Callable[[Job], TaskType]:
    """Make a coroutine function that takes a TaskContext first a task of that name."""
    return lambda function: declared(TaskType(id, function))


def declared(type: TaskType) -> TaskType:
    """The task, which `find_task` finds from now on unless a package has one of that name."""
    _declared[type.id] = type
    return type


def find_task(id: str) -> TaskType:
    """The task of that name: "Hri.Speak", or as in 2003 "Evolution.Speak".

    A package declares its tasks as entry points; those of this program are found as well. Raises
    HriError.
    """
    name = registry.canonical(id)
    if name in _declared and name not in registry.known("hri.tasks"):
        return _declared[name]
    found = registry.find("hri.tasks", id)
    return found if isinstance(found, TaskType) else TaskType(registry.canonical(id), found)


def name_of(job: Job) -> str:
    """What a job is called in logs and events."""
    if isinstance(job, TaskType):
        return job.id
    if isinstance(job, partial):
        return name_of(job.func)
    return getattr(job, "__name__", "task")


def _unwrapped(error: Exception) -> Exception:
    """What ended a job; of a nursery in which all were interrupted, the first that was."""
    if isinstance(error, ExceptionGroup):
        interrupted, others = error.split(Interrupted)
        if interrupted is not None and others is None:
            return first_of(interrupted)
    return error


def _surprise(error: Exception) -> Exception | None:
    """The error when the log should show where it came from: our own say all in a line."""
    return None if isinstance(error, HriError) else error
