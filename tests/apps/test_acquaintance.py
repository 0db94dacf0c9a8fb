"""The companion knows people: their names, what they told it, and whether it may keep that."""

from __future__ import annotations

from datetime import timedelta

from hri.conversation import PEOPLE_FILE, MemoryKeeper
from hri.core import EventBus, FakeClock
from hri.emotion.behaviors import EmotionModel
from tests.apps.test_companion import SEEING, Visit
from tests.apps.test_manners import typed, typing

INTRODUCED = {1.0: "my name is Anna", 6.0: "yes"}


def said(visit):
    return " ".join(visit.said())


def test_who_says_their_name_is_asked_for_consent_and_called_by_it():
    visit = typed(24, {**INTRODUCED, 12.0: "who am i", 17.0: "hello"})
    assert "May I remember you, Anna?" in visit.said()
    assert "Thank you, Anna. I'll remember you." in visit.said()
    assert "You're Anna." in visit.said()
    assert "Hello, Anna!" in visit.said()


def test_what_people_tell_is_told_back_and_forgotten_when_they_ask():
    visit = typed(
        40,
        {
            **INTRODUCED,
            11.0: "i like jazz",
            13.0: "my birthday is on may third",
            15.0: "my sister is called Eva",
            19.0: "what do you know about me",
            27.0: "forget what i just said",
            32.0: "what do you know about me",
        },
    )
    first, last = (words for words in visit.said() if words.startswith("You're Anna."))
    assert first == (
        "You're Anna. You like jazz. Your birthday is on May 3. Your sister is called Eva."
    )
    assert last == "You're Anna. You like jazz. Your birthday is on May 3."


def test_a_no_keeps_it_for_the_visit_alone_and_forget_me_needs_a_yes():
    visit = typed(
        34, {1.0: "my name is Anna", 6.0: "no", 12.0: "forget me", 17.0: "yes", 24.0: "who am i"}
    )
    assert "Okay. I'll only know you for today." in visit.said()
    assert "Should I forget all about you, Anna?" in visit.said()
    assert "Done. I don't know you anymore." in visit.said()
    assert "You're Anna." not in said(visit)


def test_a_spoken_name_is_read_back_and_kept_as_it_was_heard(tmp_path):
    file = tmp_path / "people.db"
    lines = {2.0: "my name is peter", 9.0: "yes", 16.0: "yes"}

    def keep(robot):
        robot.board.slot(PEOPLE_FILE).set(str(file), 0.0)

    visit = Visit(22, lines, prepare=keep, devices=SEEING)
    asked = [event.properties["text"] for event in visit.named("question.asked")]
    assert asked[:2] == ["Peter?", "May I remember you, Peter?"]
    clock = FakeClock()
    kept = MemoryKeeper(file, {}, clock, EventBus(clock)).memory.named("peter")
    assert [one.heard for one in kept] == [("P", "IY", "T", "ER")]


def test_a_name_that_was_wrong_is_asked_for_again():
    lines = {2.0: "my name is zorvin", 9.0: "no", 15.5: "zorvin", 22.0: "no"}
    visit = Visit(27, lines, devices=SEEING)
    asked = [event.properties["text"] for event in visit.named("question.asked")]
    assert asked[1] == "Sorry. What's your name again?"
    read_back = [asked[0], *asked[2:]]
    assert len(read_back) == 3
    assert len({*read_back}) == 3, "what was refused is not said again"


def test_a_name_that_was_wrong_may_be_typed():
    lines = {2.0: "my name is zorvin", 9.0: "no"}
    visit = Visit(22, lines, jobs=[typing({15.0: "Zorvyn"})], devices=SEEING)
    assert "May I remember you, Zorvyn?" in visit.said()


def test_it_asks_one_thing_of_who_may_be_remembered():
    visit = typed(40, {**INTRODUCED, 11.0: "jazz", 17.0: "what do you know about me"})
    assert [text for text in visit.said() if text == "What do you like?"] == ["What do you like?"]
    assert "You're Anna. You like jazz." in visit.said()


