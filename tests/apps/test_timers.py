"""Timers, alarms and reminders of the companion: said at their time, whatever comes between."""

from datetime import timedelta

import pytest

from hri.conversation import ALARM_FILE
from hri.core.clock import FakeClock
from tests.apps.test_companion import Visit
from tests.apps.test_manners import typed, typing
from tests.robot.skills import skill

RING = "Ring, ring! Your tea timer is over."


class Later(FakeClock):
    """Half an hour later, of another start of the machine."""

    def wall(self):
        return super().wall() + timedelta(minutes=30)


def kept(file, seconds, lines, clock=None, jobs=()):
    """A visit of a robot that keeps its timers in a file."""

    def keep(robot):
        robot.board.slot(ALARM_FILE).set(str(file), 0.0)

    return Visit(seconds, {}, jobs=[typing(lines), *jobs], prepare=keep, clock=clock)


def test_what_came_due_while_it_was_off_is_said_late_and_the_rest_at_its_time(tmp_path):
    file = tmp_path / "alarms.json"
    orders = {1.0: "set a tea timer for five minutes", 5.0: "wake me up at half past ten"}
    first = kept(file, 9, orders)
    assert first.said() == ["Okay, 5 minutes for the tea.", "Okay, I'll wake you at 10:30 AM."]
    second = kept(file, 12, {}, Later())
    assert second.said()[:2] == [
        "Sorry, I'm late: your tea timer was over 25 minutes ago.",
        "Ring, ring! This is your alarm.",
    ]
    assert [event.properties["kind"] for event in second.named("alarm.rang")] == ["timer", "alarm"]
    assert kept(file, 4, {}, Later()).named("alarm.rang") == []


def test_who_does_not_answer_is_told_three_times_and_who_answers_once():
    lines = {1.0: "set a tea timer for one second"}
    assert typed(72, lines).said().count(RING) == 3
    assert typed(36, {**lines, 10.0: "thank you"}).said().count(RING) == 1


def test_a_timer_wakes_a_robot_that_sleeps_and_is_said_though_it_is_to_be_quiet():
    for order in ("go to sleep", "be quiet"):
        visit = typed(22, {1.0: "set a tea timer for ten seconds", 5.0: order})
        assert RING in visit.said()


def test_the_replies_are_not_read_against_the_grammar_of_a_question():
    visit = typed(14, {1.0: "set a timer", 5.0: "ten minutes"})
    assert visit.said()[:2] == ["For how long?", "Okay, 10 minutes."]
    assert visit.named("replies.refused") == visit.named("replies.changed") == []


def test_a_timer_does_not_talk_into_a_question():
    visit = typed(25, {1.0: "set a tea timer for ten seconds", 9.0: "set an alarm", 15.0: "noon"})
    said = visit.said()
    assert said.index("For what time?") < said.index("Okay, I'll wake you at noon.")
    assert RING in said[said.index("Okay, I'll wake you at noon.") :]


@pytest.mark.parametrize(
    ("lines", "answer"),
    [
        (["set a timer for the rolls twelve minutes"], "Okay, 12 minutes for the rolls."),
        (["set a timer for ten minutes", "add five minutes to the timer"],
         "Okay, 15 minutes left."),
        (["okay can you time eleven minutes for the pasta", "how much longer on that"],
         "Your pasta timer has 11 minutes left."),
        (["cancel all timers"], "No timer is running."),
        (["how much time is left on the pizza timer"], "No pizza timer is running."),
        (["remind me yesterday to eat"], "I can only remind you at a time to come."),
        (["before i forget remind me tonight to call my mom"],
         "Okay, I'll remind you to call your mom at 7:00 PM."),
        (["what are my reminders"], "You have no reminders."),
    ],
)  # fmt: skip
def test_what_is_asked_of_timers(lines, answer):
    said = typed(4 * len(lines) + 1, {4.0 * n + 1: line for n, line in enumerate(lines)}).said()
    assert said[-1] == answer


def test_a_skill_replaces_what_small_talk_says_and_nothing_else(tmp_path, monkeypatch):
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    skill(tmp_path, "greedy", skill='about = "A."\nreplaces = ["stop"]\n')
    visit = typed(5, {1.0: "stop"}, notice=(notices := []).append)
    assert visit.heard() == ["stop"]
    assert [line for line in notices if "<stop> is a command, not small talk" in line]
