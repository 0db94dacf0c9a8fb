"""Authored texts that are said, with names in braces that are filled in: "You like {value}."."""

from __future__ import annotations

import string
from collections.abc import Collection

from hri.core.errors import HriError, did_you_mean
from hri.core.toml import Table
from hri.speech.vocalizations.in_text import check_sounds

LONGEST = 5000
"""Characters of what is said; voices say no more."""


def fields_of(text: str) -> list[str]:
    """The names in braces in a text."""
    return [field for _, field, _, _ in string.Formatter().parse(text) if field]


def check_text(table: Table, text: str, known: Collection[str], key: str) -> None:
    """Refuse a text that is too long, or in which something is never filled in, or no sound."""
    if len(text) > LONGEST:
        raise table.error(key, f"a text of {len(text)} characters", f"keep it within {LONGEST}")
    try:
        check_sounds(text)
    except HriError as error:
        what, _, remedy = str(error).partition(" - ")
        raise table.error(key, what, remedy) from error
    try:
        parts = list(string.Formatter().parse(text))
    except ValueError as error:
        raise table.error(key, f"{error}", "close every {brace}") from error
    for _, name, form, conversion in parts:
        if name is None:
            continue
        if form or conversion:
            what = f"{{{name}}} has a format, which braces do not take"
            raise table.error(key, what, f"write {{{name}}}")
        if name not in known:
            raise table.error(key, f"nothing fills in {{{name}}}", did_you_mean(name, known))
