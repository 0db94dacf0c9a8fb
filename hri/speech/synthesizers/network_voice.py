"""Voices that are networks: sentence by sentence, with the time of every phoneme and word."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

import numpy as np

from hri.core.errors import HriError, NotAvailable
from hri.core.signals import Phoneme, Prosody, Samples, Span, Speech
from hri.hal.drivers.resampling import resample
from hri.hal.resource import Description
from hri.hal.synthesizer import PLAIN, WOMAN, Synthesizer, VocalTract
from hri.speech.pronunciation.lexicon import Lexicon, load_lexicon
from hri.speech.pronunciation.phones import Phones
from hri.speech.synthesizers.espeak import FASTEST, LONGEST_TEXT, SLOWEST, EspeakVoice
from hri.speech.synthesizers.natural_network import Sound, Utterance
from hri.speech.synthesizers.natural_symbols import MNEMONICS, PAUSE, STRESSES, Sounded, phonemes
from hri.speech.synthesizers.natural_text import Accent, Ending, Sentence
from hri.speech.synthesizers.pace import Pace, remember_slow, slow_file, slow_voices
from hri.speech.synthesizers.voice_names import HEART, unknown, voice_named

PLAIN_WPM = 170
"""Words a minute at a rate of 1: as people read aloud."""
LOUDNESS = 0.1
"""Root of the mean square of a sentence, of full scale: as loud as espeak-ng."""
_FULL = 32767


class Speaks(Protocol):
    """A network that makes sound of symbols."""

    def speak(
        self,
        symbols: str,
        prosody: Prosody,
        endings: Sequence[Ending] = (),
        accents: Sequence[Accent] = (),
    ) -> Iterable[Utterance]: ...


class Reads(Protocol):
    """What makes symbols of a text."""

    def sentences(
        self, text: str, sounds: Sequence[tuple[str, Phones]] = ()
    ) -> Iterator[Sentence]: ...


@dataclass(frozen=True, slots=True, eq=False)
class Engine:
    """All that speaks."""

    network: Speaks
    reader: Reads
    rate: int
    """Samples a second."""
    gain: float
    wpm: float = PLAIN_WPM
    """Words a minute, pauses included, that the network speaks at a rate of 1."""


class NetworkVoice(Synthesizer):
    """Speaks by a network, sentence by sentence.

    Text that it has no symbols for, or in a voice of another name, is left to espeak-ng. So is
    everything, after one notice, where the model is missing or fails, or was found too slow for
    this machine.
    """

    @abstractmethod
    def _made(self, lexicon: Lexicon) -> Engine:
        """The network and what reads for it. Raises NotAvailable."""

    @property
    @abstractmethod
    def _name(self) -> str:
        """What people know it by."""

    def _open(self) -> None:
        own = self.description.text("lexicon")
        lexicon = load_lexicon(*[Path(own)] * bool(own))
        self._wpm = self.description.count("rate_wpm", PLAIN_WPM, SLOWEST, FASTEST)
        self._pace = Pace()
        self._missing: set[str] = set()
        self._other = self._opened_other()
        self._engine: Engine | None = None
        try:
            self._refuse_slow()
            self._engine = self._made(lexicon)
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
        self._engine, self._why_not = None, why
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
        engine = self._engine
        if engine is None or (prosody.voice and self._other is not None):
            return self._by_other().stream(text, prosody, take, is_wanted)
        whole = Speech(text, np.zeros(0, np.int16), engine.rate, saying=object())
        for sentence in engine.reader.sentences(text[:LONGEST_TEXT], prosody.sounds):
            before = whole
            for said in self._said(sentence, prosody, engine.rate):
                if not is_wanted():
                    break
                whole = before.then(said, sentence.position)
                take(whole)
            if not is_wanted():
                break
        take(whole)
        return whole

    def tract(self, voice: str) -> VocalTract:
        meant = self._meant(voice)
        return self._other.tract(meant) if meant and self._other is not None else WOMAN

    def _meant(self, name: str) -> str:
        """The voice of a name, a language or a character; empty: this one, after a notice."""
        if not name or self._other is None:
            return ""
        meant = voice_named(name)
        if not meant and name not in self._missing:
            self._missing.add(name)
            self.manager.notice(f"{self.id}: {unknown(name)}; {self._name} speaks")
        return "" if meant == HEART else meant

    def _said(self, sentence: Sentence, prosody: Prosody, rate: int) -> Iterator[Speech]:
        """The sentence, as far as it is made, each time longer."""
        engine = self._engine
        if engine is None or not sentence.symbols.strip():
            yield self._said_by_other(sentence.text, prosody, rate)
            return
        accents = sentence.accents(prosody.emphases)
        faster = replace(prosody, rate=prosody.rate * self._wpm / engine.wpm, emphases=())
        parts: list[Utterance] = []
        said = Speech("", np.zeros(0, np.int16), rate)
        begun = self.manager.clock.now()
        try:
            for part in engine.network.speak(sentence.symbols, faster, sentence.endings, accents):
                self._judge(self.manager.clock.now() - begun, len(part.sound) / rate)
                parts.append(part)
                sound, symbols = _joined(parts, rate)
                samples = _samples(sound, engine.gain * prosody.volume)
                said = _timed(sentence, samples, rate, symbols)
                yield said
                begun = self.manager.clock.now()
        except Exception as error:  # onnxruntime's own, one class for each status
            self._fall_back(f"{self._name} failed ({str(error).partition(chr(10))[0]})")
            rest = sentence.position_of(sum(len(part.symbols) for part in parts))
            more = self._said_by_other(sentence.text[rest:], prosody, rate)
            yield said.then(more, rest) if parts else more

    def _by_other(self) -> Synthesizer:
        if self._other is None:
            raise NotAvailable(f"{self.id}: {self._why_not}")
        return self._other

    def _said_by_other(self, text: str, prosody: Prosody, rate: int) -> Speech:
        """Nothing is heard of a text that only the other voice could say, where it is missing."""
        if self._other is None:
            return Speech(text, np.zeros(0, np.int16), rate)
        said = self._other.synthesize(text, prosody)
        return replace(said, samples=resample(said.samples, said.rate, rate), rate=rate)

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
        if self._engine is None and self._other is not None:
            return f"{self._other.describe()} ({self._why_not})"
        return f"natural voice, {self._name}, {self._wpm} words a minute"


def gain_of(network: Speaks, trial: str, rate: int, name: str) -> float:
    """What makes a network as loud as the other voices. Raises NotAvailable for a silent one."""
    sound, _ = _joined(network.speak(trial, PLAIN), rate)
    level = float(np.sqrt((sound**2).mean())) if len(sound) else 0.0
    if level <= 0.0:
        raise NotAvailable(f"{name}: the model makes no sound - take another one")
    return LOUDNESS / level


def _joined(parts: Iterable[Utterance], rate: int) -> tuple[Sound, list[Sounded]]:
    sounds, symbols, begun = [], [], 0.0
    for part in parts:
        sounds.append(part.sound)
        symbols += [replace(one, start=one.start + begun) for one in part.symbols]
        begun += len(part.sound) / rate
    return np.concatenate(sounds), symbols


def _samples(sound: Sound, gain: float) -> Samples:
    """As 16-bit samples; what is too loud bends instead of being cut."""
    samples: Samples = (np.tanh(sound * gain) * _FULL).astype(np.int16)
    return samples


def _timed(sentence: Sentence, samples: Samples, rate: int, symbols: list[Sounded]) -> Speech:
    """A sentence with the times of its phonemes and words, counted from its own begin."""
    spoken = [one for one in phonemes(symbols) if one.duration > 0.0]
    end = spoken[-1].start + spoken[-1].duration if spoken else 0.0
    pause = Phoneme(PAUSE, end, len(samples) / rate - end)
    words = tuple(_words(sentence, symbols))
    whole = Span(sentence.text, 0, words[0].start, words[-1].end) if words else None
    return Speech(
        sentence.text,
        samples,
        rate,
        (*spoken, pause),
        words,
        (whole,) if whole is not None else (),
    )


def _words(sentence: Sentence, symbols: list[Sounded]) -> Iterator[Span]:
    spoken: dict[int, list[Sounded]] = {}
    for number, symbol in zip(sentence.words, symbols, strict=False):  # it may be a part
        if symbol.symbol in MNEMONICS or symbol.symbol in STRESSES:
            spoken.setdefault(number, []).append(symbol)
    for number, (text, position) in enumerate(sentence.written()):
        if number in spoken:
            yield Span(text, position, spoken[number][0].start, spoken[number][-1].end)
