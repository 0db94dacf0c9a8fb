"""What the network sees of sound: log-mel energies, 100 frames a second."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Samples

RATE = 16000
"""Samples a second."""
HOP = 160
"""Samples from one frame to the next."""
WIDTH = 400
"""Samples under the window of one frame."""
BANDS = 80
BINS = WIDTH // 2 + 1
_FULL_SCALE = 32768.0
_LEAST = 1e-10
"""Energy under which the network was never shown anything."""

_WINDOW = (np.hanning(WIDTH + 1)[:WIDTH] / _FULL_SCALE).astype(np.float32)


Sound = NDArray[np.float32] | Samples
"""In steps of 16 bits; what was amplified may be louder than they can count."""


def padded(samples: Sound) -> NDArray[np.float32]:
    """The sound with half a window mirrored at both ends, where its first and last frames lie."""
    return np.pad(samples.astype(np.float32), WIDTH // 2, mode="reflect")


def log_mel(sound: NDArray[np.float32], filters: NDArray[np.float32]) -> NDArray[np.float32]:
    """Log energies [frames, BANDS] of sound in 16-bit units, a frame every HOP samples.

    Frame i lies under the samples from i * HOP to i * HOP + WIDTH. `filters` [BINS, BANDS] come
    with the weights; their first two rows are 0 and the window is a periodic Hann window, so a
    constant offset of the sound leaves no trace.
    """
    return log_mel_of(np.lib.stride_tricks.sliding_window_view(sound, WIDTH)[::HOP], filters)


def log_mel_of(windows: NDArray[np.float32], filters: NDArray[np.float32]) -> NDArray[np.float32]:
    """Log energies [frames, BANDS] of the sound [frames, WIDTH] under each window."""
    spectrum = np.fft.rfft(windows * _WINDOW)
    energies = spectrum.real**2 + spectrum.imag**2
    mel: NDArray[np.float32] = energies.astype(np.float32, copy=False) @ filters
    np.maximum(mel, _LEAST, out=mel)
    return np.log(mel, out=mel)
