"""What happened lately, as an assistant is shown it: no memory, no names, no words for others."""

from __future__ import annotations

import math
from collections import deque
from typing import Any

from hri.core.origin import MCP
from hri.core.signals import Event
from hri.net.mcp.names import Names, without
from hri.speech.behaviors import Listener
from hri.speech.grammar import Grammar, parse
from hri.task.context import TaskContext

MOST = 200
"""Events that are kept."""
LONGEST_VALUE = 200
"""Letters of a property."""
PRIVATE = ("alarm.", "memory.", "person.named", "speech.partial", "visitor.", "odometry", "studio.")
"""How the names of events begin that an assistant is not shown."""
WITHHELD = frozenset(
    ("text", "detail", "answer", "arguments", "name", "tags", "about", "file", "error")
)
"""Properties that may hold what a person said, or a path."""
NAMES_THINGS = frozenset(("gesture.started", "gesture.ended"))
"""Events whose `name` is that of a thing."""
REMEMBERED = "remember"
"""The tag of a rule by which people say something about themselves."""

Shown = dict[str, Any]


class RecentEvents:
    """Listens to the robot, and keeps what may be shown."""

    def __init__(self, context: TaskContext) -> None:
        self._context = context
        self._kept: deque[tuple[int, Shown]] = deque(maxlen=MOST)
        self._count = 0
        self.names = Names()
        self._subscription = context.events.subscribe("*", self._hear)

    def stop(self) -> None:
        """Listen no more."""
        self._subscription.cancel()

    def after(self, number: int, most: int) -> list[Shown]:
        """The newest ones whose numbers are higher, oldest first."""
        return [event for count, event in self._kept if count > number][-most:]

    def last(self, name: str) -> Shown | None:
        """The newest one of a name."""
        return next((event for _, event in reversed(self._kept) if event["event"] == name), None)

    def _hear(self, event: Event) -> None:
        self.names.note(event)
        if event.name.startswith(PRIVATE):
            return
        self._count += 1
        told: Shown = {"number": self._count, "t": round(event.time, 2), "event": event.name}
        if event.origin:
            told["by"] = event.origin
        for key, value in event.properties.items():
            is_thing = key == "name" and event.name in NAMES_THINGS
            if (key not in WITHHELD or is_thing) and (shown := _shown(value)) is not None:
                told[key] = self._nameless(shown) if isinstance(shown, str) else shown
        if words := self._words(event):
            told["text"] = self._nameless(words)[:LONGEST_VALUE]
        self._kept.append((self._count, told))

    def _nameless(self, text: str) -> str:
        return without(self.names.known(self._context), text)

    def _words(self, event: Event) -> str:
        """The words of a command, or of an assistant that spoke by the robot."""
        text = str(event.properties.get("text", ""))
        if event.name == "speech.said" and event.origin == MCP:
            return text
        if event.name != "speech.heard":
            return ""
        listener = self._context.find_behavior(Listener)
        grammar = None if listener is None else listener.loaded_grammar
        return text if grammar is not None and is_impersonal(grammar, text) else ""


def is_impersonal(grammar: Grammar, text: str) -> bool:
    """Whether a sentence has only words that the grammar lists, and says nothing of the speaker."""
    found = parse(grammar, text)
    if found is None or found.free or found.slots:
        return False
    return all(tag.name != REMEMBERED for tag in grammar.rules[found.rule].doc_tags)


def _shown(value: object) -> str | float | bool | None:
    """A property that fits in a line; None for all others."""
    if isinstance(value, bool):
        return value
    if isinstance(value, (int, float)):
        return round(float(value), 3) if math.isfinite(value) else None
    return value[:LONGEST_VALUE] if isinstance(value, str) and value else None
