"""Primitives: tasks that are a network, with a little code around it.

@primitive("Examples.Counter")
class Counter(Primitive):
    \"\"\"Counts up to a limit.\"\"\"

    def start(self) -> None:
        self.on_value("counter", "count", self.look)

    def look(self, count: float, now: float) -> None:
        if count >= 10:
            self.set_status(TaskStatus.SUCCESS, count)

`Counter` is now a task like any other. Its network is `primitive/Examples/Counter.xml`, in the
first search folder that has it; it runs from `start` to `finish`. When someone else stops or swaps
the network, the task ends with Interrupted.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, ClassVar

import trio

from hri.behavior.behavior import Behavior
from hri.behavior.network import Network
from hri.behavior.network_file import load_network
from hri.behavior.runner import Runner
from hri.core import paths
from hri.core.errors import HriError
from hri.hal.pending import Interrupted
from hri.task.context import TaskContext
from hri.task.task import TaskType, declared
from hri.task.task_run import TaskStatus


class Primitive:
    """Base of primitives; subclasses fill in `start`, `compute` and `finish` as they need."""

    id: ClassVar[str] = ""
    """Names the network."""

    def __init__(self, context: TaskContext) -> None:
        self.context = context
        self.network: Network
        self._runner: Runner
        self._result: Any = None
        self._error: Exception | None = None
        self._ended = trio.Event()

    def start(self) -> None:
        """Called once, before the network first ticks."""

    def compute(self) -> None:
        """Called at every tick of the network, after all its behaviors."""

    def finish(self) -> None:
        """Called once at the end, also when the task was cancelled or has failed."""

    def inject(self, behavior: str, input: str, value: Any) -> None:
        """Send a value to an input of the network, once, at the next tick. Raises HriError."""
        self._runner.inject(behavior, input, value)

    def on_value(
        self, behavior: str, output: str, callback: Callable[[Any, float], object]
    ) -> None:
        """Call `callback(value, now)` after each tick in which an output sent something.

        An exception of the callback fails the task. Raises HriError.
        """

        def guarded(value: Any, now: float) -> None:
            self._guard(callback, value, now)

        self._runner.watch(behavior, output, guarded)

    def set_status(self, status: TaskStatus, result: Any = None) -> None:
        """End the task: SUCCESS with a result, or FAILURE with the reason as a text."""
        if status is TaskStatus.FAILURE:
            self._guard(self.context.fail, str(result or f"{self.id} failed"))
        elif status is TaskStatus.SUCCESS:
            self._result = result
            self._end()
        else:
            raise ValueError(f"a primitive cannot end as {status.name} - SUCCESS or FAILURE")

    async def run(self) -> Any:
        """Run the network until `set_status`; the result."""
        self.network = load_network(network_path(self.id))
        self.network.name = self._free_name()
        self.network.add(_Cycle("primitive", self))
        self._runner = self.context.networks.start(self.network)
        try:
            self.start()
            await self._ended.wait()
        finally:
            try:
                self._stop()
            finally:
                self.finish()
        if self._error is not None:
            raise self._error
        return self._result

    def _stop(self) -> None:
        """Stop the network, unless someone else has."""
        networks, name = self.context.networks, self.network.name
        if networks.runners.get(name) is self._runner:
            networks.stop(name)

    def _lose_network(self) -> None:
        """End the task, unless that is why its network ends."""
        if not self._ended.is_set():
            reason = f"the network of {self.id} was stopped or swapped - cancel the task instead"
            self._error = self._error or Interrupted(reason)
            self._end()

    def _free_name(self) -> str:
        """A unique name for each run, so that two may run at once."""
        name, count = self.id, 1
        while name in self.context.networks.runners:
            count += 1
            name = f"{self.id}.{count}"
        return name

    def _guard(self, function: Callable[..., object], *arguments: Any) -> None:
        """Call something; an exception is how the task ends."""
        try:
            function(*arguments)
        except Exception as error:
            self._error = self._error or error
            self._end()

    def _end(self) -> None:
        self.context.clock.soon(self._ended.set)


class _Cycle(Behavior):
    """Calls a primitive's `compute` after all other behaviors, and reports their stop to it."""

    def __init__(self, id: str, primitive: Primitive) -> None:
        super().__init__(id)
        self._primitive = primitive

    def compute(self, now: float, dt: float) -> None:
        self._primitive._guard(self._primitive.compute)

    def stop(self) -> None:
        self._primitive._lose_network()


def primitive(id: str) -> Callable[[type[Primitive]], TaskType]:
    """Make a Primitive a task of that name; the arguments are those of its constructor."""

    def decorated(cls: type[Primitive]) -> TaskType:
        cls.id = id

        async def run(context: TaskContext, *arguments: Any) -> Any:
            return await cls(context, *arguments).run()

        run.__doc__ = cls.__doc__
        return declared(TaskType(id, run, cls))

    return decorated


def network_path(id: str) -> Path:
    """The file of a primitive's network, in the first search folder that has it.

    Raises HriError that names the folders.
    """
    name = f"primitive/{id.replace('.', '/')}.xml"
    folders = [folder for base in paths.search_folders() for folder in (base / "config", base)]
    for folder in folders:
        if paths.is_file(folder / name):
            return folder / name
    looked = ", ".join(str(folder) for folder in folders)
    raise HriError(f'no "{name}" for the primitive {id} - add it (looked in {looked})')
