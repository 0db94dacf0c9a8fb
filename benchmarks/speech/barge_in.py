"""Stop words over the robot's own voice, in the simulated room, for each kind of voice.

The robot says a story, its microphone hears its loudspeaker, and a person says "stop" or the like
at a time drawn by chance; also by its name, and with other grammars in force than the companion's.
"""

from __future__ import annotations

import math
import os
import random
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from benchmarks.progress import progress
from benchmarks.speech import printed
from hri.bench.speech.listening import ONE_CORE
from hri.bench.speech.samples import Recordings
from hri.bench.table import Row, amount, at_least, at_most, share
from hri.bench.workers import variables, worker_pool
from hri.core.clock import FakeClock
from hri.core.signals import Event
from hri.hal.resource import Description
from hri.hal.synthesizer import Synthesizer
from hri.robot import Job, Robot, verbs
from hri.simulation.people.person import Spoken
from hri.simulation.simulated_devices import SimulatedSpeaker
from hri.simulation.world import SimulatedWorld
from hri.speech.behaviors import Listener, Voice
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.synthesizers.natural import NaturalVoice
from hri.task.context import TaskContext
from hri.testing import live_for

WHAT = "stop words over its own voice"
TRIES = 20
"""Stop words for each voice and loudness."""
LEVELS = (-24.0, -12.0, -6.0)
"""How loud its voice is at the microphone, dB against what the loudspeaker plays."""
WORDS = ("stop", "be quiet", "stop talking")
CALLED = ("stop", "robin stop", "stop robin", "please stop", "be quiet", "robin be quiet")
SIZES, JOKE = (Path(__file__).with_name(name) for name in ("sizes.jsgf", "joke.jsgf"))
STORY = (
    "Now I shall tell you of a robot that went to the sea. "
    "It was a dark and stormy night, and nobody was there, but for a bird that could not sleep. "
    "They talked until the morning came, and then they went to look for something to eat. "
    "Turn left, said the bird, and go forward ten meters, and there is the kitchen."
)
EARLIEST, LATEST = 1.0, 11.0
"""Seconds between which the person begins."""
AROUND = 0.2
"""Seconds by which the beginning or the end of words that were heard may be wrong."""
APP = """<BehaviorNetwork name="talk" invocation_interval="1/30">
  <Behavior id="voice" type="Hri.Voice"/>
  <Behavior id="listener" type="Hri.Recognizer">
    <Parameter name="grammar" value="{grammar}"/>
    <Parameter name="robot_name" value="Robin"/>
  </Behavior>
  <Link from="voice.is_speaking" to="listener.is_speaking"/>
  <Link from="voice.speech" to="listener.speech"/>
  <Link from="voice.position" to="listener.position"/>
</BehaviorNetwork>
"""


async def _tell(context: TaskContext) -> None:
    context.behavior(Voice).say(STORY)


async def _ask(context: TaskContext) -> None:
    await verbs.ask(context, STORY, grammar=str(SIZES))


async def _use(context: TaskContext) -> None:
    context.behavior(Listener).use(SIZES)
    await _tell(context)


@dataclass(frozen=True, slots=True)
class InForce:
    """What is listened for while it speaks."""

    name: str
    first: str
    """Name or path of the grammar that the listener starts with."""
    tell: Job
    """Says the story."""


COMPANION = InForce("the companion's grammar", "companion", _tell)
GRAMMARS = (
    COMPANION,
    InForce("a grammar to ask with", "companion", _ask),
    InForce("a grammar that is used", "companion", _use),
    InForce("a grammar that extends it", str(JOKE), _tell),
)


@dataclass(frozen=True, slots=True)
class Case:
    """Who speaks, and what is said over it."""

    name: str
    voice: type[Synthesizer]
    words: Sequence[str] = WORDS
    in_force: InForce = COMPANION
    least: float = 0.95
    """Share of the stop words that must be heard."""
    soon: float = 0.3
    """Seconds from the last sound to silence that half of them may take at most."""


NATURAL = Case("natural voice", NaturalVoice)
CASES = (
    Case("espeak-ng", EspeakVoice),
    NATURAL,
    *(
        Case(f"by its name, {one.name}", NaturalVoice, CALLED, one, 58 / 60, 0.35)
        for one in GRAMMARS
    ),
)


