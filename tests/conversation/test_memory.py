"""What is known of people in a run: pure arithmetic on their states."""

from datetime import UTC, datetime, timedelta

import pytest
from hypothesis import given, strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule

from hri.conversation.memory import (
    LONGEST_QUESTION,
    MEETING_GAP,
    MOST_PEOPLE,
    MOST_VALUES,
    Memory,
    MemoryFull,
)
from hri.conversation.people import MOST_ASKED, MOST_FACTS, MOST_FELT
from hri.conversation.relations import Relation
from hri.core.errors import HriError

NOW = datetime(2026, 5, 4, 9, 30)
DAY = timedelta(days=1)
RELATIONS = {
    one.name: one
    for one in (
        Relation(
            "likes",
            "You like {value}.",
            several=True,
            ask_for=("What do you like?",),
            follow_up=("How was your {value} evening?", "Any more {value}, {name}?"),
        ),
        Relation("birthday", "Your birthday is {value}.", ask_for=("When is your birthday?",)),
        Relation("sister", "Your sister is {value}.", several=True, ask=("Is {value} well?",)),
        Relation("home", "You live in {value}."),
    )
}


def a_memory(*names: str) -> Memory:
    """People who allowed it."""
    memory = Memory(RELATIONS)
    for name in names:
        memory.allow(memory.introduce(name, NOW).id, NOW, "word")
    return memory


def test_who_is_introduced_is_remembered_only_after_consent() -> None:
    memory = Memory(RELATIONS)
    anna = memory.introduce("Anna", NOW, heard=["AE1", "N", "AH0"])
    memory.learn(anna.id, "likes", "jazz", NOW)
    assert memory.remembered == {}
    memory.allow(anna.id, NOW, "nod")
    (kept,) = memory.remembered.values()
    assert (kept.values("likes"), kept.heard) == (("jazz",), ("AE1", "N", "AH0"))
    assert kept.consent is not None
    assert kept.consent.how == "nod"


def test_people_of_one_name_are_kept_apart() -> None:
    memory = a_memory("Anna", "ANNA", "Ben")
    first, second = memory.named("anna")
    memory.learn(first.id, "likes", "jazz", NOW)
    assert memory.named("Anna")[1].facts == ()
    assert first.id != second.id


def test_who_was_seen_last_comes_first() -> None:
    memory = a_memory("Anna", "Anna")
    memory.meet(2, NOW + DAY)
    assert [person.id for person in memory.named("Anna")] == [2, 1]


def test_several_of_one_name_are_told_apart_by_what_each_has_told() -> None:
    memory = a_memory("Anna", "Anna")
    assert memory.apart(memory.named("Anna")) == ""
    memory.learn(1, "birthday", "May third", NOW)
    assert memory.apart(memory.named("Anna")) == ""
    memory.learn(2, "birthday", "may third", NOW)
    assert memory.apart(memory.named("Anna")) == ""
    memory.learn(2, "birthday", "June first", NOW)
    assert memory.apart(memory.named("Anna")) == "birthday"
    (found,) = memory.those_with(memory.named("Anna"), "birthday", "MAY THIRD")
    assert found.id == 1


def test_an_id_is_not_given_to_another_one() -> None:
    memory = a_memory("Anna", "Ben")
    memory.forget(2)
    assert memory.introduce("Clara", NOW).id == 3
    assert Memory(RELATIONS, memory.people, 7).introduce("Dora", NOW).id == 8


def test_after_a_while_it_is_another_meeting() -> None:
    memory = a_memory("Anna")
    assert memory.meet(1, NOW + MEETING_GAP / 2).away is None
    memory.see(1, NOW + MEETING_GAP)
    assert memory.meet(1, NOW + MEETING_GAP * 1.5).away is None
    meeting = memory.meet(1, NOW + DAY)
    assert meeting.away == DAY - MEETING_GAP * 1.5
    assert (meeting.person.meetings, meeting.person.met) == (2, NOW + DAY)
    assert memory.meet(1, NOW).away is None  # a clock that was set back
    assert memory.meet(1, NOW + DAY).away == DAY


def test_that_someone_is_still_here_changes_nothing_each_time() -> None:
    memory = a_memory("Anna")
    before = memory.person(1)
    memory.see(1, NOW + timedelta(seconds=30))
    assert memory.person(1) is before
    memory.see(99, NOW)


def test_times_are_local_and_to_the_second() -> None:
    memory = a_memory("Anna")
    memory.learn(1, "likes", "jazz", datetime(2026, 5, 4, 9, 30, 1, 5, tzinfo=UTC))
    since = memory.people[0].facts[0].since
    assert (since.tzinfo, since.microsecond) == (None, 0)


