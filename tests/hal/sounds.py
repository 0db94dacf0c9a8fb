"""Sounds to test with."""

import numpy as np


def tone(rate, seconds=0.5, hertz=440, amplitude=8000):
    times = np.arange(int(rate * seconds)) / rate
    return (amplitude * np.sin(2 * np.pi * hertz * times)).astype(np.int16)


def similarity(a, b):
    """Cosine of two sounds, 1 for the same, at the shift within 30 ms at 16 kHz that fits best."""
    count = min(len(a), len(b)) - 480
    a, b = a.astype(float), b[:count].astype(float)
    return max(
        a[shift : shift + count]
        @ b
        / (np.linalg.norm(a[shift : shift + count]) * np.linalg.norm(b))
        for shift in range(480)
    )