@dataclass(frozen=True, slots=True)
class Interruption:
    """What became of one stop word."""

    what: str
    """The words, for people."""
    delay: float | None
    """Seconds from its last sound to silence; None: it was not heard."""
    obeyed: tuple[str, ...]
    """The robot's own words that it took for someone's."""


def rows(step: int = 1) -> Iterator[Row]:
    """Heard, how soon, and own words obeyed, of each case; every `step`th stop word is said."""
    with variables(**ONE_CORE), worker_pool(os.cpu_count() or 1) as pool:
        for case in CASES:
            numbers = range(0, TRIES, step)
            each = [(level, number) for level in LEVELS for number in numbers]
            tried = pool.map(partial(interrupted, case), *zip(*each, strict=True))
            tries = list(progress(tried, len(each), f"{WHAT}, {case.name}"))
            yield from _counted(case, tries)


def _counted(case: Case, tries: Sequence[Interruption]) -> Iterator[Row]:
    delays = [one.delay for one in tries if one.delay is not None]
    yield share(f"{WHAT}, {case.name}", len(delays), len(tries), at_least(case.least)) | {
        "clips": [one.what for one in tries if one.delay is None]
    }
    for what, part, limit in (("median", 0.5, at_most(case.soon)), ("p95", 0.95, None)):
        delay = float(np.quantile(delays, part)) if delays else math.inf
        yield amount(f"last sound to silence, {what}, {case.name}", delay, "s", limit)
    obeyed = [f"{one.what}: {words}" for one in tries for words in one.obeyed]
    yield amount(
        f"own words obeyed, {case.name}", len(obeyed), "sentences", at_most(0), clips=obeyed
    )


def interrupted(case: Case, level: float, number: int) -> Interruption:
    """One stop word over a voice that is that loud at the microphone."""
    chance = random.Random(number)
    at, word = chance.uniform(EARLIEST, LATEST), chance.choice(case.words)
    with tempfile.TemporaryDirectory() as folder:
        robot = talker(Path(folder), case, level, number)
        world = robot.resources.obtain("world", SimulatedWorld)
        clock = robot.clock
        person = world.person
        clock.call_at(at, lambda: world.say(word, clock.now()))
        events = live_for(robot, LATEST + 4.0, case.in_force.tell)
    (spoken,) = person.spoken
    heard = [event for event in events if event.name == "speech.heard"]
    theirs = [event for event in heard if _is_of(event, spoken)]
    own = [event.properties for event in heard if event not in theirs]
    return Interruption(
        f'"{word}" after {at:.1f} s, {level:g} dB, number {number}',
        theirs[0].time - _end(spoken) if theirs else None,
        tuple(f'"{one["text"]}" at {one["start"]:.1f} s, {one["confidence"]:.2f}' for one in own),
    )


def _is_of(heard: Event, spoken: Spoken) -> bool:
    """Whether what was heard is at the time at which someone spoke."""
    times = heard.properties
    return bool(times["end"] > spoken.start + AROUND and times["start"] < _end(spoken) - AROUND)


def _end(spoken: Spoken) -> float:
    """Seconds at which the last sound ends."""
    words = spoken.speech.words
    return spoken.start + (words[-1].end if words else spoken.speech.duration)


def talker(folder: Path, case: Case, level: float, seed: int) -> Robot:
    """A robot that is a voice and ears; its app is written into a folder."""
    (folder / "talk.xml").write_text(APP.format(grammar=case.in_force.first))
    (folder / "app.toml").write_text('about = "talks"\nnetworks = ["talk.xml"]\n')
    robot = Robot(str(folder), "simulated", clock=FakeClock(), seed=seed)
    loud = Description("speaker", "Hri.SimulatedSpeaker", {"level": str(level)})
    for device in (
        SimulatedSpeaker(loud, robot.resources),
        case.voice(Description("voice", f"Hri.{case.voice.__name__}"), robot.resources),
    ):
        device.activate()
        robot.resources.substitute(device.description.id, device)
    return robot


def _printed(people: Recordings | None, step: int) -> Iterator[Row]:
    return rows(step)


if __name__ == "__main__":
    printed.main(__doc__, _printed)
