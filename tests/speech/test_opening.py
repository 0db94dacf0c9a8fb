"""A device that takes long to open does not hold the loop up."""

import threading
from contextlib import suppress

import pytest
import trio

from hri.behavior.behavior import Context
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.hal.camera import Camera
from hri.hal.drivers.memory import MemoryCamera, MemoryMicrophone, SilentSpeaker
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.recognizers.typed import TypedRecognizer
from hri.speech.synthesizers.silent import SilentVoice
from hri.speech.tasks import say, wait_for_speech
from hri.speech.voice import Voice
from hri.task.opening import opened
from hri.task.task_manager import TaskManager
from hri.task.vision import GetImage


class Door:
    """Opens once the loop has gone on."""

    def __init__(self):
        self.knocked, self.answered = threading.Event(), threading.Event()
        self.was_held_up = []

    def open(self):
        self.knocked.set()
        self.was_held_up.append(not self.answered.wait(10.0))

    async def answer(self):
        await trio.to_thread.run_sync(self.knocked.wait)
        self.answered.set()


def slow(driver, door, manager):
    """A driver of that class that takes its time."""

    class Slow(driver):
        def _open(self):
            door.open()
            super()._open()

    return Slow(Description(driver.__name__, f"Hri.{driver.__name__}"), manager)


def lived(door, job):
    """Run a job in a robot's loop whose devices all are slow to open."""
    clock = FakeClock()
    manager = ResourceManager(
        [
            Description(driver.__name__, f"Hri.{driver.__name__}")
            for driver in (SilentSpeaker, MemoryMicrophone, MemoryCamera)
        ]
        + [
            Description("SilentVoice", "Hri.SilentVoice"),
            Description("TypedRecognizer", "Hri.Typed"),
        ],
        clock,
    )
    for driver in (SilentVoice, SilentSpeaker, MemoryMicrophone, MemoryCamera, TypedRecognizer):
        manager.substitute(driver.__name__, slow(driver, door, manager))
    tasks = TaskManager(Context(clock, EventBus(clock), manager)).context

    async def main():
        async with trio.open_nursery() as nursery:
            tasks.manager.live_in(nursery)
            nursery.start_soon(clock.drive)
            nursery.start_soon(tasks.networks.run)
            nursery.start_soon(door.answer)
            await tasks.manager.run(job)
            nursery.cancel_scope.cancel()

    trio.run(main)
    tasks.networks.close()
    manager.close()
    return tasks


JOBS = {
    "Speak": lambda context: say(context, "one two three"),
    "WaitForSpeech": lambda context: wait_for_speech(context, timeout=0.1),
}


@pytest.mark.parametrize("name", JOBS)
def test_networks_go_on_while_voice_and_ears_open(name):
    door = Door()
    lived(door, JOBS[name])
    assert door.was_held_up == [False, False]


def test_networks_go_on_while_a_camera_opens():
    door = Door()

    async def look(context):
        with suppress(HriError):  # it has no picture
            await GetImage.function(context)

    lived(door, look)
    assert door.was_held_up == [False]


def test_tasks_that_speak_at_once_share_a_voice():
    door, voices = Door(), set()

    async def both(context):
        async with trio.open_nursery() as nursery:
            for text in ("one", "two"):
                nursery.start_soon(say, context, text)
        voices.update(one for one in context.behaviors.values() if isinstance(one, Voice))

    lived(door, both)
    assert len(voices) == 1
    assert len(door.was_held_up) == 2


def test_a_device_is_given_back():
    found = []

    async def look(context):
        async with opened(context, Camera) as camera:
            found.append((camera, camera.is_active))

    lived(Door(), look)
    ((camera, was_active),) = found
    assert was_active
    assert not camera.is_active
