"""Hands out resources by id: opened when first asked for, closed by the last who gives them back.

An open resource is counted: `obtain` adds a user, `release` takes one away. Programs that need
their devices to the end only obtain; `close` deactivates whatever is still open.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, Literal, Self, TypeVar, overload

from hri.core import paths, registry
from hri.core.clock import Clock, RealClock
from hri.core.errors import HriError, NotAvailable, did_you_mean
from hri.core.geometry import Pose3D
from hri.core.python_file import load_class
from hri.core.quoting import report
from hri.hal.choices import apply_choices, load_choices
from hri.hal.configuration import load_configuration, spec_folders
from hri.hal.ids_2003 import IDS
from hri.hal.interface_2003 import IDriveSystem, interface_named, resource_of
from hri.hal.resource import ORIGIN, Description, Resource
from hri.hal.shape import NO_SHAPE, Shape

log = logging.getLogger("hri.resources")

R = TypeVar("R", bound=Resource)
T = TypeVar("T")


class ResourceManager:
    """All devices of a configuration; safe to use from several threads, and to close twice."""

    def __init__(
        self,
        descriptions: Iterable[Description],
        clock: Clock,
        notice: Callable[[str], object] = report,
        shapes: Iterable[Shape] = (),
        trusted: tuple[str, ...] = (),
    ) -> None:
        """`notice` gets one line for each stand-in that is used."""
        self.trusted = trusted
        """What the configuration says of ports of the bridge that anyone may write to."""
        self.clock = clock
        self.is_to_repeat = clock.is_fake
        """Whether nothing that is measured on this machine may decide."""
        self.waits_for_devices = False
        """Whether, in real time, what is missing is waited for, as a service does: nothing
        simulated stands in, and microphones, speakers, cameras and screens are taken when they
        come."""
        self.descriptions = {description.id: description for description in descriptions}
        self.notice = notice
        self.dimensions = next(iter(shapes), NO_SHAPE)
        """The first shape of the configuration: the box around the robot's body."""
        self._lock = threading.RLock()
        self._resources: dict[str, Resource] = {}
        self._open: list[Resource] = []
        """In the order they were opened, so that what others use closes after them."""
        self._stand_ins: dict[str, str] = {}
        self._shared: dict[tuple[type, tuple[str, ...]], Any] = {}

    @classmethod
    def load(cls, config: str | Path = "resource-config", clock: Clock | None = None) -> Self:
        """All devices of a configuration, checked; real time where no clock is given.

        `config` is a path or a name over the search folders. In real time the user's choice of
        devices counts. As a context manager it closes what was opened:
        `with ResourceManager.load() as resources:`. Raises HriError or AuthoringError.
        """
        configuration = load_configuration(paths.find("config", str(config)))
        clock = clock or RealClock()
        devices = configuration.devices
        if not clock.is_fake:  # runs that repeat know nothing of this user's devices
            devices = apply_choices(devices, load_choices())
        resources = cls(devices, clock, shapes=configuration.shapes, trusted=configuration.trusted)
        resources.check()
        return resources

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def check(self) -> None:
        """Look up every type and parameter before anything starts. Raises AuthoringError."""
        for description in self.descriptions.values():
            self.driver_of(description).check(description)
            stand_in = description.text("stand_in")
            if stand_in and stand_in not in self.descriptions:
                remedy = did_you_mean(stand_in, self.descriptions)
                raise description.error("stand_in", f'no device "{stand_in}"', remedy)
            self._refuse_circle(description)

    def _refuse_circle(self, description: Description) -> None:
        """A device must not stand in for itself, not even by a detour."""
        seen, current = [description.id], description
        while (stand_in := current.text("stand_in")) in self.descriptions:
            if stand_in in seen:
                what = f"stand-ins run in a circle: {' -> '.join([*seen, stand_in])}"
                raise description.error("stand_in", what, "let the last one stand for itself")
            seen.append(stand_in)
            current = self.descriptions[stand_in]

    @overload
    def obtain(self, id: str, interface: type[R]) -> R: ...
    @overload
    def obtain(self, id: str, interface: Literal["IDriveSystem"]) -> IDriveSystem: ...
    @overload
    def obtain(self, id: str, interface: str) -> Any: ...
    def obtain(self, id: str, interface: type[Resource] | str) -> Any:
        """The open resource of that id, its stand-in where it is not there; adds a user.

        `interface` is a class, or a name of 2003: `obtain("drive", "IDriveSystem")` hands out the
        drive in centimeters; also the INTERFACE_ID of a class that the driver derives from. Raises
        HriError for an unknown id, an unknown or a wrong interface, NotAvailable when neither the
        device nor a stand-in can be opened.
        """
        if isinstance(interface, str):
            return self._obtain_named(id, interface)
        resource = self._reserved(id)
        if not isinstance(resource, interface):
            self.release(resource)
            raise HriError(
                f'"{id}" is a {type(resource).__name__}, not a {interface.__name__} - check the id'
            )
        return resource

    def _obtain_named(self, id: str, name: str) -> Any:
        interface_named(name, self._resource(self.known_id(id)))  # refused before it is opened
        resource = self._reserved(id)
        try:
            return interface_named(name, resource)(resource)
        except HriError:
            self.release(resource)
            raise

    def release(self, resource: Resource | IDriveSystem) -> None:
        """Give back what `obtain` gave; the last user's release deactivates it."""
        resource = resource_of(resource)
        resource.release()
        with self._lock:
            if not resource.is_active and resource in self._open:
                self._open.remove(resource)

    def find(self, interface: type[R]) -> R | None:
        """The first resource with that interface that is there; None when none is named.

        Raises NotAvailable when some are named, but none is there.
        """
        missing: NotAvailable | None = None
        for id in self.ids(interface):
            try:
                return self.obtain(id, interface)
            except NotAvailable as error:
                missing = missing or error
        if missing is not None:
            raise missing
        return None

    def opened(self, interface: type[R]) -> list[R]:
        """What is open with that interface, stand-ins too, in the order in which it was opened."""
        with self._lock:
            return [resource for resource in self._open if isinstance(resource, interface)]

    def ids(self, interface: type[Resource]) -> list[str]:
        """Ids of all devices with that interface, as configured; those that stand in come last."""
        stand_ins = {description.text("stand_in") for description in self.descriptions.values()}
        ids = [d.id for d in self.descriptions.values() if self._offers(d, interface)]
        return sorted(ids, key=lambda id: id in stand_ins)

    def _offers(self, description: Description, interface: type[Resource]) -> bool:
        try:
            return issubclass(self.driver_of(description), interface)
        except HriError:  # `check` says so
            return False

    def declare(self, description: Description) -> None:
        """Add a device that the configuration does not name; one that it names stays."""
        with self._lock:
            self.descriptions.setdefault(description.id, description)

    def pose_of(self, id: str) -> Pose3D:
        """Where a device is in the robot's frame, along all its links.

        Raises HriError for an unknown id, AuthoringError for a link to nothing or in a circle.
        """
        description = self._description(id)
        pose, seen = description.pose, [id]
        while description.link != ORIGIN:
            link = description.link
            if link not in self.descriptions:
                remedy = did_you_mean(link, [ORIGIN, *self.descriptions])
                raise description.error("link", f'no device "{link}" to be fixed to', remedy)
            if link in seen:
                what = f"links run in a circle: {' -> '.join([*seen, link])}"
                raise description.error("link", what, f'fix one of them to "{ORIGIN}"')
            seen.append(link)
            description = self.descriptions[link]
            pose = description.pose.then(pose)
        return pose

    def shared(self, kind: type[T], ids: tuple[str, ...], make: Callable[[], T]) -> T:
        """What all resources about the same ids have in common of that kind, made for the first."""
        with self._lock:
            if (kind, ids) not in self._shared:
                self._shared[kind, ids] = make()
            found: T = self._shared[kind, ids]
            return found

    def stand_in_of(self, id: str) -> str | None:
        """Id of the device that stands in for this one; None when it is there itself."""
        return self._stand_ins.get(id)

    def substitute(self, id: str, resource: Resource) -> None:
        """Use this resource under that id: for tests, recordings, files of the command line."""
        with self._lock:
            self._resources[id] = resource
            self._stand_ins.pop(id, None)
            if resource.is_active and resource not in self._open:
                self._open.append(resource)

    def close(self) -> None:
        """Deactivate everything, newest first; one that fails does not keep the others open."""
        while (resource := self._newest()) is not None:
            try:
                resource.deactivate()
            except Exception:
                log.exception(f"{resource.id}: closing failed")

    def _newest(self) -> Resource | None:
        with self._lock:
            return self._open.pop() if self._open else None

    def known_id(self, id: str) -> str:
        """The id itself, or what an id of 2003 is called in a configuration without one of it."""
        if id in self.descriptions or id in self._resources:
            return id
        ours = IDS.get(id, id)
        return ours if ours in self.descriptions else id

    def _reserved(self, id: str) -> Resource:
        id = self.known_id(id)
        stand_in = self._stand_ins.get(id)
        if stand_in is not None:
            return self._reserved(stand_in)
        resource = self._resource(id)
        try:
            if resource.is_hardware and self.clock.is_fake and not resource.is_active:
                type = resource.description.type
                raise NotAvailable(f"{id}: {type} needs real time - use its stand-in")
            resource.reserve()
        except NotAvailable as error:
            return self._replacement(resource, error)
        with self._lock:
            if resource not in self._open:
                self._open.append(resource)
        return resource

    def _replacement(self, missing: Resource, error: NotAvailable) -> Resource:
        is_to_wait = self.waits_for_devices and not self.clock.is_fake
        if is_to_wait and (waiting := self._waiting(missing, error)) is not None:
            return waiting
        description = missing.description
        stand_in = description.text("stand_in")
        if not stand_in or (is_to_wait and self._is_simulated(stand_in)):
            raise error
        replacement = self._reserved(stand_in)
        with self._lock:
            is_news = description.id not in self._stand_ins
            self._stand_ins[description.id] = stand_in
        if is_news and not self.clock.is_fake:
            self.notice(f"{error} (using {stand_in} instead)")
        return replacement

    def _waiting(self, missing: Resource, error: NotAvailable) -> Resource | None:
        """What waits for a device, from now on in its place; None where none does."""
        from hri.hal.awaited import awaited  # only a service needs it

        if (waiting := awaited(missing)) is None:
            return None
        with self._lock:
            if self._resources[missing.id] is missing:
                self._resources[missing.id] = waiting
        waiting.report(error)
        return self._reserved(missing.id)

    def _is_simulated(self, id: str) -> bool:
        return self.driver_of(self._description(id)).is_simulated

    def _resource(self, id: str) -> Resource:
        """The one object of that id; its driver is not opened here."""
        with self._lock:
            if id not in self._resources:
                description = self._description(id)
                driver = self.driver_of(description)
                driver.check(description)
                self._resources[id] = driver(description, self)
            return self._resources[id]

    def _description(self, id: str) -> Description:
        description = self.descriptions.get(self.known_id(id))
        if description is None:
            raise HriError(f'no device "{id}" - {did_you_mean(id, self.descriptions)}')
        return description

    def driver_of(self, description: Description) -> type[Resource]:
        """The class that drives a device.

        Raises AuthoringError when nobody declares it, NotAvailable when it cannot be loaded.
        """
        name = description.driver or description.type
        try:
            if description.library is not None:
                found = load_class(description.library, name.rpartition(".")[2])
            else:
                found = registry.find("hri.resources", name)
        except NotAvailable:
            raise
        except HriError as error:
            what, _, remedy = str(error).partition(" - ")
            if description.library is None:
                remedy += f" (no spec of it in {spec_folders(description.type)} either)"
            raise description.error("type", what, remedy) from error
        if not (isinstance(found, type) and issubclass(found, Resource)):
            what = f"{name} is not a driver"
            raise description.error("type", what, "derive its class from hri.hal.resource.Resource")
        if missing := sorted(found.__abstractmethods__):
            raise description.error("type", f"{name} lacks {', '.join(missing)}", "write it")
        return found
