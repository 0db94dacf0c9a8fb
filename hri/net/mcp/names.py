"""Names of people, which no assistant gets: who agreed to be remembered agreed to no more."""

from __future__ import annotations

import re
from collections import deque

from hri.core.signals import Event, People
from hri.emotion.behaviors import EmotionModel
from hri.task.context import TaskContext

SOMEONE = "someone"
_ID = re.compile(r"p\d+")
"""What stands for the name of a stranger: their id, which is shown."""
MOST = 200
"""Names that were heard and are kept in mind."""


class Names:
    """The names that the robot may say or show now."""

    def __init__(self) -> None:
        self._heard: deque[str] = deque(maxlen=MOST)

    def note(self, event: Event) -> None:
        """Keep the name that was given to a person in mind."""
        if event.name == "person.named":
            self._heard.append(str(event.properties.get("name", "")))

    def known(self, context: TaskContext) -> frozenset[str]:
        """All of them: of people in view, and of those whom it has feelings about."""
        seen = context.board.slot("people").value
        found = [one.name for one in seen.persons] if isinstance(seen, People) else []
        emotion = context.find_behavior(EmotionModel)
        found += [cause.person or "" for cause in emotion.why()] if emotion is not None else []
        every = (*found, *self._heard)
        return frozenset(name for name in every if name.strip() and not _ID.fullmatch(name))


def without(names: frozenset[str], text: str) -> str:
    """A text with "someone" for each name, in capital letters or not."""
    if not names:
        return text
    either = "|".join(re.escape(name) for name in sorted(names, key=len, reverse=True))
    return re.sub(rf"(?<!\w)(?:{either})(?!\w)", SOMEONE, text, flags=re.IGNORECASE)
