"""The network of the natural voice: symbols in, sound out, with the time of each symbol.

The network is hibari's (https://github.com/MMWilliams/hibari), distilled from Kokoro-82M. From the
ids of symbols it computes how long each lasts, a pitch for every 12.5 ms, and the spectra of a
harmonic and of a noise source, which an inverse Fourier transform makes into sound.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError, NotAvailable
from hri.core.native_path import native_path
from hri.core.signals import PLAIN_QUALITY, Prosody, VoiceQuality
from hri.speech.notation.intonation import LAST_S
from hri.speech.synthesizers.natural_melody import (
    ACCENT_DB,
    LOUD_DB,
    VOICED_HZ,
    Curve,
    Phrase,
    accented,
    bent,
    falling,
    lifted,
    weighted,
)
from hri.speech.synthesizers.natural_quality import (
    DECIBELS,
    Spectrum,
    breathed,
    loudened,
    smiling,
    tilted,
    trembling,
    voicing,
)
from hri.speech.synthesizers.natural_symbols import Sounded, longest_parts
from hri.speech.synthesizers.natural_text import Accent, Ending
from hri.speech.synthesizers.natural_timing import Timing, timing

Sound = NDArray[np.float32]

RATE = 24000
"""Samples a second."""
BIN_HZ = 20.0
MOST_SYMBOLS = 400
"""What the network is given at once: its sentences were seldom longer when it learned."""
LONG = 160
"""Symbols from which on a sentence is made up to one pause after another: the first of it is heard
while the rest is made.
"""
LEAST_FIRST, LEAST = 25, 60
"""Symbols of the first such part, and of another, at least."""
SLOWEST, FASTEST = 0.3, 2.5
"""Factors of the rate at which it still speaks well."""
SEMITONES = 12
"""Of an octave."""
REST_DAMPING = 0.35
"""By how much the part of the sound that has the network's own pitch in its phases is damped for
each semitone of another pitch: 3 dB, as a natural logarithm.
"""
_FRAME, _HOP = 600, 300
"""Samples of one unit of the durations, 25 ms, and of one frame of the spectra."""
FALLS = 3.0
"""Semitones for which the end of a falling phrase counts as moved: the network says that its pitch
falls there, but in the phases of the rest, which are most of the sound, it stays.
"""
UNMOVED = 0.05
"""Semitones by which a pitch may be moved without a trace."""
VOICE_HZ = 4000.0
"""Above it, what is not harmonic is noise."""
HARMONICS = 30
"""Those that make nearly all of the loudness."""
_LOBE = 1.5
"""Energy of a harmonic over that of its bin: the window spreads it over three."""
_NOTHING = -20.0
"""Logarithm of a magnitude that is not heard."""
_AFTER = 4
"""Frames by which a sound may go on beyond its time."""
_DURATIONS = "/Clip_output_0"
"""The tensor of the durations, which the model computes but does not give out."""
LEAD = 0.056
"""Seconds by which a sound comes before its durations say so: at this shift the spectra within each
symbol differ least, over 66 sentences (a sum of squares of 5.8, of 10.0 without the shift).
"""
SILENCE_DBFS = -60.0
"""Below this level there is nothing to be heard."""
BREATH = 0.05
"""Seconds of silence that are left before a sentence."""
MOST_KEPT = 32
"""Parts of sentences whose sound is kept, for when they are said again: 10 MB."""
_BLOCK = 120
"""Samples of which the level is measured."""


@dataclass(frozen=True, slots=True)
class Utterance:
    """A part of a sentence in sound."""

    sound: Sound
    """At RATE, -1 to 1."""
    symbols: tuple[Sounded, ...]
    """One for each symbol that it was given."""


class _Line(NamedTuple):
    """What the network is given at once."""

    symbols: str
    endings: tuple[Ending, ...]
    accents: tuple[Accent, ...]
    is_first: bool
    """Whether the sentence begins with it."""


class Network:
    """Speaks symbols; the same symbols give the same sound. Safe from several threads."""

    def __init__(
        self, model: Path, vocabulary: dict[str, int], synthesize: Callable[..., Sound]
    ) -> None:
        """`synthesize` makes sound of spectra. Raises NotAvailable for another kind of file."""
        self._vocabulary = vocabulary
        self._synthesize = synthesize
        self._session = session_of(model, _DURATIONS)
        self._part = lru_cache(maxsize=MOST_KEPT)(self._spoken)

    def speak(
        self,
        symbols: str,
        prosody: Prosody,
        endings: Sequence[Ending] = (),
        accents: Sequence[Accent] = (),
    ) -> Iterator[Utterance]:
        """The symbols in sound, part by part as it is made.

        `endings` are those of the phrases.
        """
        for begin, end in parts(symbols, endings):
            within = [
                ending._replace(symbol=ending.symbol - begin)
                for ending in endings
                if begin < ending.symbol <= end
            ]
            heavy = [
                Accent(max(accent.begin - begin, 0), min(accent.end, end) - begin, accent.weight)
                for accent in accents
                if accent.begin < end and begin < accent.end
            ]
            line = _Line(symbols[begin:end], tuple(within), tuple(heavy), begin == 0)
            yield self._part(line, prosody)

    def _spoken(self, line: _Line, prosody: Prosody) -> Utterance:
        factor = 1.0 / min(max(prosody.rate, SLOWEST), FASTEST)
        spectra, pitch, heard_at = self._paced(line, factor)
        sound = self._voiced(line, prosody, spectra, pitch, heard_at)
        sound.flags.writeable = False  # It is kept.
        pause = line.endings[-1].pause_s if line.endings else LAST_S
        if pause != LAST_S:
            pause *= factor
        breath = BREATH * factor if line.is_first else 0.0
        return trimmed(sound, _sounded(line.symbols, heard_at), RATE, pause, breath)

    def _paced(
        self, line: _Line, factor: float
    ) -> tuple[list[Spectrum], Curve, NDArray[np.float64]]:
        """Spectra and pitch in time, and the frames in which the symbols begin and end."""
        spectra, pitch, starts = self._framed(line.symbols)
        pauses = [
            (ending.symbol, round(ending.pause_s * factor * RATE / _HOP))
            for ending in line.endings[:-1]
            if ending.pause_s
        ]
        loudness = _loudness(spectra, pitch)
        weights = weighted(starts, line.accents, len(loudness))
        timed = timing(line.symbols, starts, loudness, factor, pauses, weights)
        return *_drawn(spectra, pitch, timed), timed.at(starts)

    def _voiced(
        self,
        line: _Line,
        prosody: Prosody,
        spectra: list[Spectrum],
        pitch: Curve,
        heard_at: NDArray[np.float64],
    ) -> Sound:
        """The sound in the melody and the quality of a voice."""
        phrases = _phrases(heard_at, line.endings)
        loudness = _loudness(spectra, pitch)
        weights = weighted(heard_at, line.accents, len(loudness))
        gain = lifted(loudness, phrases) + loudened(loudness, phrases, prosody.quality)
        gain += ACCENT_DB * weights
        for magnitudes in (spectra[0], spectra[2], spectra[3]):
            magnitudes += (gain / DECIBELS).astype(np.float32)
        is_loud = loudness > loudness.max() - LOUD_DB
        melody = bent(accented(pitch, weights, phrases), is_loud, phrases)
        ends = np.maximum(_semitones(melody, pitch), FALLS * falling(is_loud, phrases))
        changed = trembling(pitched(melody, prosody), prosody.quality.tremble)
        return self._sound(spectra, pitch, ends, changed, prosody.quality)

    def _framed(self, symbols: str) -> tuple[list[Spectrum], Curve, NDArray[np.float64]]:
        """The network's spectra and pitch, and the frames in which the symbols begin and end."""
        ids = [self._vocabulary.get(symbol) for symbol in symbols]
        given = {
            "ids": np.array([[0, *(one for one in ids if one is not None), 0]], np.int64),
            "speed": np.array([1.0], np.float32),
        }
        *framed, durations = self._session.run(None, given)
        *spectra, pitch = (one[0] for one in framed)
        ends = np.cumsum(durations) * (_FRAME / _HOP) - LEAD * RATE / _HOP
        return spectra, pitch, np.array([ends[place] for place in _places(ids)])

    def _sound(
        self,
        spectra: list[Spectrum],
        pitch: Curve,
        ends: NDArray[np.float64],
        changed: Curve,
        quality: VoiceQuality,
    ) -> Sound:
        """The sound of spectra, as loud at another pitch and quality as at their own.

        `ends` says how far the tones of the phrases move it, semitones by frame; `changed` is the
        pitch that is heard.
        """
        moved = np.maximum(_semitones(changed, pitch), ends)
        is_plain = quality == PLAIN_QUALITY
        frames = np.flatnonzero((moved > UNMOVED) | (not is_plain))
        if not len(frames):
            return self._of_spectra(spectra, pitch)
        loud = _energy(spectra, pitch)
        harmonic, rest = spectra[0].copy(), spectra[3].copy()
        rest[:, frames] -= REST_DAMPING * moved[frames]
        harmonic[:, frames] = envelope(harmonic[:, frames], pitch[frames])
        bends = np.flatnonzero(ends > UNMOVED)
        lost = spectra[3][:, bends], rest[:, bends]
        harmonic[:, bends] = _with_rest(harmonic[:, bends], *lost, changed[bends])
        shifted = [harmonic, spectra[1], spectra[2], rest, spectra[4]]
        if not is_plain:
            shifted = _colored(shifted, quality)
        level = np.sqrt(loud.sum() / max(float(_energy(shifted, changed).sum()), 1e-12))
        return self._of_spectra(shifted, changed) * np.float32(level)

    def _of_spectra(self, spectra: list[Spectrum], pitch: Curve) -> Sound:
        # Each part draws the same noise: what was said before changes nothing.
        return self._synthesize(*spectra, pitch, np.random.default_rng(0))


