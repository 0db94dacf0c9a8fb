"""The network of the natural voice: symbols in, sound out, with the time of each symbol.

The network is hibari's (https://github.com/MMWilliams/hibari), distilled from Kokoro-82M. From the
ids of symbols it computes how long each lasts, a pitch for every 12.5 ms, and the spectra of a
harmonic and of a noise source, which an inverse Fourier transform makes into sound.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError, NotAvailable
from hri.core.native_path import native_path
from hri.core.signals import Prosody
from hri.speech.synthesizers.natural_symbols import Sounded, longest_parts

Sound = NDArray[np.float32]
Spectrum = NDArray[np.float32]
"""Bins of BIN_HZ by frames of 12.5 ms."""
Curve = NDArray[np.float32]
"""Hertz, by frames."""

RATE = 24000
"""Samples a second."""
BIN_HZ = 20.0
MOST_SYMBOLS = 400
"""What the network is given at once: its sentences were seldom longer when it learned."""
SLOWEST, FASTEST = 0.5, 2.0
"""Factors of the rate at which it still speaks well."""
VOICED_HZ = 40.0
"""Frames with a lower pitch have no voice."""
SEMITONES = 12
"""Of an octave."""
REST_DAMPING = 0.35
"""By how much the part of the sound that has the network's own pitch in its phases is damped for
each semitone of another pitch: 3 dB, as a natural logarithm.
"""
_FRAME = 600
"""Samples of one unit of the durations: 25 ms."""
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
PAUSE = 0.25
"""Seconds of silence that are left after a sentence."""
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

    def speak(self, symbols: str, prosody: Prosody) -> list[Utterance]:
        """The symbols in sound, in parts that the network can take at once."""
        parts = longest_parts(symbols, MOST_SYMBOLS)
        return [self._part(symbols[begin:end], prosody) for begin, end in parts]

    def _spoken(self, symbols: str, prosody: Prosody) -> Utterance:
        ids = [self._vocabulary.get(symbol) for symbol in symbols]
        speed = min(max(prosody.rate, SLOWEST), FASTEST)
        given = {
            "ids": np.array([[0, *(one for one in ids if one is not None), 0]], np.int64),
            "speed": np.array([speed], np.float32),
        }
        *framed, durations = self._session.run(None, given)
        *spectra, pitch = (one[0] for one in framed)
        sound = self._sound(spectra, pitch, prosody)
        sound.flags.writeable = False  # It is kept.
        ends = np.cumsum(durations) * _FRAME / RATE - LEAD
        return trimmed(sound, _sounded(symbols, ids, ends), RATE)

    def _sound(self, spectra: list[Spectrum], pitch: Curve, prosody: Prosody) -> Sound:
        """The sound of spectra, as loud at another pitch as at their own."""
        plain = self._of_spectra(spectra, pitch)
        changed = pitched(pitch, prosody)
        if changed is pitch:
            return plain
        harmonic, phase, noise, rest, rest_phase = spectra
        moved = np.abs(SEMITONES * np.log2(np.maximum(changed, 1.0) / np.maximum(pitch, 1.0)))
        shifted = [envelope(harmonic, pitch), phase, noise, rest - REST_DAMPING * moved, rest_phase]
        sound = self._of_spectra(shifted, changed)
        return sound * (_level(plain) / max(_level(sound), 1e-9))

    def _of_spectra(self, spectra: list[Spectrum], pitch: Curve) -> Sound:
        # Each part draws the same noise: what was said before changes nothing.
        return self._synthesize(*spectra, pitch, np.random.default_rng(0))


def _sounded(symbols: str, ids: list[int | None], ends: NDArray[np.float64]) -> list[Sounded]:
    """The time of each symbol; those that the network does not know take none."""
    spoken, place = [], 0
    for symbol, id in zip(symbols, ids, strict=True):
        start = float(ends[place])
        place += id is not None
        spoken.append(Sounded(symbol, start, float(ends[place]) - start))
    return spoken


def trimmed(sound: Sound, symbols: list[Sounded], rate: int) -> Utterance:
    """Without the silence that a network puts around a sentence, up to a third of a second."""
    blocks = sound[: len(sound) // _BLOCK * _BLOCK].reshape(-1, _BLOCK)
    loud = np.flatnonzero((blocks**2).mean(axis=1) > 10 ** (SILENCE_DBFS / 10))
    if not len(loud):
        return Utterance(sound[:0], tuple(Sounded(one.symbol, 0.0, 0.0) for one in symbols))
    begin = max(int(loud[0]) * _BLOCK - round(BREATH * rate), 0)
    heard_until = (int(loud[-1]) + 1) * _BLOCK
    end = min(heard_until + round(PAUSE * rate), len(sound))
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


def _level(sound: Sound) -> float:
    return float(np.sqrt((sound**2).mean())) if len(sound) else 0.0


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
