"""The companion leaves no one without an answer, and does not talk over people."""

from datetime import datetime
from functools import cache

import pytest

from hri.conversation.puzzlement import Kind
from hri.core.clock import FakeClock
from hri.hal.resource import Description
from hri.robot import verbs
from hri.speech.behaviors import Listener, Voice
from tests.apps.test_companion import SEEING, SLOW_CAMERA, Visit
from tests.devices import BLIND, UNSEEN

UNKNOWN = ["glue a zeppelin", "purple elephants", "juggle nine pineapples", "iron a shirt"]


def typing(lines):
    """A job that types lines at times, as the page of the studio does: no keyboard is open."""

    async def job(context):
        for time, line in lines.items():
            await context.clock.sleep_until(time)
            context.behavior(Listener).type_line(line)

    return job


def typed(seconds, lines, **more):
    return Visit(seconds, {}, jobs=[typing(lines)], **more)


def questions(visit):
    return [event.properties["text"] for event in visit.named("question.asked")]


def test_each_line_that_is_typed_gets_an_answer_and_none_twice():
    lines = {1.0 + 3 * number: line for number, line in enumerate(UNKNOWN * 2)}
    visit = typed(26, lines)
    assert visit.heard() == []
    said = visit.said()
    assert len(said) == len(lines)
    assert len({*said}) == len(said)
    assert not [text for text in said if "what can I say" in text.lower()]


@pytest.mark.parametrize(
    ("line", "answer"),
    [
        ("rotate the pancake", "Something about turning? Say it another way, please."),
        ("glue me to you", 'I don\'t know the word "glue" yet.'),
        ("go forwrd", 'I almost got that. Try "go forward".'),
        ("turn arround", 'I almost got that. Try "turn around".'),
        ("glue a zeppelin", "I heard you, but I don't know those words yet."),
        ("red me the go", "Sorry, I didn't get that. Could you say it another way?"),
        ("the neighbors bought a boat", "Oh, I see."),
        ("is tuesday a vegetable", "I don't know, to be honest."),
        ("could you iron a shirt", "I don't know how to iron a shirt."),
        ("head on over here to me", 'I almost got that. Try "come closer".'),
        ("can i have a cookie", "I don't think I can do that, sorry."),
        ("my brother broke his arm", "Oh no. I'm sorry to hear that."),
        ("my aunt bought a boat", "Your aunt bought a boat? Tell me more."),
        ("your beeping is annoying tonight", "[ouch] That wasn't very nice."),
        ("where do penguins nest", "I don't know where. I only see what's in front of me."),
        ("yes please", "I didn't ask anything just now."),
    ],
)
def test_the_answer_says_what_is_known_of_the_line(line, answer):
    assert typed(5, {1.0: line}).said() == [answer]


def test_the_third_time_it_offers_what_can_be_said():
    said = typed(9, {1.0: "glue a zeppelin", 4.0: "lilac zithers", 7.0: "gnomes yodel"}).said()
    assert said[2].startswith("I still don't get it. You could say \"")


def test_a_correction_is_answered_by_what_the_talk_is_about():
    said = typed(9, {1.0: "call my mom", 5.0: "make it my dad"}).said()
    assert said[1] == "Got it, but I can't do that one. Sorry."


def test_what_is_for_the_keyboard_alone_is_understood_in_part_and_in_other_words():
    lines = {1.0: "morning robin you sleep good", 5.0: "quiz me on the cell would you"}
    assert typed(9, lines).heard() == ["greet", "quiz_me"]


def test_who_talks_to_it_is_answered_and_who_talks_to_others_is_not():
    lost = {9.0: "the train to the seaside was late again on monday"}
    assert Visit(14, lost).said() == []
    talk = Visit(14, {6.0: "what is your name", **lost})
    assert talk.named("speech.rejected")[0].properties["is_addressed"]
    assert talk.said()[1] == "Sorry, I didn't catch that. Could you say it again?"


def test_all_kinds_of_answers_have_three_ways_or_more():
    visit = Visit(1, {})
    unasked = visit.robot.board.slot("companion").value.replies.unasked
    assert all(len({*unasked[kind]}) >= 3 for kind in Kind)


def test_no_question_comes_after_what_was_not_understood():
    assert questions(typed(17, {1.0: "hello", 4.0: "glue a zeppelin"})) == []
    assert len(questions(typed(17, {1.0: "hello", 4.0: "glue a zeppelin", 6.0: "hello"}))) == 1


def test_no_question_comes_after_a_farewell():
    assert questions(Visit(19, {1.0: "hello robot", 6.0: "good night robot"})) == []


def test_no_question_comes_into_a_dialogue():
    async def order(context):
        await verbs.ask(context, "Do you want a pizza?", timeout=2)
        await context.clock.sleep(15)
        await verbs.ask(context, "Is that right?", timeout=2)

    visit = Visit(22, {1.0: "hello robot"}, jobs=[order])
    assert questions(visit) == ["Do you want a pizza?", "Is that right?"]


