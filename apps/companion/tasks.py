"""What the companion does: it converses, wonders, notices, and obeys the keys.

converse    replies to what is heard, as `replies.toml` says
wonder      asks a yes/no question now and then
notice      reacts to a bump and a low battery, and feels ignored; what else happens is felt by the
            triggers in emotions/stimuli
watch_keys  space stops it, r releases a base that must be released, m mutes the microphone, v turns
            the camera off and on, c switches captions, escape ends
"""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from typing import Any

from hri.core import paths
from hri.core.errors import NotAvailable
from hri.core.latest import Latest
from hri.core.signals import Event, Person
from hri.drive import travel
from hri.drive.behaviors import CommandGate
from hri.drive.guard import BaseGuard
from hri.emotion.behaviors import EmotionModel
from hri.emotion.stimulus import load_stimuli
from hri.face.behaviors import FaceRenderer
from hri.face.gestures import load_gestures
from hri.face.model import load_face
from hri.hal.battery import Battery
from hri.hal.camera import Camera
from hri.hal.screen import Screen
from hri.robot import verbs
from hri.speech.behaviors import Listener, Voice
from hri.speech.grammar import Grammar, load_grammar
from hri.speech.grammar.tags import written
from hri.speech.tasks import hears_people
from hri.task.context import TaskContext
from hri.task.lane import Lane
from hri.task.task import Job
from hri.vision.tasks import people_of

from .replies import Question, Replies, Reply, Vocabulary, load_replies

ALWAYS = ("stop", "wake")
"""Rules that count even while it sleeps."""
SHOW_SECONDS = 4.0
FOR_GOOD = 1e9
QUIET_SECONDS = 60.0
FIRST_QUESTION = 7.0
"""Seconds of calm after a conversation before it asks a question of its own."""
BETWEEN_QUESTIONS = 40.0
COMPANY_SECONDS = 45.0
"""How long after the last words somebody who is seen counts as company."""
UNSEEN_SECONDS = 20.0
"""The same for somebody who is not seen."""
IGNORED_SECONDS = 25.0
"""Calm while somebody is there, after which it feels ignored; again after each such time."""


def check(context: TaskContext) -> None:
    """Read what the tasks will need, before anything is opened. Raises AuthoringError."""
    authored_replies(context)


def authored_replies(context: TaskContext) -> Replies:
    """The replies, checked against the grammar, the stimuli and the face that are in use."""
    grammar = load_grammar(paths.find("grammars", context.behavior(Listener).grammar))
    face = load_face(context.behavior(FaceRenderer).face)
    vocabulary = Vocabulary(
        rules=grammar.public_rules,
        tags=grammar.tag_names(),
        stimuli=load_stimuli(),
        expressions=face.expressions,
        gestures=load_gestures(face),
    )
    return load_replies(Path(__file__).with_name("replies.toml"), vocabulary)


