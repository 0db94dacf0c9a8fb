"""The robot's own voice in its ears: subtracted as far as it goes, and never obeyed."""

from __future__ import annotations

import numpy as np

from hri.core.signals import Samples, Speech
from hri.speech.echo import ECHO_TAIL, EchoCanceller, Leftover, OwnVoice
from hri.speech.understanding import Heard

OWN_SHARE = 0.5
"""Share of a sound's energy that must be left without the robot's voice to be someone else's."""
LEARNING = 2.0
"""Seconds of the robot's voice after which most of it is subtracted."""
CLEAR = 0.97
"""Confidence from which words count before, and those of which little is left: what is left of its
voice sounds like a command, most often "halt", in one first sentence of ten (at most 0.95), while
"stop" in quiet has 0.99 or more.
"""
LITTLE = 0.25
"""Share of a sound's energy without the robot's voice that may be only what is left of it: where
that sounded like a command it had 0.24 at most, a stop word as loud as its voice has 0.28 and more.
"""
FAR_ABOVE = 20.0
"""Decibels above the noise at which a voice is not what is left of the robot's own: that had 17 at
most, people in the simulated room 27 and more."""
ABOVE_LEAST = 15.0
"""Decibels above the least that was left of its voice from which unclear words may be someone's:
words found in its own voice had 13 at most, those of people in the simulated room 23 and more."""
RECENT = 0.2
"""Seconds of sound that show whether its voice is subtracted, and nobody else speaks."""


class OwnVoiceFilter:
    """What is heard without the robot's own voice, and whether words that are heard are its own."""

    def __init__(self, rate: int) -> None:
        """`rate` is the microphone's samples a second."""
        self._rate = rate
        self._own_voice = OwnVoice(rate)
        self._canceller = EchoCanceller()
        self._leftover = Leftover()
        self._spoke = -ECHO_TAIL
        self._subtracted = 0.0  # seconds of its voice so far
        self._learned = 0.0  # when that was LEARNING
        self._subtracts = False  # whether little of its voice has been left since
        self._sounded = -ECHO_TAIL  # when it was last to be heard
        self._unheard = 0.0  # seconds of its voice since a voice was heard with it

    def note_speaking(self, now: float) -> None:
        """The robot speaks at a time in seconds."""
        self._spoke = now

    def filtered(
        self, heard: Samples, speech: Speech | None, position: float, now: float
    ) -> Samples:
        """The sound up to a time, without the `speech` of which `position` seconds were played."""
        if now - self._spoke > ECHO_TAIL:
            played, samples = heard[:0], np.concatenate([self._canceller.flush(), heard])
        else:
            played = self._own_voice.played(speech, position, len(heard), now)
            samples = self._canceller.cancel(heard, played)
        if played.any():
            self._note_sound(len(heard) / self._rate, now)
        self._leftover.add(heard, samples, played, now)
        return samples

    def _note_sound(self, seconds: float, now: float) -> None:
        self._sounded = now
        if self._subtracted < LEARNING:
            self._subtracted += seconds
            self._learned = now

    def begins_to_subtract(self, now: float) -> bool:
        """Whether little of its voice is left for the first time.

        What was left before ends there, so that it does not come before someone's words. While
        someone speaks that waits: it would cut the words in two.
        """
        if self._subtracts or self._subtracted < LEARNING:
            return False
        self._subtracts = self._leftover.share(now - RECENT, now) < LITTLE
        return self._subtracts

    def note_voice(self, begun: float | None, dt: float, now: float) -> None:
        """A voice is heard that began at a time in seconds, or none, in the last `dt` seconds.

        As long as none is while the robot speaks, its own does not get to the microphone.
        """
        if begun is None and self._sounded == now:
            self._unheard += dt
        elif begun is not None and begun <= self._sounded:
            self._unheard = 0.0

    @property
    def is_known(self) -> bool:
        """Whether it is known what of its voice gets to the microphone: little, or nothing."""
        return self._subtracts or self._unheard >= LEARNING

    def is_other(self, begun: float, now: float, noise_db: float) -> bool:
        """Whether a voice that began at a time is someone else's, if that is known."""
        is_loud = self._leftover.level_db(begun, now) >= noise_db + FAR_ABOVE
        return is_loud and self._leftover.share(begun, now) >= LITTLE

    def is_own(self, heard: Heard) -> bool:
        """Whether words heard while the robot spoke are its own, and its voice most of the sound.

        As long as its voice cannot be subtracted yet, where little is left without it, and where
        the rest is hardly louder than its voice leaves, unclear words are taken for its own.
        """
        left = self._leftover.share(heard.start, heard.end)
        if heard.confidence < CLEAR and (
            heard.start < self._learned
            or left < LITTLE
            or self._leftover.above_least_db(heard.start, heard.end) < ABOVE_LEAST
        ):
            return True
        if left >= OWN_SHARE:
            return False
        said = self._own_voice.said(heard.start - ECHO_TAIL, heard.end + ECHO_TAIL)
        return f" {heard.text} " in f" {' '.join(said)} "
