"""What the author of a stimulus expects of it, so that a file tests itself.

[[stimulus.praise.expect]]
personality = "optimist"     # who feels it; "neutral" when left out
times = 3                    # how often it comes
every_s = 5                  # seconds from one time to the next
after_s = 10                 # seconds from the last time to the look
dominant = "joy"             # the label then: an emotion, or a mood
at_least = { joy = 0.3 }     # intensities then
at_most = { sadness = 0.05 }
pleasure = [0.1, 1.0]        # the mood then, from and to; arousal and dominance likewise
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from hri.core.errors import Place
from hri.core.signals import EmotionState
from hri.core.toml import Table
from hri.emotion.emotions import NAMES, emotions_in
from hri.emotion.label import FORMER, MOODS, known_as

AXES = {"pleasure": "valence", "arousal": "arousal", "dominance": "dominance"}
"""The axes of the mood, and what a state calls them."""
MOST = 20
"""Expectations of one stimulus."""
MOST_TIMES = 100
_LONGEST_S = 86400.0
_NEARLY = 1e-9
"""What rounding may take from an intensity."""


@dataclass(frozen=True, slots=True)
class Expectation:
    """What a robot in a calm is to feel after a stimulus."""

    place: Place
    personality: str = "neutral"
    intensity: float = 1.0
    times: int = 1
    every_s: float = 1.0
    after_s: float = 0.0
    dominant: str = ""
    """The label; empty for any."""
    at_least: Mapping[str, float] = field(default_factory=dict)
    at_most: Mapping[str, float] = field(default_factory=dict)
    mood: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """Least and most of each axis."""

    def failures(self, state: EmotionState) -> Iterator[str]:
        """What is otherwise in a state, a sentence each."""
        if known_as(self.dominant) not in ("", state.label):
            yield f"{self.dominant} was to be dominant, but {state.label} is"
        for name, least in self.at_least.items():
            if state.emotions.get(name, 0.0) < least - _NEARLY:
                yield f"{name} is {state.emotions.get(name, 0.0):.3f}, not {least:g} or more"
        for name, most in self.at_most.items():
            if state.emotions.get(name, 0.0) > most + _NEARLY:
                yield f"{name} is {state.emotions.get(name, 0.0):.3f}, not {most:g} or less"
        for axis, (least, most) in self.mood.items():
            value = getattr(state, AXES[axis])
            if not least - _NEARLY <= value <= most + _NEARLY:
                yield f"{axis} is {value:.3f}, not {least:g} to {most:g}"


def expectations_in(table: Table) -> tuple[Expectation, ...]:
    """All under `expect` of a stimulus. Raises AuthoringError with the place."""
    entries = table.array("expect")
    if len(entries) > MOST:
        raise table.error("expect", f"{len(entries)} expectations", f"keep {MOST} at most")
    return tuple(map(_expectation, entries))


def _expectation(table: Table) -> Expectation:
    expectation = Expectation(
        place=table.place(),
        personality=table.string("personality", "neutral"),
        intensity=table.number("intensity", 1.0, minimum=0, maximum=1),
        times=_times(table),
        every_s=table.number("every_s", 1.0, minimum=0, maximum=_LONGEST_S),
        after_s=table.number("after_s", 0.0, minimum=0, maximum=_LONGEST_S),
        dominant=table.string("dominant", "", among=(*NAMES, *MOODS, *FORMER)),
        at_least=_intensities(table.table("at_least", optional=True)),
        at_most=_intensities(table.table("at_most", optional=True)),
        mood={axis: _span(table, axis) for axis in AXES},
    )
    table.finish()
    return expectation


def _times(table: Table) -> int:
    times = table.number("times", 1, minimum=1, maximum=MOST_TIMES)
    if times != int(times):
        raise table.error("times", f"times is {times}", "write a whole number")
    return int(times)


def _intensities(table: Table) -> dict[str, float]:
    emotions_in(table)
    return table.weights()


def _span(table: Table, axis: str) -> tuple[float, float]:
    least, most = table.numbers(axis, (-1.0, 1.0), count=2)
    if not -1 <= least <= most <= 1:
        remedy = "write the least and the most, such as [0.1, 1.0]"
        raise table.error(axis, f"{axis} is {least:g} to {most:g}", remedy)
    return least, most