@pytest.mark.slow
def test_no_question_comes_while_a_task_of_an_app_drives():
    async def drive(context):
        await verbs.move(context, 4.0)

    devices = [UNSEEN, SLOW_CAMERA]
    visit = Visit(14, {1.0: "hello robot"}, jobs=[drive], devices=devices)
    assert visit.pose_at(13).x > 2
    assert questions(visit) == []


LONG = "my sister went to the seaside for the summer with all of her friends and the dog " * 2


def nods(visit):
    return [event for event in visit.named("gesture.ended") if event.properties["name"] == "nod"]


@pytest.mark.slow
def test_it_nods_to_who_talks_for_long_and_looks_at_it():
    assert len(nods(Visit(11, {2.0: LONG}, devices=[UNSEEN, SLOW_CAMERA]))) >= 1
    assert nods(Visit(11, {2.0: LONG})) == []


def test_it_shows_that_it_thinks_where_an_answer_takes_its_time():
    shown = []

    async def look(context):
        slot = context.board.slot(verbs.SHOWN)
        while True:
            await context.clock.sleep(0.1)
            shown.append("" if slot.value is None else slot.value.label)

    jobs = [look, typing({4.0: "what is your name"})]
    Visit(10, {}, parameters={"listener": {"latency_s": 2.0}}, jobs=jobs)
    assert "thinking" in shown
    assert shown[-1] == ""


def test_at_night_it_asks_nothing(monkeypatch):
    monkeypatch.setattr(FakeClock, "wall", lambda self: datetime(2026, 5, 4, 23, 0))
    assert questions(Visit(14, {1.0: "hello robot"})) == []


@cache
def undisturbed(level=None):
    """A visit in which it asks its first question, and nobody speaks meanwhile."""
    return Visit(12.5, {1.0: "hello robot"}, devices=room(level))


def first_question(level=None):
    """When it begins to say that question."""
    (asked,) = [event for event in undisturbed(level).named("speech.said") if event.time > 7]
    return asked.time


def room(level=None):
    """Devices of a room in which its voice is heard as loud as that, in dB, or not at all."""
    loud = Description("speaker", "Hri.SimulatedSpeaker", {"level": str(level)}, "world")
    return [UNSEEN, BLIND, *([] if level is None else [loud])]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("after", "level"), [(-0.3, None), (-0.1, None), (0.1, None), (0.25, None), (0.15, -6)]
)
def test_who_begins_to_speak_with_it_has_the_floor(after, level):
    asked = first_question(level)
    lines = {1.0: "hello robot", asked + after: "what is your name"}
    visit = Visit(asked + 4, lines, devices=room(level))
    assert visit.heard() == ["greet", "name"]
    assert visit.said()[-1] == "My name is Robin."
    assert questions(visit) == []
    # Who began before its ears knew it cuts it short.
    cut = [event for event in visit.named("speech.finished") if event.properties["cut"]]
    assert all(event.time < max(asked, asked + after) + 0.3 for event in cut)


def test_who_begins_later_does_not_have_the_floor():
    asked = first_question()
    visit = Visit(asked + 3, {1.0: "hello robot", asked + 0.5: "what is your name"})
    assert visit.heard() == ["greet"]
    assert [event.properties["reason"] for event in visit.named("speech.rejected")] == [
        "robot speaking"
    ]


@pytest.mark.parametrize("level", [-30, -20, -6])
def test_it_does_not_give_way_to_its_own_voice(level):
    visit = undisturbed(level)
    assert visit.heard() == ["greet"]
    assert [event.properties["cut"] for event in visit.named("speech.finished")] == [False, False]
    assert len(visit.said()) == 2


@pytest.mark.parametrize("line", ["don't drive into the table", "don't scratch my new floor"])
def test_who_forbids_something_ends_the_motion_that_it_may_be_about(line):
    visit = typed(12, {1.0: "go forward two meters", 4.0: line})
    answers = [event for event in visit.named("speech.said") if event.time > 4.0]
    later = [pose for time, pose in visit.poses if time > answers[0].time + 1.0]
    assert abs(later[0].x) > 0.2, "it drove before"
    assert max(abs(pose.x - later[0].x) for pose in later) < 0.01


def test_it_giggles_until_it_is_asked_not_to():
    lines = {1.0: "stop giggling", 5.0: "you may giggle again"}
    seen = []

    async def look(context):
        for time in (0.5, 4.0, 9.0):
            await context.clock.sleep_until(time)
            seen.append(context.behavior(Voice).makes_sounds)

    visit = Visit(10, {}, jobs=[typing(lines), look])
    assert seen == [True, False, True]
    before, after = visit.said()
    assert "[" not in before
    assert after.startswith("[")


def test_it_asks_for_the_one_value_that_was_not_clear_and_does_what_the_whole_says():
    """A parcel is not among the things that it knows; the purse that comes nearest is not taken."""
    visit = Visit(14, {2.0: "find my parcel", 8.0: "the cup"}, devices=SEEING)
    assert visit.named("speech.rejected")[0].properties["unsure"] == ["thing"]
    assert visit.said()[0] == "Which thing?"
    assert "cup" in visit.said()[1]
