"""What moves the emotions, read from `emotions/stimuli/*.toml`: praise, a bump, being ignored."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from hri.core import paths
from hri.core.errors import HriError
from hri.core.toml import REQUIRED, Table, load_toml
from hri.emotion.appraisal import LONGEST_NAME, name_of
from hri.emotion.drives import drives_in
from hri.emotion.emotions import NAMES, emotions_in
from hri.emotion.expectation import Expectation, expectations_in
from hri.emotion.formula import Formula, parse_formula
from hri.emotion.ledger import OTHER, TEMPERAMENT

FOLDER = "emotions/stimuli"
MOST = 1000
"""Stimuli at most, in all files."""
_STRONGEST = 0.95
_FULL = parse_formula("1")
_WORDS = re.compile(r"(?:[^{}]|\{[^{}\s]+(?: (?:are|were|have))?\})*")
_PASTS = {"am": "was", "is": "was", "are": "were", "has": "had", "have": "had", "may": "might"}
_PRESENT = re.compile(rf"\b({'|'.join(_PASTS)})\b")
_NAME = re.compile(r"[\w-]{1,60}", re.ASCII)
_TRIGGER = re.compile(r"[\w-]+(\.[\w-]+)+", re.ASCII)


@dataclass(frozen=True, slots=True)
class HeldSpec:
    """How a state lasts: its emotions rise while it goes on, and fall when it is over."""

    rise_s: float = 2.0
    """Seconds in which all but 1/e of the way is gone."""
    fall_s: float = 10.0
    """Seconds in which they fall to 1/e."""
    for_s: float = math.inf
    """Seconds after which it is over, unless it is felt again; infinite: when it is felt with an
    intensity of 0."""
    ended_by: str = ""
    """The event that ends it; empty for none."""
    as_liked: bool = False
    """Whether it counts as much as the robot likes the person: half as much for a stranger."""
    past: str = ""
    """What is said of it after "because" once it is over; empty: the words in the past tense."""
    over: str = ""
    """What is said instead where that pleases: "my battery is not low anymore"."""


@dataclass(frozen=True, slots=True)
class StimulusSpec:
    """A kind of thing that can happen to the robot."""

    name: str
    words: str
    """What happened, as the robot says it after "because": "{you} praised me". What stands in
    braces gives way to the name of who did it, where that is known."""
    emotions: Mapping[str, float]
    """Intensity that each emotion reaches when this comes in full strength out of a calm."""
    habituates: float = 0.0
    """Share of its effect that is lost with each time, 0 to 1."""
    recover_s: float = 60.0
    """Seconds in which that loss falls to 1/e."""
    trigger: str = ""
    """The event that brings it, "bumper.pressed", or the port of a behavior that does,
    "battery.level"; empty: someone feels it by name."""
    formula: Formula = _FULL
    """Its intensity, of the event's properties; of a port's `value`."""
    satisfies: Mapping[str, float] = field(default_factory=dict)
    """Share of each drive that it stills in full strength, 0 to 1."""
    relation: float = 0.0
    """What it adds to the liking of who does it, in full strength, -1 to 1."""
    person: str = ""
    """The person behind events without a property `person`; empty for none."""
    held: HeldSpec | None = None
    """How it lasts, where it is not a moment but a state; None: it fades from the first."""
    soothes: Mapping[str, float] = field(default_factory=dict)
    """Share of each emotion about the same person's deeds that goes in full strength, 0 to 1."""
    reunion: float = 0.0
    """Charge of lasting joy that the robot's best friend brings after a long absence."""
    expects: tuple[Expectation, ...] = ()
    """What must be felt after it, for `hri emotion check`."""

    def past_words(self, is_pleasant: bool) -> str:
        """What is said of a feeling, pleasant or not, once it is over, where it lasts."""
        if self.held is None:
            return self.words
        if is_pleasant and self.held.over:
            return self.held.over
        return self.held.past or _PRESENT.sub(lambda verb: _PASTS[verb[0]], self.words, count=1)

    def charges(self) -> list[float]:
        """Charge it adds to each emotion in full strength, in the order of the table."""
        return [-math.log1p(-self.emotions.get(name, 0.0)) for name in NAMES]

    def intensity(self, properties: Mapping[str, Any]) -> float:
        """How strong it is for an event, 0 (it is not felt) to 1.

        Raises ValueError when the event lacks a property that the formula asks for.
        """
        return self.formula.intensity(properties)

    def doer(self, properties: Mapping[str, Any]) -> str | None:
        """The person it comes from, for an event; None without one."""
        return name_of(properties.get("person") or self.person)