def _semitones(one: Curve, other: Curve) -> NDArray[np.float64]:
    """How far two curves are apart."""
    apart: NDArray[np.float64] = np.log2(np.maximum(one, 1.0) / np.maximum(other, 1.0))
    return np.abs(SEMITONES * apart)


def _colored(spectra: list[Spectrum], quality: VoiceQuality) -> list[Spectrum]:
    """Spectra, whose harmonics are an envelope, in the quality of a voice."""
    harmonic, phase, noise, rest, rest_phase = spectra
    voiced = voicing(harmonic, rest, BIN_HZ)
    tilt = tilted(quality.tension, voiced, len(harmonic), BIN_HZ)
    tract = smiling(harmonic, quality.smile)
    air = breathed(noise, tract, voiced, quality.breath, BIN_HZ)
    return [tract + tilt, phase, air, rest + tilt, rest_phase]


def _with_rest(harmonic: Spectrum, rest: Spectrum, damped: Spectrum, pitch: Curve) -> Spectrum:
    """The harmonics with what the rest loses: at the end of a sentence most of a vowel is there."""
    low = round(VOICE_HZ / BIN_HZ)
    bins = pitch / BIN_HZ / _LOBE  # of the rest, in one harmonic
    lost = np.exp(2.0 * rest[:low]) - np.exp(2.0 * damped[:low])
    together = np.exp(2.0 * np.minimum(harmonic[:low], 7.0)) + np.maximum(lost, 0.0) * bins
    filled = harmonic.copy()
    has_voice = pitch > VOICED_HZ
    filled[:low] = np.where(has_voice, 0.5 * np.log(np.maximum(together, 1e-20)), harmonic[:low])
    return filled


