"""Recordings with transcripts: from a manifest, or from synthetic voices.

A manifest is a text file with a line for each recording and a tab between its columns:

    file      path of the recording, relative to the manifest
    sentence      its words; `-` for something the grammar does not allow
    tags          optional: its meaning, as in files of expectations: `move: distance=-1`

With tags, the sentence may be left empty, or hold words that the grammar does not know. Empty lines
and those that begin with `#` are skipped. A first line whose first word is `file` is a heading;
where its third word is not `tags`, that column and those after it are ignored.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Self

import numpy as np

from hri.cli.terminal.progress_line import progress
from hri.core.clock import RealClock
from hri.core.errors import AuthoringError, HriError, Place, did_you_mean
from hri.core.reading import read_text
from hri.core.signals import Samples
from hri.hal.drivers.wav_file import load_sound
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.grammar import Grammar
from hri.speech.grammar.lint.expectations import Meaning, meaning_of, read_meaning
from hri.speech.grammar.matching import parse
from hri.speech.synthesizers import flite
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.trials import RecordedClip

ESPEAK_VOICES = ("en-us", "en-gb", "en-us+f3", "en-gb+m3")
FLITE = "flite:"
"""Prefix of the names of flite's voices."""
MOST_ROWS = 20_000
"""Most recordings of one manifest."""
LEAD, TAIL = 0.4, 0.8
"""Seconds of silence around a spoken sentence."""


@dataclass(frozen=True, slots=True)
class ManifestRow:
    """One line of a manifest."""

    path: Path
    said: str
    meaning: Meaning | None

    def clip(self) -> RecordedClip:
        """The recording itself. Raises HriError when it cannot be read."""
        samples, rate = load_sound(self.path)
        return RecordedClip(str(self.path), samples, rate, self.said, self.meaning)


def read_manifest(path: Path, grammar: Grammar) -> list[ManifestRow]:
    """The lines of a manifest.

    Raises AuthoringError for a line that cannot be read, or whose sentence the grammar refuses, and
    where there is none.
    """
    rows: list[ManifestRow] = []
    most = 3
    for number, line in enumerate(read_text(path, "manifest").splitlines(), start=1):
        columns = [column.strip() for column in line.split("\t")]
        if not rows and columns[0] == "file":
            most = 3 if columns[2:3] == ["tags"] else 2
        elif columns != [""] and not line.startswith("#"):
            rows.append(_row(columns[:most], Place(path, number), grammar))
        if len(rows) > MOST_ROWS:
            what = f"more than {MOST_ROWS:,} recordings"
            raise AuthoringError(Place(path, number), what, "cut the manifest into parts")
    if not rows:
        raise AuthoringError(Place(path), "no recording in this manifest", "write one a line")
    return rows


def _row(columns: list[str], place: Place, grammar: Grammar) -> ManifestRow:
    if len(columns) < 2:
        remedy = "write a tab and the sentence after the file, or - for speech outside the grammar"
        raise AuthoringError(place, "no sentence", remedy)
    name, said, *more = columns
    path = place.path.parent / name
    if said == "-":
        return ManifestRow(path, "-", None)
    if more and more[0]:
        return ManifestRow(path, said, read_meaning(more[0], place))
    found = parse(grammar, said)
    if found is None:
        remedy = "fix the sentence or the grammar, or write - instead"
        raise AuthoringError(place, f'the grammar does not allow "{said}"', remedy)
    return ManifestRow(path, said, meaning_of(found))


class Voices(AbstractContextManager["Voices"]):
    """Synthetic voices: those of espeak-ng by their names, those of flite as `flite:slt`."""

    def __init__(self) -> None:
        self._resources = ResourceManager((), RealClock())
        self._espeak: dict[str, EspeakVoice] = {}

    def __exit__(self, *_: object) -> None:
        for voice in self._espeak.values():
            voice.deactivate()
        self._resources.close()

    def __enter__(self) -> Self:
        return self

    def speak(self, text: str, voice: str) -> tuple[Samples, int]:
        """A sentence with silence around it, and its rate.

        Raises HriError when there is no such voice.
        """
        if voice.startswith(FLITE):
            samples, rate = flite.speak(text, _flite_voice(voice))
        else:
            speech = self._open(voice).synthesize(text)
            samples, rate = speech.samples, speech.rate
        silences = (np.zeros(round(LEAD * rate), np.int16), np.zeros(round(TAIL * rate), np.int16))
        return np.concatenate([silences[0], samples, silences[1]]), rate

    def _open(self, name: str) -> EspeakVoice:
        if name not in self._espeak:
            description = Description("voice", "Hri.EspeakVoice", {"voice": name})
            voice = EspeakVoice(description, self._resources)
            try:
                voice.activate()
            except AuthoringError as error:
                raise HriError(f"{error.what} - {error.remedy}") from error
            self._espeak[name] = voice
        return self._espeak[name]


def _flite_voice(voice: str) -> str:
    name = voice.removeprefix(FLITE)
    if name not in flite.VOICES:
        raise HriError(f'flite has no voice "{name}" - {did_you_mean(name, flite.VOICES)}')
    return name


def usual_voices() -> tuple[str, ...]:
    """Some of espeak-ng, and all of flite where it is installed."""
    of_flite = tuple(FLITE + name for name in flite.VOICES) if flite.is_there() else ()
    return ESPEAK_VOICES + of_flite


def spoken(
    grammar: Grammar, sentences: Sequence[str], voices: Sequence[str]
) -> Iterator[RecordedClip]:
    """Each sentence in each voice, synthesized lazily, with a progress bar; also those the grammar
    refuses.
    """
    pairs = list(product(sentences, voices))
    with Voices() as speakers:
        for sentence, voice in progress(pairs, len(pairs), "speaking and hearing"):
            found = parse(grammar, sentence)
            meaning = None if found is None else meaning_of(found)
            samples, rate = speakers.speak(sentence, voice)
            yield RecordedClip(f"{voice}: {sentence}", samples, rate, sentence, meaning)
