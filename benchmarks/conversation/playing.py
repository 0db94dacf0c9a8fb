"""Plays a talk: typed to a simulated companion whom a person stands in front of."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import pairwise
from tempfile import TemporaryDirectory
from typing import Any

from benchmarks.conversation.legs import Sample, legs
from benchmarks.conversation.talks import Talk, Turn
from benchmarks.conversation.transcript import STILL, Line, Words
from benchmarks.progress import progress
from hri.bench.speech.listening import ONE_CORE
from hri.bench.workers import variables, worker_pool
from hri.core.clock import Clock, FakeClock
from hri.core.origin import KEYBOARD, caused_by
from hri.core.signals import Event, Utterance
from hri.hal.drive import Odometry
from hri.hal.resource import Description
from hri.robot import Robot
from hri.robot.verbs import SHOWN
from hri.speech.behaviors import Listener, Voice
from hri.speech.turn import QUESTION
from hri.speech.understanding import Heard
from hri.task.context import TaskContext
from hri.testing import live_for

READY = 1.0
"""Seconds after which the companion listens."""
EVERY = 8.0
"""Seconds from one turn to the next."""
ANSWER_AFTER = 2.0
"""Seconds from the end of a question to the next turn, if that is sooner."""
AFTER_WORDS = 1.0
"""Seconds that a person waits where it still spoke then."""
PATIENCE = 30.0
"""Seconds after which nobody waits for the end of its words any more."""
WATCH_EVERY = 0.1
UNMOVED = 0.15
"""Seconds from a turn in which no motion begins because of it: understanding takes longer."""
LONGEST = 3600.0
"""Seconds that a life may last; it ends with its last turn."""
DEVICES = (
    Description("screen", "Hri.OffscreenScreen", {"width": "16", "height": "16"}),
    Description("recognizer", "Hri.Typed"),
    # Seeing is most of the time of a life, and the person only stands there.
    Description(
        "camera", "Hri.SimulatedCamera", {"width": "320", "height": "240", "rate": "2"}, "world"
    ),
    Description("microphone", "Hri.MemoryMicrophone"),
    Description("voice", "Hri.SilentVoice"),
)
"""A robot that hears what is typed, sees a person, and costs little time."""


@dataclass(slots=True)
class Seen:
    """What was noted while a robot lived."""

    turns: list[float] = field(default_factory=list)
    """When each was typed, and at the end when it was over."""
    heard: dict[int, Heard] = field(default_factory=dict)
    """What became of each, by its number from 0."""
    poses: list[Sample] = field(default_factory=list)
    shown: list[tuple[float, str]] = field(default_factory=list)


def play_all(talks: Sequence[Talk]) -> list[Line]:
    """Play talks side by side, each to a fresh robot; the lines in the order of the talks."""
    with variables(**ONE_CORE), worker_pool(os.cpu_count() or 1) as pool:
        played = progress(pool.map(play_fresh, talks), len(talks), "talks")
        return [line for lines in played for line in lines]


def play_fresh(talk: Talk) -> list[Line]:
    """Play a talk to a robot that remembers nothing."""
    with TemporaryDirectory() as folder, variables(XDG_STATE_HOME=folder):
        return play(
            talk, Robot("companion", "simulated", clock=FakeClock(), seed=3, devices=DEVICES)
        )


def play(talk: Talk, robot: Robot, seconds: float = LONGEST) -> list[Line]:
    """Play a talk, as far as it gets in some seconds, to a robot that has not lived yet."""
    seen = Seen()
    jobs = partial(_talk, talk.turns, seconds, seen, robot), partial(_watch, seen)
    events = live_for(robot, LONGEST, *robot.app.load_tasks(), *jobs)
    return list(_lines(talk, seen, events))


async def _talk(
    turns: Sequence[Turn], seconds: float, seen: Seen, robot: Robot, context: TaskContext
) -> None:
    listener, voice, clock = context.behavior(Listener), context.behavior(Voice), context.clock
    await clock.sleep(READY)
    for number, turn in enumerate(turns):
        if clock.now() >= READY + seconds:
            break
        seen.turns.append(clock.now())
        with caused_by(KEYBOARD):
            listener.type_line(turn.say, partial(seen.heard.__setitem__, number))
        await _let_answer(context)
        await _let_finish(voice, clock)
    seen.turns.append(clock.now())
    robot.finish()


async def _let_answer(context: TaskContext) -> None:
    """Wait as long as people do, or until they would answer a question that has come now."""
    clock, question = context.clock, context.board.slot(QUESTION)
    begun = clock.now()
    while (now := clock.now()) < begun + EVERY:
        is_open, asked = question.get()
        if is_open and begun < asked <= now - ANSWER_AFTER:
            return
        await clock.sleep(WATCH_EVERY)


async def _let_finish(voice: Voice, clock: Clock) -> None:
    """Wait for the end of what it says, as polite people do."""
    begun = clock.now()
    while not voice.is_idle and clock.now() < begun + PATIENCE:
        await clock.sleep(WATCH_EVERY)
    if clock.now() > begun:
        await clock.sleep(AFTER_WORDS)


async def _watch(seen: Seen, context: TaskContext) -> None:
    """Note where it is, and what it is made to show."""
    odometry = context.resources.obtain("odometry", Odometry)
    slot, label = context.board.slot(SHOWN), ""
    while True:
        now = context.clock.now()
        seen.poses.append((now, odometry.pose(now)))
        before, label = label, slot.value.label if slot.value else ""
        if label not in ("", before):
            seen.shown.append((now, label))
        await context.clock.sleep(WATCH_EVERY)


def _lines(talk: Talk, seen: Seen, events: Sequence[Event]) -> Iterator[Line]:
    spoken = list(_spoken(events))
    gestures = ((e.time, str(e.properties["name"])) for e in events if e.name == "gesture.started")
    showed = sorted((*seen.shown, *gestures))
    for number, (begin, end) in enumerate(pairwise(seen.turns)):
        turn = talk.turns[number]
        rule, tags, why_not = _meaning(seen.heard.get(number))
        said = [one for one in spoken if begin <= one[0] < end]
        yield Line(
            id=f"{talk.id}/{number + 1}",
            writer=talk.writer,
            situation=talk.situation,
            time=round(begin, 2),
            say=turn.say,
            expects=turn.expects,
            kind=turn.kind,
            rule=rule,
            tags=tags,
            why_not=why_not,
            said=tuple(Words(round(time - begin, 2), text, part) for time, text, part in said),
            moved=tuple(_moved(seen.poses, begin, end)),
            showed=tuple(what for time, what in showed if begin <= time < end),
        )


def _meaning(heard: Heard | None) -> tuple[str, dict[str, Any], str]:
    """The rule and the tags of what was understood, and why it was not."""
    if isinstance(heard, Utterance):
        return heard.rule, dict(heard.tags), ""
    if heard is None:
        return "", {}, "nothing became of it"
    nearest = f' (nearest: "{heard.text}")' if heard.text else ""
    return "", {}, heard.reason + (heard.detail and f": {heard.detail}") + nearest


def _spoken(events: Sequence[Event]) -> Iterator[tuple[float, str, str]]:
    """When each text began, the text, and as much of it as was heard."""
    begun: tuple[float, str] | None = None
    for event in events:
        if event.name == "speech.said":
            begun = event.time, str(event.properties["text"])
        elif event.name == "speech.finished" and begun is not None:
            yield *begun, str(event.properties["heard"])
            begun = None
    if begun is not None:
        yield *begun, begun[1]


def _moved(poses: Sequence[Sample], begin: float, end: float) -> Iterator[str]:
    samples = [sample for sample in poses if begin - WATCH_EVERY <= sample[0] <= end]
    for leg in legs(samples):
        yield STILL * (leg.begun < begin + UNMOVED) + str(leg)
