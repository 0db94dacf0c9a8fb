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

import math
import zlib
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar, Protocol

from hri.behavior.declaration import Schema
from hri.behavior.doors import Doors
from hri.behavior.effects import Effect
from hri.behavior.ports import Input, InputPort, Output, OutputPort, Param
from hri.behavior.reason import Arrived, Reason
from hri.behavior.tick_statistics import Statistics
from hri.core.clock import Clock
from hri.core.errors import HriError, did_you_mean
from hri.core.event_bus import EventBus
from hri.core.latest import Board
from hri.hal.resource_manager import ResourceManager


class Running(Protocol):
    """A network that runs, as others of the same robot see it: `hri.behavior.runner.Runner`."""

    network: Any
    statistics: Statistics

    @property
    def watched(self) -> tuple[OutputPort[Any], ...]:
        """The outputs that are watched."""

    @property
    def may_interleave(self) -> bool:
        """Whether it may tick between two behaviors of a slower one."""

    def tick_if_due(self) -> None:
        """Tick, if it is time."""

    def watch(self, behavior: str, output: str, callback: Callable[[Any, float], object]) -> Any:
        """Call `callback(value, now)` after each tick in which the output sent something."""


@dataclass
class Context:
    """What the robot lends to its behaviors while they run."""

    clock: Clock
    events: EventBus
    resources: ResourceManager
    board: Board = field(default_factory=Board)
    seed: int = 0
    doors: Doors = field(default_factory=Doors)
    runners: list[Running] = field(default_factory=list)
    """All that run, in the order they were started."""
    has_tasks: bool = False
    """Whether tasks run beside the networks."""
    paused: set[str] = field(default_factory=set)
    """Names of the networks that are paused; no network moves a drive meanwhile."""
    held_up_by: str = ""
    """The task that kept all others waiting last, for longer than it should."""
    held_up_at: float = -math.inf
    """Seconds of the clock when it let them go on."""

    def seed_for(self, name: str) -> int:
        """A separate seed for each user of randomness, so that adding one does not shift others."""
        return zlib.crc32(f"{self.seed}/{name}".encode())


