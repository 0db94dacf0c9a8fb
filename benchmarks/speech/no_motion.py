"""Everyday turns that ask for no motion: typed to the companion, and spoken to its recognizer."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence

from benchmarks.progress import progress
from benchmarks.speech import ears, printed
from benchmarks.speech.ears import companion
from benchmarks.speech.texts import lines
from benchmarks.speech.voices import spoken
from hri.bench.speech.listening import ONE_CORE
from hri.bench.speech.samples import Recordings
from hri.bench.table import Row, at_most, share
from hri.bench.workers import variables, worker_pool
from hri.core.clock import FakeClock
from hri.core.signals import Utterance
from hri.drive.supervisor_relay import SupervisorRelay
from hri.hal.resource import Description
from hri.robot import Robot
from hri.simulation.world import SimulatedWorld
from hri.speech.behaviors import Listener
from hri.speech.turn import Turn
from hri.speech.understanding import Heard
from hri.task.context import TaskContext
from hri.testing import live_for

VOICES = ("slt", "rms", "heart", "en-us")
BATCH = 50
"""Turns in the life of one robot."""
READY = 1.0
"""Seconds after which the companion listens."""
BEGINS = 1.5
"""Seconds in which a motion begins that a turn asked for."""
ENDS = 2.0
"""Seconds in which one that was stopped is over."""
MOVED = 0.001
"""Meters that a wheel turns when the base moves."""
LONGEST = 3600.0
"""Seconds that a life may last; it ends with its last turn."""
DEVICES = (
    Description("screen", "Hri.OffscreenScreen", {"width": "16", "height": "16"}),
    Description("recognizer", "Hri.Typed"),
    Description("camera", "Hri.BlankCamera"),
    Description("microphone", "Hri.MemoryMicrophone"),
    Description("voice", "Hri.SilentVoice"),
)
"""A robot that hears what is typed, sees nothing, and costs little time."""


def rows(people: Recordings | None, step: int = 1) -> Iterator[Row]:
    """Typed and spoken. Raises NotAvailable without flite."""
    turns = lines("no_motion.txt")[::step]
    moving, careful = typed(turns)
    yield share("motions begun, typed", len(moving), len(turns), at_most(0)) | {"clips": moving}
    yield share("@careful rules, typed", len(careful), len(turns), at_most(0)) | {"clips": careful}
    clips = list(spoken(turns, VOICES))
    told = [
        one.told()
        for one in ears.heard(clips, Turn(), "no motion, spoken")
        if any(heard.rule in companion().marked("careful") for heard in one.accepted)
    ]
    yield share("@careful rules, spoken", len(told), len(clips), at_most(0)) | {"clips": told}


def typed(turns: Sequence[str]) -> tuple[list[str], list[str]]:
    """The turns after which the base moved, and those taken for a rule marked @careful.

    The latter may move nothing, such as "follow me" to a robot that sees nobody.
    """
    batches = [turns[start : start + BATCH] for start in range(0, len(turns), BATCH)]
    with variables(**ONE_CORE), worker_pool(os.cpu_count() or 1) as pool:
        lives = [*progress(pool.map(life, batches), len(batches), "no motion, typed")]
    return [one for moved, _ in lives for one in moved], [one for _, told in lives for one in told]


def life(turns: Sequence[str]) -> tuple[list[str], list[str]]:
    """The same of a few turns, in this process."""
    robot = Robot("companion", "simulated", clock=FakeClock(), seed=3, devices=DEVICES)
    moving: list[str] = []
    careful: list[str] = []

    async def talk(context: TaskContext) -> None:
        await context.clock.sleep(READY)
        for text in turns:
            has_moved, made = await _turn(context, text)
            if has_moved:
                moving.append(_told(text, made))
            if isinstance(made, Utterance) and made.rule in companion().marked("careful"):
                careful.append(_told(text, made))
        robot.finish()

    live_for(robot, LONGEST, *robot.app.load_tasks(), talk)
    return moving, careful


async def _turn(context: TaskContext, text: str) -> tuple[bool, Heard | None]:
    """Whether the base moves, and what was understood; afterwards it stands, released and awake."""
    listener, clock = context.behavior(Listener), context.clock
    base = context.resources.obtain("world", SimulatedWorld).base
    before = base.way
    made: list[Heard] = []
    listener.type_line(text, made.append)
    await clock.sleep(BEGINS)
    has_moved = base.way - before > MOVED
    for line in ("stop",) * has_moved + ("wake up",) * _is_of(made, "sleep"):
        listener.type_line(line)
        await clock.sleep(ENDS)
    relay = context.behavior(SupervisorRelay)
    if relay.must_wait:
        relay.release()
    return has_moved, made[0] if made else None


def _is_of(made: Sequence[Heard], rule: str) -> bool:
    return any(isinstance(one, Utterance) and one.rule == rule for one in made)


def _told(text: str, made: Heard | None) -> str:
    return f'{text} - "{made.text}" <{getattr(made, "rule", "")}>' if made else text


if __name__ == "__main__":
    printed.main(__doc__, rows)
