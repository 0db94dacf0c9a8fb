"""How well numbers fit a distribution, by the test of Kolmogorov and Smirnov."""

from collections.abc import Callable, Sequence

import numpy as np


def p_value(found: Sequence[float], share_below: Callable[[float], float]) -> float:
    """How often numbers of that distribution lie as far from it as these, by its limit formula."""
    wanted = np.array([share_below(number) for number in sorted(found)])
    size = len(wanted)
    steps = np.arange(size + 1) / size
    distance = max((steps[1:] - wanted).max(), (wanted - steps[:-1]).max())
    size_root = np.sqrt(size)
    scaled = (size_root + 0.12 + 0.11 / size_root) * distance
    terms = np.arange(1, 101)
    series = 2 * np.sum((-1.0) ** (terms - 1) * np.exp(-2 * (terms * scaled) ** 2))
    return float(np.clip(series, 0, 1))
