"""The life of a resource: described by a file, opened when first needed, closed once."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from hri.core.errors import AuthoringError, NotAvailable, Place, did_you_mean
from hri.core.expression import evaluate

if TYPE_CHECKING:
    from hri.hal.manager import ResourceManager

POSE = ("link", "x", "y", "z", "roll", "pitch", "yaw")
"""Parameters that every device may have: the frame it is fixed to and where (cm, radians)."""


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

    def error(self, parameter: str, what: str, remedy: str) -> AuthoringError:
        return AuthoringError(self.places.get(parameter, self.place), what, remedy)

    def text(self, name: str, default: str = "") -> str:
        return self.parameters.get(name, default)

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


class Resource:
    """Base of all drivers. A subclass fills in `_open` and `_close`, and its interface."""

    parameters: ClassVar[tuple[str, ...]] = ()
    """Names of the parameters it understands, beside those of every device."""
    is_hardware: ClassVar[bool] = False
    """True for what lives in real time: not used on a fake clock, its stand-in is."""

    def __init__(self, description: Description, manager: ResourceManager) -> None:
        self.description = description
        self.manager = manager
        self.id = description.id
        self._lock = threading.RLock()
        self._is_active = False

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
            if not self._is_active:
                self._open()
                self._is_active = True

    def deactivate(self) -> None:
        """Close; a second call does nothing."""
        with self._lock:
            if self._is_active:
                self._is_active = False
                self._close()

    def describe(self) -> str:
        """One line for people: what it is, with what settings."""
        return self.description.type

    def not_available(self, why: str, remedy: str) -> NotAvailable:
        """The error to raise when the thing is not there."""
        return NotAvailable(f"{self.id}: {why} - {remedy}")

    def _open(self) -> None:
        """Acquire the device."""

    def _close(self) -> None:
        """Let the device go; must not raise."""
