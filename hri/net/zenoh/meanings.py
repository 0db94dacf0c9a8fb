"""Meanings of slots to the networks here, compared with those that other robots send.

As between two networks of one robot, a value that means something else counts, and a line warns.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from hri.behavior.network import Network
from hri.behavior.network_check import slot_uses
from hri.behavior.ports import GENERIC, means_same

MOST_WARNED = 200
"""Lines, whatever others send."""


class Meanings:
    """Of the slots that networks read and write; `note` is used in the robot's loop."""

    def __init__(self, warn: Callable[[str], object]) -> None:
        """`warn` gets a line, once for each pair of meanings."""
        self._warn = warn
        self._read: dict[str, str] = {}
        self._written: dict[str, str] = {}
        self._warned: set[tuple[str, str]] = set()

    def note(self, networks: Iterable[Network]) -> None:
        """Look at the networks that run now."""
        uses = [use for use in slot_uses(networks) if use.semantic != GENERIC]
        self._read = {use.slot: use.semantic for use in uses if not use.writes}
        self._written = {use.slot: use.semantic for use in uses if use.writes}

    def sent(self, slot: str) -> str:
        """What a slot means that a network writes; empty for whatever."""
        return self._written.get(slot, "")

    def check(self, slot: str, meaning: str, robot: str) -> None:
        """Warn where a network reads a slot as something else than a robot sends."""
        wanted = self._read.get(slot, "")
        if not (meaning and wanted) or means_same(meaning, wanted):
            return
        if (slot, meaning) not in self._warned and len(self._warned) < MOST_WARNED:
            self._warned.add((slot, meaning))
            self._warn(f"{robot} sends {meaning:.60}, but {slot} is read as {wanted}")
