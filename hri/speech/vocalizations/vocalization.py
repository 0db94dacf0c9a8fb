"""Sounds that are not words: a giggle, a sigh, "mm-hm"; `emotions/sounds.toml`.

The calls of a laugh, their pace and how they fall: J.-A. Bachorowski, M. J. Smoski and M. J. Owren,
"The acoustic features of human laughter", JASA 110 (2001). Which short sounds people know a feeling
by: M. Schroeder, "Experimental study of affect bursts", Speech Communication 40 (2003).
"""

from __future__ import annotations

import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hri.core import paths
from hri.core.errors import HriError, did_you_mean
from hri.core.signals import Phoneme, Samples, Span, Speech
from hri.core.toml import Table, load_toml
from hri.hal.synthesizer import WOMAN, VocalTract
from hri.speech.vocalizations.formant_synthesis import RATE, STEP_S, Curve, Tracks, sounded
from hri.speech.vocalizations.mouth_shapes import CLOSED, SHAPES

LOUDNESS = 0.1
"""Root of the mean square of a sound of 0 dB where it is loud, of full scale: as loud as speech."""
LOUD_SHARE = 0.5
"""Of the loudest stretch, from which on one counts."""
BLENDS_S = 0.07
"""Seconds in which the mouth goes from one shape to the next."""
SWELLS_S = 0.02
"""Seconds in which voice and air come and go."""
SHORTEST_MS, LONGEST_MS = 10.0, 2000.0
MOST_REPEATS = 12
LONGEST_S = 8.0
"""Of a whole sound, at any length."""
STRENGTHS = {"soft": 0.6, "": 1.0, "strong": 1.4}
"""Factors on the loudness and on the way of the pitch."""
LENGTHS = {"short": 0.65, "": 1.0, "long": 1.5}
MOST_KEPT = 64
"""Sounds that are kept as they were made."""
_FULL = 32767


@dataclass(frozen=True, slots=True)
class Part:
    """A stretch of a sound; lists go from its begin to its end."""

    shape: str
    """Of the mouth, one of SHAPES."""
    ms: float
    pitch: tuple[float, ...]
    """Semitones above the middle of the voice."""
    voice: tuple[float, ...]
    """Amplitude, 0 to 1."""
    air: tuple[float, ...]
    """Amplitude of the breath, 0 to 1."""
    tension: float
    """-1 (lax) to 1 (pressed)."""


@dataclass(frozen=True, slots=True)
class Vocalization:
    """A sound that is not a word."""

    name: str
    about: str
    parts: tuple[Part, ...]
    loudness: float
    """Decibels, of the voice."""
    gesture: str = ""
    """The gesture of the face that makes this sound too."""

    def speech(self, tract: VocalTract = WOMAN, strength: str = "", length: str = "") -> Speech:
        """The sound, with the shapes of its mouth as phonemes.

        `strength` is one of STRENGTHS, `length` one of LENGTHS.
        """
        samples, phonemes = _made(self, tract, STRENGTHS[strength], LENGTHS[length])
        text = f"[{' '.join(word for word in (self.name, strength, length) if word)}]"
        span = Span(text, 0, 0.0, len(samples) / RATE)
        return Speech(text, samples, RATE, phonemes, (), (span,))


@lru_cache(maxsize=MOST_KEPT)
def _made(
    sound: Vocalization, tract: VocalTract, strength: float, length: float
) -> tuple[Samples, tuple[Phoneme, ...]]:
    frames = [max(round(part.ms * length / 1000.0 / STEP_S), 1) for part in sound.parts]
    tracks = _tracks(sound.parts, frames, tract, strength)
    wave = sounded(tracks, zlib.crc32(sound.name.encode()))
    gain = LOUDNESS * 10.0 ** (sound.loudness / 20.0) * strength / _level(wave)
    samples = (np.tanh(wave * gain) * _FULL).astype(np.int16)
    samples.flags.writeable = False
    return samples, tuple(_phonemes(sound.parts, frames))


def _tracks(
    parts: Sequence[Part], frames: Sequence[int], tract: VocalTract, strength: float
) -> Tracks:
    semitones = strength * _joined([part.pitch for part in parts], frames)
    shapes = [SHAPES[part.shape] for part in parts]
    formants = np.array(
        [
            _blended(_joined([(shape.formants[number],) for shape in shapes], frames), BLENDS_S)
            for number in range(len(shapes[0].formants))
        ]
    )
    return Tracks(
        tract.pitch_hz * np.exp2(_blended(semitones, SWELLS_S) / 12.0),
        _blended(_joined([part.voice for part in parts], frames), SWELLS_S),
        _blended(_joined([part.air for part in parts], frames), SWELLS_S),
        formants * tract.resonances,
        _blended(_joined([(shape.nose,) for shape in shapes], frames), BLENDS_S),
        _blended(_joined([(float(shape.hiss_hz > 0),) for shape in shapes], frames), SWELLS_S),
        _joined([(shape.hiss_hz,) for shape in shapes], frames),
        _blended(_joined([(part.tension,) for part in parts], frames), BLENDS_S),
    )


def _joined(values: Sequence[Sequence[float]], frames: Sequence[int]) -> Curve:
    """Values of parts, each drawn from its first to its last over its frames."""
    return np.concatenate(
        [
            np.interp(np.linspace(0, len(of) - 1, count), np.arange(len(of)), of)
            for of, count in zip(values, frames, strict=True)
        ]
    )


