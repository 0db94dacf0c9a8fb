"""Tasks that see.

GetImage(camera_id="")               the next picture
SwitchCamera(on, camera_id="")
WaitForPerson(looking=False, within=0, timeout=inf)
LookAt(person="", seconds=0)
FindObject(name, distance=0), FollowObject(name, distance=0, seconds=0)    default units
WaitForObject(name="", timeout=inf)
LearnObject(name, seconds=5, camera_id="camera"), ForgetObject(name)
"""

from __future__ import annotations

from hri.core.errors import NotAvailable
from hri.core.signals import Frame
from hri.hal.camera import Camera
from hri.task.context import TaskContext
from hri.task.library import tasks_by_name
from hri.task.opening import opened
from hri.task.task import task

__all__ = [  # noqa: F822
    "FindObject",
    "FollowObject",
    "ForgetObject",
    "GetImage",
    "LearnObject",
    "LookAt",
    "SwitchCamera",
    "WaitForObject",
    "WaitForPerson",
]

__getattr__, __dir__ = tasks_by_name(__name__, *__all__)

TIMEOUT = 5.0
"""Seconds for a camera to give a picture."""
LOOK_EVERY = 0.02


@task("Hri.GetImage")
async def GetImage(context: TaskContext, camera_id: str = "") -> Frame:
    """The next picture of a camera, of the first one without an id; fails when none comes."""
    async with opened(context, Camera, camera_id) as camera:
        with context.clock.move_on_after(TIMEOUT):
            while (frame := camera.read(context.clock.now())) is None:
                if not camera.is_on:
                    context.fail(f"{camera.id} is switched off - switch it on")
                await context.clock.sleep(LOOK_EVERY)
            return frame
    context.fail(f"{camera.id} gave no picture within {TIMEOUT:g} s - unplug it and plug it in")


@task("Hri.SwitchCamera")
async def SwitchCamera(context: TaskContext, on: bool, camera_id: str = "") -> None:
    """Turn a camera on or off, the first one without an id; off lets the device go.

    It stays off for everyone until it is turned on. Fails when it cannot be opened again.
    """
    async with opened(context, Camera, camera_id) as camera:
        try:
            await context.blocking(camera.switch, on)
        except NotAvailable as error:
            context.fail(str(error))
