"""The mouth of a talking robot: the lip track at the position that has really been heard."""

from __future__ import annotations

import math

import numpy as np

from hri.core.signals import Speech
from hri.face.lips.envelope import EnvelopeTrack
from hri.face.lips.lipsync import LipTrack, PhonemeTrack
from hri.face.lips.loudness import Loudness
from hri.face.lips.spans import ARTICULATORS
from hri.face.model import FaceModel
from hri.face.motion.spring import Follower, Spring, Values
from hri.face.vocabulary import VISEMES

PICTURE_LEAD = 0.05
"""Seconds by which the track of the lips is read ahead of the sound: one frame until the
picture is seen, and a little more, since lips that are early look right and late ones do not."""
RAISED = {"browOuterUp": 0.5, "browInnerUp": 0.3, "headPitch": -0.35, "headY": 0.4}
"""Weights that an accent adds: brows go up as the head dips."""

_LIPS = 70.0
"""Stiffness in radians a second: shut within 100 ms of a cut."""
_TALKING = 30.0
"""Stiffness with which speech takes the mouth over, and gives it back."""


class LipPlayer:
    """The mouth of one face."""

    def __init__(self, model: FaceModel, latency: float) -> None:
        """`latency` is how many seconds pass until a picture of the mouth is seen."""
        self.speech: Speech | None = None
        """What is being said."""
        self._latency = latency
        self._track: LipTrack | None = None
        self._followed: LipTrack | None = None
        self._shapes = np.array([model.vector(model.viseme(viseme)) for viseme in VISEMES])
        self._articulators = [
            ARTICULATORS.index(articulator_of(channel)) for channel in model.channels
        ]
        there = {name: weight for name, weight in RAISED.items() if name in model.names}
        self._raised = model.vector(there).astype(float)
        self._rest = np.zeros(len(model.channels))
        self._mouth = Spring(len(model.channels), _LIPS)
        self._talking = Follower(0.0)

    def say(self, speech: Speech | None) -> None:
        """Follow this speech; None when nothing is said. The mouth glides only to another one."""
        is_followed = self._followed is self._track and self._track is not None
        goes_on = speech is not None and speech.continues(self.speech)
        self.speech = speech
        self._track = None if speech is None else lip_track(speech)
        if is_followed and goes_on:
            self._followed = self._track

    def follow(self, position: float | None, dt: float) -> tuple[Values, float]:
        """Weights of all channels, and how much speech owns the mouth, 0 to 1.

        `position` is how many seconds have been heard. Nothing waits in a queue: what comes too
        late to be seen is never shown. A track that begins or is cut short glides.
        """
        is_heard = position is not None and math.isfinite(position)
        track = self._track if is_heard else None
        goal = self._rest
        if track is not None and position is not None:
            at = position + self._latency
            weights = track.shape(at).astype(np.float32)[:, self._articulators]
            goal = (weights * self._shapes).sum(axis=0) + track.emphasis(at) * self._raised
        leaps, self._followed = track is not self._followed, track
        talking = self._talking.follow(float(self.speech is not None), dt, _TALKING)
        return self._mouth.follow(goal, dt, leaps=leaps), float(talking)


def lip_track(speech: Speech) -> LipTrack:
    """The track of a speech: by its phonemes, or by its sound alone when it has none."""
    if speech.phonemes:
        return PhonemeTrack(speech.phonemes, Loudness(speech.samples, speech.rate))
    return EnvelopeTrack(speech.samples, speech.rate)


def articulator_of(channel: str) -> str:
    """What a channel belongs to when the face speaks; all but jaw and tongue goes with the lips."""
    return next((name for name in ("jaw", "tongue") if channel.startswith(name)), "lips")
