"""Tasks that find devices: FindResource, GetResource."""

from __future__ import annotations

from hri.core.errors import HriError, did_you_mean
from hri.hal.interface_2003 import own_interfaces
from hri.hal.resource import Resource
from hri.hal.resource_manager import ResourceManager
from hri.task.context import TaskContext
from hri.task.library import tasks_by_name
from hri.task.task import task

__all__ = ["FindResource", "GetResource"]

__getattr__, __dir__ = tasks_by_name(__name__, *__all__)


@task("Hri.FindResource")
async def FindResource(context: TaskContext, interface: str) -> str:
    """The id of the first device with an interface, such as "Camera"; fails without one.

    The names of 2003, "ICamera", and an INTERFACE_ID of your own are understood.
    """
    known = _interfaces(context.resources)
    name = interface if interface in known else interface.removeprefix("I")
    if name not in known:
        raise HriError(f'no device is a "{interface}" - {did_you_mean(name, known)}')
    return context.resources.ids(known[name])[0]


@task("Hri.GetResource")
async def GetResource(context: TaskContext, id: str) -> Resource:
    """The device of that id, open."""
    return context.resources.obtain(id, Resource)


def _interfaces(resources: ResourceManager) -> dict[str, type[Resource]]:
    """What the devices of the configuration are, by name."""
    drivers = [resources.driver_of(resources.descriptions[id]) for id in resources.ids(Resource)]
    kinds = {cls for driver in drivers for cls in driver.__mro__ if issubclass(cls, Resource)}
    own = {id: cls for driver in drivers for id, cls in own_interfaces(driver).items()}
    return {cls.__name__: cls for cls in kinds if cls is not Resource} | own
