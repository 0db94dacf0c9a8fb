"""Reminders: what a person wants to do, said at its time.

ring_reminders    says each at its time, from the start
"""

from __future__ import annotations

from pathlib import Path

from hri.conversation import (
    Alarm,
    AlarmKeeper,
    AlarmKind,
    TooManyAlarms,
    fill,
    length_words,
    load_forms,
    ring,
    turned,
)
from hri.robot import verbs
from hri.task import TaskContext

FORMS = Path(__file__).with_name("forms.toml")
DEED = "What do you want to do then?"
ANY_DEED = "What should I remind you of?"
UNSAVED = " But I can't save it, so please don't switch me off."


async def ring_reminders(context: TaskContext) -> None:
    """Remind of everything at its time."""
    await ring(context, words_of, AlarmKind.REMINDER)


def words_of(alarm: Alarm, late: float) -> str:
    """What is said of it, given how many seconds late."""
    if late:
        return f"Sorry, I'm {length_words(late)} late. You wanted to {alarm.about}."
    return f"A reminder: you wanted to {alarm.about}."


async def set_reminder(context: TaskContext) -> str:
    """Ask what to remind of, and when."""
    deed = await _deed(context, ANY_DEED)
    values = await fill(context, load_forms([FORMS])["reminder"], {}) if deed else None
    return await remind(context, deed=deed, **values) if values else ""


async def remind(context: TaskContext, when: str, deed: str = "", thing: str = "") -> str:
    """Remind of something at a time; what it is may be left to be asked for."""
    keeper = AlarmKeeper.of(context)
    if not deed and not thing:
        deed = await _deed(context, DEED)
        if not deed:
            return ""
    about = turned(deed.split()) if deed else f"think of your {thing}"
    try:
        reminder = keeper.promise(AlarmKind.REMINDER, when, about)
    except TooManyAlarms:
        return "I can't keep any more reminders. Cancel one first."
    except ValueError:
        return "I can only remind you at a time to come."
    words = f"Okay, I'll remind you to {about} {keeper.when_words(reminder)}."
    return words if await keeper.kept() else words + UNSAVED


async def _deed(context: TaskContext, question: str) -> str:
    """What someone wants to do; empty without an answer."""
    answer = await verbs.ask_value(context, "remind", "deed", question=question)
    return str(answer.tags["deed"]).removeprefix("to ") if answer is not None else ""


async def ask_reminders(context: TaskContext) -> str:
    """Say all that it reminds of."""
    keeper = AlarmKeeper.of(context)
    found = [
        f"{keeper.when_words(one)} you want to {one.about}"
        for one in keeper.alarms.of(AlarmKind.REMINDER)
    ]
    if not found:
        return "You have no reminders."
    words = ", and ".join([", ".join(found[:-1]), found[-1]] if found[1:] else found)
    return f"{words[0].upper()}{words[1:]}."


async def cancel_reminder(context: TaskContext, every: bool = False) -> str:
    """Take back all reminders, or the one that was made last."""
    keeper = AlarmKeeper.of(context)
    found = sorted(keeper.alarms.of(AlarmKind.REMINDER), key=lambda one: one.id)
    if not found:
        return "You have no reminders."
    gone = found if every else found[-1:]
    for one in gone:
        keeper.alarms.remove(one)
    await keeper.kept()
    if len(gone) > 1:
        return f"Okay, all {len(gone)} reminders are gone."
    return f"Okay, I won't remind you to {gone[0].about}."
