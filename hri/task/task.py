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
from collections.abc import Callable, Mapping
from functools import cached_property, partial, update_wrapper
from typing import Any, get_args, get_origin

import trio

from hri.core import registry
from hri.core.errors import HriError
from hri.task.context import TaskContext
from hri.task.task_run import Job

_manager_of_script: Callable[[], Any]


def run_scripts_on(manager: Callable[[], Any]) -> None:
    """Say what finds the task manager of a plain script; `hri.task.script` does."""
    global _manager_of_script
    _manager_of_script = manager


class TaskType:
    """A task that can be run by name: `find_task("Hri.Speak")`, or decorated with `@task`."""

    def __init__(
        self, id: str, function: Job, arguments_of: Callable[..., Any] | None = None
    ) -> None:
        """`arguments_of`: a function with the parameters of `function`, if its own do not show
        them.
        """
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
        return _manager_of_script().run(self, *self.bound(*arguments, **named))

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
            raise HriError(f"{self.id}: two arguments have the same name - use positions")
        return bound.args

    def _fitted(self, name: str, value: Any) -> Any:
        wanted, is_number = self._types[name], isinstance(value, (int, float))
        if isinstance(value, (list, tuple)) and wanted is tuple:
            if get_args(self.parameters[name].annotation)[:1] == (str,):
                return tuple(value)  # a list of texts, as the tags of a grammar collect
            try:
                return tuple(float(element) for element in value)
            except (TypeError, ValueError) as error:
                raise HriError(f"{self.id}: {name} is not an array - give numbers") from error
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


class ImmediateTask(TaskType):
    """A task that is over in one step: its result is there when it has been started."""

    def __init__(self, id: str, function: Callable[..., Any]) -> None:
        async def awaited(context: TaskContext, *arguments: Any) -> Any:
            return function(context, *arguments)

        super().__init__(id, awaited, function)
        update_wrapper(self, function)
        self._step = function

    def at_once(self, context: TaskContext, values: Mapping[str, Any]) -> Any:
        """Do it with those of these values that it has a parameter for; what it returns.

        Raises HriError for values that do not fit.
        """
        taken = {name: value for name, value in values.items() if name in self.parameters}
        return self._step(context, *self.bound(**taken))


def immediate(function: Callable[..., Any]) -> ImmediateTask:
    """Make a plain function that takes a TaskContext first a task of its name, over in one step."""
    return ImmediateTask(function.__name__, function)


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
