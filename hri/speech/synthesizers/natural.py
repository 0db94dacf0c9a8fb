"""A natural voice: a small network that speaks English, with the time of every phoneme and word."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from hri.core.errors import HriError, NotAvailable
from hri.core.signals import Phoneme, Prosody, Samples, Span, Speech
from hri.hal.drivers.resampling import resample
from hri.hal.resource import Description
from hri.hal.synthesizer import PLAIN, Synthesizer
from hri.speech.pronunciation.lexicon import load_lexicon
from hri.speech.synthesizers.espeak import FASTEST, LONGEST_TEXT, SLOWEST, EspeakVoice
from hri.speech.synthesizers.natural_network import RATE, Network, Sound, Utterance
from hri.speech.synthesizers.natural_symbols import MNEMONICS, PAUSE, STRESSES, Sounded, phonemes
from hri.speech.synthesizers.natural_text import Reader, Sentence
from hri.speech.synthesizers.pace import Pace, remember_slow, slow_file, slow_voices
from hri.speech.synthesizers.voice_names import HEART, unknown, voice_named

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
    what is said in a voice of another name, are said by espeak-ng. So is everything, after one
    notice, where the model is missing or fails, or was found too slow for this machine.
    """

    parameters = ("model", "rate_wpm", "lexicon")

    def _open(self) -> None:
        own = self.description.text("lexicon")
        lexicon = load_lexicon(*[Path(own)] * bool(own))
        self._wpm = self.description.count("rate_wpm", PLAIN_WPM, SLOWEST, FASTEST)
        model = self.description.text("model")
        self._name = model or HEART
        self._pace = Pace()
        self._missing: set[str] = set()
        self._other = self._opened_other()
        self._network: Network | None = None
        try:
            self._refuse_slow()
            self._network, self._gain, g2p, split = _engine(model)
            self._reader = Reader(g2p, split, lexicon)
        except NotAvailable as error:
            self._fall_back(str(error))

    def _opened_other(self) -> Synthesizer | None:
        """What says that which this voice cannot; None without its library."""
        names = [name for name in ("rate_wpm", "lexicon") if self.description.text(name)]
        parameters = {name: self.description.text(name) for name in names}
        voice = EspeakVoice(Description(self.id, "Hri.EspeakVoice", parameters), self.manager)
        try:
            voice.activate()
        except NotAvailable:
            return None
        return voice

    def _refuse_slow(self) -> None:
        factor = 0.0 if self.manager.is_to_repeat else slow_voices().get(self._name, 0.0)
        if factor:
            what = f"{self._name} took {factor:g} s for a second of speech on this machine"
            raise NotAvailable(f"{what} - delete {slow_file()} to try it again")

    def _fall_back(self, why: str) -> None:
        """Leave everything to the other voice. Raises NotAvailable where there is none."""
        self._network, self._why_not = None, why
        if self._other is None:
            raise NotAvailable(why)
        self.manager.notice(f"{self.id}: {why}; espeak-ng speaks")

    def _close(self) -> None:
        if self._other is not None:
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
        prosody = replace(prosody, voice=self._meant(prosody.voice))
        if self._other is not None and (self._network is None or prosody.voice):
            return self._other.stream(text, prosody, take, is_wanted)
        whole = Speech(text, np.zeros(0, np.int16), RATE)
        for sentence in self._reader.sentences(text[:LONGEST_TEXT], prosody.sounds):
            if not is_wanted():
                break
            whole = whole.then(self._said(sentence, prosody), sentence.position)
            take(whole)
        take(whole)
        return whole

    def _meant(self, name: str) -> str:
        """The voice of a name, a language or a character; empty: this one, after a notice."""
        if not name or self._other is None:
            return ""
        meant = voice_named(name)
        if not meant and name not in self._missing:
            self._missing.add(name)
            self.manager.notice(f"{self.id}: {unknown(name)}; {self._name} speaks")
        return "" if meant == HEART else meant

    def _said(self, sentence: Sentence, prosody: Prosody) -> Speech:
        network = self._network
        if network is None or not sentence.symbols.strip():
            return self._said_by_other(sentence.text, prosody)
        begun = self.manager.clock.now()
        faster = replace(prosody, rate=prosody.rate * self._wpm / PLAIN_WPM)
        try:
            sound, symbols = _joined(network.speak(sentence.symbols, faster))
        except Exception as error:  # onnxruntime's own, one class for each status
            self._fall_back(f"{self._name} failed ({str(error).partition(chr(10))[0]})")
            return self._said_by_other(sentence.text, prosody)
        self._judge(self.manager.clock.now() - begun, len(sound) / RATE)
        return _timed(sentence, _samples(sound, self._gain * prosody.volume), symbols)

    def _said_by_other(self, text: str, prosody: Prosody) -> Speech:
        """Nothing is heard of a text that only the other voice could say, where it is missing."""
        if self._other is None:
            return Speech(text, np.zeros(0, np.int16), RATE)
        said = self._other.synthesize(text, prosody)
        return replace(said, samples=resample(said.samples, said.rate, RATE), rate=RATE)

    def _judge(self, took: float, sound: float) -> None:
        """Give up a voice for good that this machine is too slow for."""
        if self.manager.is_to_repeat or self._other is None:
            return
        self._pace.add(took, sound)
        if self._pace.is_slow:
            with suppress(HriError):  # where nothing can be kept, the next run measures again
                remember_slow(self._name, self._pace)
            self._fall_back(f"this machine is too slow for {self._name}")

    def describe(self) -> str:
        if self._network is None and self._other is not None:
            return f"{self._other.describe()} ({self._why_not})"
        return f"natural voice, {self._name}, {self._wpm} words a minute"


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
    spoken = list(phonemes(symbols))
    end = spoken[-1].start + spoken[-1].duration if spoken else 0.0
    pause = Phoneme(PAUSE, end, len(samples) / RATE - end)
    words = tuple(_words(sentence, symbols))
    whole = Span(sentence.text, 0, words[0].start, words[-1].end) if words else None
    return Speech(
        sentence.text,
        samples,
        RATE,
        (*spoken, pause),
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