def test_a_relation_of_one_value_is_replaced_and_of_several_grows() -> None:
    memory = a_memory("Anna")
    for value in ("May third", "June first"):
        memory.learn(1, "birthday", value, NOW)
    for value in ("jazz", "tea", "JAZZ"):
        person = memory.learn(1, "likes", value, NOW)
    assert person.values("birthday") == ("June first",)
    assert person.values("likes") == ("tea", "JAZZ")


def test_what_was_told_last_can_be_forgotten() -> None:
    memory = a_memory("Anna")
    assert memory.newest_fact(1) is None
    memory.learn(1, "likes", "jazz", NOW)
    memory.learn(1, "likes", "tea", NOW)
    newest = memory.newest_fact(1)
    assert newest is not None
    assert memory.unlearn(1, newest.relation, newest.value).values("likes") == ("jazz",)
    assert memory.unlearn(1, "likes").facts == ()


def test_what_is_known_is_told_in_sentences() -> None:
    memory = a_memory("Anna")
    memory.learn(1, "likes", "jazz", NOW)
    memory.learn(1, "sister", "Eva", NOW)
    assert memory.told(1) == ("You like jazz.", "Your sister is Eva.")
    assert Memory({}, memory.people).told(1) == ()  # an app that knows other relations


def test_who_is_forgotten_is_also_forgotten_by_others() -> None:
    memory = a_memory("Anna", "Ben")
    memory.learn(2, "sister", "Anna", NOW)
    memory.learn(2, "likes", "Anna's cake", NOW)
    memory.learn(2, "likes", "tea", NOW)
    memory.note_asked(2, "sister", "Anna", "Is Anna well?")
    memory.feel(2, "joy", "a word about Anna", NOW)
    memory.forget(1)
    (ben,) = memory.people
    assert "Anna" not in " ".join(ben.texts())
    assert ben.values("likes") == ("tea",)
    memory.forget(1)


def test_a_name_that_someone_else_has_too_stays_with_those_who_told_of_it() -> None:
    memory = a_memory("Anna", "Anna", "Ben")
    memory.learn(3, "sister", "Anna", NOW)
    memory.forget(1)
    assert memory.named("Ben")[0].values("sister") == ("Anna",)


def test_it_asks_first_about_what_was_told_in_earlier_meetings() -> None:
    memory = a_memory("Anna")
    memory.learn(1, "likes", "jazz", NOW)
    kinds = [(one.kind, one.relation) for one in memory.questions(1)]
    assert kinds == [("ask_for", "birthday")]
    memory.learn(1, "sister", "Eva", NOW)
    memory.meet(1, NOW + DAY)
    assert [one.text for one in memory.questions(1)] == [
        "How was your jazz evening?", "When is your birthday?", "Is Eva well?",
    ]  # fmt: skip


def test_it_asks_one_question_a_meeting_about_the_same_thing() -> None:
    memory = a_memory("Anna")
    memory.learn(1, "likes", "jazz", NOW)
    memory.learn(1, "likes", "tea", NOW)
    asked = []
    for day in range(1, 4):
        memory.meet(1, NOW + day * DAY)
        while questions := memory.questions(1):
            one = questions[0]
            assert memory.may_ask(1, one.relation, one.value)
            asked.append(one.text)
            memory.note_asked(1, one.relation, one.value, one.text)
            assert not memory.may_ask(1, one.relation, one.value)
    assert asked[:3] == [
        "How was your tea evening?", "How was your jazz evening?", "When is your birthday?",
    ]  # fmt: skip
    assert asked[3:5] == ["Any more tea, Anna?", "Any more jazz, Anna?"]
    assert len(asked) == 9


def test_there_is_room_for_so_much_only() -> None:
    memory = a_memory(*(f"Anna{number}" for number in range(MOST_PEOPLE)))
    stranger = memory.introduce("Zoe", NOW)
    with pytest.raises(MemoryFull, match="make room"):
        memory.allow(stranger.id, NOW, "word")
    for number in range(MOST_VALUES):
        memory.learn(1, "likes", f"tea {number}", NOW)
    with pytest.raises(MemoryFull, match="forget one"):
        memory.learn(1, "likes", "jam", NOW)
    memory.learn(1, "likes", "tea 0", NOW)  # again
    for number in range(MOST_FACTS - MOST_VALUES):
        memory.learn(1, "sister", f"Eva {number}", NOW)
    with pytest.raises(MemoryFull, match="forget one"):
        memory.learn(1, "home", "Berlin", NOW)
    for number in range(2 * MOST_PEOPLE):
        memory.introduce(f"Stranger {number}", NOW)
    assert len(memory.people) <= 2 * MOST_PEOPLE
    for _ in range(2 * MOST_ASKED):
        memory.feel(1, "joy", "praise", NOW)
        memory.note_asked(1, "likes", "tea", "?" * 2 * LONGEST_QUESTION)
    assert len(memory.people[0].felt) == MOST_FELT
    assert len(memory.people[0].asked) == MOST_ASKED


