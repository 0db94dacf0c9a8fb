"""Whether frames are lost while the face talks, beside all that the companion does.

In real time: the companion listens to a simulated visitor through its recognizer, sees it, and
shows its face at 30 frames a second, saying one sentence after the other; a network of 100
behaviors runs at 50 Hz in the same process.
"""

from __future__ import annotations

from collections.abc import Iterator

from hri.bench.behavior import relays
from hri.bench.table import Row, amount, at_most
from hri.core.clock import RealClock
from hri.face.behaviors import FaceRenderer
from hri.hal.resource import Description
from hri.robot import Robot, verbs
from hri.simulation.visit_script import load_visit
from hri.simulation.world import SimulatedWorld
from hri.task.context import TaskContext

SENTENCES = (
    "Hello, I am happy to see you.",
    "Four brave fish jump over the mat.",
    "Please move the big blue box before five.",
    "My favorite people visit us every Wednesday afternoon.",
)
SETTLING = 6.0
"""Seconds until the models are loaded."""
LOOK_EVERY = 0.002
RATE = 30
BESIDE_RATE = 50
BEHAVIORS = 100
DEVICES = (
    Description("microphone", "Hri.SimulatedMicrophone", bus="world"),
    Description("camera", "Hri.SimulatedCamera", bus="world"),
    Description("screen", "Hri.OffscreenScreen", {"width": "800", "height": "600"}),
    Description("speaker", "Hri.SilentSpeaker"),
)


def rows(seconds: float) -> Iterator[Row]:
    """Number of frames dropped in a period, seconds."""
    robot = Robot("companion", clock=RealClock(), devices=DEVICES, notice=lambda line: None)
    noted: list[tuple[float, int]] = []

    async def talk(context: TaskContext) -> None:
        while True:
            for sentence in SENTENCES:
                await verbs.say(context, sentence)

    async def count(context: TaskContext) -> None:
        world = robot.resources.obtain("world", SimulatedWorld)
        load_visit(robot.app.folder / "demo.toml").start(world, context.clock, context.events)
        robot.networks.start(relays(BEHAVIORS, 1 / BESIDE_RATE))
        await context.clock.sleep(SETTLING)
        noted.append(await _next_frame(context))
        await context.clock.sleep(seconds)
        noted.append(await _next_frame(context))
        robot.finish()

    robot.live_until_over(*robot.app.load_tasks(), talk, count)
    (begun, before), (ended, after) = noted
    due, shown = round((ended - begun) * RATE), after - before
    what = f"frames dropped in {seconds:g} s of talking"
    yield amount(what, max(0, due - shown), "frames", at_most(0), due=due, shown=shown)


async def _next_frame(context: TaskContext) -> tuple[float, int]:
    """When the next frame is shown, and how many there are then."""
    renderer = context.behavior(FaceRenderer)
    before = renderer.frames
    while renderer.frames == before:
        await context.clock.sleep(LOOK_EVERY)
    return context.clock.now(), renderer.frames
