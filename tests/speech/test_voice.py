from __future__ import annotations

import pytest
import trio

from hri.behavior.behavior import Context
from hri.behavior.ports import OutputPort
from hri.core.events import EventBus
from hri.core.signals import Prosody
from hri.speech.behaviors import Voice
from hri.speech.tasks import say
from hri.task.context import TaskContext

from .fakes import TICK, Stage


def test_one_thing_is_said_after_the_other():
    stage = Stage(Voice())
    first, second = stage.behavior.say("hello"), stage.behavior.say("you")

    stage.run(0.3)
    assert stage.behavior.is_speaking.value
    assert stage.behavior.speech.value.text == "hello"
    assert 0.1 <= stage.behavior.position.value <= 0.3
    stage.run(0.4)
    assert (first.is_done, second.is_done) == (True, False)
    stage.run(0.6)

    assert (second.is_done, second.was_cut) == (True, False)
    assert stage.behavior.is_idle
    assert [(name, properties) for _, name, properties in stage.events] == [
        ("speech.said", {"text": "hello"}),
        ("speech.finished", {"text": "hello", "cut": False}),
        ("speech.said", {"text": "you"}),
        ("speech.finished", {"text": "you", "cut": False}),
    ]


def test_hush_cuts_the_sound_and_empties_the_queue():
    stage = Stage(Voice())
    sayings = [stage.behavior.say(text) for text in ("a long sentence", "another", "third")]

    stage.run(0.5)
    stage.behavior.hush()

    assert all(saying.is_done and saying.was_cut for saying in sayings)
    assert stage.speaker.position(stage.clock.now()) is None
    assert stage.names() == ["speech.said", "speech.finished"]
    stage.run(1.0)
    assert stage.behavior.is_idle
    assert not stage.behavior.is_speaking.value


def test_hush_reaches_a_sound_in_the_making():
    stage = Stage(Voice())
    stage.behavior.say("hello")
    stage.run(TICK)

    stage.behavior.hush()
    stage.behavior.say("new")
    stage.run(1.0)

    assert [properties["text"] for _, name, properties in stage.events] == ["new", "new"]


def test_one_thing_can_be_taken_back():
    stage = Stage(Voice())
    first, second, third = (stage.behavior.say(text) for text in ("one", "two", "three"))

    stage.run(0.2)
    stage.behavior.cancel(second)
    stage.behavior.cancel(first)
    stage.run(1.5)

    assert (first.was_cut, second.was_cut, third.was_cut) == (True, True, False)
    said = [properties["text"] for _, name, properties in stage.events if name == "speech.said"]
    assert said == ["one", "three"]


def test_nothing_to_say_is_done_at_once():
    assert Stage(Voice()).behavior.say("  ").is_done


def test_prosody_shapes_the_speech():
    voice = Voice()
    port: OutputPort[Prosody] = OutputPort()
    voice.prosody.sources.append(port)
    stage = Stage(voice)
    port.value = Prosody(rate=2.0)

    saying = voice.say("hello there")
    stage.run(0.8)

    assert saying.is_done


def run_task(stage: Stage, seconds: float) -> None:
    """Let a task say something, cancelled after some seconds, while the behavior ticks."""
    lent = Context(stage.clock, EventBus(stage.clock), stage.resources)
    context = TaskContext.of(lent, {"net.voice": stage.behavior})

    async def tick() -> None:
        while True:
            await stage.clock.sleep(TICK)
            stage.behavior.compute(stage.clock.now(), TICK)

    async def main() -> None:
        async with trio.open_nursery() as nursery:
            nursery.start_soon(stage.clock.drive)
            nursery.start_soon(tick)
            with stage.clock.move_on_after(seconds):
                await say(context, "hello")
            nursery.cancel_scope.cancel()

    trio.run(main)


@pytest.mark.parametrize(("seconds", "was_cut"), [(10.0, False), (0.3, True)])
def test_the_task_waits_and_its_end_cuts_the_speech(seconds, was_cut):
    stage = Stage(Voice())

    run_task(stage, seconds)

    assert stage.events[-1][1:] == ("speech.finished", {"text": "hello", "cut": was_cut})
    assert stage.clock.now() == pytest.approx(0.3 if was_cut else 0.65, abs=0.1)
