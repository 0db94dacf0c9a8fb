"""What a behavior declares: inputs, outputs and parameters, with types that are checked early."""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Sequence
from typing import Any, Generic, TypeVar, overload

from hri.core import registry, signals
from hri.core.errors import did_you_mean
from hri.core.expression import evaluate
from hri.core.origin import OUTSIDE
from hri.hal.manner import FREELY, Manner

T = TypeVar("T")

GENERIC = "Evolution.Generic"
LINEAR_VELOCITY = "Evolution.LinearVelocity"
ANGULAR_VELOCITY = "Evolution.AngularVelocity"
"""Meanings of ports; a generic one fits all others."""


def means_same(one: str, other: str) -> bool:
    """Whether two meanings fit: they are alike, or one is generic. `Hri.` is `Evolution.` here."""
    meanings = {registry.canonical(one), registry.canonical(other)}
    return len(meanings) == 1 or registry.canonical(GENERIC) in meanings


DBL_MAX = sys.float_info.max
"""What ports of 2003 carry, instead of infinity, when nothing is in range."""

ANY = "any"
"""The datatype that fits every other."""

DATATYPES: dict[str, type] = {
    ANY: object,
    "double": float,
    "string": str,
    "doublearray": tuple,
    "boolean": bool,
    "image": signals.Frame,
    "samples": object,
    "sound": signals.SoundWindow,
    "utterance": signals.Utterance,
    "speech": signals.Speech,
    "prosody": signals.Prosody,
    "stimulus": signals.Stimulus,
    "emotion": signals.EmotionState,
    "expression": signals.Expression,
    "weights": signals.FaceWeights,
    "gaze": signals.Gaze,
    "headpose": signals.HeadPose,
    "gesture": signals.HeadGesture,
    "handgesture": signals.HandGesture,
    "people": signals.People,
    "objects": signals.Objects,
    "blobs": signals.ColorBlobs,
    "markers": signals.Markers,
    "motion": signals.Motion,
    "twist": signals.Twist,
    "pose": signals.Pose2D,
    "range": signals.RangeReading,
}
"""The names that files use for the types of ports; `declare_datatype` adds to them."""


_OWN_NAME = re.compile(r"[A-Za-z]\w*(\.\w+)+")


def declare_datatype(name: str, kind: type) -> type:
    """Give a class of your own a name that ports and schemas may use: `"My.Track"`; the class.

    Call it before the behaviors that have such ports. Raises TypeError for a name without a
    namespace, one that names another class already, and for what is not a class.
    """
    if not _OWN_NAME.fullmatch(name):
        raise TypeError(f'"{name}" is not a valid datatype name - write Namespace.Name')
    if not isinstance(kind, type):
        raise TypeError(f"{name} is {kind!r:.60} - give a class")
    known = DATATYPES.get(name, kind)
    # A file that is read again makes its classes again.
    if (known.__module__, known.__qualname__) != (kind.__module__, kind.__qualname__):
        what = f'the datatype "{name}" is {known.__module__}.{known.__qualname__} already'
        raise TypeError(f"{what} - choose another name")
    DATATYPES[name] = kind
    return kind


class InputPort(Generic[T]):
    """What arrives at an input in this tick."""

    __slots__ = ("sources",)

    def __init__(self) -> None:
        self.sources: list[OutputPort[T]] = []

    @property
    def source(self) -> OutputPort[T] | None:
        """The first link that carries a value; None when nothing was sent."""
        for source in self.sources:
            if source.value is not None:
                return source
        return None

    @property
    def value(self) -> T | None:
        """The value of the first link that carries one; None when nothing was sent."""
        for source in self.sources:  # not by `source`: this is read everywhere, at every tick
            if source.value is not None:
                return source.value
        return None

    @property
    def values(self) -> list[T]:
        """What all links carry; those that sent nothing are left out."""
        return [source.value for source in self.sources if source.value is not None]

    @property
    def spoken(self) -> float | None:
        """When the source of `value` spoke last, seconds; None: it is this network, in this tick.

        See `OutputPort.spoken`.
        """
        return None if (source := self.source) is None else source.spoken

    @property
    def origin(self) -> str:
        """Who causes what `value` leads to, as `hri.core.origin` has it; empty: this network."""
        return "" if self.spoken is None else OUTSIDE

    @property
    def rank(self) -> str:
        """The rank of whoever asks for `value`; see `OutputPort.rank`."""
        return "" if (source := self.source) is None else source.rank

    @property
    def manner(self) -> Manner:
        """How `value` is to be carried out; see `OutputPort.manner`."""
        return FREELY if (source := self.source) is None else source.manner


class OutputPort(Generic[T]):
    """What a behavior sends in this tick; empty again at the next."""

    __slots__ = ("_datatype", "_kind", "manner", "rank", "spoken", "value")

    def __init__(self, value: T | None = None, datatype: str = ANY) -> None:
        self.value = value
        self.spoken: float | None = None
        """When the source outside of the network that the value comes from spoke last: a peer over
        the network, a joystick. The oldest time of several, in seconds; None without a source."""
        self.rank = ""
        """Of a command: the rank of whoever asks for it, as in `hri.hal.rank`; without one, it is
        that of the behavior which passes it on to the drive."""
        self.manner = FREELY
        """Of a command: how it is to be carried out."""
        self.restrict(datatype)

    def restrict(self, datatype: str) -> None:
        """Take values of this datatype alone."""
        self._datatype = datatype
        # Whole numbers are good enough for a double.
        self._kind = (float, int) if datatype == "double" else DATATYPES[datatype]

    def takes(self, value: object) -> bool:
        """Whether a value is of the port's datatype."""
        return isinstance(value, self._kind)

    def send(self, value: T, spoken: float | None = None) -> None:
        """Send a value in this tick; `spoken` is for behaviors with `is_relay`.

        Raises TypeError when it is not of the port's datatype.
        """
        if not isinstance(value, self._kind):
            raise TypeError(f"{_shown(value)} was sent - this output is a {self._datatype}")
        self.value = value
        self.spoken = spoken


