"""Replies lie in `replies.toml`, and in the files that its key `also` names.

also = ["smalltalk/about_me.toml"]   # below the folder of this file; only [reply.RULE] tables
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path, PurePath

from hri.core import HriError, Mistakes, Table, did_you_mean, load_toml, paths

ALSO = "also"
KIND = "file of replies"


def also_named(table: Table) -> list[Path]:
    """The further files that a file of replies names.

    Raises AuthoringError for one that is missing, that lies outside of its folder, or that is
    named twice.
    """
    names = table.strings(ALSO, [])
    for name in names:
        if names.count(name) > 1:
            raise table.error(ALSO, f'"{name}" is named twice', "name it once")
        _refuse_unfit(table, name)
    return [table.path.parent / name for name in names]


def _refuse_unfit(table: Table, name: str) -> None:
    folder = table.path.parent
    if PurePath(name).is_absolute() or ".." in PurePath(name).parts:
        what = f'"{name}" is outside of the folder of {table.path.name}'
        raise table.error(ALSO, what, f"put it into {folder}, or below it")
    if not paths.is_file(folder / name):
        near = [str(path.relative_to(folder).as_posix()) for path in folder.rglob("*.toml")]
        remedy = did_you_mean(name, near, f"write it in {folder}")
        raise table.error(ALSO, f'there is no file "{name}" in {folder}', remedy)


def parts_of(table: Table, mistakes: Mistakes) -> tuple[list[Table], bool]:
    """A file of replies and those it names as one list, and whether all of them could be read."""
    parts, before = [table], len(mistakes.errors)
    for path in mistakes.keep(lambda: also_named(table)) or ():
        if (part := mistakes.keep(partial(load_toml, path, KIND))) is not None:
            parts.append(part)
    return parts, len(mistakes.errors) == before


def joined_entries(parts: Sequence[Table], mistakes: Mistakes) -> dict[str, Table]:
    """The `[reply.RULE]` tables of a file and of those it names; notes a rule that has two."""
    entries: dict[str, Table] = {}
    for part in parts:
        for rule, entry in mistakes.keep(partial(_entries, part)) or ():
            if rule in entries:
                what = f"<{rule}> has another reply in {entries[rule].path}"
                mistakes.add(entry.error(None, what, "delete one of the two tables"))
            entries.setdefault(rule, entry)
    return entries


def _entries(part: Table) -> list[tuple[str, Table]]:
    return list(part.tables("reply"))


def with_named_files(files: Sequence[Path]) -> list[Path]:
    """These files and those that they name, as far as they can be read."""
    found = []
    for file in files:
        found.append(file)
        with suppress(HriError):
            named = load_toml(file, KIND).strings(ALSO, [])
            found += [file.parent / name for name in named]
    return found
