"""Voices of Piper (https://github.com/OHF-Voice/piper1-gpl), by the path of their model.

A model is a VITS network (J. Kim et al., ICML 2021) as ONNX: ids of IPA symbols in, sound out. The
file with its settings lies beside it, under its name and `.json`. espeak-ng writes the symbols.
Nothing of Piper's own code is used.
"""

# ruff: noqa: RUF001 - letters of the International Phonetic Alphabet are meant.
from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np

from hri.core.errors import HriError, NotAvailable
from hri.core.reading import parse_json, read_text
from hri.core.signals import Prosody
from hri.hal.synthesizer import Skill
from hri.speech.notation.sentences import sentences
from hri.speech.pronunciation.lexicon import Lexicon
from hri.speech.pronunciation.phones import Phones
from hri.speech.synthesizers.espeak_library import EspeakLibrary, load_espeak
from hri.speech.synthesizers.espeak_text import plain
from hri.speech.synthesizers.natural_network import (
    FASTEST,
    SLOWEST,
    Sound,
    Utterance,
    session_of,
    trimmed,
)
from hri.speech.synthesizers.natural_symbols import SPACE, Sounded, longest_parts
from hri.speech.synthesizers.natural_text import Accent, Ending, Sentence, words_read
from hri.speech.synthesizers.network_voice import Engine, NetworkVoice, gain_of

TRIAL = "ðɪs ɪz hˌaʊ lˈaʊd aɪ spˈiːk."
"""What is said once, to learn how loud a model is."""
DURATIONS = "/Ceil_output_0"
"""The tensor with the frames that each id lasts."""
FRAME = 256
"""Samples."""
LEAD = 0.022
"""Seconds by which a sound comes before its durations say so: the median over 88 phonemes of the
voice joe, by forced alignment.
"""
MOST_SYMBOLS = 400
PAD, BEGIN, END = "_", "^", "$"
_MARK = re.compile(r"([,;:.!?…])[,;:.!?…]*$")


class PiperVoice(NetworkVoice):
    """Speaks a language with the model that `model` names; the same text gives the same samples.

    Its pitch stays as it is, whatever is felt: the network has no input for it. Of a model with
    several speakers, `speaker` is the number of one.
    """

    parameters = ("model", "speaker", "rate_wpm")
    skills = frozenset({Skill.PACE, Skill.LOUDNESS})

    @property
    def _name(self) -> str:
        return Path(self.description.text("model", "no model")).name

    def _made(self, lexicon: Lexicon) -> Engine:
        if not (model := self.description.text("model")):
            raise self.description.error("model", "no model is named", "give the path of an .onnx")
        speaker = self.description.count("speaker", 0, 0, 10_000)
        network, gain = _loaded(Path(model), speaker)
        settings = network.settings
        return Engine(network, PiperReader(load_espeak(), settings), settings.rate, gain)


@dataclass(frozen=True, slots=True)
class Settings:
    """What is in the file beside a model."""

    rate: int
    language: str
    """The voice of espeak-ng that writes the symbols."""
    ids: Mapping[str, int]
    length: float
    speakers: int


def read_settings(path: Path) -> Settings:
    """Raises HriError with what is wrong with the file."""
    text = read_text(path, "settings file of a Piper model")
    try:
        found = parse_json(text)
        ids = {str(name): int(numbers[0]) for name, numbers in found["phoneme_id_map"].items()}
        settings = Settings(
            int(found["audio"]["sample_rate"]),
            str(found["espeak"]["voice"]),
            ids,
            float(found["inference"]["length_scale"]),
            int(found.get("num_speakers", 1)),
        )
    except (KeyError, TypeError, ValueError, AttributeError, IndexError) as error:
        raise HriError(f"{path}: not the settings of a Piper model - take another one") from error
    if not {PAD, BEGIN, END} <= set(ids) or not 8000 <= settings.rate <= 96_000:
        raise HriError(f"{path}: not the settings of a Piper model - take another one")
    return settings


@lru_cache(maxsize=4)
def _loaded(model: Path, speaker: int) -> tuple[PiperNetwork, float]:
    try:
        settings = read_settings(Path(f"{model}.json"))
    except HriError as error:
        raise NotAvailable(str(error)) from error
    network = PiperNetwork(model, settings, speaker)
    return network, gain_of(network, TRIAL, settings.rate, model.name)


