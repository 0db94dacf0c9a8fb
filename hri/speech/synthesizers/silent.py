"""A voice for tests and for robots that must not be heard: real timing, no sound, no library."""

from __future__ import annotations

import re

import numpy as np

from hri.core.signals import Phoneme, Prosody, Span, Speech
from hri.hal.synthesizer import PLAIN, Synthesizer

SECONDS_A_LETTER = 0.06


class SilentVoice(Synthesizer):
    """Each letter is a phoneme of 60 ms at the plain rate; all else takes no time."""

    rate = 22050

    def synthesize(self, text: str, prosody: Prosody = PLAIN) -> Speech:
        step = SECONDS_A_LETTER / prosody.rate
        letters = [letter for letter in text.lower() if letter.isalpha()]
        phonemes = tuple(Phoneme(letter, i * step, step) for i, letter in enumerate(letters))
        silence = np.zeros(round(len(letters) * step * self.rate), np.int16)
        words, sentences = (
            _spans(part, text, step) for part in (r"\S+", r"\S.*?(?:[.!?]+(?=\s)|$)")
        )
        return Speech(text, silence, self.rate, phonemes, words, sentences)


def _spans(pattern: str, text: str, step: float) -> tuple[Span, ...]:
    """What matches in the text, at the times of its letters; what has none is not spoken."""
    found = [
        (match, _letters(text[: match.start()]), _letters(match[0]))
        for match in re.finditer(pattern, text, re.DOTALL)
    ]
    return tuple(
        Span(match[0].strip(), match.start(), before * step, (before + count) * step)
        for match, before, count in found
        if count
    )


def _letters(text: str) -> int:
    return sum(letter.isalpha() for letter in text)
