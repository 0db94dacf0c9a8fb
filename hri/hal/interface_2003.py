"""Interfaces by the names of 2003, for `obtain("drive", "IDriveSystem")`.

A name stands for an interface only where its numbers mean what they meant in 2003. Those of your
own are classes with an id, which the driver derives from, as in 2003:

class ICompass(Resource):
    INTERFACE_ID = "Examples.ICompass"
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from hri.core.errors import HriError, did_you_mean
from hri.core.quantities import cm
from hri.hal.camera import Camera
from hri.hal.drive import DriveSystem, Stop, too_long
from hri.hal.pending import Pending
from hri.hal.resource import Resource
from hri.hal.stream import Stream


class IDriveSystem:
    """A drive system in centimeters, cm/s, cm/s² and radians, as in 2003.

    The methods and the order of their arguments are those of `DriveSystem`, and so are the errors;
    `stop` with a type is `DriveSystem.halt`. Security tickets and callbacks are gone: what takes
    time returns a `Pending`.
    """

    def __init__(self, drive: DriveSystem) -> None:
        self.drive = drive

    def set_idle_power(self, percent: float) -> Pending[None]:
        """Force with which the base holds its place while it stands, 0 (rolls free) to 100."""
        return self.drive.set_idle_power(percent)

    def set_move_power(self, percent: float) -> Pending[None]:
        """Force for motions, above 0 to 100."""
        return self.drive.set_move_power(percent)

    def move_delta(self, distance: float, velocity: float, acceleration: float) -> Pending[None]:
        """Drive straight on: cm, cm/s, cm/s²."""
        longest = self.drive.longest_move
        if abs(distance * cm) > longest:
            given = f"{distance:g} cm ({distance * cm:g} m)"
            raise too_long(self.drive.id, given, longest, "move in shorter steps")
        return self.drive.move_delta(distance * cm, velocity * cm, acceleration * cm)

    def turn_delta(self, angle: float, velocity: float, acceleration: float) -> Pending[None]:
        """Turn on the spot, left when positive: radians, rad/s, rad/s²."""
        return self.drive.turn_delta(angle, velocity, acceleration)

    def move_and_turn(
        self,
        linear: float,
        linear_acceleration: float,
        angular: float,
        angular_acceleration: float,
    ) -> None:
        """Go for these velocities, cm/s and rad/s, and keep them until another command comes."""
        self.drive.move_and_turn(
            linear * cm, linear_acceleration * cm, angular, angular_acceleration
        )

    def stop(self, how: Stop = Stop.SMOOTH) -> Pending[None]:
        """Come to rest; done when the base stands."""
        return self.drive.halt(how)


def _itself(resource: Any) -> Any:
    return resource


_INTERFACES: Mapping[str, tuple[type[Resource], Callable[[Any], Any]]] = {
    "ICamera": (Camera, _itself),
    "IDriveSystem": (DriveSystem, IDriveSystem),
    "IStream": (Stream, _itself),
}
"""For each name: the class that a resource must have, and what is handed out for it."""


def interface_named(name: str, resource: Resource) -> Callable[[Any], Any]:
    """What makes the interface of that name from a resource, which need not be open.

    The name may carry a namespace: "Evolution.IDriveSystem". An id of a driver's own goes before
    ours. Raises HriError for an unknown one, and for one that the driver does not have.
    """
    own, last = own_interfaces(type(resource)), name.rpartition(".")[2]
    if name in own:
        return _itself
    needed, made = _INTERFACES.get(last, (None, _itself))
    if needed is None:
        remedy = did_you_mean(name if own else last, (*own, *_INTERFACES))
        raise HriError(
            f'no interface of 2003 is called "{name}" here - {remedy}; or give the class itself, '
            "such as RangeSensor, or your class an INTERFACE_ID"
        )
    if not isinstance(resource, needed):
        what = f'"{resource.id}" is a {type(resource).__name__}, not a {needed.__name__}'
        raise HriError(f"{what} - check the id")
    return made


def own_interfaces(driver: type[Resource]) -> dict[str, type]:
    """The interfaces that a driver derives from and that have an id, by it."""
    return {vars(cls)["INTERFACE_ID"]: cls for cls in driver.__mro__ if "INTERFACE_ID" in vars(cls)}


def resource_of(handed: Resource | IDriveSystem) -> Resource:
    """The resource behind what was handed out."""
    return handed.drive if isinstance(handed, IDriveSystem) else handed
