"""A natural voice: a small network that speaks English, with the time of every phoneme and word."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from hri.core.errors import NotAvailable
from hri.core.signals import Phoneme, Prosody, Samples, Span, Speech
from hri.hal.drivers.resampling import resample
from hri.hal.resource import Description
from hri.hal.synthesizer import PLAIN, Synthesizer
from hri.speech.pronunciation.lexicon import load_lexicon
from hri.speech.synthesizers.espeak import FASTEST, LONGEST_TEXT, SLOWEST, EspeakVoice
from hri.speech.synthesizers.natural_network import RATE, Network, Sound, Utterance
from hri.speech.synthesizers.natural_symbols import MNEMONICS, STRESSES, Sounded, phonemes
from hri.speech.synthesizers.natural_text import Reader, Sentence

HEART = "heart"
"""The voice inside the package: an American woman."""
PLAIN_WPM = 165
"""Words a minute at a rate of 1."""
LOUDNESS = 0.1
"""Root of the mean square of a sentence, of full scale: as loud as espeak-ng."""
TRIAL = "ðˈɪs ɪz hˌW lˈWd ˌI spˈik."
"""What is said once, to learn how loud a model is."""
_FULL = 32767


class NaturalVoice(Synthesizer):
    """Speaks some fifty times faster than real time; the same text gives the same samples.

    Says the words of the user's lexicon, and of the file that `lexicon` names, as they are written
    there. `model` is the file of another voice of the same kind. Sentences of other scripts, and
    what is said in a voice of another name, are said by espeak-ng.
    """

    parameters = ("model", "rate_wpm", "lexicon")

    def _open(self) -> None:
        own = self.description.text("lexicon")
        rate = self.description.count("rate_wpm", PLAIN_WPM, SLOWEST, FASTEST)
        self._rate = rate / PLAIN_WPM
        self._network, self._gain, g2p, split = _engine(self.description.text("model"))
        self._reader = Reader(g2p, split, load_lexicon(*[Path(own)] * bool(own)))
        self._other = EspeakVoice(
            Description(self.id, "Hri.EspeakVoice", {"rate_wpm": str(rate)}), self.manager
        )
        self._other.activate()

    def _close(self) -> None:
        self._other.deactivate()

    def synthesize(self, text: str, prosody: Prosody = PLAIN) -> Speech:
        return self.stream(text, prosody, lambda speech: None, lambda: True)

    def stream(
        self,
        text: str,
        prosody: Prosody,
        take: Callable[[Speech], object],
        is_wanted: Callable[[], bool],
    ) -> Speech:
        if prosody.voice not in ("", HEART):
            return self._other.stream(text, prosody, take, is_wanted)
        whole = Speech(text, np.zeros(0, np.int16), RATE)
        for sentence in self._reader.sentences(text[:LONGEST_TEXT]):
            if not is_wanted():
                break
            whole = _continued(whole, self._said(sentence, prosody), sentence.position)
            take(whole)
        take(whole)
        return whole

    def _said(self, sentence: Sentence, prosody: Prosody) -> Speech:
        if not sentence.symbols.strip():
            said = self._other.synthesize(sentence.text, replace(prosody, voice=""))
            return replace(said, samples=resample(said.samples, said.rate, RATE), rate=RATE)
        prosody = replace(prosody, rate=prosody.rate * self._rate)
        sound, symbols = _joined(self._network.speak(sentence.symbols, prosody))
        return _timed(sentence, _samples(sound, self._gain * prosody.volume), symbols)

    def describe(self) -> str:
        name = self.description.text("model") or HEART
        return f"natural voice, {name}, {round(self._rate * PLAIN_WPM)} words a minute"


@lru_cache(maxsize=4)
def _engine(model: str) -> tuple[Network, float, Any, Callable[[str], list[str]]]:
    """A network, the gain that makes it as loud as the others, and what reads text for it.

    Raises NotAvailable without the package or the model.
    """
    try:
        from hibari.dsp import synth
        from hibari.tts import ASSETS, Hibari

        from hri.speech.synthesizers.natural_dictionaries import Pronouncer
    except ImportError as error:
        what = "the natural voice is not installed"
        raise NotAvailable(f"{what} ({error}) - pip install hibari-tts") from error
    assets = Path(ASSETS)
    vocabulary = json.loads((assets / "vocab.json").read_text(encoding="utf-8"))
    network = Network(Path(model) if model else assets / "hibari.onnx", vocabulary, synth)
    sound, _ = _joined(network.speak(TRIAL, PLAIN))
    level = float(np.sqrt((sound**2).mean())) if len(sound) else 0.0
    if level <= 0.0:
        raise NotAvailable(f"{model}: the model makes no sound - take another one")
    return network, LOUDNESS / level, Pronouncer(), Hibari.split_sentences


def _joined(parts: Iterable[Utterance]) -> tuple[Sound, list[Sounded]]:
    sounds, symbols, begun = [], [], 0.0
    for part in parts:
        sounds.append(part.sound)
        symbols += [replace(one, start=one.start + begun) for one in part.symbols]
        begun += len(part.sound) / RATE
    return np.concatenate(sounds), symbols


def _samples(sound: Sound, gain: float) -> Samples:
    """As 16-bit samples; what is too loud bends instead of being cut."""
    samples: Samples = (np.tanh(sound * gain) * _FULL).astype(np.int16)
    return samples


def _timed(sentence: Sentence, samples: Samples, symbols: list[Sounded]) -> Speech:
    """A sentence with the times of its phonemes and words, counted from its own begin."""
    words = tuple(_words(sentence, symbols))
    whole = Span(sentence.text, 0, words[0].start, words[-1].end) if words else None
    return Speech(
        sentence.text,
        samples,
        RATE,
        tuple(phonemes(symbols)),
        words,
        (whole,) if whole is not None else (),
    )


def _words(sentence: Sentence, symbols: list[Sounded]) -> Iterator[Span]:
    spoken: dict[int, list[Sounded]] = {}
    for number, symbol in zip(sentence.words, symbols, strict=True):
        if symbol.symbol in MNEMONICS or symbol.symbol in STRESSES:
            spoken.setdefault(number, []).append(symbol)
    for number, (text, position) in enumerate(sentence.written()):
        if number in spoken:
            yield Span(text, position, spoken[number][0].start, spoken[number][-1].end)


def _continued(whole: Speech, part: Speech, position: int) -> Speech:
    """A speech with another sentence after it, which stands at a place of the whole text."""
    begun = whole.duration

    def moved(span: Span) -> Span:
        place, start, end = span.position + position, span.start + begun, span.end + begun
        return Span(span.text, place, start, end)

    later = (Phoneme(p.name, p.start + begun, p.duration, p.stressed) for p in part.phonemes)
    return Speech(
        whole.text,
        np.concatenate((whole.samples, part.samples)),
        RATE,
        (*whole.phonemes, *later),
        (*whole.words, *map(moved, part.words)),
        (*whole.sentences, *map(moved, part.sentences)),
    )
