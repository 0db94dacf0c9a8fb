"""Says what was promised when its time comes, and again until someone answers."""

from __future__ import annotations

from collections.abc import Callable

from hri.conversation.alarm_keeper import AlarmKeeper
from hri.conversation.alarms import Alarm, AlarmKind
from hri.conversation.floor import Importance
from hri.conversation.speaking_up import speak_up
from hri.task.context import TaskContext

LOOK_EVERY = 0.2
"""Seconds between looks at the clock."""
LATE = 60.0
"""Seconds after which it is said with an apology."""
AGAIN_AFTER = 20.0
"""Seconds without an answer after which it is said again."""
TIMES = 3
"""How often it is said at most."""
ONCE_MORE = "You may have heard this already."
"""Said first where the robot was switched off while it said it."""
ANSWERS = ("speech.heard", "speech.rejected", "head.nodded", "head.shaken", "hand.*")
"""What shows that someone heard it."""

Words = Callable[[Alarm, float], str]
"""What is said of an alarm, given how many seconds late it is: 0 within a minute."""


class _Unheard:
    """What was said, and not answered yet."""

    def __init__(self) -> None:
        self._said: dict[str, int] = {}
        """How often, by the words."""
        self._next = 0.0

    def note(self, words: str, now: float) -> None:
        """They were said just now."""
        self._said[words] = self._said.get(words, 0) + 1
        if self._said[words] >= TIMES:
            del self._said[words]
        self._next = now + AGAIN_AFTER

    def answer(self) -> None:
        """Someone is there, and heard all of it."""
        self._said.clear()

    def due(self, now: float) -> str:
        """What is to be said again now; empty for nothing."""
        return next(iter(self._said), "") if now >= self._next else ""


async def ring(context: TaskContext, words: Words, *kinds: AlarmKind) -> None:
    """Say everything of these kinds at its time, for ever.

    It counts as said when it was said to its end: after a crash it is said late, and not as new
    where it had begun. Without an answer it is said again. Raises `alarm.rang` (kind, about, late)
    for each.
    """
    keeper, unheard = AlarmKeeper.of(context), _Unheard()
    with context.queue(*ANSWERS) as answers:
        while True:
            keeper.poll()
            if due := keeper.alarms.due(keeper.instant(), *kinds):
                said = await _say(context, keeper, due[0], words)
            elif said := unheard.due(context.clock.now()):
                await speak_up(context, said, Importance.ALARM)
            if said:
                answers.keep()
                unheard.note(said, context.clock.now())
            with context.clock.move_on_after(LOOK_EVERY):
                await answers.get()
                unheard.answer()


async def _say(context: TaskContext, keeper: AlarmKeeper, alarm: Alarm, words: Words) -> str:
    late = keeper.instant().wall - alarm.due
    said = words(alarm, late if late > LATE else 0.0)
    if not await keeper.begin(alarm):
        said = f"{ONCE_MORE} {said}"
    await speak_up(context, said, Importance.ALARM)
    await keeper.end(alarm)
    late = round(late, 1)
    context.events.raise_event("alarm.rang", kind=alarm.kind.value, about=alarm.about, late=late)
    return said
