"""Base class of behaviors that use devices."""

from __future__ import annotations

from typing import TypeVar

from hri.behavior.behavior import Behavior, Context
from hri.core.errors import HriError
from hri.hal.resource import Resource

R = TypeVar("R", bound=Resource)


class DeviceBehavior(Behavior):
    """A behavior with devices; it releases them when it stops."""

    category = "drivers"

    def start(self, context: Context) -> None:
        self._resources = context.resources
        self._held: list[Resource] = []

    def obtain(self, id: str, interface: type[R]) -> R:
        """A device, until this behavior stops. Raises as `ResourceManager.obtain` does."""
        try:
            resource = self._resources.obtain(id, interface)
        except HriError:
            # A behavior that cannot start is never stopped.
            self._give_back()
            raise
        self._held.append(resource)
        return resource

    def stop(self) -> None:
        self._give_back()

    def _give_back(self) -> None:
        while self._held:
            self._resources.release(self._held.pop())
