"""The people it knows: their names, what they told it, and whether it may keep that.

Who someone is comes from what they say, or from a face that a recognizer knows; it is not guessed.
Nothing is kept of anyone who did not allow it (`docs/memory.md`).

acquaint       keeps the memory, and notices who comes and goes
introduce, know_me, know_about_me, forget_that, forget_me   actions of replies
ask_for        for the tasks of skills
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from datetime import timedelta
from typing import Any, Literal

from hri.conversation import (
    MEETING_GAP,
    PEOPLE_FILE,
    KnownPerson,
    Meeting,
    MemoryFull,
    MemoryKeeper,
    Question,
    as_name,
    fact_of,
    file_of_run,
    load_relations,
    part_of_day,
    remembered_by,
    source_of,
)
from hri.core import HeardSlot, Latest, Utterance
from hri.robot import App, verbs
from hri.speech import Listener, both_sayings, parse, without
from hri.task import TaskContext, immediate
from hri.vision import people_of

from .companion import Companion

FILE = "memory.toml"
LOOK_EVERY = 0.5
"""Seconds between looks at who is there, and at what is to be written."""
BREATH = 0.1
"""Seconds between looks at whether it has answered."""
LONG_AWAY = timedelta(days=1)
LAST_TIME: Mapping[str, str] = {
    "praise": "met_kind",
    "comforted": "met_kind",
    "thanked": "met_kind",
    "insulted": "met_rude",
    "scold": "met_rude",
    "friend_sad": "met_sad",
}
"""By stimulus: what it says of it at the next meeting, a key of [unasked]."""
SAME_TALK = timedelta(hours=2)
"""How long before someone left a thing may have happened that is spoken of at the next meeting."""
READ_BACK = 3
"""Names that are read back: the first one heard, the likeliest of both sayings, the next best."""
NAMING = "my_name_is"
"""The rule by which people give their name."""


class Acquaintance:
    """Who is there, and the memory of them."""

    def __init__(self, context: TaskContext) -> None:
        self._context = context
        relations = load_relations(App.of(context).files(FILE))
        named: str | None = context.board.slot(PEOPLE_FILE).value
        path = file_of_run(context.clock, context.resources.is_to_repeat, named)
        self.keeper = MemoryKeeper(path, relations, context.clock, context.events)
        self.memory = self.keeper.memory
        self.relations = relations
        self._known: dict[str, int] = {}
        """By the id of who is seen, "" without eyes: who they said they are."""

    @classmethod
    def of(cls, context: TaskContext) -> Acquaintance:
        """The one of this robot, made on first use."""
        slot: Latest[Acquaintance] = context.board.slot("acquaintance")
        known = slot.value or cls(context)
        slot.set(known, context.clock.now())
        return known

    def talker(self) -> KnownPerson | None:
        """Who talks, who is taken to be the one it attends to; None for a stranger."""
        id = self._known.get(people_of(self._context).attended)
        return None if id is None else self.memory.person(id)

    def names(self) -> dict[str, str]:
        """The names of those who are there and may be remembered, by the ids of who is seen."""
        found = {id: self.memory.person(number) for id, number in self._known.items()}
        return {id: one.name for id, one in found.items() if one is not None and one.consent}

    def present(self) -> list[KnownPerson]:
        """Everyone whom it knows and who is there."""
        found = (self.memory.person(id) for id in self._known.values())
        return [person for person in found if person is not None]

    def is_called(self, person: KnownPerson) -> None:
        """Take who talks for this person from now on."""
        self._known[people_of(self._context).attended] = person.id

    def look(self) -> Meeting | None:
        """See who is there; a meeting with one whose face is known and who has just come.

        Without eyes, whoever says nothing for as long as MEETING_GAP has gone.
        """
        people, wall = people_of(self._context), self._context.clock.wall()
        here = {person.id for person in people.persons}
        unseen = self.memory.person(self._known.get("", 0))
        if unseen is not None and wall - unseen.seen < MEETING_GAP:
            here.add("")
        self._known = {seen: id for seen, id in self._known.items() if seen in here}
        for seen, id in self._known.items():
            if seen and self.memory.person(id) is not None:
                self.memory.see(id, wall)
        for person in people.persons:
            same = self.memory.named(person.name) if person.name else ()
            if person.id not in self._known and len(same) == 1:
                self._known[person.id] = same[0].id
                return self.memory.meet(same[0].id, wall)
        return None

    def teach(self) -> None:
        """Let the ears and the voice know the names of all people as they were heard."""
        companion = Companion.of(self._context)
        heard = {one.name.lower(): one.heard for one in self.memory.people if one.heard}
        companion.listener.know("name", heard)
        for one in self.memory.people:
            if one.said:
                companion.voice.pronounce(one.name, one.said)

    def note(self, rule: str, tags: Mapping[str, Any]) -> None:
        """Keep what a sentence says of who talks, if its rule is marked `@remember`."""
        companion = Companion.of(self._context)
        rules = companion.listener.loaded_grammar.rules
        relation = remembered_by(rules, self.relations).get(rule, "")
        person, wall = self.talker(), self._context.clock.wall()
        value, values = fact_of(relation, tags, wall.date()) if relation else ("", {})
        companion.talker = "" if person is None else person.name
        if person is None:
            return
        self.memory.see(person.id, wall)
        reply = companion.replies.replies.get(rule)
        if reply is not None and reply.feel in LAST_TIME:
            self.memory.feel(person.id, companion.emotion.feeling().label, reply.feel, wall)
        if not value:
            return
        if self.relations[relation].is_name:
            value = as_name(value)
        try:
            self.memory.learn(person.id, relation, value, wall, values)
        except MemoryFull:
            companion.tell("memory_full")


def check_memory(context: TaskContext) -> None:
    """Read what may be remembered. Raises AuthoringError for a mistake in it, or in the grammar."""
    relations = load_relations(App.of(context).files(FILE))
    remembered_by(context.behavior(Listener).read_grammar().rules, relations)


async def acquaint(context: TaskContext) -> None:
    """Keep the memory, and greet those whose face is known."""
    companion, known = Companion.of(context), Acquaintance.of(context)
    known.teach()
    try:
        while True:
            await context.clock.sleep(LOOK_EVERY)
            known.keeper.poll(context.clock.now())
            meeting = known.look()
            companion.emotion.know(known.names())
            if meeting is not None and meeting.away is not None and not companion.is_asleep:
                if companion.lessons.is_busy:
                    companion.say(greeting(companion, meeting))
                else:
                    companion.lessons.start(_greet, companion, meeting)
    finally:
        known.keeper.close()


async def _greet(context: TaskContext, companion: Companion, meeting: Meeting) -> None:
    """Greet someone it knows, and ask one thing."""
    known, id = Acquaintance.of(context), meeting.person.id
    question = _next_question(companion, known, id)
    words = greeting(companion, meeting)
    if question is None:
        await verbs.say(context, words)
    else:
        await _ask_about(context, companion, known, id, question, words)


def _next_question(companion: Companion, known: Acquaintance, id: int) -> Question | None:
    """What it asks someone now; it asks for no fact that no rule of its grammar gives."""
    grammar = companion.listener.loaded_grammar
    for question in known.memory.questions(id):
        if question.kind != "ask_for" or source_of(question.relation, grammar, known.relations):
            return question
    return None


def greeting(companion: Companion, meeting: Meeting) -> str:
    """A greeting of someone it knows, by the hour and by how long they were away."""
    away, hour = meeting.away or timedelta(), part_of_day(companion.context.clock.wall().hour)
    key = "met_again" if away < LONG_AWAY else "met_after_days"
    hello = companion.words(f"hello_{hour}" if away >= MEETING_GAP else "hello_again")
    words = companion.words(key, hello=hello, person=meeting.person.name, days=_days(away.days))
    if meeting.away is not None and (last := _last_time(meeting)):
        words = f"{words} {companion.words(last)}"
    return words


async def _ask_about(
    context: TaskContext,
    companion: Companion,
    known: Acquaintance,
    id: int,
    question: Question,
    words: str = "",
) -> None:
    """Say words and ask a question about someone who is known; a fact that they tell is kept."""
    asked = f"{words} {question.text}".strip()
    known.memory.note_asked(id, question.relation, question.value, question.text)
    if question.kind == "ask_for":
        await _learn(context, companion, known, question.relation, asked)
        return
    answer = await verbs.ask(context, asked)
    if answer is None or known.memory.person(id) is None:
        return
    if question.kind == "ask" and not answer:
        known.memory.unlearn(id, question.relation, question.value)
    await verbs.say(context, companion.words("is_so" if answer else "is_not_so"))


async def ask_for(
    context: TaskContext, relation: str, question: str
) -> Literal["told", "known", "unanswered", "stranger"]:
    """Ask who talks for a fact, unless they told it before; what they tell is answered and kept.

    Not an action of replies, but for tasks of skills, who get it by `App.of(context).task`.
    """
    companion, known = Companion.of(context), Acquaintance.of(context)
    person = known.talker()
    if person is None:
        return "stranger"
    if person.values(relation):
        return "known"
    known.memory.note_asked(person.id, relation, "", question)
    if not await _learn(context, companion, known, relation, question):
        return "unanswered"
    await after_the_reply(context, companion)
    return "told"


async def _learn(
    context: TaskContext, companion: Companion, known: Acquaintance, relation: str, question: str
) -> bool:
    """Ask for a fact; whether it was told, and so is answered and kept."""
    told = await _told(context, companion, known, relation, question)
    if told is None:
        return False
    known.note(told.rule, told.tags)
    companion.reply(told.rule, told.command or told.text, dict(told.tags))
    return True


async def _told(
    context: TaskContext, companion: Companion, known: Acquaintance, relation: str, question: str
) -> Utterance | None:
    """What someone says when they are asked for a fact; None without an answer.

    A free slot takes any words: those of another sentence are answered as that one.
    """
    grammar = companion.listener.loaded_grammar
    source = source_of(relation, grammar, known.relations)
    answer = await verbs.ask_value(context, *source, question=question) if source else None
    if answer is None or source is None:
        return None
    other = parse(grammar, answer.text)
    if other is None or other.rule == source[0]:
        return replace(answer, rule=source[0])
    known.note(other.rule, other.tags)
    companion.reply(other.rule, other.text, dict(other.tags))
    return None


def _last_time(meeting: Meeting) -> str:
    """The key of [unasked] for what it felt with them at the last meeting; empty for nothing."""
    felt = meeting.person.felt
    since = meeting.person.seen - (meeting.away or timedelta()) - SAME_TALK
    return LAST_TIME.get(felt[-1].because, "") if felt and felt[-1].when >= since else ""


def _days(days: int) -> str:
    return "a day" if days == 1 else f"{days} days"


@immediate
def introduce(context: TaskContext, name: str = "") -> None:
    """Learn the name of who talks: read back what was heard, and ask whether it may be kept."""
    companion = Companion.of(context)
    if not name or not companion.may_speak:
        return
    utterance = companion.listener.last_utterance
    heard = (
        next((slot for slot in utterance.slots if slot.name == "name"), None) if utterance else None
    )
    companion.lessons.start(_introduce, companion, name, heard)


def take_name(companion: Companion, name: str) -> None:
    """Learn the name of who talks as it was typed: ask whether it may be kept."""
    companion.lessons.start(_introduce, companion, name, None)


async def _introduce(
    context: TaskContext, companion: Companion, name: str, heard: HeardSlot | None
) -> None:
    known, wall = Acquaintance.of(context), context.clock.wall()
    await after_the_reply(context, companion)
    name = as_name(name)
    phones: tuple[str, ...] = ()
    if heard is not None:
        name, phones = await _read_back(context, companion, heard)
    if not name:
        return
    here = {person.id for person in known.present()}
    same = [person for person in known.memory.named(name) if person.id not in here]
    talker = known.talker()
    if talker is not None and talker.name == name:
        await verbs.say(context, companion.words("name_known", person=name))
        return
    have_met = await _have_met(context, companion, same, name)
    if have_met is None:  # Another person of that name is made only after a no.
        return
    person = await _who_of(context, companion, known, same, name) if have_met else None
    if person is not None:
        known.is_called(person)
        await _greet(context, companion, known.memory.meet(person.id, wall))
        return
    person = known.memory.introduce(name, wall, heard=phones, said=phones)
    known.is_called(person)
    known.teach()
    if not await _may_keep(context, companion, known, person):
        return
    if (question := _next_question(companion, known, person.id)) is not None:
        await _ask_about(context, companion, known, person.id, question)


async def after_the_reply(context: TaskContext, companion: Companion) -> None:
    """Let it say what it answers at once."""
    await context.clock.sleep(BREATH)
    while companion.talk.is_busy:
        await context.clock.sleep(BREATH)


async def _read_back(
    context: TaskContext, companion: Companion, heard: HeardSlot
) -> tuple[str, tuple[str, ...]]:
    """The name that was said, and its phones; empty when none was right, or nobody answered.

    After the first no the name is asked for once more, and both sayings count together.
    """
    refused: list[HeardSlot] = []
    for number in range(READ_BACK):
        name = as_name(heard.text)
        companion.voice.pronounce(name, heard.phones)
        answer = await verbs.ask(context, f"{name}?")
        if answer is None:
            return "", ()
        if answer:
            return name, heard.phones
        refused.append(heard)
        if number == 0:
            again = await _name_again(context, companion)
            if again is None:
                return "", ()
            if not again.phones:  # what was typed has none, and is taken as it is
                return as_name(again.text), ()
            heard = both_sayings(heard, again)
        rest = without(heard, refused)
        if rest is None:
            break
        heard = rest
    await verbs.say(context, companion.words("name_unclear"))
    return "", ()


async def _name_again(context: TaskContext, companion: Companion) -> HeardSlot | None:
    """The name as it is said once more; None without an answer."""
    question = companion.words("name_again")
    answer = await verbs.ask_value(context, NAMING, "name", question=question)
    if answer is None:
        return None
    typed = HeardSlot("name", str(answer.tags["name"]))
    return next((slot for slot in answer.slots if slot.name == "name"), typed)


async def _have_met(
    context: TaskContext, companion: Companion, same: Sequence[KnownPerson], name: str
) -> bool | None:
    """Whether who talks is one of those with this name; None without an answer."""
    if not same:
        return False
    answer = await verbs.ask(context, companion.words("have_we_met", person=name))
    return answer if isinstance(answer, bool) else None


async def _who_of(
    context: TaskContext,
    companion: Companion,
    known: Acquaintance,
    same: Sequence[KnownPerson],
    name: str,
) -> KnownPerson | None:
    """Who of those with this name talks; None where it cannot be known.

    Of several it asks for what each of them told, and no two the same: it says nothing of anyone.
    """
    if len(same) == 1:
        return same[0]
    relation = known.memory.apart(same)
    if not relation:
        return None
    question = companion.words("which_of_them", person=name)
    asked = f"{question} {known.relations[relation].ask_for[0]}"
    told = await _told(context, companion, known, relation, asked)
    value = fact_of(relation, told.tags, context.clock.wall().date())[0] if told else ""
    found = known.memory.those_with(same, relation, value) if value else ()
    return found[0] if len(found) == 1 else None


async def _may_keep(
    context: TaskContext, companion: Companion, known: Acquaintance, person: KnownPerson
) -> bool:
    """Ask aloud whether it may remember a person; a word or a nod gives leave."""
    with context.queue("question.answered") as answered:
        may = await verbs.ask(context, companion.words("may_remember", person=person.name))
        event = await answered.get() if may is not None else None
    may = may is True and known.memory.person(person.id) is not None
    if may:
        how: Literal["word", "nod"] = (
            "nod" if event and event.properties["by"] == "head" else "word"
        )
        try:
            known.memory.allow(person.id, context.clock.wall(), how)
        except MemoryFull:
            await verbs.say(context, companion.words("memory_full"))
            return False
    key = "will_remember" if may else "will_not_remember"
    await verbs.say(context, companion.words(key, person=person.name))
    return may


@immediate
def know_me(context: TaskContext) -> str | None:
    """Say the name of who talks; for a stranger the reply."""
    person = Acquaintance.of(context).talker()
    companion = Companion.of(context)
    return None if person is None else companion.words("you_are", person=person.name)


@immediate
def know_about_me(context: TaskContext) -> str | None:
    """Say all that it knows of who talks."""
    known, companion = Acquaintance.of(context), Companion.of(context)
    person = known.talker()
    if person is None:
        return None
    told = known.memory.told(person.id)
    name = companion.words("you_are", person=person.name)
    return f"{name} {' '.join(told)}" if told else f"{name} {companion.words('nothing_told')}"


@immediate
def forget_that(context: TaskContext) -> str | None:
    """Forget what who talks told last."""
    known, companion = Acquaintance.of(context), Companion.of(context)
    person = known.talker()
    fact = None if person is None else known.memory.newest_fact(person.id)
    if person is None or fact is None:
        return None
    known.memory.unlearn(person.id, fact.relation, fact.value)
    return companion.words("forgot_that", value=fact.value)


@immediate
def forget_me(context: TaskContext) -> str | None:
    """Forget who talks, after a yes."""
    person = Acquaintance.of(context).talker()
    if person is None:
        return None
    companion = Companion.of(context)
    companion.lessons.start(_forget, companion, person)
    return ""


async def _forget(context: TaskContext, companion: Companion, person: KnownPerson) -> None:
    known = Acquaintance.of(context)
    if await verbs.ask(context, companion.words("forget_all", person=person.name)):
        if known.memory.person(person.id) is not None:
            known.memory.forget(person.id)
            known.teach()
            if not known.memory.named(person.name):  # else it feels that about another one, too
                companion.emotion.forget(person.name)
            companion.voice.pronounce(person.name, ())
        await verbs.say(context, companion.words("forgot_you"))
