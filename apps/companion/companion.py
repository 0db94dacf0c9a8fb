"""The companion: its replies, its deeds, and whether it sleeps."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Mapping
from typing import Any

from hri.conversation import (
    NEVER,
    NIGHT,
    SPEAKER,
    Curiosity,
    Form,
    Importance,
    Moment,
    Pool,
    Puzzlement,
    Scene,
    Spoken,
    Texts,
    clock_words,
    face_for,
    fields_of,
    fill,
    load_forms,
    part_of_day,
    pools,
    sayings,
    suits,
)
from hri.core import Event, Expression, Hand, Latest, NotAvailable, Person
from hri.drive import CommandGate, SupervisorRelay
from hri.emotion import EmotionModel, load_stimuli, personality_names, personality_path
from hri.face import FaceRenderer, load_face, load_gestures
from hri.hal import Battery, Camera
from hri.robot import App, verbs
from hri.speech import QUESTION, Grammar, Listener, Voice, written
from hri.task import ImmediateTask, Job, Lane, TaskContext, TaskType, said
from hri.vision import people_of

from .facts import Commands, aloud, direction_words
from .replies import FILE, FORMS, Replies, Reply, Vocabulary, load_replies

DANGER = ("in_danger", "being_hurt", "emergency")
"""Rules of people in danger: they wake it, and it speaks even if it was asked to be quiet."""
ALWAYS = ("stop", "wake", *DANGER)
"""Rules that count even while it sleeps."""
FLOOR_SECONDS = 0.4
"""How long it waits with words for someone who may go on speaking; it acts at once."""
SHOW_SECONDS = 4.0
FELT_SECONDS = 0.07
"""Until the face knows what has just been felt."""
SEEN = 0.3
"""Intensity of an expression that others see."""
FOR_GOOD = 1e9
QUIET_SECONDS = 60.0
TOPIC_SECONDS = 60.0
"""How long what comes after something that was understood may go on with it."""
WORN = 0.8
"""Share of a stimulus that is lost by habit, from which on it is answered as what is overdone."""
ABOUT_THE_LAST = ("why_that", "say_again")
"""Rules that speak of the reply before them."""
GREETING = "greet"
"""The rule that is answered by the name of who talks, where that is known."""
GOES_ON = ("corrected",)
"""Rules that are answered by what the talk is about, if [[then]] has something for that."""
SPEAK_UP = ("greet", "wake", *DANGER)
"""Rules that end its being quiet."""
FAREWELLS = ("leave", "good_night", "sleep")
"""Rules that end a talk; it asks no question then."""
TENDER = ("sad", "vulnerable", "embarrassed")
"""Faces of moments in which it asks nothing by itself."""
MOST_HEARD = 100
"""Rules that are remembered."""


def authored_replies(context: TaskContext) -> Replies:
    """The replies, checked against the grammar, the stimuli and the face that are in use."""
    grammar = context.behavior(Listener).read_grammar()
    return load_replies(App.of(context).files(FILE), vocabulary_of(context, grammar))


def vocabulary_of(context: TaskContext, grammar: Grammar) -> Vocabulary:
    """What the replies may use."""
    face = load_face(context.behavior(FaceRenderer).face)
    app = App.of(context)
    own = personality_path(context.behavior(EmotionModel).personality).stem
    gestures = load_gestures(face)
    known = {own, *personality_names()}
    forms = load_forms(app.files(FORMS))
    return Vocabulary(grammar, load_stimuli(), face.expressions, gestures, app, known, forms)


class Companion:
    """What the tasks share: its replies, what it is doing, and whether it sleeps."""

    def __init__(self, context: TaskContext) -> None:
        self.context = context
        self.listener = context.behavior(Listener)
        self.voice = context.behavior(Voice)
        self.gate = context.behavior(CommandGate)
        self.guard = context.behavior(SupervisorRelay)
        self.emotion = context.behavior(EmotionModel)
        self.camera = context.resources.obtain("camera", Camera)
        self.replies = authored_replies(context)
        self.voice.voice = self.replies.voice or self.voice.voice
        self.listener.call(self.replies.name)
        self.talk = Lane(context)
        self.motion = Lane(context)
        self.face = Lane(context)
        self.gestures = Lane(context)
        self.agreeing = Lane(context)
        self.lessons = Lane(context)
        self.floor = Lane(context)
        self.pointing = Lane(context)
        self.pointed: tuple[float, Hand] | None = None
        """When someone pointed at something last, and with which hand."""
        self.is_asleep = False
        self.fidgets = True
        """Whether the base may move a little while nothing happens."""
        self.has_asked_to_keep = False
        self.silent_until = -math.inf
        self.last_contact = -math.inf
        self._last: Reply | None = None
        """The reply that people mean who ask why."""
        self._said_last = self._topic = ""
        self._commands = Commands()
        self.puzzlement = Puzzlement()
        self._spoken = Spoken()
        self.curiosity = Curiosity(f"{context.clock.wall():%Y-%m-%d %H:%M}")
        self.heard: deque[str] = deque(maxlen=MOST_HEARD)
        """The rules that people said, the last one last."""
        self.last_voice = self.last_farewell = self.last_dialogue = self.last_tender = NEVER
        self.last_spoke = NEVER
        self.talker = ""
        """The name of who talks; empty for a stranger."""
        self.is_wondering = False
        """Whether it asked the last question by itself, not for a task."""
        self.is_held = False
        """Whether it waits: the person goes on with the sentence that it acts on."""
        for name in ("question.refused", "question.unanswered"):
            context.events.subscribe(name, self._give_up)
        context.events.subscribe("question.*", self._note_dialogue)
        context.events.subscribe("speech.finished", self._note_end)
        context.board.slot(SPEAKER).set(self, context.clock.now())

    def vocabulary(self) -> Vocabulary:
        """What its replies may use."""
        return vocabulary_of(self.context, self.listener.loaded_grammar)

    @classmethod
    def of(cls, context: TaskContext) -> Companion:
        """The one companion of this robot, made on first use."""
        slot: Latest[Companion] = context.board.slot("companion")
        companion = slot.value or cls(context)
        slot.set(companion, context.clock.now())
        return companion

    # --- replying ---

    def reply(
        self,
        rule: str,
        text: str,
        tags: dict[str, Any],
        may_go_on: bool = False,
        goes_on: bool = False,
    ) -> None:
        """Do what the file says of this rule.

        Whoever may go on with the sentence has the floor a little longer before it answers. A
        sentence that goes on with the one before it is not the same said again.
        """
        self.last_contact = now = self.context.clock.now()
        self.is_held = False
        self.puzzlement.understand()
        self.heard.append(rule)
        topic, self._topic = self._topic, rule
        if rule in FAREWELLS:
            self.last_farewell = now
        reply = self.replies.replies.get(rule)
        if reply is None or (self.is_asleep and rule not in ALWAYS):
            return
        if self.is_asleep and rule in DANGER:
            self.wake()
        if rule in SPEAK_UP and not self.may_speak:
            self.be_quiet(0.0)
        may_speak = self.may_speak  # a robot asked to be quiet may still answer that
        if reply.show in TENDER:
            self.last_tender = now
        if reply.feel:
            self.feel(reply.feel, reply.intensity)
        objection = self.perform(reply.task, {"text": text, **tags})
        if reply.event:
            self.context.events.raise_event(reply.event, text=text, **tags)
        may_speak = may_speak or self.may_speak
        is_wanted = may_speak and objection is None
        then = self.replies.then.get(topic, ()) if rule in GOES_ON else ()
        if rule == GREETING and self.talker:
            then = self.replies.unasked["greet_by_name"]
        template, pool = self._choose(rule, goes_on, then) if is_wanted else ("", Pool())
        words = objection or self._filled_in(template, text, tags)
        # What it says of its feeling must not be hidden by another face.
        if reply.show and not pool.is_felt:
            label = str(tags.get("emotion", "neutral")) if reply.show[0] == "{" else reply.show
            self.show(label)
        if reply.gesture:
            self.make(reply.gesture)
        if words and may_speak:
            self.talk.start(self._say_after, FLOOR_SECONDS if may_go_on else 0.0, words)
        if reply.form is not None and may_speak:
            self.lessons.start(self._fill, reply, reply.form, tags, self._typed())
        if rule not in ABOUT_THE_LAST:
            self._last = reply
        if rule in FAREWELLS:
            self.last_contact = -math.inf

    async def _say_after(self, context: TaskContext, seconds: float, words: str) -> None:
        self._said_last = words
        await context.clock.sleep(seconds)
        self.agreeing.start(self._agree, words)
        await verbs.say(context, words)

    def _typed(self) -> str:
        """The last sentence, where it was typed."""
        heard = self.listener.last_utterance
        return heard.text if heard is not None and heard.level_db is None else ""

    async def _fill(
        self, context: TaskContext, reply: Reply, form: Form, tags: Mapping[str, Any], typed: str
    ) -> None:
        """Ask for what a form lacks, and act on it when all is there."""
        values = await fill(context, form, tags, typed)
        if values is None:
            return
        if form.event:
            context.events.raise_event(form.event, **values)
        told = {**tags, **values}
        words = self.perform(reply.form_task, told) or form.filled_in(form.done, values)
        if words:
            self.say(words)

    async def _agree(self, context: TaskContext, words: str) -> None:
        """Let the face go with the words, where it says something else."""
        await context.clock.sleep(FELT_SECONDS)
        if label := face_for(words, self._shown()):
            self.show(label)

    def hold(self) -> None:
        """Wait: the person goes on with the sentence that it acts on."""
        self.is_held = True
        self.motion.hold()
        self.talk.hold()

    def resume(self) -> None:
        """Act on the sentence after all; what the person added changes nothing."""
        self.is_held = False
        self.motion.resume()
        self.talk.resume()

    def _note_dialogue(self, event: Event) -> None:
        """A task asks, or was answered: it may go on to ask."""
        self.is_wondering = self._is_own_question(str(event.properties.get("text", "")))
        if not self.is_wondering:
            self.last_dialogue = event.time

    def _note_end(self, event: Event) -> None:
        self.last_spoke = event.time

    def _is_own_question(self, text: str) -> bool:
        return text in [question.ask for question in self.replies.questions]

    def _give_up(self, event: Event) -> None:
        """Say that a question of a task is over, before the task goes on."""
        words = self.words(event.name.replace("question.", ""))
        is_own = self._is_own_question(str(event.properties["text"]))
        if words and not is_own and self.may_speak:
            self.voice.say(words)

    def make(self, gesture: str) -> None:
        """Make a gesture that suits the face, instead of one that is being made."""
        if suits(gesture, self._shown()):
            self.gestures.start(verbs.gesture, gesture)

    def say(self, words: str) -> None:
        """Say it, interrupting other speech; nothing while it is asked to be quiet."""
        if self.may_speak:
            self.talk.start(self._say_after, 0.0, words)

    def words(self, key: str, **facts: str) -> str:
        """What [unasked] says, filled in: of several texts the one that was said longest ago."""
        return self.fresh(key).format_map(facts)

    def fresh(self, *keys: str, before: Texts = ()) -> str:
        """A text that was not said of late: one of those `before`, else of [unasked] one of the
        first of these keys, if it can.
        """
        now = self.context.clock.now()
        pools = [Pool(before), *(Pool(self.replies.unasked[key]) for key in keys)]
        text, _ = self._spoken.choose(pools, now)
        self._spoken.note(text, now)
        return text

    @property
    def is_in_touch(self) -> bool:
        """Whether it answered something within the last minute."""
        last = max(self.last_contact, self.puzzlement.last)
        return self.context.clock.now() - last < TOPIC_SECONDS

    def take_topic(self) -> str:
        """The rule that was understood just before; the next line goes on with something else."""
        topic, self._topic = self._topic, ""
        return topic if self.is_in_touch else ""

    def tell(self, key: str, **facts: str) -> None:
        """Say what [unasked] says."""
        self.say(self.words(key, **facts))

    @property
    def may_speak(self) -> bool:
        """Whether it may talk: it was not asked to be quiet."""
        return self.context.clock.now() >= self.silent_until

    def _choose(self, rule: str, goes_on: bool, before: Texts) -> tuple[str, Pool]:
        """What to say to a rule at this moment, with its braces, and where it is from: one of the
        texts `before`, if there are any.
        """
        now, reply = self.context.clock.now(), self.replies.replies[rule]
        moment = Moment(
            self.emotion.feeling().label,
            part_of_day(self.context.clock.wall().hour),
            personality_path(self.emotion.personality).stem,
            self._spoken.answer(rule, now) and not goes_on,
            self._is_worn(reply.feel),
        )
        usual = pools(reply.wording, moment)
        template, pool = self._spoken.choose([Pool(before), *usual], now)
        if template:
            self._spoken.note(template, now)
        return template, pool

    def _is_worn(self, stimulus: str) -> bool:
        """Whether a stimulus has come from who talks so often that it means little."""
        if not stimulus:
            return False
        return self.emotion.wear(stimulus, people_of(self.context).attended) >= WORN

    def _filled_in(self, template: str, text: str, tags: dict[str, Any]) -> str:
        """A text with what its braces stand for."""
        facts: dict[str, Callable[[], object]] = {
            "text": lambda: text,
            "name": lambda: self.replies.name,
            "person": lambda: self.talker,
            "time": self._time_words,
            "date": self._date_words,
            "battery": self._percent_of_battery,
            "why": lambda: aloud(self.emotion.why_words(str(tags.get("emotion", "")))),
            "feeling": self.emotion.feeling_words,
            "why_stopped": self._why_stopped,
            "commands": lambda: self._commands.words(self.examples()),
            "said": lambda: self._said_last or self.words("nothing_said"),
            "because": lambda: self._because(text, tags),
        }
        if "direction" not in tags:  # a tag of that name is the app's own
            facts["direction"] = lambda: direction_words(tags)
        values: dict[str, object] = {key: written(value) for key, value in tags.items()}
        # Only what is filled in is asked for: commands are named in turns.
        fields = set(fields_of(template))
        values.update((field, facts[field]()) for field in fields & facts.keys())
        if "battery" in fields and values["battery"] is None:
            return self.words("battery_unknown")
        return template.format_map(values)

    def _because(self, text: str, tags: dict[str, Any]) -> str:
        """Why it did or said what it did last."""
        last = self._last
        if last is not None and last.because:
            return self._filled_in(last.because, text, tags)
        if last is not None and last.task is not None:
            return self.words("asked_to")
        return aloud(self.emotion.why_words(""))

    def _time_words(self) -> str:
        wall = self.context.clock.wall()
        return clock_words(wall.hour, wall.minute)

    def _date_words(self) -> str:
        """Today, in words."""
        wall = self.context.clock.wall()
        return f"{wall:%A, %B} {wall.day}"

    def _why_stopped(self) -> str:
        """Why it stopped, as a sentence."""
        why = self.guard.explain()
        return f"{why.rstrip('.')}." if why else self.words("no_stop")

    def _percent_of_battery(self) -> int | None:
        """None while it is not known."""
        battery = self.context.resources.find(Battery)
        level = battery.level(self.context.clock.now()) if battery else 1.0
        return None if level is None else round(100 * level)

    def examples(self) -> dict[str, str]:
        """One sentence for each command by its rule, those of the app's own grammar first."""
        grammar: Grammar = self.listener.loaded_grammar
        return {rule: examples[0] for rule, examples in sayings(grammar).items()}

    # --- speaking up ---

    def scene(self, wondered: float = NEVER) -> Scene:
        """How things stand for who would begin to speak, and asked last at a time in seconds."""
        context = self.context
        is_heard = bool(self.listener.is_hearing.value)
        is_claimed = context.manager.claims.holder("drive") is not None
        return Scene(
            now=context.clock.now(),
            hour=context.clock.wall().hour,
            quiet_hours=App.of(context).quiet_hours or NIGHT,
            is_asleep=self.is_asleep,
            is_quiet=not self.may_speak,
            is_voice_heard=is_heard or self.is_held,
            is_speaking=self.talk.is_busy or not self.voice.is_idle,
            is_question_open=bool(context.board.slot(QUESTION).value),
            is_driving=self.motion.is_busy or is_claimed,
            is_seen=self.person() is not None,
            understood=self.last_contact,
            voice=self.last_voice,
            spoke=self.last_spoke,
            puzzled=self.puzzlement.last,
            farewell=self.last_farewell,
            dialogue=self.last_dialogue,
            tender=self.last_tender,
            wondered=wondered,
        )

    async def say_unasked(self, context: TaskContext, words: str, importance: Importance) -> None:
        """Say what nobody asked for just now; an alarm wakes it, and may be asked about."""
        if importance is Importance.ALARM and self.is_asleep:
            self.wake()
        self._said_last = words
        await verbs.say(context, words)

    # --- what its actions do ---

    def perform(self, task: TaskType | None, values: Mapping[str, object]) -> str | None:
        """Do a task with the values it takes; what is to be said instead of the reply, if anything.

        A text that comes after more than one step is said when it comes.
        """
        if task is None:
            return None
        if isinstance(task, ImmediateTask):
            words: str | None = task.at_once(self.context, values)
            return words
        job = task.with_those_it_takes(values)

        async def performed(context: TaskContext) -> None:
            words = await job(context)
            if isinstance(words, str) and words:
                self.say(words)

        self.context.manager.install(TaskType(task.id, performed))
        return None

    def drive(self, job: Job, *arguments: Any) -> str | None:
        """Start a motion; while the order does not let the base move, return why it does not."""
        if not self.guard.lift(said()):
            return f"{self._why_stopped()} {self.words('waiting')}"
        self.motion.start(job, *arguments)
        return None

    def halt(self) -> None:
        """Stand still, and fall silent."""
        self.motion.stop()
        self.gate.halt()
        self.hush()

    def hush(self) -> None:
        """Fall silent."""
        self.talk.stop()
        self.voice.hush()

    def be_quiet(self, seconds: float) -> None:
        """Say nothing for so long, and show that it listens."""
        self.silent_until = self.voice.quiet_until = self.context.clock.now() + seconds
        self._settle()

    def fall_asleep(self) -> None:
        """Stand still, say nothing and shut its eyes until it is woken."""
        self.is_asleep = True
        self.voice.quiet_until = math.inf
        self.motion.stop()
        self._settle()

    def wake(self) -> None:
        """Listen and speak again."""
        self.is_asleep = False
        self.voice.quiet_until = self.silent_until
        self._settle()

    # --- what the face shows ---

    def _settle(self) -> None:
        """Show shut eyes while it sleeps or does not watch, that it listens while it is quiet.

        Else it shows what it feels.
        """
        if self.is_asleep or not self.camera.is_on:
            self.face.start(verbs.show, "asleep", FOR_GOOD)
        elif not self.may_speak:
            quiet_for = self.silent_until - self.context.clock.now()
            self.face.start(verbs.show, "listening", quiet_for)
        else:
            self.face.stop()

    def _shown(self) -> str:
        """The expression that is to be seen; "" while it is faint."""
        slot: Latest[Expression] = self.context.board.slot("expression")
        expression = slot.value or Expression()
        return expression.label if expression.intensity >= SEEN else ""

    def is_showing(self, label: str) -> bool:
        """Whether it shows an expression instead of what it feels."""
        shown = self.context.board.slot(verbs.SHOWN).value
        return shown is not None and shown.label == label

    def feel(self, stimulus: str, intensity: float = 1.0) -> None:
        """Feel a stimulus from who talks, who is taken to be the one it attends to."""
        self.emotion.feel(stimulus, intensity, people_of(self.context).attended)

    def show(self, label: str) -> None:
        """Show an expression for a few seconds, instead of another one."""
        self.face.start(self._show, label)

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
        """Nobody talks, nothing moves, and no question of a task is open."""
        is_open = self.context.board.slot(QUESTION).value or not self.voice.is_idle
        is_busy = self.talk.is_busy or self.motion.is_busy
        return not (is_open or is_busy or self.listener.is_hearing.value)
