"""Reports changes of feelings: `emotion.changed` and `mood.changed`."""

from __future__ import annotations

from hri.core.event_bus import EventBus
from hri.core.signals import EmotionState

NOTABLE = 0.1
"""A change of valence worth an event when the label stays the same."""
INTERVAL_S = 1.0
"""Seconds between two such events."""


class Announcer:
    """Raises the events of one robot.

    `emotion.changed` has the label and the mood's valence (its pleasure), arousal and dominance; it
    comes when the label changes, and when the valence has moved. `mood.changed` has the mood's name
    and the same three as pleasure, arousal and dominance; it comes when the name changes.
    """

    def __init__(self, events: EventBus) -> None:
        self._events = events
        self._label = ""
        self._valence = 0.0
        self._time = 0.0
        self._mood = ""

    def announce(self, state: EmotionState, now: float) -> None:
        """Report changes at a time in seconds."""
        moved = abs(state.valence - self._valence) > NOTABLE and now - self._time >= INTERVAL_S
        if state.label != self._label or moved:
            self._label, self._valence, self._time = state.label, state.valence, now
            self._raise("emotion.changed", state.label, "valence", state)
        if state.mood != self._mood:
            self._mood = state.mood
            self._raise("mood.changed", state.mood, "pleasure", state)

    def _raise(self, event: str, label: str, pleasure: str, state: EmotionState) -> None:
        axes = {pleasure: state.valence, "arousal": state.arousal, "dominance": state.dominance}
        rounded = {name: round(value, 4) for name, value in axes.items()}
        self._events.raise_event(event, label=label, **rounded)
