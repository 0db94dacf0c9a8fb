"""Your own primitive, a task that is a network: run it with `python thing.py`."""

import os
from pathlib import Path

from hri.task import TaskContext, TaskStatus
from hri.task.primitive import Primitive, primitive

# The network is beside this file, in primitive/My/Thing.xml.
HERE = str(Path(__file__).parent)
os.environ["HRI_PATH"] = ":".join(filter(None, [HERE, os.environ.get("HRI_PATH")]))


@primitive("My.Thing")
class Thing(Primitive):
    """Wait until the battery is at a level or below it; the level then, 0 to 1."""

    def __init__(self, context: TaskContext, level: float = 1.0) -> None:
        super().__init__(context)
        self.wanted = level

    def start(self) -> None:
        self.on_value("gauge", "level", self.look)

    def look(self, level: float, now: float) -> None:
        if level <= self.wanted:
            self.set_status(TaskStatus.SUCCESS, level)


if __name__ == "__main__":
    print(f"the battery is at {Thing():.0%}")
