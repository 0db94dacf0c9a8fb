"""Reports changes among the people in sight as they happen."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from hri.core.signals import People, Person

STEP = 0.3
"""Meters someone must come nearer, or move away, before it is reported."""
SETTLING = 0.5
"""Seconds after which a newcomer's distance is taken for where they start from."""


@dataclass(frozen=True, slots=True)
class Happening:
    """Something that a person did: the name of the event and who it was."""

    name: str
    person: str
    properties: dict[str, float] = field(default_factory=dict)


@dataclass(slots=True)
class _Guest:
    entered: float
    is_looking: bool = False
    anchor: float = math.nan
    """Meters, their distance at the last report."""


class Presence:
    """Compares everyone with how they were before."""

    def __init__(self) -> None:
        self._guests: dict[str, _Guest] = {}

    def update(self, people: People) -> list[Happening]:
        """What happened since the last call, in the order to report it.

        Names are `person.entered`, `person.left`, `person.approached`, `person.moved_away` (both
        with the `distance` in meters), `person.looked`, `person.looked_away`; besides,
        `person.seen` with the first who is there, and `person.lost` with the last who was.
        """
        happened: list[Happening] = []
        was_empty = not self._guests
        here = {person.id for person in people.persons}
        for id in [id for id in self._guests if id not in here]:
            if self._guests.pop(id).is_looking:
                happened.append(Happening("person.looked_away", id))
            happened.append(Happening("person.left", id))
            if not self._guests and not here:
                happened.append(Happening("person.lost", id))
        for person in people.persons:
            if person.id not in self._guests:
                self._guests[person.id] = _Guest(people.time)
                if was_empty:
                    happened.append(Happening("person.seen", person.id))
                    was_empty = False
                happened.append(Happening("person.entered", person.id))
            happened += self._changes(people.time, person, self._guests[person.id])
        return happened

    def _changes(self, time: float, person: Person, guest: _Guest) -> list[Happening]:
        happened = []
        if person.is_looking != guest.is_looking:
            guest.is_looking = person.is_looking
            name = "person.looked" if person.is_looking else "person.looked_away"
            happened.append(Happening(name, person.id))
        if not (person.is_visible and math.isfinite(person.distance)):
            return happened
        if math.isnan(guest.anchor):
            if time - guest.entered >= SETTLING:
                guest.anchor = person.distance
        elif abs(person.distance - guest.anchor) >= STEP:
            comes = person.distance < guest.anchor
            guest.anchor = person.distance
            name = "person.approached" if comes else "person.moved_away"
            told = {"distance": round(person.distance, 2)}
            happened.append(Happening(name, person.id, told))
        return happened
