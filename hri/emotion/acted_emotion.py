"""Acted feelings: for a while an emotion is shown at a chosen value without being felt. Real
feelings continue below, and show again afterwards.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from hri.core.errors import HriError, did_you_mean
from hri.core.signals import EmotionState
from hri.emotion.emotions import NAMES
from hri.emotion.label import MOODS, STANDS_OUT, mood_name

MOST_ACTS = 20
"""Values of one emotion that may lie upon each other; the oldest is forgotten."""


@dataclass(frozen=True, slots=True)
class Act:
    """An emotion that is put on."""

    value: float
    """0 to 1, shown instead of the felt intensity."""
    until: float
    """Seconds of the clock at which it ends."""


@dataclass(frozen=True, slots=True)
class Acting:
    """All that is put on, by emotion; a value, each method gives a new one."""

    acts: Mapping[str, tuple[Act, ...]]
    """Of each emotion those that are still to be seen: the last one now, the one before when that
    is over."""

    def set(self, values: Mapping[str, float], duration: float, now: float) -> Acting:
        """Show these intensities, 0 to 1, for `duration` seconds; others stay as they are.

        What was put on for longer is shown again after that. Raises HriError for an unknown
        emotion, or a value or a duration out of range.
        """
        if not duration > 0:
            raise HriError(f"an emotion for {duration} seconds - give a time above 0")
        for emotion, value in values.items():
            _check(emotion, value, lowest=0.0)
        until = now + duration
        acts = self._current(now)
        for emotion, value in values.items():
            longer = [act for act in acts.get(emotion, ()) if act.until > until]
            acts[emotion] = (*longer, Act(float(value), until))[-MOST_ACTS:]
        return Acting(acts)

    def raised(
        self, emotion: str, increment: float, state: EmotionState, duration: float, now: float
    ) -> Acting:
        """Show an emotion by `increment` (-1 to 1) more than now, within 0 to 1; see `set`."""
        _check(emotion, increment, lowest=-1.0)
        shown = self.shown(state, now).emotions.get(emotion, 0.0)
        return self.set({emotion: min(max(shown + increment, 0.0), 1.0)}, duration, now)

    def ends(self, now: float) -> float:
        """When the last of it is over, in seconds of the clock; `now` when nothing is put on."""
        return max((acts[0].until for acts in self._current(now).values()), default=now)

    def shown(self, state: EmotionState, now: float) -> EmotionState:
        """What is to be seen of a robot that feels `state`."""
        acts = self._current(now)
        if not acts:
            return state
        emotions = {**state.emotions, **{emotion: on[-1].value for emotion, on in acts.items()}}
        strongest = max(emotions, key=lambda emotion: emotions[emotion])
        if emotions[strongest] >= STANDS_OUT:
            label, intensity = strongest, emotions[strongest]
        else:
            label, intensity = _mood_of(state)
        return replace(state, label=label, intensity=intensity, emotions=emotions)

    def _current(self, now: float) -> dict[str, tuple[Act, ...]]:
        """What is not over: of each emotion those below end later than those above."""
        going = {
            emotion: tuple(act for act in acts if act.until > now)
            for emotion, acts in self.acts.items()
        }
        return {emotion: acts for emotion, acts in going.items() if acts}


NOTHING_ACTED = Acting({})


def whole_vector(values: Mapping[str, float] | Sequence[float]) -> dict[str, float]:
    """An intensity for every emotion: by name, those left out being 0, or in the table's order.

    Raises HriError for an unknown emotion, or a list of another length than the table.
    """
    if isinstance(values, Mapping):
        for emotion, value in values.items():
            _check(emotion, value, lowest=0.0)
        return {name: float(values.get(name, 0.0)) for name in NAMES}
    if len(values) != len(NAMES):
        count = f"{len(values)} values for {len(NAMES)} emotions"
        raise HriError(f"{count} - give one for each of {', '.join(NAMES)}")
    return dict(zip(NAMES, map(float, values), strict=True))


def _mood_of(state: EmotionState) -> tuple[str, float]:
    """Name and intensity of the mood below the emotions."""
    if state.label in MOODS:
        return state.label, state.intensity
    mood = (state.valence, state.arousal, state.dominance)
    return state.mood or mood_name(mood), math.hypot(*mood) / math.sqrt(3)


def _check(emotion: str, value: float, lowest: float) -> None:
    if emotion not in NAMES:
        raise HriError(f'no emotion "{emotion}" - {did_you_mean(emotion, NAMES)}')
    if not lowest <= value <= 1:
        raise HriError(f"{emotion} of {value} - give {lowest:g} to 1")
