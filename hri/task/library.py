"""Tasks by the names they have in a module, taken from the registry on first use.

The code of a task lives with its subsystem, above this layer; a script finds it in a category.
"""

from __future__ import annotations

from collections.abc import Callable

from hri.core.errors import did_you_mean
from hri.task.task import TaskType, find_task


def tasks_by_name(
    module: str, *names: str
) -> tuple[Callable[[str], TaskType], Callable[[], list[str]]]:
    """A module's `__getattr__` that gives the task "Hri.Name" for each name, and its `__dir__`."""

    def lookup(name: str) -> TaskType:
        if name not in names:
            raise AttributeError(f'{module} has no task "{name}" - {did_you_mean(name, names)}')
        return find_task(f"Hri.{name}")

    return lookup, lambda: sorted(names)