def _blended(track: Curve, seconds: float) -> Curve:
    """A track without steps."""
    width = min(round(seconds / STEP_S), len(track)) | 1
    window = np.hanning(width + 2)[1:-1]
    padded = np.pad(track, width // 2, mode="edge")
    smooth: Curve = np.convolve(padded, window / window.sum(), "valid")
    return smooth


def _level(wave: NDArray[np.float32]) -> float:
    """Root of the mean square where it is loud."""
    step = round(0.02 * RATE)
    pieces = wave[: max(len(wave) // step, 1) * step].reshape(-1, min(step, len(wave)))
    levels = np.sqrt((pieces.astype(np.float64) ** 2).mean(axis=1))
    loud = levels[levels >= LOUD_SHARE * levels.max()]
    return max(float(np.sqrt((loud**2).mean())), 1e-6)


def _phonemes(parts: Sequence[Part], frames: Sequence[int]) -> list[Phoneme]:
    """The shapes of the mouth, like ones together."""
    found: list[Phoneme] = []
    start = 0.0
    for part, count in zip(parts, frames, strict=True):
        name, duration = SHAPES[part.shape].phoneme, count * STEP_S
        if found and found[-1].name == name:
            last = found.pop()
            found.append(Phoneme(name, last.start, last.duration + duration))
        else:
            found.append(Phoneme(name, start, duration))
        start += duration
    return [*found, Phoneme(CLOSED, start, 0.0)]


def sounds_path() -> Path:
    """The file that is in use."""
    return paths.find("emotions", "sounds")


def load_sounds(path: Path | None = None) -> Mapping[str, Vocalization]:
    """The sounds by their names. Raises HriError, or AuthoringError with the place.

    The file that is in use is read once: what is saved meanwhile cannot break a sentence.
    """
    return _in_use(sounds_path()) if path is None else _loaded(path)


@lru_cache(maxsize=4)
def _in_use(path: Path) -> Mapping[str, Vocalization]:
    """The user's file adds sounds to those that come with `hri`, or redefines some."""
    return {**_loaded(paths.house() / "emotions" / "sounds.toml"), **_loaded(path)}


def _loaded(path: Path) -> Mapping[str, Vocalization]:
    table = load_toml(path, "file of sounds")
    table.number("schema", 1, minimum=1, maximum=1)
    sounds = {name: _sound(name, table.table(name)) for name in table.data if name != "schema"}
    table.finish()
    return sounds


def sound_named(name: str) -> Vocalization:
    """Raises HriError for an unknown one."""
    sounds = load_sounds()
    if name not in sounds:
        raise HriError(f'no sound "{name}" - {did_you_mean(name, sounds)}')
    return sounds[name]


def _sound(name: str, table: Table) -> Vocalization:
    repeats = int(table.number("repeats", 1, minimum=1, maximum=MOST_REPEATS))
    falls = table.number("falls", 0.0, minimum=-12, maximum=12)
    fades = table.number("fades", 1.0, minimum=0.1, maximum=1.5)
    slows = table.number("slows", 1.0, minimum=0.5, maximum=2.0)
    again = [_part(part) for part in table.array("parts")]
    calls = [
        _changed(part, -falls * number, fades**number, slows**number)
        for number in range(repeats)
        for part in again
    ]
    before, after = ([_part(part) for part in table.array(key)] for key in ("before", "after"))
    sound = Vocalization(
        name,
        table.string("about"),
        (*before, *calls, *after),
        table.number("loudness", 0.0, minimum=-30, maximum=6),
        table.string("gesture", ""),
    )
    table.finish()
    seconds = max(LENGTHS.values()) * sum(part.ms for part in sound.parts) / 1000.0
    if not sound.parts:
        raise table.error("parts", "the sound has no parts", "write parts = [{ ... }]")
    if seconds > LONGEST_S:
        what = f"it takes {seconds:.1f} s when it is long"
        raise table.error("parts", what, f"keep to {LONGEST_S:g} s")
    return sound


def _part(table: Table) -> Part:
    shape = table.string("shape", among=tuple(SHAPES))
    part = Part(
        shape,
        table.number("ms", minimum=SHORTEST_MS, maximum=LONGEST_MS),
        _track(table, "pitch", 0.0, -24, 36),
        _track(table, "voice", 0.0, 0, 1),
        _track(table, "air", 0.0, 0, 1),
        table.number("tension", 0.0, minimum=-1, maximum=1),
    )
    table.finish()
    return part


def _track(
    table: Table, name: str, default: float, minimum: float, maximum: float
) -> tuple[float, ...]:
    """A number, or a list of numbers that are gone through."""
    if not isinstance(table.data.get(name), list):
        return (table.number(name, default, minimum=minimum, maximum=maximum),)
    values = table.numbers(name)
    if not values or not all(minimum <= value <= maximum for value in values):
        what, remedy = f"{name} is {values}", f"write numbers from {minimum:g} to {maximum:g}"
        raise table.error(name, what, remedy)
    return tuple(values)


def _changed(part: Part, semitones: float, gain: float, time: float) -> Part:
    """A part of a later call."""
    return Part(
        part.shape,
        part.ms * time,
        tuple(value + semitones for value in part.pitch),
        tuple(value * gain for value in part.voice),
        tuple(value * gain for value in part.air),
        part.tension,
    )
