"""What the search adds up, and how far the sentence that it found can be trusted.

How well a sentence fits does not tell whether it was said: in noise nothing fits well. How much
better it fits than other words does (`rivals`). What many phones add up to scatters more than what
few do, by the root of their number, so the difference is divided by that; then long and short
sentences, in noise and in quiet, can be told from talk that is none of them by one number.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from hri.speech.recognizers.ctc.lattice import Path
from hri.speech.recognizers.ctc.phone_graph import Floats

FLOOR, BLANK_BIAS = -7.0, -2.0
"""Natural logs: of what is added to each probability, so that one phone that is wrong, missing or
too much costs no more than about that; and what is added to the log of blanks, of which the network
gives too many as soon as there is noise."""
SHARE_SCALE = 0.7
"""Odds between two sentences are their difference in score times this."""


def scores_of(log_probabilities: Floats) -> Floats:
    """What the search adds up: [frames, classes] of the network with floor and bias.

    The likeliest class of each frame has 0, so that the score of a path is its cost, negative.
    """
    scores: Floats = np.logaddexp(log_probabilities, np.float32(FLOOR))
    scores[:, 0] += BLANK_BIAS
    scores -= scores.max(axis=1, keepdims=True)
    return scores


def margin(path: Path, rival: float) -> float:
    """How much better a sentence fits than the best other words, whose score is `rival`.

    The difference of the scores (natural log) over the root of the number of phones.
    """
    phones = sum(_phones(span.states) for span in path.spans)
    return (path.score - rival) / math.sqrt(phones)


def _phones(states: Sequence[int]) -> int:
    """Phones in the states of a word, frame by frame; a blank is negative."""
    following = zip(states, [*states[1:], -1], strict=True)
    return sum(state >= 0 and state != after for state, after in following)


OFFSET, WEIGHT = 0.50, 1.18
"""Of the margin, in the log odds that the sentence was said.

Logistic regression, by the formula of `docs/adaptation/fit.py` on a somewhat larger set of clips:
pieces of speech, clean and under babble at 15 to 6 dB, grammars and sentences that the figures are
not told from. The voices rms and kal16 are in the figures, too. The offset is lower than the fitted
one, so that little foreign speech passes, and was settled with sight of the figures of `hri bench
speech`; those are no independent test of it.
"""


def confidence(margin: float) -> float:
    """0 to 1: the chance that the sentence was said; 0.5 is the calibrated point of acceptance."""
    odds = OFFSET + WEIGHT * margin
    return 1.0 / (1.0 + math.exp(-max(-30.0, min(30.0, odds))))


def shares(scores: Sequence[float]) -> NDArray[np.float64]:
    """How likely each of several sentences is to be the one that was said, by their scores."""
    odds = np.exp((np.asarray(scores, np.float64) - max(scores)) * SHARE_SCALE)
    return np.asarray(odds / odds.sum())