class Companion:
    """What the tasks share: its replies, what it is doing, and whether it sleeps."""

    def __init__(self, context: TaskContext) -> None:
        self.context = context
        self.listener = context.behavior(Listener)
        self.voice = context.behavior(Voice)
        self.gate = context.behavior(CommandGate)
        self.guard = context.behavior(BaseGuard)
        self.emotion = context.behavior(EmotionModel)
        self.camera = context.resources.obtain("camera", Camera)
        self.replies = authored_replies(context)
        self.talk = Lane(context)
        self.motion = Lane(context)
        self.face = Lane(context)
        self.gestures = Lane(context)
        self.is_asleep = False
        self.has_asked_to_keep = False
        self.silent_until = -math.inf
        self.last_contact = -math.inf
        self._turns: dict[str, int] = {}

    @classmethod
    def of(cls, context: TaskContext) -> Companion:
        """The one companion of this robot, made on first use."""
        slot: Latest[Companion] = context.board.slot("companion")
        companion = slot.value or cls(context)
        slot.set(companion, context.clock.now())
        return companion

    # --- replying ---

    def reply(self, rule: str, text: str, tags: dict[str, Any]) -> None:
        """Do what the file says of this rule."""
        self.last_contact = self.context.clock.now()
        reply = self.replies.replies.get(rule)
        if reply is None or (self.is_asleep and rule not in ALWAYS):
            return
        if reply.feel:
            # Whoever talks is taken to be the one it attends to.
            self.emotion.feel(reply.feel, reply.intensity, people_of(self.context).attended)
        objection = getattr(self, f"_{reply.action}")(tags) if reply.action else None
        words = objection or self._words(rule, reply, text, tags)
        if reply.show:
            label = str(tags.get("emotion", "neutral")) if reply.show[0] == "{" else reply.show
            self.face.start(self._show, label)
        if reply.gesture:
            self.make(reply.gesture)
        if words:
            self.say(words)

    def make(self, gesture: str) -> None:
        """Make a gesture, in place of one that is being made."""
        self.gestures.start(verbs.gesture, gesture)

    def say(self, words: str) -> None:
        """Say it, in place of what is being said; nothing while it was told to be quiet."""
        if self.context.clock.now() >= self.silent_until:
            self.talk.start(verbs.say, words)

    def _words(self, rule: str, reply: Reply, text: str, tags: dict[str, Any]) -> str:
        if not reply.say:
            return ""
        turn = self._turns[rule] = self._turns.get(rule, -1) + 1
        template = reply.say[turn % len(reply.say)]
        facts = {
            "text": text,
            "name": self.replies.name,
            "time": f"{self.context.clock.wall():%H:%M}",
            "battery": round(100 * self._battery()),
            "why": self.emotion.why_words(str(tags.get("emotion", ""))),
            "feeling": self.emotion.feeling_words(),
            "why_stopped": self.guard.explain() or self.replies.unasked["no_stop"],
            "commands": self._commands(),
        }
        values = {key: written(value) for key, value in tags.items()}
        return template.format(**values, **facts)

    def _battery(self) -> float:
        battery = self.context.resources.find(Battery)
        return battery.level(self.context.clock.now()) if battery else 1.0

    def _commands(self) -> str:
        """One example for each of some rules."""
        grammar: Grammar = self.listener.loaded_grammar
        examples = [
            next(iter(grammar.sentences_of(rule, 1)), "")
            for rule in ("greet", "move", "turn", "show", "stop")
            if rule in grammar.public_rules
        ]
        return ", ".join(example for example in examples if example)

    # --- actions, named as in replies.toml; what one returns is said in place of the reply ---

    def _drive(self, job: Job, *arguments: Any) -> str | None:
        """Start a motion; why there is none, while the base must not move."""
        if self.guard.must_wait:
            return f"{self.guard.explain()}. {self.replies.unasked['waiting']}"
        self.motion.start(job, *arguments)
        return None

    def _move(self, tags: dict[str, Any]) -> str | None:
        return self._drive(self._move_on, float(tags.get("distance", 0.5)))

    async def _move_on(self, context: TaskContext, distance: float) -> None:
        travelled = await verbs.move(context, distance)
        if abs(travelled) < 0.9 * abs(distance):
            self.say(self.replies.unasked["blocked"])

    def _turn(self, tags: dict[str, Any]) -> str | None:
        angle = math.radians(float(tags.get("angle", 90.0)))
        return self._drive(verbs.turn, angle)

    def _come(self, tags: dict[str, Any]) -> str | None:
        return self._drive(self._come_here)

    def _follow(self, tags: dict[str, Any]) -> str | None:
        return self._drive(self._go_along)

    async def _come_here(self, context: TaskContext) -> None:
        if not self.camera.is_on or not await travel.come_here(context):
            self.say(self.replies.unasked["nobody"])

    async def _go_along(self, context: TaskContext) -> None:
        if self.person() is None or not await travel.follow(context):
            self.say(self.replies.unasked["nobody"])

    def _stop(self, tags: dict[str, Any]) -> None:
        self.motion.stop()
        self.gate.halt()
        self.talk.stop()
        self.voice.hush()

    def _release(self, tags: dict[str, Any]) -> None:
        self.guard.release()

    def _quiet(self, tags: dict[str, Any]) -> None:
        self.talk.stop()
        self.voice.hush()
        self.silent_until = self.context.clock.now() + QUIET_SECONDS

    def _sleep(self, tags: dict[str, Any]) -> None:
        self.is_asleep = True
        self.motion.stop()
        self._settle()

    def _wake(self, tags: dict[str, Any]) -> None:
        self.is_asleep = False
        self.silent_until = -math.inf
        self._settle()

    def _eyes(self, tags: dict[str, Any]) -> None:
        self.switch_camera(tags.get("eyes") == "open")

    # --- asking ---

    def questions(self) -> list[Question]:
        """What it may ask now: whether it may keep what it feels, only once, and only people."""
        may_ask = self.emotion.may_ask_to_keep and hears_people(self.context)
        may_ask = may_ask and not self.has_asked_to_keep
        return [q for q in self.replies.questions if q.action != "keep" or may_ask]

    # --- what the face shows ---

    def _settle(self) -> None:
        """Show shut eyes for as long as it sleeps or does not watch, else what it feels."""
        if self.is_asleep or not self.camera.is_on:
            self.face.start(verbs.show, "asleep", FOR_GOOD)
        else:
            self.face.stop()

    async def _show(self, context: TaskContext, label: str) -> None:
        await verbs.show(context, label, SHOW_SECONDS)
        self._settle()

    # --- what is seen ---

    def person(self) -> Person | None:
        """The one it attends to, when they are in sight."""
        people = people_of(self.context)
        person = people.person(people.attended)
        return person if person is not None and person.is_visible else None

    def switch_camera(self, on: bool) -> None:
        """Turn the camera off for real, or on again."""
        try:
            self.camera.switch(on)
        except NotAvailable as error:
            self.context.events.raise_event("camera.lost", camera=self.camera.id, why=str(error))
        self._settle()

    @property
    def is_calm(self) -> bool:
        """Nobody talks and nothing moves."""
        return not (self.talk.is_busy or self.motion.is_busy or self.listener.is_hearing.value)