def test_another_sentence_does_not_answer_its_question():
    visit = typed(
        30, {**INTRODUCED, 11.0: "who am i", 16.0: "my name is Ben", 24.0: "yes", 28.0: "hello"}
    )
    assert "You're Anna." in visit.said()
    assert visit.said()[-1] == "Hello, Ben!"


def test_what_it_feels_about_who_may_be_remembered_is_about_them_by_name():
    visit = typed(
        30, {**INTRODUCED, 11.0: "never mind", 14.0: "bad robot", 18.0: "why are you sad"}
    )
    assert any("you scolded me" in text for text in visit.said())
    emotion = visit.robot.context.behavior(EmotionModel)
    assert "Anna" in {cause.person for cause in emotion.why()}


def test_two_people_of_one_name_are_known_by_what_each_of_them_told(tmp_path):
    file = tmp_path / "people.db"
    day(file, {**INTRODUCED, 11.0: "jazz"}, 15)
    other = {1.0: "my name is Anna", 7.0: "no", 12.0: "yes", 17.0: "gardening"}
    day(file, other, 21)
    third = day(
        file,
        {1.0: "my name is Anna", 7.0: "yes", 14.0: "gardening", 26.0: "what do you know about me"},
        32,
        DayLater(),
    )
    assert "I know more than one Anna. What do you like?" in third.said()
    assert "You're Anna. You like gardening." in third.said()


def test_of_a_stranger_nothing_is_kept():
    visit = typed(12, {1.0: "i like jazz", 5.0: "what do you know about me"})
    assert "jazz" not in said(visit)


class DayLater(FakeClock):
    """The next day, and half an hour."""

    def wall(self):
        return super().wall() + timedelta(days=1, minutes=30)


def day(file, lines, seconds, clock=None):
    """A visit of a robot that keeps its memory of people in a file."""

    def keep(robot):
        robot.board.slot(PEOPLE_FILE).set(str(file), 0.0)

    return Visit(seconds, {}, jobs=[typing(lines)], prepare=keep, clock=clock)


def test_who_comes_back_the_next_day_is_known_again_and_two_people_are_not_confused(tmp_path):
    """Of Anna a fact is used; of Ben, who gave no leave, nothing is left."""
    file = tmp_path / "people.db"
    anna = {**INTRODUCED, 10.0: "good job", 13.0: "i like jazz"}
    day(file, {**anna, 18.0: "my name is Ben", 24.0: "no", 30.0: "i like tea"}, 36)
    again = {1.0: "my name is Anna", 7.0: "yes", 16.0: "what do you know about me"}
    other = {24.0: "my name is Ben", 30.0: "no", 36.0: "what do you know about me"}
    second = day(file, {**again, **other}, 42, DayLater())

    words = said(second)
    assert "Have we met before, Anna?" in words
    assert (
        "Good morning, Anna! I haven't seen you for a day. You were so nice to me last time."
        " Did you have time for jazz lately?"
    ) in words
    assert "You're Anna. You like jazz." in words
    assert "Have we met before, Ben?" not in words
    assert "tea" not in words
    assert b"Ben" not in file.read_bytes()


def test_who_says_by_the_way_who_they_are_is_asked_for_consent_too():
    visit = typed(9, {1.0: "i'm deborah i'm the sister"})
    assert "May I remember you, Deborah?" in visit.said()


def test_no_is_no_answer_to_what_someone_likes():
    lines = {**INTRODUCED, 16.0: "no", 20.0: "what do you know about me"}
    visit = typed(24, lines)
    assert "Okay, never mind." in visit.said()
    assert "You're Anna. You haven't told me more than that." in visit.said()


def test_who_does_not_say_whether_they_have_met_is_not_made_another_person(tmp_path):
    file = tmp_path / "people.db"
    day(file, {1.0: "my name is ben", 7.0: "yes"}, 12)
    second = day(file, {1.0: "my name is ben"}, 16, DayLater())
    assert "Have we met before, Ben?" in second.said()
    assert not [text for text in second.said() if text.startswith("May I remember you")]
