"""Knowledge of people during a run: who they are, what they told, which questions they were asked.

Only arithmetic: wall times are arguments, and the file is `MemoryKeeper`'s. Who allowed it is
written there; everyone else is forgotten with the run. Nothing is guessed: people of the same name
are different people, until what they say shows who they are.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from typing import Literal

from hri.conversation.facts import Fact, Scalar, check_values, check_words
from hri.conversation.people import (
    MOST_ASKED,
    MOST_FACTS,
    MOST_FELT,
    MOST_PHONES,
    WAYS,
    Asked,
    Consent,
    Felt,
    How,
    KnownPerson,
)
from hri.conversation.relations import Relation
from hri.core.errors import HriError, did_you_mean
from hri.core.privacy import is_same_name

MEETING_GAP = timedelta(minutes=30)
"""Who was away for that long is met again."""
SEEN_EVERY = timedelta(minutes=1)
"""How exactly it is known when someone was here last."""
MOST_PEOPLE = 100
"""People that are remembered, and as many who are known in a run."""
MOST_VALUES = 30
"""Values of one relation of a person."""
LONGEST_QUESTION = 200
"""Characters of a question that are remembered."""


class MemoryFull(HriError):
    """There is no room for another person or fact."""


@dataclass(frozen=True, slots=True)
class Meeting:
    """Someone is here."""

    person: KnownPerson
    away: timedelta | None
    """How long they were away; None within a meeting."""


@dataclass(frozen=True, slots=True)
class Question:
    """What may be asked about a fact, or for one."""

    kind: Literal["follow_up", "ask_for", "ask"]
    """What of the relation it is; `ask` and some of `follow_up` are answered by yes or no."""
    relation: str
    value: str
    """Empty for one that asks for a fact."""
    text: str
    """As it is said."""


class Memory:
    """The people that are known; each call that changes one gives their new state."""

    def __init__(
        self,
        relations: Mapping[str, Relation] | None = None,
        people: Iterable[KnownPerson] = (),
        last_id: int = 0,
    ) -> None:
        """`last_id` is the highest id that anyone ever had."""
        self.relations = dict(relations or {})
        self._people = {person.id: person for person in people}
        self.last_id = max([last_id, *self._people])

    @property
    def people(self) -> tuple[KnownPerson, ...]:
        """Everyone who is known."""
        return tuple(self._people.values())

    @property
    def remembered(self) -> dict[int, KnownPerson]:
        """Everyone who allowed it, by id: what is written to the file."""
        return {id: person for id, person in self._people.items() if person.consent is not None}

    def person(self, id: int) -> KnownPerson | None:
        """The person with an id; None when they were forgotten."""
        return self._people.get(id)

    def named(self, name: str) -> tuple[KnownPerson, ...]:
        """Everyone of that name, capital letters or not; who was seen last comes first."""
        found = [person for person in self.people if person.is_called(name)]
        return tuple(sorted(found, key=lambda person: person.seen, reverse=True))

    # --- who they are ---

    def introduce(
        self, name: str, now: datetime, *, heard: Iterable[str] = (), said: Iterable[str] = ()
    ) -> KnownPerson:
        """Someone who is not known yet, also when others have the same name.

        Raises HriError for a name that cannot be kept.
        """
        now = _to_the_second(now)
        strangers = [person for person in self.people if person.consent is None]
        if len(strangers) >= MOST_PEOPLE:
            self.drop(min(strangers, key=lambda person: person.seen).id)
        self.last_id += 1
        person = KnownPerson(self.last_id, check_words(name, "name"), now, now, now)
        self._people[person.id] = person
        return self.rename(person.id, name, heard=heard, said=said)

    def rename(
        self, id: int, name: str, *, heard: Iterable[str] = (), said: Iterable[str] = ()
    ) -> KnownPerson:
        """Another name, or the same one with another sound. Raises HriError."""
        sounds = _phones(heard), _phones(said)
        person = self._known(id)
        return self._put(
            replace(person, name=check_words(name, "name"), heard=sounds[0], said=sounds[1])
        )

    def allow(self, id: int, now: datetime, how: How) -> KnownPerson:
        """From now on they are remembered, with all that is known by now. Raises MemoryFull."""
        person = self._known(id)
        if how not in WAYS:
            raise HriError(f'"{how}" is not a consent - {did_you_mean(how, WAYS)}')
        if person.consent is None and len(self.remembered) >= MOST_PEOPLE:
            what = f"{MOST_PEOPLE} people are remembered"
            raise MemoryFull(f"{what} - make room: hri memory list, hri forget NAME")
        return self._put(replace(person, consent=Consent(_to_the_second(now), how)))

    def meet(self, id: int, now: datetime) -> Meeting:
        """They came, or are known again. After MEETING_GAP it is another meeting."""
        now, person = _to_the_second(now), self._known(id)
        away = now - person.seen
        if away < MEETING_GAP:
            return Meeting(self._put(replace(person, seen=now)), None)
        again = replace(person, seen=now, met=now, meetings=person.meetings + 1)
        return Meeting(self._put(again), away)

    def see(self, id: int, now: datetime) -> None:
        """They are still here. One who was forgotten is not known."""
        now, person = _to_the_second(now), self.person(id)
        if person is not None and now - person.seen >= SEEN_EVERY:
            self._put(replace(person, seen=now))

    def feel(self, id: int, feeling: str, because: str, now: datetime) -> KnownPerson:
        """What the robot felt with them. Raises HriError for a text that cannot be kept."""
        words = check_words(feeling, "feeling"), check_words(because, "cause")
        felt, person = Felt(*words, _to_the_second(now)), self._known(id)
        return self._put(replace(person, felt=(*person.felt, felt)[-MOST_FELT:]))

    def forget(self, id: int) -> None:
        """Someone is no longer known, nor is what others told of them, unless someone else who
        is known has the same name.
        """
        gone = self._people.pop(id, None)
        if gone is None or self.named(gone.name):
            return
        for person in self.people:
            rest = person.without(gone.name)
            if rest != person:
                self._put(rest)

    def forget_all(self) -> None:
        """Nobody is known any more."""
        self._people.clear()

    # --- what they told ---

    def learn(
        self,
        id: int,
        relation: str,
        value: str,
        now: datetime,
        values: Mapping[str, Scalar] | None = None,
    ) -> KnownPerson:
        """They told a fact. A value that was told before is only newer then.

        Raises MemoryFull; HriError for a relation that is not known, and for words that cannot be
        kept.
        """
        kind, person = self._relation(relation), self._known(id)
        told = Fact(
            relation, check_words(value, "value"), _to_the_second(now), check_values(values or {})
        )
        of_it = [fact for fact in person.facts if fact.relation == relation]
        gone = [f for f in of_it if not kind.several or is_same_name(f.value, told.value)]
        if len(of_it) - len(gone) >= MOST_VALUES:
            what = f"{len(of_it)} values of {relation} are known of {person.name}"
            raise MemoryFull(f"{what} - forget one first")
        rest = tuple(fact for fact in person.facts if fact not in gone)
        if len(rest) >= MOST_FACTS:
            what = f"{len(rest)} facts are known of {person.name}"
            raise MemoryFull(f"{what} - forget one first")
        return self._put(replace(person, facts=(*rest, told)))

    def unlearn(self, id: int, relation: str, value: str = "") -> KnownPerson:
        """Forget a value, or all of a relation, with what was asked about it."""
        person = self._known(id)
        return self._put(
            replace(
                person,
                facts=tuple(fact for fact in person.facts if not fact.is_about(relation, value)),
                asked=tuple(one for one in person.asked if not _is_about(one, relation, value)),
            )
        )

    def newest_fact(self, id: int) -> Fact | None:
        """What they told last; None when nothing is known."""
        person = self.person(id)
        return person.facts[-1] if person is not None and person.facts else None

    def told(self, id: int) -> tuple[str, ...]:
        """What is known of them, in sentences for them, the newest last."""
        person = self._known(id)
        facts = [fact for fact in person.facts if fact.relation in self.relations]
        return tuple(_filled(self.relations[f.relation].tell, person, f.value) for f in facts)

    # --- what to ask ---

    def may_ask(self, id: int, relation: str, value: str = "") -> bool:
        """Whether nothing was asked about that in this meeting."""
        person = self._known(id)
        return not any(
            one.meeting == person.meetings and _is_about(one, relation, value or None)
            for one in person.asked
        )

    def note_asked(self, id: int, relation: str, value: str = "", text: str = "") -> KnownPerson:
        """A question was asked; `value` is empty for one that asked for a fact. Raises HriError."""
        person = self._known(id)
        about = check_words(relation, "relation"), value and check_words(value, "value")
        short = text[:LONGEST_QUESTION]
        question = short and check_words(short, "question", LONGEST_QUESTION)
        asked = Asked(*about, question, person.meetings)
        return self._put(replace(person, asked=(*person.asked, asked)[-MOST_ASKED:]))

    def questions(self, id: int) -> tuple[Question, ...]:
        """What may be asked now, the best first.

        Those that follow up on facts of earlier meetings come first, then those that ask for
        facts, then those that check one; of each kind the one that was asked least, and of these
        that about the newest fact.
        """
        person = self._known(id)
        told = [fact for fact in reversed(person.facts) if fact.since < person.met]
        facts = [
            (self.relations[f.relation], f.value) for f in told if f.relation in self.relations
        ]
        missing = [(one, "") for one in self.relations.values() if not person.values(one.name)]
        found = [
            *self._asking(person, "follow_up", facts),
            *self._asking(person, "ask_for", missing),
            *self._asking(person, "ask", facts),
        ]
        things = {(one.relation, one.value): one for one in reversed(found)}
        return tuple(one for one in found if things[one.relation, one.value] is one)

    def _asking(
        self,
        person: KnownPerson,
        kind: Literal["follow_up", "ask_for", "ask"],
        about: Iterable[tuple[Relation, str]],
    ) -> list[Question]:
        """The questions of a kind about facts, or for them; their texts take turns."""
        found = []
        for relation, value in about:
            texts: tuple[str, ...] = getattr(relation, kind)
            if texts and self.may_ask(person.id, relation.name, value):
                times = sum(_is_about(one, relation.name, value or None) for one in person.asked)
                text = _filled(texts[times % len(texts)], person, value)
                found.append((times, Question(kind, relation.name, value, text)))
        return [question for _, question in sorted(found, key=lambda one: one[0])]

    # --- who is who ---

    def apart(self, people: Iterable[KnownPerson]) -> str:
        """The relation to ask for, so that an answer shows who of these it is; empty for none.

        Each of them has told of it, and no two the same.
        """
        several = tuple(people)
        for relation in self.relations.values():
            values = [person.values(relation.name) for person in several]
            flat = [value.casefold() for of_one in values for value in of_one]
            if relation.ask_for and all(values) and len(set(flat)) == len(flat):
                return relation.name
        return ""

    @staticmethod
    def those_with(
        people: Iterable[KnownPerson], relation: str, value: str
    ) -> tuple[KnownPerson, ...]:
        """Those who told this."""
        return tuple(person for person in people if person.has(relation, value))

    # --- for the keeper ---

    def put(self, person: KnownPerson) -> None:
        """Take over the state of a person from the file."""
        self._people[person.id] = person
        self.last_id = max(self.last_id, person.id)

    def drop(self, id: int) -> None:
        """Someone is not known any more; what others told of them stays."""
        self._people.pop(id, None)

    def _known(self, id: int) -> KnownPerson:
        person = self.person(id)
        if person is None:
            raise HriError(f"nobody is known by the id {id} - introduce them first")
        return person

    def _relation(self, name: str) -> Relation:
        if name not in self.relations:
            raise HriError(f'no relation "{name}" - add [relation.{name}] to memory.toml')
        return self.relations[name]

    def _put(self, person: KnownPerson) -> KnownPerson:
        self._people[person.id] = person
        return person


def _is_about(asked: Asked, relation: str, value: str | None) -> bool:
    """Whether a question was about a relation and a value; None for one that asked for a value,
    empty for any.
    """
    if asked.relation != relation:
        return False
    return value == "" or is_same_name(asked.value, value or "")


def _filled(text: str, person: KnownPerson, value: str) -> str:
    return text.format(name=person.name, value=value)


def _phones(phones: Iterable[str]) -> tuple[str, ...]:
    """Phones that may be remembered. Raises HriError."""
    found = tuple(phones)
    if len(found) > MOST_PHONES or not all(phone.isalnum() and len(phone) <= 4 for phone in found):
        raise HriError(f"{len(found)} phones of a name - give at most {MOST_PHONES} of the CMU set")
    return found


def _to_the_second(time: datetime) -> datetime:
    """A wall time as it is kept: local, without what nobody needs."""
    local = time if time.tzinfo is None else time.astimezone().replace(tzinfo=None)
    return local.replace(microsecond=0)
