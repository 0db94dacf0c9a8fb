"""Whether the face agrees with what the robot feels and says: visits in which people praise, scold,
comfort and bump it.

A contradiction is a smile for a quarter of a second while it shows an unpleasant feeling, a frown
while it shows a pleasant one, a tear or the like beside a glad face, a merry gesture in anger, fear
or sadness, and words of joy in them, or of sorrow in joy.
"""

from __future__ import annotations

import math
import random
import re
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from hri.bench.table import Row, amount, at_most
from hri.conversation import sentiment_of
from hri.conversation.sentiment import Sentiment
from hri.core.clock import FakeClock
from hri.core.latest import Latest
from hri.core.signals import Event, Expression
from hri.face.behaviors import Face
from hri.hal.resource import Description
from hri.robot import Robot
from hri.simulation.world import SimulatedWorld
from hri.speech.behaviors import Listener
from hri.task import TaskContext
from hri.testing import live_for

VISITS = 20
SECONDS = 100.0
PAUSE = (4.0, 9.0)
"""Seconds from one line to the next."""
LINES = (
    "hello robot", "how are you", "you are great", "you are wonderful", "bad robot", "you are ugly",
    "i am sad", "my dog died", "tell me a joke", "another one", "thank you", "i love you",
    "i hate you", "good bye", "what do you feel", "why are you sad", "are you happy", "shut up",
    "i had a bad day", "i am happy", "you are stupid", "i am sorry", "sing a song", "good job",
    "show me a happy face", "show me a sad face", "how old are you", "stop", "you may move",
)  # fmt: skip
PLEASANT = ("happy", "excited", "amazed")
UNPLEASANT = (
    "sad", "angry", "scared", "disgusted", "disappointed", "despaired", "annoyed", "furious",
    "horrified", "guilty", "rejected",
)  # fmt: skip
MERRY = ("laugh", "wink", "beam", "bounce", "secretSmile", "glow", "sway")
MERRY_SOUNDS = ("laugh", "giggle", "chuckle", "snicker", "yay", "whee")
TEARFUL = ("tear", "tearRight", "gloom")
GLAD_WORDS = (Sentiment.GLAD, Sentiment.KIND)
SORRY_WORDS = (Sentiment.SAD, Sentiment.AFRAID, Sentiment.ANGRY)
SENTENCE = re.compile(r"[^.!?]+[.!?]*")
STRONG = 0.3
"""Intensity of an expression from which on it counts."""
SMILES, FROWNS, SEEN = 0.3, 0.35, 0.2
"""Weights from which on they count."""
LOOK_EVERY = 0.05
LASTS = 0.5
"""Seconds that a face may go against the feeling: an expression takes as long to come."""
NOTED = math.inf
TYPED = (
    Description("screen", "Hri.BlankScreen"),
    Description("recognizer", "Hri.Typed"),
    Description("camera", "Hri.BlankCamera"),
    Description("microphone", "Hri.MemoryMicrophone"),
)
"""Of a robot that hears what is typed."""


@dataclass(frozen=True, slots=True)
class Contradiction:
    """A moment in which face, feeling and words do not agree."""

    time: float
    what: str


class Looking:
    """Looks at one robot."""

    def __init__(self, context: TaskContext) -> None:
        self.found: list[Contradiction] = []
        self._context = context
        self._face = context.behavior(Face)
        self._since: dict[str, float] = {}
        context.events.subscribe("speech.said", self._on_said)
        context.events.subscribe("gesture.started", self._on_gesture)

    async def live(self) -> None:
        while True:
            await self._context.clock.sleep(LOOK_EVERY)
            self.look(self._context.clock.now())

    def look(self, now: float) -> None:
        """Compare the face with the feelings, at a time in seconds."""
        weights = self._face.weights.value
        if weights is None:
            return

        def of(*names: str) -> float:
            return max(weights.values.get(name, 0.0) for name in names)

        shown = self._shown()
        smiles = of("mouthSmileLeft", "mouthSmileRight") > SMILES
        frowns = of("mouthFrownLeft", "mouthFrownRight") > FROWNS
        self._hold(now, "smiles", shown, shown in UNPLEASANT and smiles)
        self._hold(now, "frowns", shown, shown in PLEASANT and frowns)
        self._hold(now, "tears", shown, shown in PLEASANT and of(*TEARFUL) > SEEN)

    def _hold(self, now: float, what: str, shown: str, is_so: bool) -> None:
        """Note what has held for long enough, once."""
        since = self._since.setdefault(what, now) if is_so else now
        if not is_so:
            self._since.pop(what, None)
        elif now - since >= LASTS and since != NOTED:
            self._since[what] = NOTED
            self.found.append(Contradiction(now, f"{what}, {shown}"))

    def _shown(self) -> str:
        """The expression that is shown, if strongly enough; "" for none."""
        slot: Latest[Expression] = self._context.board.slot("expression")
        expression = slot.value or Expression()
        return expression.label if expression.intensity >= STRONG else ""

    def _on_said(self, event: Event) -> None:
        self._context.manager.install(self._judge, str(event.properties["text"]))

    async def _judge(self, context: TaskContext, text: str) -> None:
        """Compare words with the face that goes with them, once it has had time to change."""
        await context.clock.sleep(LASTS)
        shown, sentences = self._shown(), SENTENCE.findall(text)
        said = [sentiment_of(one) for one in sentences if not one.endswith("?")]
        is_glad = any(one in GLAD_WORDS for one in said)
        is_glad = is_glad or any(f"[{sound}" in text for sound in MERRY_SOUNDS)
        is_sorry = any(one in SORRY_WORDS for one in said)
        if is_glad != is_sorry and shown in (UNPLEASANT if is_glad else PLEASANT):
            self.found.append(Contradiction(context.clock.now(), f'says "{text}", {shown}'))

    def _on_gesture(self, event: Event) -> None:
        name, shown = event.properties["name"], self._shown()
        if name in MERRY and shown in UNPLEASANT:
            self.found.append(Contradiction(event.time, f"makes {name}, {shown}"))


def rows() -> Iterator[Row]:
    """The contradictions of all visits."""
    found = [(seed, one) for seed in range(VISITS) for one in contradictions(seed)]
    for seed, one in found:
        print(f"visit {seed}, {one.time:.1f} s: {one.what}", file=sys.stderr)
    what = f"contradictions of face, feeling and words in {VISITS} visits of {SECONDS:g} s"
    yield amount(what, len(found), "", at_most(0))


def contradictions(seed: int) -> Sequence[Contradiction]:
    """Those of one visit."""
    chance = random.Random(seed)
    robot = Robot(config="simulated", clock=FakeClock(), seed=seed, devices=TYPED)
    robot.resources.obtain("world", SimulatedWorld).bump(chance.uniform(20.0, SECONDS - 20.0))
    looking: list[Looking] = []

    async def talk(context: TaskContext) -> None:
        while True:
            await context.clock.sleep(chance.uniform(*PAUSE))
            context.behavior(Listener).type_line(chance.choice(LINES))

    async def lower(context: TaskContext) -> None:
        await context.clock.sleep(chance.uniform(20.0, SECONDS - 20.0))
        context.events.raise_event("battery.lowered", level=0.15)

    async def look(context: TaskContext) -> None:
        looking.append(Looking(context))
        await looking[0].live()

    live_for(robot, SECONDS, *robot.app.load_tasks(), talk, lower, look)
    return looking[0].found


if __name__ == "__main__":
    for row in rows():
        print(row)
