"""The speech synthesizer interface."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

from hri.core.signals import Prosody, Speech
from hri.hal.resource import Resource

PLAIN = Prosody()


class Skill(StrEnum):
    """What a voice may be able to do with how something is said."""

    PACE = "pace"
    LOUDNESS = "loudness"
    PITCH = "pitch"
    MELODY = "pitch range"
    QUESTIONS = "questions that rise"
    PAUSES = "pauses by rank"
    EMPHASIS = "emphasis within a sentence"
    QUALITY = "breath, tension, tremble, smile, onset"


@dataclass(frozen=True, slots=True)
class VocalTract:
    """Who speaks, for sounds that are not words."""

    pitch_hz: float
    """Of the voice, in the middle."""
    resonances: float
    """Factor on the resonances of a woman's mouth."""


WOMAN = VocalTract(200.0, 1.0)
MAN = VocalTract(118.0, 0.86)
CHILD = VocalTract(290.0, 1.2)


class Synthesizer(Resource):
    """Turns text into sound with the times of its phonemes.

    `synthesize` is all that a voice must have. One that makes its sound bit by bit overrides
    `stream` as well, so that the first of it is heard before the last is made.
    """

    skills: frozenset[Skill] = frozenset()
    """What it does; the rest of a Prosody it leaves out."""

    def tract(self, voice: str) -> VocalTract:
        """Who speaks in a voice of that name; empty: in its own."""
        return WOMAN

    @abstractmethod
    def synthesize(self, text: str, prosody: Prosody = PLAIN) -> Speech:
        """The speech; may take a while, so call it from a worker. Safe from several threads."""

    def stream(
        self,
        text: str,
        prosody: Prosody,
        take: Callable[[Speech], object],
        is_wanted: Callable[[], bool],
    ) -> Speech:
        """The same speech, and what there is of it handed over while it is made.

        Each speech that `take` gets goes on where the one before ended; the whole one is returned
        and handed over last. It ends early, with what there is, as soon as `is_wanted` says no.
        """
        speech = self.synthesize(text, prosody)
        take(speech)
        return speech