@pytest.mark.parametrize("text", ["", " ", "a" * 101, "\x1b[2J", "\ud800", "\u202eanna"])
def test_what_cannot_be_kept_is_refused_and_changes_nothing(text: str) -> None:
    memory = a_memory("Anna")
    before = memory.people
    for call in (
        lambda: memory.introduce(text, NOW),
        lambda: memory.rename(1, text),
        lambda: memory.learn(1, "likes", text, NOW),
        lambda: memory.feel(1, text, "praise", NOW),
        lambda: memory.feel(1, "joy", text, NOW),
    ):
        with pytest.raises(HriError):
            call()
    assert memory.people == before


@pytest.mark.parametrize(
    "call",
    [
        lambda memory: memory.learn(1, "hates", "jazz", NOW),
        lambda memory: memory.learn(9, "likes", "jazz", NOW),
        lambda memory: memory.learn(1, "likes", "jazz", NOW, {"how": float("nan")}),
        lambda memory: memory.learn(1, "likes", "jazz", NOW, {f"{n}": n for n in range(9)}),
        lambda memory: memory.rename(1, "Anna", heard=["AE1 N"]),
        lambda memory: memory.rename(1, "Anna", said=["AE1"] * 101),
        lambda memory: memory.allow(1, NOW, "guess"),
        lambda memory: memory.note_asked(1, "likes", "a" * 101),
    ],
)
def test_what_is_not_known_is_refused(call: object) -> None:
    memory = a_memory("Anna")
    before = memory.people
    with pytest.raises(HriError):
        call(memory)  # type: ignore[operator]
    assert memory.people == before


@given(st.lists(st.text(max_size=9)))
def test_any_names_are_kept_or_refused(names: list[str]) -> None:
    memory = Memory(RELATIONS)
    for name in names:
        try:
            person = memory.introduce(name, NOW)
        except HriError:
            continue
        assert person in memory.named(person.name)


class Visits(RuleBasedStateMachine):
    """Whatever happens, ids are unique, and only who allowed it is remembered."""

    def __init__(self) -> None:
        super().__init__()
        self.memory = Memory(RELATIONS)
        self.time = NOW
        self.allowed: set[int] = set()
        self.ids: list[int] = []

    @rule(name=st.sampled_from(["Anna", "Ben"]))
    def introduce(self, name: str) -> None:
        person = self.memory.introduce(name, self.time)
        assert person.id not in self.ids
        self.ids.append(person.id)

    @rule(data=st.data())
    def act(self, data: st.DataObject) -> None:
        if not self.memory.people:
            return
        id = data.draw(st.sampled_from([person.id for person in self.memory.people]))
        act = data.draw(st.sampled_from(["allow", "learn", "forget", "meet", "ask"]))
        self.time += data.draw(st.sampled_from([timedelta(0), MEETING_GAP]))
        if act == "allow":
            self.memory.allow(id, self.time, "word")
            self.allowed.add(id)
        elif act == "learn":
            value = data.draw(st.sampled_from(["Anna", "Ben", "jazz"]))
            relation = data.draw(st.sampled_from([*RELATIONS]))
            self.memory.learn(id, relation, value, self.time)
        elif act == "forget":
            self.memory.forget(id)
        elif act == "meet":
            self.memory.meet(id, self.time)
        elif questions := self.memory.questions(id):
            one = questions[0]
            self.memory.note_asked(id, one.relation, one.value, one.text)

    @invariant()
    def only_who_allowed_it_is_remembered(self) -> None:
        assert set(self.memory.remembered) <= self.allowed

    @invariant()
    def nothing_is_asked_twice_in_a_meeting(self) -> None:
        for person in self.memory.people:
            things = [(a.relation, a.value, a.meeting) for a in person.asked]
            assert len(things) == len(set(things))

    @invariant()
    def each_relation_has_the_values_it_may_have(self) -> None:
        for person in self.memory.people:
            assert all(
                len(person.values(name)) <= 1 or kind.several for name, kind in RELATIONS.items()
            )


TestVisits = Visits.TestCase
