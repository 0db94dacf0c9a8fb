"""Which of several classes a text most likely belongs to, learned by counting words in examples.

The multinomial model of McCallum and Nigam, "A Comparison of Event Models for Naive Bayes Text
Classification" (1998), over words and pairs of neighbors. Each text counts as one, and a rare word
for more than a frequent one (tf-idf and length normalization: Rennie et al., "Tackling the Poor
Assumptions of Naive Bayes Text Classifiers", 2003, section 4). All classes are as likely before.
"""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

SMOOTHING = 0.02
"""What is added to every count; of 0.01 to 0.1, all about as good."""
_START, _END = "<s>", "</s>"


class Prediction(NamedTuple):
    """The most likely class of a text."""

    label: str
    probability: float
    """0 to 1, of all classes."""


class NaiveBayes:
    """Classes, and the words that speak for each."""

    def __init__(self, examples: Iterable[tuple[str, Sequence[str]]]) -> None:
        """`examples` are labels and the words of a text each. Nothing is kept of their order."""
        texts = [(label, _features(words)) for label, words in examples]
        spread = Counter(feature for _, features in texts for feature in features)
        self._weights = {
            feature: 1.0 + math.log((1 + len(texts)) / (1 + count))
            for feature, count in spread.items()
        }
        counts: dict[str, dict[str, float]] = defaultdict(lambda: defaultdict(float))
        totals: dict[str, float] = defaultdict(float)
        for label, features in texts:
            for feature, weight in self._weighed(features).items():
                counts[feature][label] += weight
                totals[label] += weight
        # Kept are the gain of a feature for a class that has it, and the cost of a large class.
        self._gains = {
            feature: [(label, math.log1p(count / SMOOTHING)) for label, count in by_label.items()]
            for feature, by_label in counts.items()
        }
        self._costs = {
            label: math.log(total + SMOOTHING * len(counts)) for label, total in totals.items()
        }

    def knows(self, word: str) -> bool:
        """Whether an example has this word."""
        return word in self._weights

    def predict(self, words: Sequence[str]) -> Prediction | None:
        """The most likely class by the words that it knows; None without one."""
        # Every text begins and ends: an end alone says nothing.
        if not any(map(self.knows, words)):
            return None
        features = self._weighed(_features(words))
        length = sum(features.values())
        scores = {label: -length * cost for label, cost in self._costs.items()}
        for feature, weight in features.items():
            for label, gain in self._gains[feature]:
                scores[label] += weight * gain
        best = max(scores, key=scores.__getitem__)
        odds = sum(math.exp(score - scores[best]) for score in scores.values())
        return Prediction(best, 1.0 / odds)

    def _weighed(self, features: frozenset[str]) -> Mapping[str, float]:
        """The weights of the known features of a text, of length 1."""
        weights = {one: self._weights[one] for one in sorted(features) if one in self._weights}
        length = math.sqrt(sum(weight * weight for weight in weights.values()))
        return {feature: weight / length for feature, weight in weights.items()}


def _features(words: Sequence[str]) -> frozenset[str]:
    """The words of a text, and its pairs of neighbors, with those at its ends."""
    framed = (_START, *words, _END)
    pairs = (f"{one} {other}" for one, other in pairwise(framed))
    return frozenset((*words, *pairs))