class Input(Generic[T]):
    """Declares an input: `range_sensor = Input("double", doc="...")`. Any number of links."""

    name = ""

    def __init__(
        self, datatype: str, doc: str, semantic: str = GENERIC, *, is_optional: bool = False
    ) -> None:
        """`is_optional`: the behavior has other things to do when no link leads there."""
        self.datatype = _checked(datatype)
        self.doc = doc
        self.semantic = semantic
        self.is_optional = is_optional

    @overload
    def __get__(self, instance: None, owner: type) -> Input[T]: ...
    @overload
    def __get__(self, instance: object, owner: type) -> InputPort[T]: ...
    def __get__(self, instance: object | None, owner: type) -> Any:
        if instance is None:
            return self
        raise AttributeError(f"call super().__init__() before you use the input {self.name}")

    def check(self, value: Any) -> T:
        """The value as this input takes it: whole numbers become floats, lists arrays.

        Raises ValueError when it is of another type.
        """
        if self.datatype == "double" and isinstance(value, int) and not isinstance(value, bool):
            value = float(value)
        elif self.datatype == "doublearray" and isinstance(value, (list, tuple)):
            value = tuple(map(float, value))
        if not isinstance(value, DATATYPES[self.datatype]):
            raise ValueError(f"{_shown(value)} - send a {self.datatype}")
        checked: Any = value
        return checked  # type: ignore[no-any-return]


class Output(Generic[T]):
    """Declares an output: `linear_velocity = Output("double", doc="...")`."""

    name = ""

    attribute = ""
    """What holds its port in a behavior; not the name where an input has the same."""

    def __init__(self, datatype: str, doc: str, semantic: str = GENERIC, *, name: str = "") -> None:
        """`name`: where an input has it too, so that the attribute must be another word."""
        self.name = name
        self.datatype = _checked(datatype)
        self.doc = doc
        self.semantic = semantic

    @overload
    def __get__(self, instance: None, owner: type) -> Output[T]: ...
    @overload
    def __get__(self, instance: object, owner: type) -> OutputPort[T]: ...
    def __get__(self, instance: object | None, owner: type) -> Any:
        if instance is None:
            return self
        raise AttributeError(f"call super().__init__() before you use the output {self.name}")


class Param(Generic[T]):
    """Declares a parameter: a text, a number within a range, or true/false, by its default."""

    name = ""

    def __init__(
        self,
        default: T,
        doc: str,
        *,
        minimum: float = -math.inf,
        maximum: float = math.inf,
        among: Sequence[str] = (),
    ) -> None:
        self.default = default
        self.doc = doc
        self.minimum = minimum
        self.maximum = maximum
        self.among = among

    @overload
    def __get__(self, instance: None, owner: type) -> Param[T]: ...
    @overload
    def __get__(self, instance: object, owner: type) -> T: ...
    def __get__(self, instance: object | None, owner: type) -> Any:
        return self if instance is None else instance.__dict__.get(self.name, self.default)

    def parse(self, text: str) -> T:
        """The value of a text from a file. Raises ValueError with the mistake and its remedy."""
        value: Any = text
        if isinstance(self.default, bool):
            if text.strip().lower() not in ("true", "false"):
                raise ValueError(f'"{text}" is not true or false - write true or false')
            value = text.strip().lower() == "true"
        elif isinstance(self.default, (int, float)):
            try:
                value = evaluate(text)
            except ValueError as error:
                raise ValueError(f"{error} - write a number, such as 0.5 or pi/4") from error
        return self.check(value)

    @staticmethod
    def text(value: Any) -> str:
        """A value as files write it; `parse` gives it back."""
        if isinstance(value, bool):
            return str(value).lower()
        return str(value).removesuffix(".0") if isinstance(value, float) else str(value)

    def check(self, value: Any) -> T:
        """The value when it has the right type and range, else ValueError with what to do."""
        if isinstance(self.default, bool):
            self._checked_type(value, bool, "true or false")
            return value  # type: ignore[no-any-return]
        if isinstance(self.default, (int, float)):
            return self._checked_number(value)
        if isinstance(self.default, str):
            self._checked_type(value, str, "a text")
            if self.among and value not in self.among:
                raise ValueError(f'"{value}" is not known - {did_you_mean(value, self.among)}')
        return value  # type: ignore[no-any-return]

    def _checked_number(self, value: Any) -> T:
        if isinstance(value, bool):
            raise ValueError(f"{value} is not a number - write a number")
        self._checked_type(value, (int, float), "a number")
        if not self.minimum <= value <= self.maximum:
            raise ValueError(
                f"{value:g} is out of range - write a number"
                f" from {self.minimum:g} to {self.maximum:g}"
            )
        if isinstance(self.default, float):
            return float(value)  # type: ignore[return-value]
        if value != int(value):
            raise ValueError(f"{value:g} is not a whole number - write a whole number")
        return int(value)  # type: ignore[return-value]

    @staticmethod
    def _checked_type(value: Any, kind: type | tuple[type, ...], wanted: str) -> None:
        if not isinstance(value, kind):
            raise ValueError(f"{_shown(value)} - write {wanted}")


def _shown(value: object) -> str:
    return f"{value!r:.60} is of type {type(value).__name__}"


def _checked(datatype: str) -> str:
    if datatype not in DATATYPES:
        raise TypeError(f'unknown datatype "{datatype}" - {did_you_mean(datatype, DATATYPES)}')
    return datatype