def stimulus_paths() -> Iterator[Path]:
    """All stimulus files; of two of the same name, that of the first search folder."""
    for name in paths.names(FOLDER):
        if name.endswith(".toml"):
            yield paths.find(FOLDER, Path(name).stem)


def load_stimuli() -> dict[str, StimulusSpec]:
    """All stimuli by name. Raises HriError without any, AuthoringError with the place."""
    stimuli: dict[str, StimulusSpec] = {}
    for path in stimulus_paths():
        table = load_toml(path, "stimulus file")
        table.number("schema", 1, minimum=1, maximum=1)
        for name, entry in table.tables("stimulus"):
            if name in stimuli or name in (TEMPERAMENT, OTHER):
                raise entry.error(None, f'"{name}" is taken already', "choose another name")
            if not _NAME.fullmatch(name):
                remedy = "use letters, digits, - and _"
                raise entry.error(None, f'"{name[:40]}" is not a valid stimulus name', remedy)
            if len(stimuli) == MOST:
                raise entry.error(None, f"more than {MOST} stimuli", "take away some")
            stimuli[name] = _stimulus(name, entry)
        table.finish()
    if not stimuli:
        raise HriError(f"no stimulus in {FOLDER} - add a file such as companion.toml there")
    return stimuli


def _stimulus(name: str, table: Table) -> StimulusSpec:
    emotions = table.table("emotions", optional=True)
    emotions_in(emotions)
    habituation = table.table("habituation", optional=True)
    stimulus = StimulusSpec(
        name=name,
        words=_words(table),
        emotions=emotions.weights(maximum=_STRONGEST),
        habituates=habituation.number("per_event", 0.0, minimum=0, maximum=1),
        recover_s=habituation.number("recover_s", 60.0, minimum=1, maximum=86400),
        trigger=_trigger(table),
        formula=_formula(table),
        satisfies=_satisfied(table.table("satisfies", optional=True)),
        relation=table.number("relation", 0.0, minimum=-1, maximum=1),
        person=_text(table, "person", ""),
        held=_held(table.table("held")) if "held" in table else None,
        soothes=_soothed(table.table("soothes", optional=True)),
        reunion=table.number("reunion", 0.0, minimum=0, maximum=5),
        expects=expectations_in(table),
    )
    for key in ("habituation", "satisfies", "relation", "soothes", "reunion"):
        if stimulus.held is not None and key in table:
            remedy = "leave that out: only what happens at a moment has it"
            raise table.error(key, f"{name} is held and has {key}", remedy)
    habituation.finish()
    table.finish()
    return stimulus


def _held(table: Table) -> HeldSpec:
    held = HeldSpec(
        rise_s=table.number("rise_s", 2.0, minimum=0.1, maximum=86400),
        fall_s=table.number("fall_s", 10.0, minimum=0.1, maximum=86400),
        for_s=table.number("for_s", math.inf, minimum=0.1, maximum=math.inf),
        ended_by=_trigger(table, "ended_by"),
        as_liked=table.flag("as_liked"),
        past=_words(table, "past", ""),
        over=_words(table, "over", ""),
    )
    table.finish()
    return held


def _soothed(table: Table) -> dict[str, float]:
    emotions_in(table)
    return table.weights()


def _text(table: Table, name: str, default: str = REQUIRED) -> str:
    """A text that can be said."""
    text: str = table.string(name, default)
    if len(text) > LONGEST_NAME:
        raise table.error(name, f"{name} has {len(text)} letters", f"keep it within {LONGEST_NAME}")
    return text


def _words(table: Table, name: str = "words", default: str = REQUIRED) -> str:
    words = _text(table, name, default)
    if not _WORDS.fullmatch(words):
        remedy = 'put one word in braces, such as "{you} praised me", or none'
        raise table.error(name, f'"{words}" has a brace too many', remedy)
    return words


def _trigger(table: Table, name: str = "trigger") -> str:
    trigger = table.string(name, "")
    if trigger and not _TRIGGER.fullmatch(trigger):
        remedy = 'write an event, "bumper.pressed", or a port, "battery.level"'
        raise table.error(name, f'"{trigger}" is not a trigger', remedy)
    return trigger


def _formula(table: Table) -> Formula:
    """An intensity: a number from 0 to 1, or a formula in quotes."""
    if not isinstance(table.data.get("intensity"), str):
        return parse_formula(repr(table.number("intensity", 1.0, minimum=0, maximum=1)))
    text = table.string("intensity")
    try:
        return parse_formula(text)
    except ValueError as error:
        what, _, remedy = str(error).partition(" - ")
        raise table.error("intensity", what, remedy or "fix the formula") from error


def _satisfied(table: Table) -> dict[str, float]:
    drives_in(table)
    return table.weights()
