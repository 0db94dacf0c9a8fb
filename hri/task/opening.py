"""Devices that tasks use for a while, opened aside: networks and other tasks go on meanwhile."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import TypeVar

from hri.core.errors import HriError
from hri.hal.resource import Resource
from hri.task.context import TaskContext

R = TypeVar("R", bound=Resource)


@asynccontextmanager
async def opened(context: TaskContext, interface: type[R], id: str = "") -> AsyncIterator[R]:
    """The device of that id while the body runs; without an id, the first with the interface.

    Opening loads networks and waits for hardware, which takes seconds: it is done in a thread.
    Raises HriError without such a device, NotAvailable when it cannot be opened.
    """
    resources = context.resources
    if id:
        resource = await context.blocking(resources.obtain, id, interface)
    else:
        resource = await context.blocking(resources.find, interface)
    if resource is None:
        raise HriError(f"no {interface.__name__.lower()} in the configuration - add one")
    try:
        yield resource
    finally:
        resources.release(resource)