def parts(symbols: str, endings: Sequence[Ending]) -> Iterator[tuple[int, int]]:
    """Where the stretches begin and end that the network is given one after another."""
    cuts = [0]
    for ending in endings[:-1] if len(symbols) > LONG else ():
        least = LEAST if len(cuts) > 1 else LEAST_FIRST
        is_far = min(ending.symbol - cuts[-1] - least, len(symbols) - ending.symbol - LEAST) >= 0
        if ending.pause_s and is_far:
            cuts.append(ending.symbol)
    for first, last in pairwise([*cuts, len(symbols)]):
        for begin, end in longest_parts(symbols[first:last], MOST_SYMBOLS):
            yield first + begin, first + end


def _places(ids: list[int | None]) -> list[int]:
    """Before each symbol, and after the last, how many ends the network gives; those that it does
    not know take no time.
    """
    places = [0]
    for id in ids:
        places.append(places[-1] + (id is not None))
    return places


def _sounded(symbols: str, starts: NDArray[np.float64]) -> list[Sounded]:
    """The time of each symbol; `starts` are the frames in which they begin and end."""
    times = starts * _HOP / RATE
    return [
        Sounded(symbol, float(begin), float(end - begin))
        for symbol, begin, end in zip(symbols, times[:-1], times[1:], strict=True)
    ]


