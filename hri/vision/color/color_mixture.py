"""Mixtures of Gaussians over chroma, fitted by expectation maximization.

Dempster, Laird and Rubin, "Maximum likelihood from incomplete data via the EM algorithm" (1977).
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError
from hri.core.signals import Image

Samples = NDArray[np.float64]
"""Chroma of pixels, shape [n, 2]: Cr and Cb, 0 to 255."""

STEPS = 30
FLOOR = 4.0
"""Variance, in squared levels, below which no component shrinks: the noise of a camera."""
MOST = 20_000
"""Samples that are fitted; of more, these are drawn."""
FEWEST = 20
"""Samples that a mixture needs."""
UNSEEN = 1e-3
"""Share of the background that is any chroma at all, so that rare ones do not look like a color."""
ELSEWHERE, GRAYISH = 0.05, 900.0
"""Share of the background that is what other rooms are like: around gray, with this variance."""


def chroma(image: Image) -> NDArray[np.uint8]:
    """Cr and Cb of a picture, shape [height, width, 2]."""
    return np.asarray(cv2.cvtColor(image, cv2.COLOR_RGB2YCrCb)[..., 1:], np.uint8)


@dataclass(frozen=True, slots=True)
class ColorMixture:
    """Weighted Gaussians over chroma."""

    weights: NDArray[np.float64]
    """Shape [k], 0 to 1; they sum to 1."""
    means: NDArray[np.float64]
    """Shape [k, 2], levels."""
    covariances: NDArray[np.float64]
    """Shape [k, 2, 2], squared levels."""

    def log_likelihood(self, samples: Samples) -> NDArray[np.float64]:
        """Of each sample, shape [n]."""
        return np.asarray(np.logaddexp.reduce(self._joint(samples), axis=1))

    def _joint(self, samples: Samples) -> NDArray[np.float64]:
        """Of each sample with each component, shape [n, k]."""
        red, blue = (samples[:, axis, None] - self.means[:, axis] for axis in (0, 1))
        inverse = np.linalg.inv(self.covariances)
        distance = inverse[:, 0, 0] * red**2 + inverse[:, 1, 1] * blue**2
        distance += 2 * inverse[:, 0, 1] * red * blue
        scale = np.log(self.weights) - np.log(np.linalg.det(self.covariances)) / 2
        return np.asarray(scale - np.log(2 * np.pi) - distance / 2)


def fit(samples: Samples, components: int, seed: int = 0) -> ColorMixture:
    """The mixture that explains the samples best, the same for the same seed.

    Raises HriError when there are fewer than 20 samples.
    """
    if len(samples) < FEWEST:
        raise HriError(f"{len(samples)} pixels are too few for a color - draw a larger box")
    random = np.random.default_rng(seed)
    if len(samples) > MOST:
        samples = samples[random.choice(len(samples), MOST, replace=False)]
    spread = np.cov(samples.T) + FLOOR * np.eye(2)
    mixture = ColorMixture(
        np.full(components, 1 / components),
        _apart(samples, components, random),
        np.repeat(spread[None], components, axis=0),
    )
    for _ in range(STEPS):
        mixture = _improved(mixture, samples)
    return mixture


def _apart(samples: Samples, count: int, random: np.random.Generator) -> NDArray[np.float64]:
    """Samples to start from that are far from each other (Arthur and Vassilvitskii 2007)."""
    chosen = [samples[random.integers(len(samples))]]
    while len(chosen) < count:
        distance = np.min([np.sum((samples - one) ** 2, axis=1) for one in chosen], axis=0) + 1e-9
        chosen.append(samples[random.choice(len(samples), p=distance / distance.sum())])
    return np.array(chosen)


def _improved(mixture: ColorMixture, samples: Samples) -> ColorMixture:
    """One step of expectation and maximization."""
    joint = mixture._joint(samples)
    share = np.exp(joint - np.logaddexp.reduce(joint, axis=1, keepdims=True))
    mass = share.sum(axis=0) + 1e-9
    means = share.T @ samples / mass[:, None]
    squares = (samples[:, :, None] * samples[:, None, :]).reshape(-1, 4)
    covariances = (share.T @ squares / mass[:, None]).reshape(-1, 2, 2)
    covariances -= means[:, :, None] * means[:, None, :]
    return ColorMixture(mass / mass.sum(), means, covariances + FLOOR * np.eye(2))


@dataclass(frozen=True, slots=True)
class ColorTable:
    """How much likelier each chroma is in a color than in its background."""

    ratios: NDArray[np.float32]
    """Log-likelihood ratios, shape [256, 256]: by Cr, then by Cb."""
    center: NDArray[np.float64]
    """Mean chroma of the color, shape [2]."""
    brightness: float = 0.0
    """Of the thing that has the color, levels of standard light; 0 for the color of no one thing,
    such as skin."""


def ratio_table(
    color: ColorMixture, background: ColorMixture, brightness: float = 0.0
) -> ColorTable:
    """The table of a color. With the brightness of a thing it is looked for in other rooms, too;
    without it before this background alone.
    """
    levels = np.arange(256.0)
    every = np.stack(np.meshgrid(levels, levels, indexing="ij"), axis=-1).reshape(-1, 2)
    behind = np.logaddexp(background.log_likelihood(every), np.log(UNSEEN / 256**2))
    if brightness:
        rooms = -((every - 128) ** 2).sum(axis=1) / (2 * GRAYISH)
        behind = np.logaddexp(behind, rooms + np.log(ELSEWHERE / (2 * np.pi * GRAYISH)))
    ratios = (color.log_likelihood(every) - behind).reshape(256, 256).astype(np.float32)
    return ColorTable(ratios, color.weights @ color.means, brightness)
