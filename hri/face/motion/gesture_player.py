"""Gestures while they are made: one at a time, and one that is cut glides away."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hri.core.errors import HriError, did_you_mean
from hri.face.model import FaceModel
from hri.face.motion.gesture_tracks import (
    LONGEST,
    SHORTEST,
    STRONGEST,
    Track,
    load_gestures,
    track_of,
)
from hri.face.motion.spring import Spring, Values

_STIFFNESS = 14.0
"""Radians a second: a gesture that is cut is gone after 0.3 s."""


@dataclass(eq=False)
class Playing:
    """A gesture that is made, or was; to look at and to cancel."""

    name: str
    track: Track
    strength: float
    seconds: float
    started: float | None = None
    is_over: bool = False

    def cancel(self) -> None:
        """End it now: the face glides back. A second call does nothing."""
        self.is_over = True


@dataclass(frozen=True, slots=True)
class Gestured:
    """What a gesture does now."""

    weights: Values
    """Of all channels."""
    owned: Values
    """How much of each channel it owns, 0 to 1."""
    gaze: Values
    """What it adds to where the eyes look: right, up."""


class GesturePlayer:
    """The gestures of one face."""

    def __init__(self, model: FaceModel) -> None:
        """Raises AuthoringError for gestures that cannot be read."""
        self.known = load_gestures(model)
        """What the face can do, by name."""
        self._model = model
        self._tracks: dict[str, Track] = {}
        self._playing: Playing | None = None
        self._played: Playing | None = None
        self._spring = Spring(2 * len(model.channels) + 2, _STIFFNESS)

    def make(self, name: str, strength: float, seconds: float) -> Playing:
        """Make a gesture of the face; see `play`. Raises HriError for an unknown one."""
        if name not in self.known:
            what = f'the face {self._model.name} has no gesture "{name}"'
            raise HriError(f"{what} - {did_you_mean(name, self.known)}")
        if name not in self._tracks:
            self._tracks[name] = track_of(self.known[name], self._model)
        return self.play(name, self._tracks[name], strength, seconds)

    def play(self, name: str, track: Track, strength: float, seconds: float) -> Playing:
        """Play a track from the next step on, replacing the current one. Raises HriError for a
        strength or seconds that are out of range.
        """
        if not 0 <= strength <= STRONGEST:
            what = f"a gesture of strength {strength}"
            raise HriError(f"{what} - give a number from 0 to {STRONGEST:g}")
        if seconds and not SHORTEST <= seconds <= LONGEST:
            what = f"a gesture of {seconds} s"
            raise HriError(f"{what} - give {SHORTEST:g} to {LONGEST:g} seconds, or 0 for its own")
        if self._playing is not None:
            self._playing.cancel()
        self._playing = Playing(name, track, strength, seconds or track.duration)
        return self._playing

    def follow(self, now: float, dt: float) -> Gestured:
        """The effect of the current gesture, or what is left of the last one."""
        size = len(self._model.channels)
        playing = self._current(now)
        goal = np.zeros(2 * size + 2) if playing is None else _goal(playing, now)
        leaps, self._played = playing is not self._played, playing
        values = self._spring.follow(goal, dt, leaps=leaps)
        return Gestured(values[:size], np.clip(values[size:-2], 0, 1), values[-2:])

    def _current(self, now: float) -> Playing | None:
        playing = self._playing
        if playing is None:
            return None
        if playing.started is None:
            playing.started = now
        if now - playing.started >= playing.seconds:
            playing.is_over = True
        if playing.is_over:
            self._playing = None
        return self._playing


def _goal(playing: Playing, now: float) -> Values:
    """Weights, what is owned, and gaze."""
    assert playing.started is not None
    track, strength = playing.track, playing.strength
    time = (now - playing.started) * track.duration / playing.seconds
    weights, gaze = track.at(time)
    owned = min(strength, 1.0) * track.presence(time) * track.owned
    return np.concatenate([strength * weights, owned, strength * gaze])