async def converse(context: TaskContext) -> None:
    """Reply to everything that is heard."""
    companion = Companion.of(context)
    with context.queue("speech.heard") as queue:
        while True:
            heard = (await queue.get()).properties
            try:
                companion.reply(heard["rule"], heard["text"], dict(heard["tags"]))
            except (LookupError, ValueError, TypeError) as error:
                # A reply that cannot be filled in costs this reply, not the companion.
                context.events.raise_event("task.failed", task="converse", error=str(error))


async def wonder(context: TaskContext) -> None:
    """Ask a question now and then, when somebody is there and it is calm."""
    companion = Companion.of(context)
    clock = context.clock
    count, last = 0, -math.inf
    while companion.replies.questions:
        await clock.sleep(0.5)
        now = clock.now()
        since = now - companion.last_contact
        patience = COMPANY_SECONDS if companion.person() is not None else UNSEEN_SECONDS
        is_company = FIRST_QUESTION < since < patience
        if not is_company or now - last < BETWEEN_QUESTIONS or now < companion.silent_until:
            continue
        if companion.is_asleep or not companion.is_calm:
            continue
        questions = companion.questions()
        if not questions:
            continue
        question = questions[count % len(questions)]
        companion.talk.start(_ask, companion, question)
        count, last = count + (question.action != "keep"), now


async def _ask(context: TaskContext, companion: Companion, question: Question) -> None:
    companion.has_asked_to_keep |= question.action == "keep"
    answer = await verbs.ask(context, question.ask)
    if answer is None:
        return
    companion.last_contact = context.clock.now()
    if answer and question.action == "keep":
        companion.emotion.begin_keeping()
    if words := (question.yes if answer else question.no):
        await verbs.say(context, words)


async def notice(context: TaskContext) -> None:
    """React to what happens, and feel that nothing happens."""
    companion = Companion.of(context)
    calm_since = context.clock.now()
    deeds = {
        "bumper.pressed": partial(_bumped, companion),
        "battery.lowered": partial(_talk_about, companion, "battery_low"),
    }
    others = ("person.seen", "speech.heard", "question.answered")
    with context.queue(*deeds, *others) as queue:
        while True:
            event: Event | None = None
            with context.clock.move_on_after(1.0):
                event = await queue.get()
            now = context.clock.now()
            if event is not None:
                calm_since = now
                if event.name in deeds:
                    deeds[event.name]()
            elif not companion.is_calm or companion.is_asleep:
                calm_since = now
            elif now - calm_since > IGNORED_SECONDS and companion.person() is not None:
                calm_since = now
                companion.emotion.feel("ignored")


def _bumped(companion: Companion) -> None:
    companion.motion.stop()  # no second try: whoever was bumped decides what comes next
    companion.make("startle")
    _talk_about(companion, "bump")


def _talk_about(companion: Companion, words: str) -> None:
    """What hurts or worries it is talked about first, before any question."""
    if not companion.is_asleep:
        companion.last_contact = max(companion.last_contact, companion.context.clock.now())
        companion.say(companion.replies.unasked[words])


async def watch_keys(context: TaskContext) -> None:
    """Obey the keys of the window; closing it ends the program."""
    companion = Companion.of(context)
    screen = context.resources.obtain("screen", Screen)
    renderer = context.behavior(FaceRenderer)
    while True:
        await context.clock.sleep(0.05)
        for key in screen.pressed_keys():
            if key == "space":
                companion.guard.halt("somebody pressed the stop key")
                companion.reply("stop", "stop", {})
            elif key == "r":
                companion.guard.release()
            elif key == "m":
                companion.listener.is_muted = not companion.listener.is_muted
                context.events.raise_event("microphone.muted", muted=companion.listener.is_muted)
            elif key == "v":
                companion.switch_camera(not companion.camera.is_on)
            elif key == "c":
                renderer.captions_on = not renderer.captions_on
            elif key == "escape":
                context.events.raise_event("window.closed")
        if screen.is_closed:
            context.events.raise_event("window.closed")
            return
