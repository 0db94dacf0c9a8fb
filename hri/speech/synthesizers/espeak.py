"""The robot's own voice: espeak-ng, with the time of every phoneme, word and sentence."""

from __future__ import annotations

import math
import re
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from hri.core.errors import did_you_mean
from hri.core.signals import Phoneme, Prosody, Samples, Span, Speech
from hri.hal.synthesizer import CHILD, MAN, PLAIN, WOMAN, Skill, Synthesizer, VocalTract
from hri.speech.pronunciation.lexicon import load_lexicon
from hri.speech.synthesizers.espeak_library import Event, Mark, Setting, load_espeak
from hri.speech.synthesizers.espeak_text import reading
from hri.speech.synthesizers.voice_names import HEART, unknown, voice_named

LEVEL = 0.85
"""Share of the library's own volume: at 1, numbers in words reach 32,700 of 32,767 with joy."""
PLAIN_SETTING = Setting()
CHILDREN = ("anika", "anikarobot")
"""Variants that speak as children do."""
SLOWEST, FASTEST = 80, 450
"""Words a minute that the library takes."""
TELLING_LETTERS = 4
"""Codes of languages that are shorter are all alike, so that none can be guessed."""
LONGEST_TEXT = 5000
"""Characters; what is longer is cut, it would be minutes of speech."""
_STRESS = "',"
_PAUSE = "_"
"""What the names of pauses begin with."""


class EspeakVoice(Synthesizer):
    """Speaks some two hundred times faster than real time; the same text gives the same samples.

    An English voice says the words of the user's lexicon, and of the file that `lexicon` names,
    as they are written there.
    """

    parameters = ("voice", "rate_wpm", "pitch", "lexicon")
    skills = frozenset({Skill.PACE, Skill.LOUDNESS, Skill.PITCH, Skill.MELODY, Skill.QUESTIONS})

    def _open(self) -> None:
        self._library = load_espeak()
        self._missing: set[str] = set()
        self._plain = Setting(
            voice=self.description.text("voice", PLAIN_SETTING.voice),
            rate=self.description.count("rate_wpm", PLAIN_SETTING.rate, SLOWEST, FASTEST),
            pitch=self.description.count("pitch", PLAIN_SETTING.pitch, 0, 100),
        )
        if not self._library.has_voice(self._plain.voice):
            raise self.description.error("voice", *self._unknown(self._plain.voice))
        own = self.description.text("lexicon")
        self._lexicon = load_lexicon(*[Path(own)] * bool(own))

    def _meant(self, name: str) -> str:
        """The voice of a name, a language or a character; empty: its own, after a notice."""
        meant = voice_named(name) if name else ""
        if name and not meant and name not in self._missing:
            self._missing.add(name)
            self.manager.notice(f"{self.id}: {unknown(name)}; {self._plain.voice} speaks")
        return "" if meant == HEART else meant

    def tract(self, voice: str) -> VocalTract:
        """A man's, unless the variant is a woman's or a child's."""
        _, _, variant = (self._meant(voice) or self._plain.voice).casefold().partition("+")
        found = next((v for v in self._library.variants() if v.id.casefold() == variant), None)
        if variant in CHILDREN:
            return CHILD
        return WOMAN if found is not None and found.gender == "female" else MAN

    def _unknown(self, voice: str) -> tuple[str, str]:
        """What is wrong with the name of a voice that is not there, and the remedy."""
        what = f'espeak-ng has no voice "{voice}"'
        language, _, variant = voice.partition("+")
        known = self._library.voices() if len(language) >= TELLING_LETTERS else ()
        if self._library.has_voice(language):
            language, known = variant, self._library.variants()
        near = did_you_mean(language, [voice.id for voice in known], "`hri voices` lists them")
        return what, near

    def synthesize(self, text: str, prosody: Prosody = PLAIN) -> Speech:
        return self.stream(text, prosody, lambda speech: None, lambda: True)

    def stream(
        self,
        text: str,
        prosody: Prosody,
        take: Callable[[Speech], object],
        is_wanted: Callable[[], bool],
    ) -> Speech:
        setting = scaled(self._plain, replace(prosody, voice=self._meant(prosody.voice)))
        is_english = setting.voice.lower().startswith("en")
        lexicon = self._lexicon.extended(prosody.sounds) if is_english else None
        read = reading(text[:LONGEST_TEXT], lexicon)
        sound = bytearray()
        marks: list[Mark] = []
        handed_over = 0

        def speech() -> Speech:
            samples = np.frombuffer(bytes(sound), np.int16)
            return timed_speech(text, read.origins, samples, self._library.rate, marks)

        def hear(block: bytes, begun: list[Mark]) -> bool:
            nonlocal handed_over
            sound.extend(block)
            marks.extend(begun)
            # Each time twice as much, so that a long text is not copied for every block of it.
            if len(sound) > 2 * handed_over:
                handed_over = len(sound)
                take(speech())
            return is_wanted()

        self._library.speak(read.text, setting, hear, has_phonemes=read.has_phonemes)
        whole = speech()
        take(whole)
        return whole

    def describe(self) -> str:
        return f"espeak-ng, voice {self._plain.voice}, {self._plain.rate} words a minute"


