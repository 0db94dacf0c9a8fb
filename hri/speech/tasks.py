"""What tasks do with speech. Where no network has a voice or ears, they start one of their own."""

from __future__ import annotations

from hri.behavior.behavior import Behavior
from hri.behavior.network import Network
from hri.core.errors import HriError
from hri.hal.microphone import Microphone
from hri.hal.recognizer import Recognizer
from hri.hal.resource import Resource
from hri.hal.speaker import Speaker
from hri.hal.synthesizer import Synthesizer
from hri.speech.behaviors import Listener, Voice
from hri.task.context import TaskContext
from hri.task.task import task

LOOK_EVERY = 0.02
"""Seconds between looks at whether it has been said."""
OWN_INTERVAL = 0.05
"""Seconds between ticks of an own network."""


@task("Hri.Speak")
async def speak(context: TaskContext, text: str) -> None:
    """Say a text and wait until it has been said; when cancelled, it is cut at once."""
    await say(context, text)


async def say(context: TaskContext, text: str) -> None:
    """Say a text and wait until it has been said or cut; when cancelled, it is cut.

    Sentences of several tasks come one after the other.
    """
    voice = voice_of(context)
    async with context.claim("voice"):
        saying = voice.say(text)
        try:
            while not saying.is_done:
                await context.clock.sleep(LOOK_EVERY)
        finally:
            voice.cancel(saying)


def voice_of(context: TaskContext) -> Voice:
    """The voice that runs, else one that is started now. Raises HriError without a device."""
    voice = context.find_behavior(Voice)
    if voice is None:
        ids = {"voice_id": _id(context, Synthesizer), "speaker_id": _id(context, Speaker)}
        voice = Voice("voice", **ids)
        _start(context, voice)
    return voice


def listener_of(context: TaskContext) -> Listener:
    """The ears that run, else some that are started now. Raises HriError without a device."""
    listener = context.find_behavior(Listener)
    if listener is None:
        microphone, recognizer = _id(context, Microphone), _id(context, Recognizer)
        listener = Listener("listener", microphone_id=microphone, recognizer_id=recognizer)
        _start(context, listener)
    return listener


def _start(context: TaskContext, behavior: Behavior) -> None:
    context.networks.start(Network(f"own {behavior.id}", OWN_INTERVAL, [behavior]))


def _id(context: TaskContext, interface: type[Resource]) -> str:
    """The first device with that interface."""
    ids = context.resources.ids(interface)
    if not ids:
        raise HriError(f"no {interface.__name__.lower()} in the configuration - add one")
    return ids[0]
