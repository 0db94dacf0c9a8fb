"""The life of a resource: described by a file, opened when first needed, closed once."""

from __future__ import annotations

import threading
from abc import ABC
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import ClassVar, Protocol, TypeVar

from hri.core.clock import Clock
from hri.core.errors import AuthoringError, NotAvailable, Place, did_you_mean
from hri.core.expression import evaluate
from hri.core.geometry import Pose3D
from hri.hal.shape import Shape

POSE = ("link", "x", "y", "z", "roll", "pitch", "yaw")
"""Parameters that every device may have: the frame it is fixed to and where (cm, radians)."""
ORIGIN = "origin"
"""The frame of the robot itself."""

R = TypeVar("R", bound="Resource")
T = TypeVar("T")


@dataclass(frozen=True)
class Description:
    """What a configuration says of a device, bus or group."""

    id: str
    type: str
    parameters: Mapping[str, str] = field(default_factory=dict)
    bus: str = ""
    """Id of the bus the device sits on."""
    members: tuple[str, ...] = ()
    """Ids of a group's members."""
    place: Place = field(default_factory=lambda: Place(Path("-")))
    places: Mapping[str, Place] = field(default_factory=dict)
    """Where each parameter stands."""
    driver: str = ""
    """Name of the driver its spec gives; without one, the type is the driver."""
    library: Path | None = None
    """The Python file its spec names for the driver; None for a driver that is installed."""

    @property
    def link(self) -> str:
        """The frame it is fixed to: the robot's, or the id of another device."""
        return self.text("link", ORIGIN)

    @property
    def pose(self) -> Pose3D:
        """Where it is fixed to its link, meters and radians. Raises AuthoringError."""
        x, y, z = (self.number(name, 0.0) / 100 for name in ("x", "y", "z"))
        roll, pitch, yaw = (self.number(name, 0.0) for name in ("roll", "pitch", "yaw"))
        return Pose3D(x, y, z, roll, pitch, yaw)

    def error(self, parameter: str, what: str, remedy: str) -> AuthoringError:
        return AuthoringError(self.places.get(parameter, self.place), what, remedy)

    def text(self, name: str, default: str = "") -> str:
        return self.parameters.get(name, default)

    def choice(self, name: str, default: str, choices: Collection[str]) -> str:
        """One of some words. Raises AuthoringError with its place."""
        word = self.text(name, default)
        if word not in choices:
            raise self.error(name, f'{name}: "{word}"', did_you_mean(word, choices))
        return word

    def number(self, name: str, default: float) -> float:
        """A number or an expression such as -5*pi/6. Raises AuthoringError with its place."""
        text = self.parameters.get(name)
        if text is None:
            return default
        try:
            return evaluate(text)
        except ValueError as error:
            remedy = "write a number, such as 0.5 or -pi/4"
            raise self.error(name, f"{name}: {error}", remedy) from error

    def count(self, name: str, default: int, least: int, most: int) -> int:
        """A whole number within limits. Raises AuthoringError with its place."""
        value = self.number(name, default)
        if value != int(value) or not least <= value <= most:
            remedy = f"write a whole number from {least} to {most}"
            raise self.error(name, f"{name}: {value:g}", remedy)
        return int(value)

    def number_within(self, name: str, default: float, least: float, most: float) -> float:
        """A number that must lie in a range. Raises AuthoringError."""
        value = self.number(name, default)
        if not least <= value <= most:
            what = f"{name} is {value:g}"
            raise self.error(name, what, f"write a number from {least:g} to {most:g}")
        return value


class Resources(Protocol):
    """What a resource may ask of the `ResourceManager` that made it."""

    clock: Clock
    descriptions: dict[str, Description]
    dimensions: Shape
    is_to_repeat: bool
    notice: Callable[[str], object]

    def declare(self, description: Description) -> None: ...
    def ids(self, interface: type[Resource]) -> list[str]: ...
    def obtain(self, id: str, interface: type[R]) -> R: ...
    def opened(self, interface: type[R]) -> list[R]: ...
    def pose_of(self, id: str) -> Pose3D: ...
    def release(self, resource: Resource) -> None: ...
    def shared(self, kind: type[T], ids: tuple[str, ...], make: Callable[[], T]) -> T: ...


class Resource(ABC):  # noqa: B024 - what must be written is named by each interface
    """Base of all drivers. A subclass fills in `_open` and `_close`, and its interface."""

    parameters: ClassVar[tuple[str, ...]] = ()
    """Names of the parameters it understands, beside those of every device."""
    is_hardware: ClassVar[bool] = False
    """True for what lives in real time: not used on a fake clock, its stand-in is."""

    is_simulated: ClassVar[bool] = False
    """True for a device of a simulated world."""

    def __init__(self, description: Description, manager: Resources) -> None:
        self.description = description
        self.manager = manager
        self.id = description.id
        self._lock = threading.RLock()
        self._is_active = False
        self._reservations = 0
        self._used: list[Resource] = []

    @classmethod
    def check(cls, description: Description) -> None:
        """Refuse a description with parameters nobody reads. Raises AuthoringError."""
        known = {*cls.parameters, *POSE, "stand_in"}
        for name in description.parameters:
            if name not in known:
                what = f'{description.type} has no parameter "{name}"'
                raise description.error(name, what, did_you_mean(name, known))

    @property
    def is_active(self) -> bool:
        return self._is_active

    def activate(self) -> None:
        """Open; a second call does nothing. Raises NotAvailable when the thing is not there."""
        with self._lock:
            if self._is_active:
                return
            try:
                self._open()
            except OSError as error:
                self._let_go()
                why = error.strerror or str(error)
                remedy = "see that it is plugged in and nothing else uses it"
                raise self.not_available(why, remedy) from error
            except BaseException:
                self._let_go()
                raise
            self._is_active = True

    def deactivate(self) -> None:
        """Close, whoever still uses it; a second call does nothing."""
        with self._lock:
            if not self._is_active:
                return
            self._is_active = False
            self._reservations = 0
            try:
                self._close()
            finally:
                self._let_go()

    def reserve(self) -> None:
        """Count one more user; the first one opens it. Raises NotAvailable as `activate` does."""
        with self._lock:
            self.activate()
            self._reservations += 1

    def release(self) -> None:
        """Count one user less; the last one closes it. Without a user it does nothing."""
        with self._lock:
            if self._reservations > 0:
                self._reservations -= 1
                if self._reservations == 0:
                    self.deactivate()

    @property
    def reservations(self) -> int:
        """How many use it."""
        return self._reservations

    def use(self, id: str, interface: type[R]) -> R:
        """Another resource for as long as this one is open; for `_open`. Raises as `obtain`."""
        used = self.manager.obtain(id, interface)
        self._used.append(used)
        return used

    def _let_go(self) -> None:
        while self._used:
            self.manager.release(self._used.pop())

    def describe(self) -> str:
        """One line for people: its type and settings."""
        return self.description.type

    def not_available(self, why: str, remedy: str) -> NotAvailable:
        """The error to raise when the thing is not there."""
        return NotAvailable(f"{self.id}: {why} - {remedy}")

    def _open(self) -> None:  # noqa: B027 - many have nothing to open
        """Acquire the device."""

    def _close(self) -> None:  # noqa: B027 - nor to close
        """Let the device go; must not raise."""