def scaled(plain: Setting, prosody: Prosody) -> Setting:
    """The setting with the factors of a prosody, within what the library takes.

    Its pitch is logarithmic, an octave from 50 to 100 (`pitch_adjust_tab` in its wavegen.c); its
    range counts in hertz, so it has to grow with the pitch to stay the same in semitones.
    """
    octaves = math.log2(max(prosody.pitch, 0.01))
    return Setting(
        prosody.voice or plain.voice,
        rate=_within(plain.rate * prosody.rate, SLOWEST, FASTEST),
        pitch=_within(plain.pitch + 50 * octaves, 0, 100),
        volume=_within(LEVEL * plain.volume * prosody.volume, 0, 200),
        range=_within(plain.range * prosody.range * prosody.pitch, 0, 99),
    )


def _within(value: float, low: int, high: int) -> int:
    return round(min(max(value, low), high))


def timed_speech(
    text: str, origins: Sequence[int], samples: Samples, rate: int, marks: Sequence[Mark]
) -> Speech:
    """The speech with all its times.

    The marks count characters of what the library read; `origins` says of each of those which
    character of the text it stands for.
    """
    phonemes = tuple(_phonemes(marks, rate, len(samples) / rate))
    words, sentences = (_begun(text, kind, origins, marks) for kind in (Event.WORD, Event.SENTENCE))
    return Speech(
        text,
        samples,
        rate,
        phonemes,
        tuple(_spans(text, words, phonemes, rate)),
        tuple(_spans(text, sentences, phonemes, rate)),
    )


def _phonemes(marks: Iterable[Mark], rate: int, duration: float) -> Iterator[Phoneme]:
    """The phonemes; each lasts until the next begins, pauses included."""
    sounds = [mark for mark in marks if mark.kind == Event.PHONEME]
    starts = [mark.sample / rate for mark in sounds]
    for mark, start, end in zip(sounds, starts, [*starts[1:], duration], strict=False):
        if name := mark.name.strip(_STRESS):
            yield Phoneme(name, start, max(0.0, end - start), mark.name[0] in _STRESS)


def _begun(
    text: str, kind: Event, origins: Sequence[int], marks: Iterable[Mark]
) -> list[tuple[int, int]]:
    """The words of the text at which something of a kind begins to be spoken: (character, sample).

    The library marks parts of words ("3.5"), and passes over words that melt into others ("I am").
    """
    starts = [match.start() for match in re.finditer(r"\S+", text)]
    begun: list[tuple[int, int]] = []
    for mark in marks:
        if mark.kind == kind and starts:
            origin = origins[min(mark.position, len(origins) - 1)]
            start = starts[max(0, bisect_right(starts, origin) - 1)]
            if not begun or start > begun[-1][0]:
                begun.append((start if begun else starts[0], mark.sample))
    return begun


def _spans(
    text: str, begun: Sequence[tuple[int, int]], phonemes: Sequence[Phoneme], rate: int
) -> Iterator[Span]:
    """Each goes on until the next begins, the pause before that left out."""
    spoken = [phoneme for phoneme in phonemes if not phoneme.name.startswith(_PAUSE)]
    starts = [phoneme.start for phoneme in spoken]
    following = [*begun[1:], (len(text), None)]
    for (position, sample), (end, limit) in zip(begun, following, strict=False):
        start = sample / rate
        latest = math.inf if limit is None else limit / rate
        count = bisect_left(starts, latest)
        until = spoken[count - 1].start + spoken[count - 1].duration if count else start
        yield Span(text[position:end].strip(), position, start, min(max(start, until), latest))
