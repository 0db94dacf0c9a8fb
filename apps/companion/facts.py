"""Facts as the companion says them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hri.conversation import turn_words, way_words

UNTOLD = ("stop", "help", "greet", "leave", "good_night")
"""Rules that it does not name first when asked what can be said; how to stop it is named last."""
EXAMPLES = 4
"""Commands that it names at once when it is asked what can be said, and how to stop it."""


class Commands:
    """Names some commands, others each time."""

    def __init__(self) -> None:
        self._named = 0

    def words(self, examples: Mapping[str, str]) -> str:
        """Some of these examples by their rules, in this order; the last one stops the robot.

        Who asks what can be said knows how to greet it, and how to ask that.
        """
        stops = [example for rule, example in examples.items() if rule == "stop"]
        others = [example for rule, example in examples.items() if rule not in UNTOLD]
        first = self._named if self._named < len(others) else 0
        self._named = first + EXAMPLES
        named = [f'"{example}"' for example in others[first : first + EXAMPLES] + stops]
        return f"{', '.join(named[:-1])}, or {named[-1]}" if len(named) > 1 else "".join(named)


def direction_words(tags: Mapping[str, Any]) -> str:
    """Where a motion leads; empty without tags of one."""
    if "angle" in tags:
        return turn_words(float(tags["angle"]))
    return way_words(float(tags["distance"])) if "distance" in tags else ""


def aloud(reason: str) -> str:
    """A reason for a feeling as it is said aloud, not as a record has it."""
    reason = reason.replace(", for no special reason.", ". Nothing much has happened yet.")
    reason = reason.replace("I have had ", "I've had ").replace("I have been ", "I've been ")
    return reason.replace("that is how I am", "that's just how I am").replace("I am ", "I'm ")
