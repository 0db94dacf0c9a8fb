"""Something about a grammar that its author should know."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from hri.core.errors import Place
from hri.core.quoting import message_line

Severity = Literal["error", "warning", "hint", "note"]
SEVERITIES: tuple[Severity, ...] = ("error", "warning", "hint", "note")
"""Worst first. Errors stop a grammar from being used, warnings cost sentences or bring wrong ones,
hints cost nothing yet, notes are worth a thought and are shown to those who ask."""


@dataclass(frozen=True, slots=True)
class Finding:
    """An issue, its place and its remedy."""

    severity: Severity
    place: Place
    what: str
    remedy: str

    def __str__(self) -> str:
        return message_line(f"{self.place}: {self.severity}: {self.what} - {self.remedy}")


def warning(place: Place, what: str, remedy: str) -> Finding:
    """Something that costs sentences or brings wrong ones."""
    return Finding("warning", place, what, remedy)


def note(place: Place, what: str, remedy: str) -> Finding:
    """Something that is fine when it is meant."""
    return Finding("note", place, what, remedy)


def hint(place: Place, what: str, remedy: str) -> Finding:
    """Something that costs nothing yet."""
    return Finding("hint", place, what, remedy)
