"""The memory of people as the commands print it."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import asdict
from datetime import datetime
from typing import Any

from hri.conversation.memory_file import SCHEMA, people_file, recall
from hri.conversation.people import KnownPerson


def remembered() -> list[KnownPerson]:
    """Everyone who is remembered, by name. Raises HriError for a file that cannot be used."""
    kept = recall(people_file())
    people = [] if kept is None else kept.people.values()
    return sorted(people, key=lambda person: (person.name.casefold(), person.id))


def as_json(value: Any) -> str:
    """People, or what is made of them, as JSON; times as in ISO 8601."""
    return json.dumps(value, indent=1, ensure_ascii=False, default=datetime.isoformat)


def entries(people: Iterable[KnownPerson]) -> list[dict[str, Any]]:
    """All that is known of each, for JSON."""
    return [asdict(person) for person in people]


def whole(people: Iterable[KnownPerson]) -> dict[str, Any]:
    """All that is known of everyone, for JSON."""
    return {"schema": SCHEMA, "people": entries(people)}


def times(count: int) -> str:
    """How often, in words."""
    return "once" if count == 1 else f"{count} times"


def minute(time: datetime) -> str:
    """A wall time, for people."""
    return f"{time:%Y-%m-%d %H:%M}"
