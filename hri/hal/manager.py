"""Hands out resources by id: opened when first asked for, closed in reverse order."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from typing import TypeVar

from hri.core import registry
from hri.core.clock import Clock
from hri.core.errors import HriError, NotAvailable, did_you_mean
from hri.hal.resource import Description, Resource

R = TypeVar("R", bound=Resource)


class ResourceManager:
    """All devices of a configuration; `close()` is safe to call twice."""

    def __init__(
        self,
        descriptions: Iterable[Description],
        clock: Clock,
        notice: Callable[[str], object] = print,
    ) -> None:
        """`notice` gets one line for each stand-in that is used."""
        self.clock = clock
        self.descriptions = {description.id: description for description in descriptions}
        self.notice = notice
        self._lock = threading.RLock()
        self._open: dict[str, Resource] = {}
        self._stand_ins: dict[str, str] = {}

    def check(self) -> None:
        """Look up every type and parameter before anything starts. Raises AuthoringError."""
        for description in self.descriptions.values():
            self._driver(description)
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

    def obtain(self, id: str, interface: type[R]) -> R:
        """The open resource of that id, its stand-in where it is not there.

        Raises HriError for an unknown id or a wrong interface, NotAvailable when neither the
        device nor a stand-in can be opened.
        """
        with self._lock:
            if id not in self._open:
                self._open[id] = self._opened(id)
            resource = self._open[id]
        if not isinstance(resource, interface):
            raise HriError(
                f'"{id}" is a {type(resource).__name__}, no {interface.__name__} - check the id'
            )
        return resource

    def find(self, interface: type[R]) -> R | None:
        """The first resource of the configuration with that interface; None without one."""
        for description in self.descriptions.values():
            if issubclass(self._driver(description), interface):
                return self.obtain(description.id, interface)
        return None

    def ids(self, interface: type[Resource]) -> list[str]:
        """Ids of all devices of the configuration with that interface."""
        return [d.id for d in self.descriptions.values() if issubclass(self._driver(d), interface)]

    def stand_in_of(self, id: str) -> str | None:
        """Id of the device that stands in for this one; None when it is there itself."""
        return self._stand_ins.get(id)

    def substitute(self, id: str, resource: Resource) -> None:
        """Use this resource under that id: for tests, recordings, files of the command line."""
        with self._lock:
            self._open[id] = resource
            self._stand_ins.pop(id, None)

    def close(self) -> None:
        """Deactivate everything, newest first."""
        with self._lock:
            while self._open:
                _, resource = self._open.popitem()
                resource.deactivate()

    def _opened(self, id: str) -> Resource:
        description = self.descriptions.get(id)
        if description is None:
            raise HriError(f'no device "{id}" - {did_you_mean(id, self.descriptions)}')
        driver = self._driver(description)
        stand_in = description.text("stand_in")
        try:
            if driver.is_hardware and self.clock.is_fake:
                raise NotAvailable(f"{id}: {description.type} needs real time - use its stand-in")
            resource = driver(description, self)
            resource.activate()
            return resource
        except NotAvailable as error:
            if not stand_in:
                raise
            replacement = self.obtain(stand_in, Resource)
            self._stand_ins[id] = stand_in
            if not self.clock.is_fake:
                self.notice(f"{error} (using {stand_in} instead)")
            return replacement

    def _driver(self, description: Description) -> type[Resource]:
        try:
            driver: type[Resource] = registry.find("hri.resources", description.type)
        except NotAvailable:
            raise
        except HriError as error:
            what, _, remedy = str(error).partition(" - ")
            raise description.error("type", what, remedy) from error
        driver.check(description)
        return driver