class Behavior:
    """Base of all behaviors; subclasses declare ports and fill in `compute`."""

    id: str = ""
    """Its name in the network."""
    category: ClassVar[str] = "util"
    """The palette tab it is shown under."""
    is_sensor: ClassVar[bool] = False
    """Sensors run first in each cycle."""
    is_relay: ClassVar[bool] = False
    """Whether it passes on what someone outside of the network says, with the time of that. A
    drive that follows such values stops when that someone falls silent."""
    keeps_inputs: ClassVar[bool] = True
    """Whether its outputs may depend on inputs of earlier ticks, such as a goal. The word of a
    relay then ages until the input gets another; a class that forgets, or whose output asks for no
    motion, says False."""
    may_do: frozenset[Effect]
    """Effects of input values besides those of its outputs. Default: none if the class only
    computes, any if it defines `start` or `__init__`.
    """
    takes_any_ports: ClassVar[bool] = False
    """Whether a schema that names it as its driver may add ports."""
    inputs: ClassVar[dict[str, Input[Any]]] = {}
    outputs: ClassVar[dict[str, Output[Any]]] = {}
    parameters: ClassVar[dict[str, Param[Any]]] = {}
    schema: ClassVar[Schema | None] = None
    """What defined the class, when it was a schema file."""

    def __init_subclass__(cls, **keywords: Any) -> None:
        super().__init_subclass__(**keywords)
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
                if isinstance(declared, Output):
                    declared.attribute = name
                declared.name = declared.name or name
                cls._check_declared(name, declared)
                tables[type(declared)][declared.name] = declared

    @classmethod
    def _check_declared(cls, name: str, declared: Input[Any] | Output[Any] | Param[Any]) -> None:
        """Raise TypeError where one attribute is to be two things, or one output has two."""
        former = getattr(super(cls, cls), name, None)
        if isinstance(former, (Input, Output, Param)) and type(former) is not type(declared):
            what = f"{cls.__name__}.{name} is the {type(former).__name__} of a base class"
            raise TypeError(f"{what} - rename this {type(declared).__name__}")
        other = cls.outputs.get(declared.name)
        if isinstance(declared, Output) and other is not None and other.attribute != name:
            what = f'{cls.__name__} declares the output "{declared.name}" as {name}, too'
            raise TypeError(f"{what} - call both {other.attribute}")

    def __init__(self, id: str = "", **parameters: Any) -> None:
        self.id = id or type(self).__name__
        for name in self.inputs:
            self.__dict__[name] = InputPort()
        for output in self.outputs.values():
            self.__dict__[output.attribute] = OutputPort(datatype=output.datatype)
        for name, declared in self.parameters.items():
            self.__dict__[name] = declared.default
        for name, value in parameters.items():
            self.set_parameter(name, value)

    def set_parameter(self, name: str, value: Any) -> None:
        """Set a parameter; a text is read as in a file, so that "60" and "pi/4" are numbers.

        Raises HriError when it has none of that name, type or range.
        """
        declared = self._declared(name, self.parameters, "parameter")
        try:
            read = declared.parse if isinstance(value, str) else declared.check
            self.__dict__[name] = read(value)
        except ValueError as error:
            raise HriError(f"{self.id}.{name}: {error}") from error

    @classmethod
    def input_named(cls, name: str) -> Input[Any]:
        """The declaration of an input. Raises HriError for an unknown name."""
        declared: Input[Any] = cls._declared(name, cls.inputs, "input")
        return declared

    @classmethod
    def output_named(cls, name: str) -> Output[Any]:
        """The declaration of an output. Raises HriError for an unknown name."""
        declared: Output[Any] = cls._declared(name, cls.outputs, "output")
        return declared

    def input_port(self, name: str) -> InputPort[Any]:
        """The port of an input. Raises KeyError."""
        port: InputPort[Any] = self.__dict__[name]
        return port

    def output_port(self, name: str) -> OutputPort[Any]:
        """The port of an output, which an input may share its name with. Raises KeyError."""
        port: OutputPort[Any] = getattr(self, type(self).outputs[name].attribute)
        return port

    @classmethod
    def _declared(cls, name: str, table: dict[str, Any], kind: str) -> Any:
        if name not in table:
            remedy = did_you_mean(name, table)
            raise HriError(f'{cls.__name__} has no {kind} "{name}" - {remedy}')
        return table[name]

    @property
    def steers(self) -> tuple[str, str] | None:
        """Id of the drive that it steers, and its rank, which only it may have; None for most."""
        return None

    @property
    def bridge_ports(self) -> tuple[tuple[str, str], ...]:
        """The outputs that others write to over the network, as tag and name; most have none."""
        return ()

    def check(self) -> None:
        """Read the authored files it needs, before anything is opened. Raises HriError."""

    def start(self, context: Context) -> None:
        """Take what is needed from the robot: resources, workers, listeners."""

    def compute(self, now: float, dt: float) -> None:
        """One tick: `now` in seconds, `dt` seconds since the last tick (0 at the first)."""
        raise TypeError(f"{type(self).__name__} does not say what to compute")

    def stop(self) -> None:
        """Give back what `start` took; called once, also after an error."""

    def explain_output(self, output: str, value: Any, arrived: Sequence[Arrived]) -> Reason | None:
        """Why an output has its value, and which of the inputs decided; None where all did.

        Called between ticks, with the value of the last tick and what each link brought then.
        """
        return None


def bridge_ports(behaviors: Iterable[Behavior]) -> list[tuple[str, str]]:
    """The outputs of behaviors that others write to over the network, as tag and name."""
    return [port for behavior in behaviors for port in behavior.bridge_ports]
