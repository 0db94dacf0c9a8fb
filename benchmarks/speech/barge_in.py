"""Stop words over the robot's own voice, in the simulated room, for each kind of voice.

The robot says a story, its microphone hears its loudspeaker, and a person says "stop" or the like
at a time drawn by chance.
"""

from __future__ import annotations

import math
import random
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hri.bench.table import Row, amount, at_least, at_most, share
from hri.core.clock import FakeClock
from hri.hal.resource import Description
from hri.hal.synthesizer import Synthesizer
from hri.robot import Robot
from hri.simulation.simulated_devices import SimulatedSpeaker
from hri.simulation.world import SimulatedWorld
from hri.speech.behaviors import Voice
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
STORY = (
    "Now I shall tell you of a robot that went to the sea. "
    "It was a dark and stormy night, and nobody was there, but for a bird that could not sleep. "
    "They talked until the morning came, and then they went to look for something to eat. "
    "Turn left, said the bird, and go forward ten meters, and there is the kitchen."
)
EARLIEST, LATEST = 1.0, 11.0
"""Seconds between which the person begins."""
AROUND = 0.2
"""Seconds by which the beginning of a word that was heard may be wrong."""
APP = """<BehaviorNetwork name="talk" invocation_interval="1/30">
  <Behavior id="voice" type="Hri.Voice"/>
  <Behavior id="listener" type="Hri.Recognizer"/>
  <Link from="voice.is_speaking" to="listener.is_speaking"/>
  <Link from="voice.speech" to="listener.speech"/>
  <Link from="voice.position" to="listener.position"/>
</BehaviorNetwork>
"""


@dataclass(frozen=True, slots=True)
class Interruption:
    """What became of one stop word."""

    delay: float | None
    """Seconds from its last sound to silence; None: it was not heard."""
    obeyed: int
    """The robot's sentences that it took for someone's."""


def rows() -> Iterator[Row]:
    """Heard, how soon, and own words obeyed, of both voices."""
    for name, kind in (("espeak-ng", EspeakVoice), ("natural voice", NaturalVoice)):
        tries = [interrupted(kind, level, n) for level in LEVELS for n in range(TRIES)]
        delays = [t.delay for t in tries if t.delay is not None]
        yield share(f"{WHAT}, {name}", len(delays), len(tries), at_least(0.95))
        for what, part, limit in (("median", 0.5, at_most(0.3)), ("p95", 0.95, None)):
            delay = float(np.quantile(delays, part)) if delays else math.inf
            yield amount(f"last sound to silence, {what}, {name}", delay, "s", limit)
        obeyed = sum(t.obeyed for t in tries)
        yield amount(f"own words obeyed, {name}", obeyed, "sentences", at_most(0))


def interrupted(kind: type[Synthesizer], level: float, number: int) -> Interruption:
    """One stop word over a voice that is that loud at the microphone."""
    chance = random.Random(number)
    at, word = chance.uniform(EARLIEST, LATEST), chance.choice(WORDS)
    with tempfile.TemporaryDirectory() as folder:
        robot = _robot(Path(folder), kind, level, number)
        world = robot.resources.obtain("world", SimulatedWorld)
        clock = robot.clock
        person = world.person
        clock.call_at(at, lambda: world.say(word, clock.now()))
        events = live_for(robot, LATEST + 4.0, _tell)
    (spoken,) = person.spoken
    words = spoken.speech.words
    ended = spoken.start + (words[-1].end if words else spoken.speech.duration)
    cuts = [e.time for e in events if e.name == "speech.interrupted" and e.time > spoken.start]
    heard = [e.properties["start"] for e in events if e.name == "speech.heard"]
    obeyed = sum(start < spoken.start - AROUND for start in heard)
    return Interruption(cuts[0] - ended if cuts else None, obeyed)


async def _tell(context: TaskContext) -> None:
    context.behavior(Voice).say(STORY)


def _robot(folder: Path, kind: type[Synthesizer], level: float, seed: int) -> Robot:
    (folder / "talk.xml").write_text(APP)
    (folder / "app.toml").write_text('about = "talks"\nnetworks = ["talk.xml"]\n')
    robot = Robot(str(folder), "simulated", clock=FakeClock(), seed=seed)
    loud = Description("speaker", "Hri.SimulatedSpeaker", {"level": str(level)})
    for device in (
        SimulatedSpeaker(loud, robot.resources),
        kind(Description("voice", f"Hri.{kind.__name__}"), robot.resources),
    ):
        device.activate()
        robot.resources.substitute(device.description.id, device)
    return robot
