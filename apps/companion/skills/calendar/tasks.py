"""A calendar: the day that was meant, and how far it is from today."""

from collections.abc import Callable
from datetime import date as Date, timedelta

from hri.speech import resolve
from hri.task import TaskContext, immediate

A_YEAR = timedelta(days=365)
NO_DAY = "There's no such day in the calendar."


@immediate
def tell_day(context: TaskContext, date: str) -> str:
    """Say which day it is that a text of date.jsgf means."""
    return _of_day(context, date, _told)


@immediate
def days_until(context: TaskContext, date: str) -> str:
    """Say how many days it is until the day that a text of date.jsgf means."""
    return _of_day(context, date, _counted)


def _of_day(context: TaskContext, text: str, words: Callable[[Date, Date], str]) -> str:
    today = context.clock.wall().date()
    try:
        return words(resolve(text, today), today)
    except ValueError:  # February 29 of a year without one
        return NO_DAY


def _told(day: Date, today: Date) -> str:
    begins = {-1: "Yesterday was", 0: "Today is", 1: "Tomorrow is"}
    distance = (day - today).days
    begin = begins.get(distance, "That's" if distance > 0 else "That was")
    return f"{begin} {_in_words(day, today)}."


def _counted(day: Date, today: Date) -> str:
    days = (day - today).days
    if days == 0:
        return f"That's today, {_in_words(day, today)}."
    if days < 0:
        return f"That was {_days(-days)} ago, on {_in_words(day, today)}."
    return f"It's {_days(days)} until {_in_words(day, today)}."


def _in_words(day: Date, today: Date) -> str:
    year = "" if abs(day - today) < A_YEAR else f", {day.year}"
    return f"{day:%A, %B} {day.day}{year}"


def _days(count: int) -> str:
    return "one day" if count == 1 else f"{count} days"
