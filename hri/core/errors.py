"""Errors that name the mistake, its place and its remedy."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from hri.core.quoting import message_line

E = TypeVar("E", bound=BaseException)
T = TypeVar("T")


class HriError(Exception):
    """Something the user can fix; its text is one line: problem - remedy.

    What is quoted in it may come from anyone: see `hri.core.quoting.message_line`.
    """

    def __str__(self) -> str:
        return message_line(super().__str__())


class NotAvailable(HriError):
    """A device, library or model is not there; the feature it carries is lost, the rest goes on."""


@dataclass(frozen=True, slots=True)
class Place:
    """A spot in an authored file; line and column count from 1."""

    path: Path
    line: int = 1
    column: int = 1

    def __str__(self) -> str:
        return f"{self.path}:{self.line}:{self.column}"


class AuthoringError(HriError):
    """An authored file is wrong; reads ``file:line:column: what - remedy``."""

    def __init__(self, place: Place, what: str, remedy: str) -> None:
        super().__init__(f"{place}: {what} - {remedy}")
        self.place = place
        self.what = what
        self.remedy = remedy


class AuthoringErrors(AuthoringError):
    """Several mistakes, a line each; place, what and remedy are those of the first."""

    def __init__(self, errors: Sequence[AuthoringError]) -> None:
        super().__init__(errors[0].place, errors[0].what, errors[0].remedy)
        self.errors = tuple(errors)

    def __str__(self) -> str:
        return "\n".join(map(str, self.errors))


class Mistakes:
    """All mistakes of a file: what has one is left out, and reading goes on behind it."""

    def __init__(self) -> None:
        self.errors: list[AuthoringError] = []

    def keep(self, read: Callable[[], T]) -> T | None:
        """The parsed value; None when there was a mistake in it."""
        try:
            return read()
        except AuthoringErrors as several:
            self.errors += several.errors
        except AuthoringError as error:
            self.errors.append(error)
        return None

    def add(self, error: AuthoringError) -> None:
        self.errors.append(error)

    def tell(self) -> None:
        """Raise what was found: AuthoringError, or AuthoringErrors for several."""
        if len(self.errors) > 1:
            raise AuthoringErrors(self.errors)
        for error in self.errors:
            raise error


def did_you_mean(word: str, known: Iterable[str], otherwise: str = "") -> str:
    """The remedy for a misspelt name: the nearest known one, else the list of what is known.

    `otherwise` replaces the list where that would be too long to help.
    """
    names = sorted(set(known))
    folded = {name.casefold(): name for name in names}
    near = difflib.get_close_matches(word.casefold(), folded, n=1, cutoff=0.6)
    if near:
        return f'did you mean "{folded[near[0]]}"?'
    if otherwise:
        return otherwise
    return f"known are: {', '.join(names)}" if names else "none is known here"


def first_of(group: BaseExceptionGroup[E]) -> E:
    """The first error of a group, or of the groups in it."""
    inner = group.exceptions[0]
    return first_of(inner) if isinstance(inner, BaseExceptionGroup) else inner