def _energy(spectra: list[Spectrum], pitch: Curve) -> NDArray[np.float64]:
    """The energy of each frame; of the harmonics only where they are."""
    harmonic, _, noise, rest, _ = spectra
    has_voice = pitch > VOICED_HZ
    numbers = np.arange(1, HARMONICS + 1)[:, None]
    bins = np.rint(numbers * np.where(has_voice, pitch, RATE) / BIN_HZ).astype(np.int64)
    drawn = np.take_along_axis(harmonic, np.minimum(bins, len(harmonic) - 1), axis=0)
    voice = np.where(bins < len(harmonic), np.exp(2.0 * np.minimum(drawn, 7.0)), 0.0).sum(axis=0)
    energy: NDArray[np.float64] = _LOBE * np.where(has_voice, voice, 0.0)
    for part in (noise, rest):
        energy += np.exp(2.0 * np.minimum(part, 7.0)).sum(axis=0)
    return energy


def _loudness(spectra: list[Spectrum], pitch: Curve) -> NDArray[np.float64]:
    """Decibels of each frame."""
    decibels: NDArray[np.float64] = 10.0 * np.log10(np.maximum(_energy(spectra, pitch), 1e-12))
    return decibels


def _drawn(spectra: list[Spectrum], pitch: Curve, timed: Timing) -> tuple[list[Spectrum], Curve]:
    """Spectra and pitch at the places of a timing, between two frames linearly.

    Phases turn, so those of the rest are taken from the nearest frame.
    """
    before = timed.places.astype(np.int64)
    after = np.minimum(before + 1, len(pitch) - 1)
    share = (timed.places - before).astype(np.float32)
    nearest = np.where(share < 0.5, before, after)
    rest_phase = spectra[4]
    magnitudes = [(1 - share) * one[:, before] + share * one[:, after] for one in spectra[:4]]
    for number in (0, 2, 3):
        magnitudes[number][:, timed.silent] = _NOTHING
    has_voice = (pitch[before] > VOICED_HZ) & (pitch[after] > VOICED_HZ)
    curve = (1 - share) * pitch[before] + share * pitch[after]
    drawn = np.where(has_voice, curve, pitch[nearest])
    return [*magnitudes, rest_phase[:, nearest]], drawn.astype(np.float32)


def _phrases(starts: NDArray[np.float64], endings: Sequence[Ending]) -> list[Phrase]:
    """The phrases in frames; `starts` are the frames in which the symbols begin."""
    phrases, begin = [], 0
    for ending in endings:
        end = max(round(float(starts[ending.symbol])) + _AFTER, begin)
        phrases.append(Phrase(begin, end, ending.tone))
        begin = end
    return phrases


