"""The behavior: reads inputs, writes outputs, once a tick, without ever blocking.

class Doubler(Behavior):
    \"\"\"Twice what comes in.\"\"\"

    number = Input[float]("double", "any number")
    gain = Param(2.0, "what it is multiplied with", minimum=0)
    product = Output[float]("double", "number times gain")

    def compute(self, now: float, dt: float) -> None:
        if (number := self.number.value) is not None:
            self.product.send(number * self.gain)
"""

from __future__ import annotations

import zlib
from dataclasses import dataclass, field
from typing import Any, ClassVar

from hri.behavior.ports import Input, InputPort, Output, OutputPort, Param
from hri.core.clock import Clock
from hri.core.errors import HriError, did_you_mean
from hri.core.events import EventBus
from hri.core.latest import Board
from hri.hal.manager import ResourceManager


@dataclass
class Context:
    """What the robot lends to its behaviors while they run."""

    clock: Clock
    events: EventBus
    resources: ResourceManager
    board: Board = field(default_factory=Board)
    seed: int = 0

    def seed_for(self, name: str) -> int:
        """A seed of its own for each user of randomness, so that adding one shifts no other."""
        return zlib.crc32(f"{self.seed}/{name}".encode())


class Behavior:
    """Base of all behaviors; subclasses declare ports and fill in `compute`."""

    category: ClassVar[str] = "util"
    """The palette tab it is shown under."""
    inputs: ClassVar[dict[str, Input[Any]]] = {}
    outputs: ClassVar[dict[str, Output[Any]]] = {}
    parameters: ClassVar[dict[str, Param[Any]]] = {}

    def __init_subclass__(cls, **keywords: Any) -> None:
        super().__init_subclass__(**keywords)
        if not cls.__doc__:
            raise TypeError(f"{cls.__name__} needs a docstring - say in a line what it does")
        cls.inputs, cls.outputs, cls.parameters = (
            dict(cls.inputs),
            dict(cls.outputs),
            dict(cls.parameters),
        )
        tables: dict[type, dict[str, Any]] = {
            Input: cls.inputs,
            Output: cls.outputs,
            Param: cls.parameters,
        }
        for name, declared in vars(cls).items():
            if isinstance(declared, (Input, Output, Param)):
                if hasattr(Behavior, name):
                    raise TypeError(f"{cls.__name__}.{name} hides what Behavior uses - rename it")
                declared.name = name
                tables[type(declared)][name] = declared

    def __init__(self, id: str = "", **parameters: Any) -> None:
        self.id = id or type(self).__name__
        for name in self.inputs:
            self.__dict__[name] = InputPort()
        for name in self.outputs:
            self.__dict__[name] = OutputPort()
        for name, value in parameters.items():
            if name not in self.parameters:
                remedy = did_you_mean(name, self.parameters)
                raise HriError(f'{type(self).__name__} has no parameter "{name}" - {remedy}')
            self.__dict__[name] = value

    def check(self) -> None:
        """Read the authored files it needs, before anything is opened. Raises HriError."""

    def start(self, context: Context) -> None:
        """Take what is needed from the robot: resources, workers, listeners."""

    def compute(self, now: float, dt: float) -> None:
        """One tick: `now` in seconds, `dt` seconds since the last tick (0 at the first)."""
        raise TypeError(f"{type(self).__name__} does not say what to compute")

    def stop(self) -> None:
        """Give back what `start` took; called once, also after an error."""
