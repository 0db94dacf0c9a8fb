"""The device that a driver works over: the one its parameter names, or the first that fits."""

from __future__ import annotations

from typing import TypeVar

from hri.hal.resource import Resource

R = TypeVar("R", bound=Resource)


def use_partner(driver: Resource, parameter: str, interface: type[R]) -> R:
    """Open it for as long as the driver is open. Raises NotAvailable where there is none."""
    named = driver.description.text(parameter)
    ids = [named] if named else driver.manager.ids(interface)
    if not ids:
        kind = interface.__name__.lower()
        raise driver.not_available(f"the configuration has no {kind}", "add one to it")
    return driver.use(ids[0], interface)
