"""What happened lately, as an assistant is shown it: no memory, no names, no words for others."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from typing import Any

from hri.core.origin import MCP
from hri.core.signals import Event
from hri.net.mcp.names import Names, without
from hri.speech.behaviors import Listener
from hri.speech.grammar.expressions import Anything, RuleReference
from hri.speech.grammar.rules import Rule, Rules
from hri.task.context import TaskContext

MOST = 200
"""Events that are kept."""
LONGEST_VALUE = 200
"""Letters of a property."""
PRIVATE = ("alarm.", "memory.", "person.named", "speech.partial", "visitor.", "odometry", "studio.")
"""How the names of events begin that an assistant is not shown."""
WITHHELD = frozenset(
    ("about", "answer", "arguments", "command", "detail", "error", "file", "name", "tags", "text")
)
"""Properties that may hold what a person said, or a path."""
NAMES_THINGS = frozenset(("gesture.started", "gesture.ended"))
"""Events whose `name` is that of a thing."""
REMEMBERED = "remember"
"""The tag of a rule by which people say something about themselves."""

Shown = dict[str, Any]


@dataclass(frozen=True, slots=True)
class _Command:
    """Words that were heard, and what says whether they may be shown."""

    grammar: Rules
    rule: str
    words: str


@dataclass(frozen=True, slots=True)
class _Kept:
    number: int
    told: Shown
    command: _Command | None = None


class RecentEvents:
    """Listens to the robot, and keeps what may be shown."""

    def __init__(self, context: TaskContext) -> None:
        self._context = context
        self._kept: deque[_Kept] = deque(maxlen=MOST)
        self._count = 0
        self.names = Names()
        self._subscription = context.events.subscribe("*", self._hear)

    def stop(self) -> None:
        """Listen no more."""
        self._subscription.cancel()

    async def after(self, number: int, most: int) -> list[Shown]:
        """The newest ones whose numbers are higher, oldest first."""
        found = [one for one in self._kept if one.number > number][-most:]
        return [await self._shown(one) for one in found]

    async def last(self, name: str) -> Shown | None:
        """The newest one of a name."""
        found = next((one for one in reversed(self._kept) if one.told["event"] == name), None)
        return None if found is None else await self._shown(found)

    async def _shown(self, kept: _Kept) -> Shown:
        """It as it is shown, with the words of a command, but of none in which people speak of
        themselves. Whether that is so takes a grammar some time, so it is asked aside.
        """
        if (command := kept.command) is None:
            return kept.told
        personal = await self._context.blocking(command.grammar.made, personal_rules)
        if command.rule in personal:
            return kept.told
        return {**kept.told, "text": self._nameless(command.words)[:LONGEST_VALUE]}

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
        if event.name == "speech.said" and event.origin == MCP:
            told["text"] = self._nameless(str(event.properties.get("text", "")))[:LONGEST_VALUE]
        self._kept.append(_Kept(self._count, told, self._command(event)))

    def _nameless(self, text: str) -> str:
        return without(self.names.known(self._context), text)

    def _command(self, event: Event) -> _Command | None:
        """What was heard; None for anything else, and for words that no grammar lists."""
        listener = self._context.find_behavior(Listener)
        if event.name != "speech.heard" or listener is None or "spoken" in event.properties:
            return None
        rule, words = (str(event.properties.get(key, "")) for key in ("rule", "command"))
        return _Command(listener.loaded_grammar, rule, words)


def personal_rules(grammar: Rules) -> frozenset[str]:
    """The rules by which people say something of themselves, or words that no one listed."""
    found = {key for key, rule in grammar.rules.items() if _is_personal(rule)}
    uses = {key: _used(rule) for key, rule in grammar.rules.items()}
    before = -1
    while before != len(found):
        before = len(found)
        found |= {key for key, used in uses.items() if not used.isdisjoint(found)}
    return frozenset(found)


def _is_personal(rule: Rule) -> bool:
    """Whether a rule itself is so."""
    has_slot = any(isinstance(node, Anything) and node.slot for node in rule.nodes)
    return has_slot or any(tag.name == REMEMBERED for tag in rule.doc_tags)


def _used(rule: Rule) -> frozenset[str]:
    return frozenset(node.name for node in rule.nodes if isinstance(node, RuleReference))


def _shown(value: object) -> str | float | bool | None:
    """A property that fits in a line; None for all others."""
    if isinstance(value, bool):
        return value
    if isinstance(value, (int, float)):
        return round(float(value), 3) if math.isfinite(value) else None
    return value[:LONGEST_VALUE] if isinstance(value, str) and value else None