class PiperNetwork:
    """Speaks symbols. Without the noise that it could draw, it says a text in one way."""

    def __init__(self, model: Path, settings: Settings, speaker: int) -> None:
        self.settings = settings
        self._session: Any = session_of(model, DURATIONS)
        self._speaker = min(speaker, max(settings.speakers - 1, 0))

    def speak(
        self,
        symbols: str,
        prosody: Prosody,
        endings: Sequence[Ending] = (),
        accents: Sequence[Accent] = (),
    ) -> list[Utterance]:
        """The symbols in sound, in parts that the network can take at once.

        Its melody is its own.
        """
        parts = longest_parts(symbols, MOST_SYMBOLS)
        return [self._part(symbols[begin:end], prosody) for begin, end in parts]

    def _part(self, symbols: str, prosody: Prosody) -> Utterance:
        ids = self.settings.ids
        known = [ids.get(symbol) for symbol in symbols]
        padded = [number for one in known if one is not None for number in (one, ids[PAD])]
        given = [ids[BEGIN], ids[PAD], *padded, ids[END]]
        length = self.settings.length / min(max(prosody.rate, SLOWEST), FASTEST)
        inputs: dict[str, Any] = {
            "input": np.array([given], np.int64),
            "input_lengths": np.array([len(given)], np.int64),
            "scales": np.array([0.0, length, 0.0], np.float32),
        }
        if self.settings.speakers > 1:
            inputs["sid"] = np.array([self._speaker], np.int64)
        sound, durations = self._session.run(None, inputs)
        ends = np.cumsum(durations.reshape(-1)) * FRAME / self.settings.rate - LEAD
        wave: Sound = sound.reshape(-1).astype(np.float32)
        return trimmed(wave, _sounded(symbols, known, ends.tolist()), self.settings.rate)


def _sounded(symbols: str, known: list[int | None], ends: list[float]) -> list[Sounded]:
    """The time of each symbol, with the pad after it; unknown ones take none."""
    spoken, place = [], 1  # the begin and its pad come first
    for symbol, id in zip(symbols, known, strict=True):
        start = ends[place]
        place += 0 if id is None else 2
        spoken.append(Sounded(symbol, start, ends[place] - start))
    return spoken


class PiperReader:
    """Writes texts in IPA by espeak-ng."""

    def __init__(self, library: EspeakLibrary, settings: Settings) -> None:
        self._library = library
        self._settings = settings

    def sentences(self, text: str, sounds: Sequence[tuple[str, Phones]] = ()) -> Iterator[Sentence]:
        """The sentences of a text; phones of words are left to espeak-ng."""
        text = plain(text)
        for begin, end in sentences(text):
            sentence = text[begin:end]
            yield Sentence(sentence, begin, *self._read(sentence))

    def _read(self, sentence: str) -> tuple[str, tuple[int, ...]]:
        """Symbols, and of each the number of the written word that it belongs to."""
        written = sentence.split()
        read = words_read(sentence) if self._is_english else list(zip(written, count()))
        symbols: list[str] = []
        words: list[int] = []
        clause: list[tuple[str, int]] = []
        for number, (word, origin) in enumerate(read):
            clause.append((word, origin))
            mark = _MARK.search(word)
            if mark is None and number + 1 < len(read):
                continue
            spoken = list(self._spoken(clause))
            for place, (ipa, origin) in enumerate(spoken):
                is_last = mark is not None and place + 1 == len(spoken)
                sounding = ipa + (mark[1].replace("…", ".") if mark and is_last else "") + SPACE
                symbols.append(sounding)
                words += [origin] * len(sounding)
            clause = []
        return "".join(symbols), tuple(words)

    def _spoken(self, read: Sequence[tuple[str, int]]) -> Iterator[tuple[str, int]]:
        """The words of a clause in IPA, each with the number of its written word."""
        ipa = self._ipa(" ".join(word for word, _ in read))
        # Words that melt together, and numbers, change their count.
        counts = [1] * len(read) if len(ipa) == len(read) else [len(self._ipa(w)) for w, _ in read]
        origins = [
            origin for (_, origin), many in zip(read, counts, strict=True) for _ in range(many)
        ]
        for number, word in enumerate(ipa):
            place = round(number * (len(origins) - 1) / max(len(ipa) - 1, 1))
            yield word, origins[place] if origins else 0

    @property
    def _is_english(self) -> bool:
        return self._settings.language.startswith("en")

    def _ipa(self, text: str) -> list[str]:
        words = self._library.ipa_of(text, self._settings.language)
        return [unicodedata.normalize("NFD", word) for word in words]
