"""Timers and alarms: promises that the robot keeps over a restart (`hri.conversation.alarms`).

ring_timers    says each at its time, from the start
"""

from __future__ import annotations

from dataclasses import replace

from hri.conversation import (
    FURTHEST,
    Alarm,
    AlarmKeeper,
    AlarmKind,
    TooManyAlarms,
    completed,
    length_words,
    ring,
)
from hri.task import TaskContext

EARLIEST_ALARM = 4
"""The hour from which on "tomorrow at five" is in the morning, for an alarm."""
SNOOZE = 540.0
"""Seconds."""
UNSAVED = " But I can't save it, so please don't switch me off."
NOT_YET = "I can only do that for a time to come, within ten years."
FULL = "I can't keep any more timers and alarms. Cancel one first."


async def ring_timers(context: TaskContext) -> None:
    """Say that a timer is over, and wake who wanted to be woken."""
    await ring(context, words_of, AlarmKind.TIMER, AlarmKind.ALARM)


def words_of(alarm: Alarm, late: float) -> str:
    """What is said of it, given how many seconds late."""
    if alarm.kind is AlarmKind.ALARM:
        begin = f"Sorry, I'm {length_words(late)} late." if late else "Ring, ring!"
        return f"{begin} This is your alarm."
    name = name_of(alarm)
    if late:
        return f"Sorry, I'm late: {name} was over {length_words(late)} ago."
    return f"Ring, ring! {name[0].upper()}{name[1:]} is over."


def name_of(alarm: Alarm) -> str:
    """Which timer it is, in a sentence: "your pizza timer"."""
    if alarm.kind is AlarmKind.ALARM:
        return "your alarm"
    if alarm.about:
        return f"your {alarm.about} timer"
    return f"your timer of {length_words(alarm.length)}"


async def set_timer(context: TaskContext, duration: float, about: str = "") -> str:
    """Set a timer, beside those that run."""
    keeper = AlarmKeeper.of(context)
    try:
        keeper.promise(AlarmKind.TIMER, f"in {duration}", about)
    except TooManyAlarms:
        return FULL
    except ValueError:
        return NOT_YET
    of = f" for the {about}" if about else ""
    return f"Okay, {length_words(duration)}{of}." + await unsaved(keeper)


async def set_alarm(context: TaskContext, when: str) -> str:
    """Set an alarm, at a time or after one."""
    keeper = AlarmKeeper.of(context)
    try:
        alarm = keeper.promise(AlarmKind.ALARM, when, earliest=EARLIEST_ALARM)
    except TooManyAlarms:
        return FULL
    except ValueError:
        return NOT_YET
    return f"Okay, I'll wake you {keeper.when_words(alarm)}." + await unsaved(keeper)


async def change_alarm(context: TaskContext, when: str) -> str:
    """Set the alarm that was set last to another time; "no at eight" leaves it in the morning."""
    keeper = AlarmKeeper.of(context)
    if not (found := keeper.alarms.of(AlarmKind.ALARM)):
        return none_words("", is_alarm=True)
    old = max(found, key=lambda one: one.id)
    for text in (completed(when, keeper.when_tag(old)), when):
        keeper.alarms.remove(old)
        try:
            alarm = keeper.promise(AlarmKind.ALARM, text, earliest=EARLIEST_ALARM)
        except ValueError:
            keeper.alarms.put(old)
        else:
            return f"Okay, I'll wake you {keeper.when_words(alarm)}." + await unsaved(keeper)
    return NOT_YET


async def unsaved(keeper: AlarmKeeper) -> str:
    """What is said where the disk did not take it; empty where it did."""
    return "" if await keeper.kept() else UNSAVED


async def ask_timers(context: TaskContext, about: str = "", is_alarm: bool = False) -> str:
    """Say how long timers still run, and when alarms ring."""
    keeper = AlarmKeeper.of(context)
    found = meant_ones(keeper, about, is_alarm) if about or is_alarm else all_of(keeper)
    if not found:
        return none_words(about, is_alarm)
    first, *others = [state_words(keeper, one) for one in found]
    words = " and ".join([", ".join([first, *others[:-1]]), *others[-1:]])
    return f"{words[0].upper()}{words[1:]}."


def state_words(keeper: AlarmKeeper, alarm: Alarm) -> str:
    """How things stand with one, in a sentence."""
    if alarm.kind is AlarmKind.ALARM:
        return f"your alarm is {keeper.when_words(alarm)}"
    left = max(alarm.due - keeper.instant().wall, 1.0)
    return f"{name_of(alarm)} has {length_words(left)} left"


async def cancel_timer(
    context: TaskContext, about: str = "", is_alarm: bool = False, every: bool = False
) -> str:
    """Take back one that is named, the only one, or all; ask which where it could be several."""
    keeper = AlarmKeeper.of(context)
    found = all_of(keeper) if every else meant_ones(keeper, about, is_alarm)
    if not found:
        return none_words(about, is_alarm)
    if len(found) > 1 and not every:
        return which_words(found)
    for one in found:
        keeper.alarms.remove(one)
    await keeper.kept()
    if len(found) > 1:
        return f"Okay, all {len(found)} are off."
    return f"Okay, {name_of(found[0])} is off."


async def change_timer(
    context: TaskContext,
    by: float = 0.0,
    to: float = 0.0,
    about: str = "",
    is_alarm: bool = False,
    is_last: bool = False,
    is_new: bool = False,
) -> str:
    """Let a timer, perhaps the one that was set last, run longer, or for another time from now.

    "Set the timer for ten minutes" is another one, unless one of that name runs.
    """
    keeper = AlarmKeeper.of(context)
    found = meant_ones(keeper, about, is_alarm)
    if to and not is_alarm and (not found or (is_new and not about)):
        return await set_timer(context, to, about)
    if is_last:
        found = sorted(found, key=lambda one: one.id)[-1:]
    if not found:
        return none_words(about, is_alarm)
    if len(found) > 1:
        return which_words(found)
    (old,) = found
    wall = keeper.instant().wall
    due = wall + to if to else old.due + by
    if not 0 < due - wall <= FURTHEST:
        return NOT_YET
    length = due - wall if old.goes_with_the_clock else 0.0
    new = keeper.alarms.put(replace(old, due=due, length=length))
    if is_alarm:
        return f"Okay, {state_words(keeper, new)}." + await unsaved(keeper)
    of = f" for the {about}" if about else ""
    return f"Okay, {length_words(due - wall)} left{of}." + await unsaved(keeper)


async def snooze(context: TaskContext, duration: float = SNOOZE) -> str:
    """Wake once more, in a while."""
    return await set_alarm(context, f"in {duration}")


def all_of(keeper: AlarmKeeper) -> list[Alarm]:
    """All timers and alarms, the next one first."""
    return keeper.alarms.of(AlarmKind.TIMER, AlarmKind.ALARM)


def meant_ones(keeper: AlarmKeeper, about: str, is_alarm: bool) -> list[Alarm]:
    """Those that may be meant by a name, or by "the timer"."""
    kind = AlarmKind.ALARM if is_alarm else AlarmKind.TIMER
    return keeper.alarms.of(kind, about=about)


def none_words(about: str, is_alarm: bool) -> str:
    """What is said where there is none of that kind."""
    if is_alarm:
        return "No alarm is set."
    return f"No {about} timer is running." if about else "No timer is running."


def which_words(found: list[Alarm]) -> str:
    """What is said where one of several is meant."""
    names = [name_of(one).removeprefix("your ") for one in found]
    return f"Which one? You have the {', the '.join(names[:-1])} and the {names[-1]}."
