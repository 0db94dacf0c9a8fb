"""Writes an imprint of feelings as JSON, exact to the last bit, and reads it with every value
checked.
"""

from __future__ import annotations

import math
from typing import Any

from hri.core.errors import HriError, did_you_mean
from hri.core.json_fields import LARGEST, LATEST, Fields
from hri.emotion.affect import Imprint, Need, Soothed, Trace
from hri.emotion.emotions import NAMES, PART_OF
from hri.emotion.held import Held, Level
from hri.emotion.label import MOODS, NOTHING
from hri.emotion.ledger import Axes, LedgerRow, Origin


def encoded(imprint: Imprint) -> dict[str, Any]:
    """The imprint as JSON knows it."""
    return {
        "time": imprint.time,
        "label": imprint.label,
        "causes": [
            {**_named(origin), "charges": dict(row.charges), "mood": row.mood, "time": row.time}
            for origin, row in imprint.ledger.items()
        ],
        "fresh": [
            {**_named(origin), "charges": dict(charges)}
            for origin, charges in imprint.fresh.items()
        ],
        "needs": {name: need._asdict() for name, need in imprint.needs.items()},
        "habituation": [
            {**_named(origin), **trace._asdict()} for origin, trace in imprint.habituation.items()
        ],
        "relations": {person: trace._asdict() for person, trace in imprint.relations.items()},
        "held": [{**_named(origin), **_lasting(held)} for origin, held in imprint.held.items()],
        "mood_name": imprint.mood_name,
        "named_at": imprint.named_at,
        "words": dict(imprint.words),
        "soothed": None if imprint.soothed is None else imprint.soothed._asdict(),
    }


def _lasting(held: Held) -> dict[str, Any]:
    """What goes on; what has no end is written as null."""
    until = None if held.until == math.inf else held.until
    return {**held._asdict(), "levels": dict(held.levels), "until": until}


def decoded(data: object) -> Imprint:
    """The imprint again. Raises HriError that says which value is missing or wrong."""
    fields = Fields(data, "affect")
    time = fields.number("time", LATEST)
    label = fields.text("label")
    if label != NOTHING:
        _check_emotion(label, "affect.label")
    causes = fields.entries("causes")
    return Imprint(
        time=time,
        ledger={
            _origin(entry): LedgerRow(_charges(entry), _axes(entry), entry.number("time", time))
            for entry in causes
        },
        fresh={_origin(entry): _charges(entry) for entry in fields.entries("fresh")},
        needs=fields.table(
            "needs", lambda entry: Need(entry.number("level", 1.0, 0.0), _axes(entry))
        ),
        habituation={
            _origin(entry): _trace(entry, time, lowest=0.0, highest=1.0)
            for entry in fields.entries("habituation")
        },
        relations=fields.table(
            "relations", lambda entry: _trace(entry, time, lowest=-LARGEST, highest=LARGEST)
        ),
        label=label,
        # Files of earlier versions end here.
        held={_origin(entry): _held(entry, time) for entry in fields.entries("held", [])},
        mood_name=_mood_name(fields),
        named_at=fields.number("named_at", time, default=time),
        words=_words(fields),
        soothed=_soothed(fields, time),
    )


def _named(origin: Origin) -> dict[str, str | None]:
    return {"name": origin.name, "person": origin.person}


def _origin(entry: Fields) -> Origin:
    person = None if entry.value("person") is None else entry.text("person")
    return Origin(entry.text("name"), person)


def _charges(entry: Fields) -> dict[str, float]:
    """Charges by emotion."""
    below = entry.below("charges")
    for part in below.names():
        _check_emotion(PART_OF.get(part, part), below.place)
    return {emotion: below.number(emotion, LARGEST, 0.0) for emotion in below.names()}


def _axes(entry: Fields) -> Axes:
    axes = entry.numbers("mood")
    if len(axes) != 3:
        raise HriError(f"a mood of {len(axes)} numbers, not 3")
    return axes[0], axes[1], axes[2]


def _held(entry: Fields, time: float) -> Held:
    levels = entry.below("levels")
    for name in levels.names():
        _check_emotion(name, "affect.held.levels")
    likelihood = entry.numbers("likelihood") if "likelihood" in entry else None
    return Held(
        since=entry.number("since", time),
        levels={name: _level(levels.numbers(name), LARGEST) for name in levels.names()},
        rate=entry.number("rate", LARGEST, 1.0 / LARGEST),
        mood=_axes(entry),
        until=entry.number("until", LATEST, default=math.inf),
        fall_rate=entry.number("fall_rate", LARGEST, 1.0 / LARGEST),
        likelihood=None if likelihood is None else _level(likelihood, 1.0),
        peak=entry.number("peak", 1.0, 0.0),
    )


def _level(ends: list[float], highest: float) -> Level:
    if len(ends) != 2 or not all(0.0 <= end <= highest for end in ends):
        raise HriError(f"a level of {ends!r:.60}, not from and to, 0 to {highest:g}")
    return Level(*ends)


def _mood_name(fields: Fields) -> str:
    mood = fields.text("mood_name") if "mood_name" in fields else ""
    if mood and mood not in MOODS:
        raise HriError(f'affect.mood_name: no mood "{mood}" - {did_you_mean(mood, MOODS)}')
    return mood


def _words(fields: Fields) -> dict[str, str]:
    if "words" not in fields:
        return {}
    words = fields.below("words")
    return {cause: words.text(cause) for cause in words.names()}


def _soothed(fields: Fields, time: float) -> Soothed | None:
    if "soothed" not in fields:
        return None
    entry = fields.below("soothed")
    _check_emotion(entry.text("emotion"), "affect.soothed.emotion")
    return Soothed(
        entry.text("deed"),
        entry.text("amends"),
        entry.text("person") if "person" in entry else None,
        entry.text("emotion"),
        entry.number("time", time),
    )


def _trace(entry: Fields, time: float, lowest: float, highest: float) -> Trace:
    before, after = (entry.number(name, highest, lowest) for name in ("before", "after"))
    return Trace(before, after, entry.number("time", time))


def _check_emotion(name: str, place: str) -> None:
    if name not in NAMES:
        raise HriError(f'{place}: no emotion "{name}" - {did_you_mean(name, NAMES)}')
