"""What shows people that the companion is with them: a nod while they talk, a face while it thinks.

attend      nods while someone who looks at it talks for long, and shows that it thinks where an
            answer takes its time
"""

from __future__ import annotations

from collections.abc import Callable

from hri.robot import verbs
from hri.speech import QUESTION
from hri.task import TaskContext

from .companion import Companion

NOD_AFTER = 4.0
"""Seconds of someone's talk after which it nods; again after each such time."""
THINKING_AFTER = 0.5
"""Seconds without an answer after which it shows that it thinks."""
THINKING, NOD = "thinking", "nod"
"""Expression and gesture; a face without them does without."""
LONGEST = 20.0
"""Seconds for which it shows that it thinks at most."""
LOOK_EVERY = 0.1
LOOKED_AT = "looked_at"
"""Slot of the board that is true while someone looks at the robot."""


class Lasting:
    """For how long something has held without a break."""

    def __init__(self, holds: Callable[[], bool]) -> None:
        self._holds = holds
        self._since: float | None = None

    def seconds(self, now: float) -> float:
        """Seconds that it has held at a time; 0 when it does not."""
        if not self._holds():
            self._since = None
            return 0.0
        self._since = now if self._since is None else self._since
        return now - self._since

    def begin(self, now: float) -> None:
        """Count again from a time."""
        self._since = now


async def attend(context: TaskContext) -> None:
    """Nod to who talks for long, and show that it thinks."""
    companion = Companion.of(context)
    vocabulary = companion.vocabulary()
    can_nod, can_think = NOD in vocabulary.gestures, THINKING in vocabulary.expressions
    talk = Lasting(lambda: _is_talked_to(companion))
    thought = Lasting(lambda: _is_awaited(companion))
    is_shown = False
    while True:
        await context.clock.sleep(LOOK_EVERY)
        now = context.clock.now()
        if can_nod and talk.seconds(now) >= NOD_AFTER:
            companion.make(NOD)
            talk.begin(now)
        thinks = can_think and thought.seconds(now) >= THINKING_AFTER
        if thinks and not is_shown and not companion.face.is_busy:
            companion.face.start(verbs.show, THINKING, LONGEST)
            is_shown = True
        elif is_shown and not thinks:
            if companion.is_showing(THINKING):
                companion.face.stop()
            is_shown = False


def _is_talked_to(companion: Companion) -> bool:
    """Whether someone talks who looks at it, and it is silent."""
    looked_at = companion.context.board.slot(LOOKED_AT).value
    is_hearing = bool(companion.listener.is_hearing.value)
    return bool(looked_at) and is_hearing and companion.voice.is_idle and not companion.is_asleep


def _is_awaited(companion: Companion) -> bool:
    """Whether what someone said is being understood, or the answer is on its way to the voice."""
    if companion.is_asleep or companion.context.board.slot(QUESTION).value:
        return False
    listener, voice = companion.listener, companion.voice
    is_read = not listener.is_idle and not listener.is_hearing.value
    is_made = companion.talk.is_busy and not voice.is_speaking.value
    return is_read or is_made
