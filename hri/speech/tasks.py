"""Speech tasks. If no running network has a voice or a listener, they start one."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

from hri.behavior.behavior import Behavior
from hri.behavior.network import Network
from hri.behavior.ports import InputPort
from hri.core.errors import HriError
from hri.core.signals import Event, Utterance
from hri.hal.microphone import Microphone
from hri.hal.recognizer import Recognizer
from hri.hal.resource import Resource
from hri.hal.speaker import Speaker
from hri.hal.synthesizer import Synthesizer
from hri.speech.behaviors import Listener, Voice
from hri.speech.grammar import Grammar
from hri.speech.grammar_stack import Prepare, as_written
from hri.speech.ssml import Ssml
from hri.speech.turn import QUESTION
from hri.speech.voice import Saying
from hri.task.context import TaskContext
from hri.task.opening import opened
from hri.task.queue import EventQueue
from hri.task.task import task

LOOK_EVERY = 0.02
"""Seconds between looks at whether it has been said."""
OWN_INTERVAL = 0.05
"""Seconds between ticks of an own network."""


@task("Hri.Speak")
async def speak(context: TaskContext, text: str) -> None:
    """Say a text and wait until it has been said; when cancelled, it is cut at once."""
    await say(context, text)


async def say(context: TaskContext, text: str | Ssml) -> None:
    """Say a text and wait until it has been said or cut; when cancelled, it is cut.

    Sentences of several tasks come one after the other.
    """
    voice = await voice_of(context)
    async with context.claim("voice"):
        await _until_done(context, voice, voice.say(text))


async def play(context: TaskContext, path: Path | str, text: str = "") -> None:
    """Play a sound file through the voice, with moving lips, and wait until it has been heard.

    `text` is what it says, where that is known. When cancelled, it is cut. Raises HriError for a
    file that cannot be read.
    """
    voice = await voice_of(context)
    async with context.claim("voice"):
        saying = voice.play(path, text)
        await _until_done(context, voice, saying)
        if saying.error is not None:
            raise saying.error


async def _until_done(context: TaskContext, voice: Voice, saying: Saying) -> None:
    try:
        while not saying.is_done:
            await context.clock.sleep(LOOK_EVERY)
    finally:
        voice.cancel(saying)


def hears_people(context: TaskContext) -> bool:
    """Whether a real microphone listens: not a simulated one, a file or a keyboard."""
    return any(ear.is_hardware for ear in context.resources.opened(Microphone))


async def wait_for_speech(
    context: TaskContext, rules: str = "", timeout: float = float("inf"), grammar: str = ""
) -> Utterance | None:
    """The next thing heard by one of these rules, spaces between; by any when none is named.

    None when nothing of that kind is heard in `timeout` seconds. With the name or path of a
    `grammar`, which is looked for in the app's own folder first, that one is in force meanwhile;
    raises HriError for one that cannot be used.
    """
    if grammar:
        async with answers_of(context, grammar):
            return await wait_for_speech(context, rules, timeout)
    listener = await listener_of(context)
    end = context.clock.now() + timeout
    with context.queue("speech.heard") as queue:
        while (event := await next_heard(context, queue, end)) is not None:
            if not rules or event.properties["rule"] in rules.split():
                return listener.last_utterance
    return None


async def next_heard(context: TaskContext, queue: EventQueue, end: float) -> Event | None:
    """The next event of a queue, None after the time `end`; who speaks by then is heard out."""
    while True:
        listener = context.find_behavior(Listener)
        now = context.clock.now()
        if now >= end and (listener is None or listener.is_idle):
            return None
        event: Event | None = None
        with context.clock.move_on_after(max(LOOK_EVERY, end - now)):
            event = await queue.get()
        if event is not None:
            return event


@asynccontextmanager
async def answers_of(
    context: TaskContext, grammar: str, prepare: Prepare = as_written
) -> AsyncIterator[Grammar]:
    """Let another grammar be in force while the body runs; the grammar as its file has it.

    `prepare` makes what is heard of it. The interrupting rules of those below stay in force.
    Raises HriError for a grammar that is not there or cannot be used.
    """
    listener = await listener_of(context)
    layer = listener.push(grammar, prepare)
    try:
        while not listener.is_in_force(layer):
            if layer.error is not None:
                raise layer.error
            await context.clock.sleep(LOOK_EVERY)
        assert layer.grammar is not None
        yield layer.grammar
    finally:
        listener.pop(layer)


async def voice_of(context: TaskContext) -> Voice:
    """The voice that runs, else one that is started now. Raises HriError without a device."""
    if (running := context.find_behavior(Voice)) is not None:
        return running
    ids = {"voice_id": _id(context, Synthesizer), "speaker_id": _id(context, Speaker)}
    async with (
        opened(context, Synthesizer, ids["voice_id"]),
        opened(context, Speaker, ids["speaker_id"]),
    ):
        if (started := context.find_behavior(Voice)) is not None:
            return started  # by another task, meanwhile
        voice = Voice("voice", **ids)
        _start(context, voice)
        if (listener := context.find_behavior(Listener)) is not None:
            _let_tell(voice, listener)
        return voice


async def listener_of(context: TaskContext) -> Listener:
    """The ears that run, else some that are started now. Raises HriError without a device."""
    if (running := context.find_behavior(Listener)) is not None:
        return running
    ids = {"microphone_id": _id(context, Microphone), "recognizer_id": _id(context, Recognizer)}
    async with (
        opened(context, Recognizer, ids["recognizer_id"]),
        opened(context, Microphone, ids["microphone_id"]),
    ):
        if (started := context.find_behavior(Listener)) is not None:
            return started
        listener = Listener("listener", **ids)
        if (voice := context.find_behavior(Voice)) is not None:
            _let_tell(voice, listener)
        _start(context, listener, (f"board.{QUESTION}", listener.question))
        return listener


def _let_tell(voice: Voice, listener: Listener) -> None:
    """Let the voice tell the ears what it says, so that the robot does not hear itself."""
    if not listener.is_speaking.sources:
        listener.is_speaking.sources.append(voice.is_speaking)
        listener.speech.sources.append(voice.speech)
        listener.position.sources.append(voice.position)


def _start(context: TaskContext, behavior: Behavior, *links: tuple[str, InputPort[Any]]) -> None:
    network = Network(f"own {behavior.id}", OWN_INTERVAL, [behavior])
    for source, target in links:
        network.connect(source, target)
    network.sort()
    context.networks.start(network)


def _id(context: TaskContext, interface: type[Resource]) -> str:
    """The first device with that interface."""
    ids = context.resources.ids(interface)
    if not ids:
        raise HriError(f"no {interface.__name__.lower()} in the configuration - add one")
    return ids[0]
