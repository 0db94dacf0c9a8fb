"""Times for a sound that came without any: what phoneme is said when, for the lips."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from hri.core.errors import HriError
from hri.core.signals import Samples, Span, Speech
from hri.hal.drivers.resampling import resample
from hri.speech.pronunciation.lexicon import load_lexicon
from hri.speech.recognizers.ctc.alignment import Placed, forced, free, phonemes, placed
from hri.speech.recognizers.ctc.conformer import FRAME, load_network
from hri.speech.recognizers.ctc.features import RATE
from hri.speech.recognizers.ctc.phone_graph import Floats
from hri.speech.synthesizers.natural_text import words_read

PIECE, MARGIN = 14.0, 1.0
"""Seconds that the network hears at once, and on each side of what it is asked for."""
LONGEST = 600.0
"""Seconds of sound."""
MOST_WORDS = 1800
"""Words of a text that is known."""
LEAST_FIT = -4.0
"""Mean log probability of the phones, of 0 to -7: speech of another text has less."""
LEAST_PACE = 2.0
"""Phones a second from which a sound without a text is taken as speech."""
_WORD = re.compile(r"[a-z]+(?:'[a-z]+)*")


def with_times(speech: Speech) -> Speech:
    """The same speech with the times of its phonemes and words.

    With a text they are those of its words; without one, those of the phones that are heard. A
    sound in which nobody speaks gets no phonemes: the lips follow its loudness then. A second of
    sound takes 10 ms of one core. Raises HriError for a text that is not what is said, and for more
    than LONGEST seconds.
    """
    if speech.duration > LONGEST:
        limit = f"at most {LONGEST:.0f} s get times - cut it into parts"
        raise HriError(f"a sound of {speech.duration:.0f} s: {limit}")
    sound = resample(speech.samples, speech.rate, RATE)
    heard = posteriors(sound)
    if not speech.text.strip():
        found = free(heard)
        if len(found) < LEAST_PACE * speech.duration:
            found = []
        phones = placed(found, sound, RATE)
        return replace(speech, phonemes=tuple(phonemes(phones, speech.duration)) if found else ())
    spoken = list(spoken_words(speech.text))
    if not spoken:
        raise HriError("the text has no words in Latin letters - leave it out")
    if len(spoken) > MOST_WORDS:
        raise HriError(f"{len(spoken)} words - give at most {MOST_WORDS}")
    found, fit = forced(heard, [word for word, _ in spoken], load_lexicon())
    if fit < LEAST_FIT:
        raise HriError("the text is hardly what the sound says - correct it, or leave it out")
    phones = placed(found, sound, RATE)
    words = tuple(_spans(speech.text, phones, [origin for _, origin in spoken]))
    sentence = Span(speech.text, 0, words[0].start, words[-1].end)
    times = tuple(phonemes(phones, speech.duration))
    return replace(speech, phonemes=times, words=words, sentences=(sentence,))


def posteriors(sound: Samples) -> Floats:
    """Log probabilities [frames, classes] of 16 kHz sound of any length, piece by piece."""
    network = load_network()
    piece, margin = round(PIECE / FRAME), round(MARGIN / FRAME)
    step = round(FRAME * RATE)
    parts: list[Floats] = []
    for begin in range(0, len(sound) // step + 1, piece):
        before = min(begin, margin)
        part = sound[(begin - before) * step : (begin + piece + margin) * step]
        parts.append(network.posteriors(part)[before : before + piece])
    return np.concatenate(parts)


def spoken_words(text: str) -> Iterator[tuple[str, int]]:
    """The words that a text is read as, each with the number of the written word it stands for."""
    for read, origin in words_read(text):
        straight = read.lower().replace("\N{RIGHT SINGLE QUOTATION MARK}", "'")
        plain = unicodedata.normalize("NFKD", straight)
        for part in _WORD.findall("".join(c for c in plain if not unicodedata.combining(c))):
            yield part, origin


def _spans(text: str, phones: Sequence[Placed], origins: Sequence[int]) -> Iterator[Span]:
    """The written words that are heard, with their times."""
    spoken: dict[int, list[Placed]] = {}
    for phone in phones:
        spoken.setdefault(origins[phone.word], []).append(phone)
    for number, match in enumerate(re.finditer(r"\S+", text)):
        if number in spoken:
            said = spoken[number]
            yield Span(match[0], match.start(), said[0].start, said[-1].end)
