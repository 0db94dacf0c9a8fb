"""Timers, alarms and reminders: when they are due, whatever the clocks do, and how that is said."""

from datetime import datetime, timedelta

import pytest
from hypothesis import given, strategies as st

from hri.conversation.alarms import (
    MOST_ALARMS,
    AlarmKind,
    Alarms,
    Instant,
    TooManyAlarms,
    lacks_time,
    length_words,
    meant,
    when_words,
)
from hri.core.clock import Uptime

TIMER, ALARM, REMINDER = AlarmKind.TIMER, AlarmKind.ALARM, AlarmKind.REMINDER
FRIDAY = datetime(2026, 11, 27, 14, 0)
seconds = st.floats(0.1, 1e5)


def at(wall: float, uptime: float, boot: str = "one") -> Instant:
    return Instant(wall, Uptime(uptime, boot))


@given(st.lists(st.tuples(seconds, st.floats(-7200, 7200)), max_size=6), st.floats(60, 1e5))
def test_a_timer_runs_for_its_length_whatever_the_wall_clock_is_set_to(
    steps: list[tuple[float, float]], length: float
) -> None:
    alarms, wall, uptime = Alarms(at=at(1e9, 5.0)), 1e9, 5.0
    alarms.add(TIMER, wall + length, length=length)
    end = uptime + length
    for passed, jump in steps:
        wall, uptime = wall + passed + jump, uptime + passed
        is_due = bool(alarms.due(at(wall, uptime), TIMER))
        # Less than a second is not taken for a clock that was set.
        if abs(uptime - end) > len(steps) * 1.01:
            assert is_due == (uptime > end)


def test_an_alarm_is_due_at_its_time_on_the_wall() -> None:
    alarms = Alarms(at=at(1000.0, 0.0))
    alarms.add(ALARM, 5000.0)
    assert not alarms.due(at(1001.0, 1.0), ALARM)
    assert alarms.due(at(5000.0, 2.0), ALARM), "the clock was set forth to its time"


def test_a_timer_that_was_kept_goes_on_while_the_robot_is_off() -> None:
    kept = Alarms(at=at(1000.0, 50.0))
    timer = kept.add(TIMER, 1600.0, "tea", 600.0)
    set_back = Alarms([timer], at(1000.0, 50.0))
    assert not set_back.due(at(1000.0 + 599 - 3600, 50.0 + 599), TIMER)
    assert set_back.due(at(1000.0 + 600 - 3600, 50.0 + 600), TIMER)
    started_again = Alarms([timer], at(1000.0, 50.0))
    assert started_again.due(at(1600.0, 3.0, "another boot"), TIMER) == [timer]


def test_the_next_one_comes_first_and_names_find_them() -> None:
    alarms = Alarms()
    late, soon = alarms.add(TIMER, 90.0, "frozen pizza"), alarms.add(TIMER, 30.0, "tea")
    alarms.add(REMINDER, 10.0, "call Eva")
    assert alarms.of(TIMER, ALARM) == [soon, late]
    assert alarms.of(TIMER, about="Pizza") == [late]
    assert not alarms.of(TIMER, about="pasta")
    alarms.remove(soon)
    assert alarms.of(TIMER) == [late]
    assert alarms.add(TIMER, 1.0).id not in (late.id, soon.id)


def test_there_is_an_end_to_them() -> None:
    alarms = Alarms()
    for _ in range(MOST_ALARMS):
        alarms.add(TIMER, 1.0)
    with pytest.raises(TooManyAlarms, match="cancel one"):
        alarms.add(TIMER, 1.0)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("07:00?", "at 7:00 PM"),
        ("07:00", "tomorrow at 7:00 AM"),
        ("02:30?", "at 2:30 PM"),
        ("12:00?", "tomorrow at midnight"),
        ("15:30?", "at 3:30 PM"),
        ("in 600", "at 2:10 PM"),
        ("+0 19:00", "at 7:00 PM"),
        ("+0 03:00?", "at 3:00 PM"),
        ("+1", "tomorrow at 9:00 AM"),
        ("+1 06:30?", "tomorrow at 6:30 PM"),
        ("+1 07:00?", "tomorrow at 7:00 AM"),
        ("+1 12:00?", "tomorrow at noon"),
        ("+0 06:00pm", "at 6:00 PM"),
        ("+1 12:30am", "tomorrow at 12:30 AM"),
        ("monday 17:15", "on Monday at 5:15 PM"),
        ("--12-24", "on December 24 at 9:00 AM"),
    ],
)
def test_what_people_mean_by_a_time(text: str, words: str) -> None:
    assert when_words(meant(text, FRIDAY)[0], FRIDAY) == words


def test_a_part_of_a_day_lacks_its_time() -> None:
    assert meant("+1 09:00~", FRIDAY)[0].hour == 9
    assert lacks_time("+1 09:00~")
    assert lacks_time("friday")
    assert not lacks_time("+1 09:00")
    assert not lacks_time("07:00?")


def test_an_hour_of_an_alarm_is_early_in_the_morning() -> None:
    assert meant("+1 05:00?", FRIDAY, 4)[0].hour == 5
    assert meant("+1 05:00?", FRIDAY)[0].hour == 17


@pytest.mark.parametrize("text", ["-1", "+0 09:00", "2019-05-03", "in 0", "in 1e12", "noon"])
def test_what_is_not_a_time_to_come_is_refused(text: str) -> None:
    with pytest.raises((ValueError, OverflowError)):
        meant(text, FRIDAY)


@given(st.integers(0, 23), st.integers(0, 59), st.booleans(), st.datetimes(datetime(2020, 1, 1)))
def test_a_time_of_the_day_is_within_the_next_day(
    hour: int, minute: int, is_open: bool, now: datetime
) -> None:
    now = now.replace(year=min(now.year, 9000))
    due, length = meant(f"{hour:02}:{minute:02}{'?' if is_open else ''}", now)
    assert length == 0
    assert now < due <= now + timedelta(days=1)
    assert due.minute == minute
    assert due.hour % 12 == hour % 12 if is_open else due.hour == hour


@pytest.mark.parametrize(
    ("length", "words"),
    [
        (0.2, "1 second"),
        (59.6, "1 minute"),
        (90, "1 minute and 30 seconds"),
        (605, "10 minutes"),
        (3599, "1 hour"),
        (5400, "1 hour and 30 minutes"),
        (90000, "1 day and 1 hour"),
    ],
)
def test_a_length_of_time_is_said_as_people_do(length: float, words: str) -> None:
    assert length_words(length) == words
