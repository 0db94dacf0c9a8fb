"""What the base does by itself as a feeling begins to show: it wiggles, backs off, turns away.

pose        moves as `[motion]` of `emotions/display.toml` says, while nobody speaks or drives, and
            feels it when someone kicks the base
"""

from __future__ import annotations

from hri.conversation import NEVER
from hri.core import Latest, Pose2D
from hri.drive import CRUISE, TURN_RATE, CoveredGround, PushDetector
from hri.emotion import EmotionDisplay, ExpressiveMotion
from hri.robot import verbs
from hri.task import TaskContext

from .companion import Companion

PLACE = "place"
"""Slot of the board with where the base is, by its own wheels."""
LOOK_EVERY = 0.1
REST_SECONDS = 20.0
"""From one motion to the next."""
KICK = 0.8
"""m/s of a push that is felt in full strength."""
LEAST_BACK = 0.02
"""Meters of ground behind it for which it is worth backing off."""
DONE = 0.9
"""Share of a turn after which something was in the way: then it leaves off."""


async def pose(context: TaskContext) -> None:
    """Move the base as a feeling begins to show, and feel kicks."""
    companion = Companion.of(context)
    display = context.behavior(EmotionDisplay)
    place: Latest[Pose2D] = context.board.slot(PLACE)
    ground, pushes = CoveredGround(), PushDetector()
    shown: ExpressiveMotion | None = None
    moved = NEVER
    while True:
        await context.clock.sleep(LOOK_EVERY)
        now = context.clock.now()
        if place.value is not None:
            ground.see(now, place.value)
            if speed := pushes.see(now, place.value, companion.gate.is_moving):
                companion.feel("kicked", min(speed / KICK, 1.0))
        if companion.guard.must_wait:
            ground.forget()
        motion = display.motion
        if motion is None or motion == shown:
            shown = motion
        elif now - moved >= REST_SECONDS and may_move(companion):
            shown, back = motion, min(motion.backs_off, ground.behind())
            if not motion.turns and back < LEAST_BACK:
                continue
            moved = now
            context.events.raise_event("emotion.moved", emotion=display.shown.label)
            companion.motion.start(express, motion, back)


def may_move(companion: Companion) -> bool:
    """Whether nobody needs it to stand still."""
    now = companion.scene()
    is_needed = now.is_voice_heard or now.is_question_open or now.is_driving
    return not (is_needed or now.is_asleep or companion.guard.must_wait)


async def express(context: TaskContext, motion: ExpressiveMotion, back: float = 0.0) -> None:
    """Move as a feeling or an idle act says; `back` is how far it backs off, in meters."""
    if back >= LEAST_BACK:
        await verbs.move(context, -back, motion.pace * CRUISE)
    for number, angle in enumerate(motion.turns):
        if number:
            await context.clock.sleep(motion.pause_s)
        turned = await verbs.turn(context, angle, motion.pace * TURN_RATE)
        if abs(turned) < DONE * abs(angle):
            return