def trimmed(
    sound: Sound,
    symbols: list[Sounded],
    rate: int,
    pause: float = LAST_S,
    breath: float = BREATH,
) -> Utterance:
    """With these silences around it, in seconds, instead of those of the network."""
    blocks = sound[: len(sound) // _BLOCK * _BLOCK].reshape(-1, _BLOCK)
    loud = np.flatnonzero((blocks**2).mean(axis=1) > 10 ** (SILENCE_DBFS / 10))
    if not len(loud):
        return Utterance(sound[:0], tuple(Sounded(one.symbol, 0.0, 0.0) for one in symbols))
    begin = max(int(loud[0]) * _BLOCK - round(breath * rate), 0)
    heard_until = (int(loud[-1]) + 1) * _BLOCK
    end = heard_until + round(pause * rate)
    sound = np.pad(sound, (0, max(end - len(sound), 0)))
    first, last = 0.0, (heard_until - begin) / rate
    times = [(one.start - begin / rate, one.end - begin / rate) for one in symbols]
    limited = [(min(max(a, first), last), min(max(b, first), last)) for a, b in times]
    kept = zip(symbols, limited, strict=True)
    return Utterance(sound[begin:end], tuple(Sounded(s.symbol, a, b - a) for s, (a, b) in kept))


def envelope(harmonic: Spectrum, pitch: Curve) -> Spectrum:
    """The log magnitudes of the harmonics, drawn through all frequencies.

    Between the harmonics the source has no sound, so what the network computes there means nothing:
    at another pitch it would make the voice rough, and 4 dB louder.
    """
    bins = np.arange(len(harmonic))[:, None]
    voiced = pitch > VOICED_HZ
    step = np.where(voiced, pitch, RATE) / BIN_HZ
    number = np.maximum(bins / step, 1.0)
    below = np.floor(number)
    share = number - below
    drawn = (1 - share) * _at(harmonic, below * step) + share * _at(harmonic, (below + 1) * step)
    return np.where(voiced, drawn, harmonic).astype(np.float32)


def _at(spectrum: Spectrum, places: NDArray[np.float64]) -> NDArray[np.float64]:
    """A spectrum at fractions of its bins, linearly interpolated; the last bin beyond them."""
    places = np.minimum(places, len(spectrum) - 1.001)
    bins = places.astype(np.int64)
    frames = np.arange(spectrum.shape[1])
    share = places - bins
    found: NDArray[np.float64] = (1 - share) * spectrum[bins, frames]
    return found + share * spectrum[bins + 1, frames]


def pitched(pitch: Curve, prosody: Prosody) -> Curve:
    """The curve of the pitch, hertz, raised, and its way around its middle widened in semitones."""
    voiced = pitch > VOICED_HZ
    if not voiced.any() or (prosody.pitch == 1.0 and prosody.range == 1.0):
        return pitch
    logs = np.log(pitch[voiced])
    middle = float(np.median(logs))
    changed = pitch.copy()
    changed[voiced] = np.exp(middle + prosody.range * (logs - middle)) * prosody.pitch
    return np.where(voiced, np.maximum(changed, VOICED_HZ + 1), pitch)


def session_of(path: Path, output: str) -> Any:
    """A model on one thread, with a tensor added to its outputs. Raises NotAvailable."""
    import onnxruntime

    onnxruntime.disable_telemetry_events()  # where it was imported before `hri`
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    # Without its own store of memory it takes 45 MB less after a long sentence, and no more time.
    options.enable_cpu_mem_arena = options.enable_mem_pattern = False
    options.log_severity_level = 4
    try:
        with TemporaryDirectory() as folder:  # a session keeps bytes for good, but closes a file
            model = Path(folder) / "model.onnx"
            model.write_bytes(path.read_bytes() + _output(output))
            with native_path(model) as name:
                session = onnxruntime.InferenceSession(name, options, ["CPUExecutionProvider"])
    except OSError as error:
        raise NotAvailable(f"{path}: {error.strerror} - see `hri voices`") from error
    except HriError as error:
        raise NotAvailable(str(error)) from error
    except Exception as error:  # onnxruntime's own, one class for each status
        raise NotAvailable(f"{path}: not a model of this kind of voice - take another") from error
    return session


def _output(name: str) -> bytes:
    """What makes a tensor an output of a model, appended to its file.

    Protocol buffers that follow each other are merged, their lists appended: this is a ModelProto
    (onnx.proto) whose graph (field 7) has one output (field 12), a ValueInfoProto of that name
    (field 1).
    """
    return _field(7, _field(12, _field(1, name.encode())))


def _field(number: int, content: bytes) -> bytes:
    """A field of bytes, shorter than 128."""
    return bytes((number << 3 | 2, len(content))) + content
