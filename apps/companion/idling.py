"""What it does by itself while nothing happens, as `emotions/idle.toml` says.

idle        looks about, hums, stretches, plays, yawns; dozes off, and wakes when something happens
"""

from __future__ import annotations

from hri.conversation import (
    IdleAct,
    IdleActs,
    Idler,
    Stillness,
    load_idle_acts,
    may_murmur,
)
from hri.core import Event
from hri.face import FaceRenderer, load_face, load_gestures
from hri.hal import Battery
from hri.robot import App, verbs
from hri.speech import Priority
from hri.task import Lane, TaskContext

from .companion import FOR_GOOD, Companion
from .moving_by_feeling import express, may_move

FILE = "idle.toml"
LOOK_EVERY = 0.25
STIRS = (
    "speech.*", "question.*", "person.entered", "person.approached", "bumper.pressed", "head.*",
    "battery.lowered",
)  # fmt: skip
"""Events after which something has happened."""
SPOKEN = ("speech.said", "speech.finished")
"""Those that its sounds raise, too."""
WAKING = "wakeUp"
"""Gesture with which it starts awake; a face without it does without."""


def authored_acts(context: TaskContext) -> IdleActs:
    """The acts, checked against the face that is in use. Raises AuthoringError."""
    gestures = load_gestures(load_face(context.behavior(FaceRenderer).face))
    return load_idle_acts(App.of(context).files(FILE), gestures)


async def idle(context: TaskContext) -> None:
    """Do small things while nothing happens, and leave off when something does."""
    await Idling(context).live()


class Idling:
    """The idle life of one companion."""

    def __init__(self, context: TaskContext) -> None:
        self._context = context
        self._companion = companion = Companion.of(context)
        self._idler = Idler(authored_acts(context), f"{context.clock.wall():%Y-%m-%d %H:%M}")
        self._can_wake = WAKING in companion.vocabulary().gestures
        self._doing = Lane(context)
        self._act: IdleAct | None = None
        """What it does, or did last."""
        self._stirred = context.clock.now()

    async def live(self) -> None:
        """Choose acts until the task is cancelled."""
        with self._context.queue(*STIRS) as queue:
            while True:
                event: Event | None = None
                with self._context.clock.move_on_after(LOOK_EVERY):
                    event = await queue.get()
                self._look(event)

    def _look(self, event: Event | None) -> None:
        now = self._context.clock.now()
        if self._is_needed() or (event is not None and not self._is_own(event)):
            still = self._stillness(now)
            self._stir(now)
            if event is not None and not self._is_needed():
                self._begin(self._idler.answer(event.name, now, still))
        elif not self._doing.is_busy:
            self._begin(self._idler.choose(now, self._stillness(now)))

    def _stir(self, now: float) -> None:
        """Leave off: something happens. It goes on waking up."""
        self._stirred = now
        if self._act is None:
            return
        naps = self._doing.is_busy and self._act.naps
        if self._moves():
            self._companion.motion.stop()
        self._doing.stop()
        self._act = None
        if naps and self._can_wake:
            self._doing.start(verbs.gesture, WAKING)

    def _is_needed(self) -> bool:
        """Whether it is spoken to, speaks, moves, or sleeps, other than by an act."""
        companion = self._companion
        around = companion.scene()
        is_driving = around.is_driving and not self._moves()
        is_speaking = companion.talk.is_busy or not (companion.voice.is_idle or self._sounds())
        is_busy = is_driving or is_speaking or companion.gestures.is_busy or companion.face.is_busy
        return is_busy or around.is_voice_heard or around.is_question_open or around.is_asleep

    def _moves(self) -> bool:
        """Whether an act moves the base; an order that took its place is left alone."""
        is_moving = self._act is not None and self._act.move is not None
        return is_moving and self._companion.motion.runs(express)

    def _sounds(self) -> bool:
        return self._doing.is_busy and self._act is not None and self._act.is_heard

    def _is_own(self, event: Event) -> bool:
        """Whether a sound of an act raised it."""
        is_spoken = event.name in SPOKEN and self._act is not None and self._act.is_heard
        return is_spoken and str(event.properties["text"]).startswith("[")

    def _stillness(self, now: float) -> Stillness:
        companion, around = self._companion, self._companion.scene()
        battery = self._context.resources.find(Battery)
        level = battery.level(now) if battery else 1.0
        return Stillness(
            still_s=now - self._stirred,
            feeling=companion.emotion.feeling().label,
            energy=1.0 if level is None else level,
            hour=around.hour,
            is_seen=around.is_seen,
            may_sound=companion.voice.makes_sounds and may_murmur(around),
            may_move=companion.fidgets and may_move(companion),
        )

    def _begin(self, act: IdleAct | None) -> None:
        if act is not None:
            self._act = act
            self._doing.start(self._do, act)

    async def _do(self, context: TaskContext, act: IdleAct) -> None:
        companion = self._companion
        context.events.raise_event("idle.acted", act=act.name)
        if act.sound:
            companion.voice.say(act.sound, Priority.IDLE)
        if act.move is not None:
            companion.motion.start(express, act.move)
        if act.gesture:
            await verbs.gesture(context, act.gesture)
        if act.show:
            await verbs.show(context, act.show, FOR_GOOD if act.naps else act.seconds)
        while not companion.voice.is_idle or companion.motion.is_busy:
            await context.clock.sleep(LOOK_EVERY)
