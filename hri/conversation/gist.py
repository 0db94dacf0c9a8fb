"""What a sentence that no rule allows seems to be about: the rule whose words are nearest to it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

from hri.speech.grammar import analysis
from hri.speech.grammar.numerals import NUMERALS
from hri.speech.grammar.rules import Rules
from hri.speech.grammar.words import normalize

# fmt: off
LITTLE = NUMERALS.union((
    "a", "about", "again", "all", "also", "am", "an", "and", "another", "any", "are", "as", "at",
    "be", "because", "been", "bring", "but", "by", "can", "can't", "cannot", "could", "did",
    "didn't", "do", "does", "doesn't", "don't", "ever", "for", "from", "get", "give", "go", "going",
    "got", "had", "has", "have", "he", "he's", "her", "here", "hey", "him", "his", "how", "i",
    "i'd", "i'll", "i'm", "i've", "if", "in", "into", "is", "isn't", "it", "it's", "its", "just",
    "keep", "kindly", "know", "let", "let's", "like", "make", "may", "me", "mean", "meant",
    "more", "much", "my", "nah", "no", "nope", "not", "now", "of", "off", "oh", "ok", "okay",
    "on", "once", "one", "or", "other", "our", "out", "please", "put", "really", "said", "she",
    "she's", "should", "so", "some", "sorry", "still", "take", "than", "that", "that's", "the",
    "them", "then", "there", "these", "they", "they're", "thing", "things", "think", "this", "to",
    "too", "up", "us", "very", "wait", "want", "was", "we", "we're", "well", "were", "what",
    "what's", "when", "where", "which", "who", "who's", "why", "will", "with", "won't", "would",
    "wrong", "yes", "you", "you'll", "you're", "your",
))
# fmt: on
"""Words that say nothing about the subject."""
LEAST_SHARE = 0.5
"""Share of the telling words of a sentence that a rule must have to be the subject."""
MOST_RULES = 3
"""A word that more rules have does not tell one from another, unless it is in an example."""
ENDINGS = ("ing", "ed", "s")


@dataclass(frozen=True)
class Gist:
    """The telling words of each public rule of a grammar."""

    words: Mapping[str, frozenset[str]]
    """By rule, without their endings."""
    shared: frozenset[str]
    """All words of these rules, as they are written."""
    known: frozenset[str]
    """All words of the grammar, as they are written."""

    @classmethod
    def of(cls, grammar: Rules) -> Gist:
        """The words of a grammar.

        Those of answers, of courtesies, and of what follows a command say nothing of a subject.
        What is only typed stands for a command that has other words.
        Small talk, whose rules have a topic, is about everything, and is not what people grope for.
        """
        answers, follow_ups = grammar.marked("answer"), grammar.marked("after")
        rules = [rule for rule in grammar.public_rules if rule not in answers]
        known = {rule: analysis.words_of(grammar.rules, [rule]) for rule in rules}
        typed = grammar.marked("typed")
        own = [rule for rule in rules if rule not in typed and not grammar.rules[rule].topics]
        every = {rule: known[rule] for rule in own}
        telling = {rule: words - LITTLE for rule, words in every.items() if rule not in follow_ups}
        stems = {rule: frozenset(map(stem, words)) for rule, words in telling.items()}
        spread = Counter(stem for words in stems.values() for stem in words)
        rare = {stem for stem, count in spread.items() if count <= MOST_RULES}
        return cls(
            {rule: words & (rare | _first_example(grammar, rule)) for rule, words in stems.items()},
            frozenset().union(*every.values()),
            frozenset().union(*known.values()),
        )

    def rule_of(self, text: str) -> str:
        """The rule that a text is most likely about; empty when it may be about anything."""
        spread = Counter(stem for words in self.words.values() for stem in words)
        # A word that many rules have does not show another subject, one of small talk does.
        stems = [
            stem(word)
            for word in normalize(text)
            if word not in LITTLE and (stem(word) in spread or word not in self.shared)
        ]
        scores = {
            rule: sum(1 / spread[stem] for stem in stems if stem in words)
            for rule, words in self.words.items()
            if sum(stem in words for stem in stems) >= LEAST_SHARE * len(stems)
        }
        ranked = sorted(scores, key=lambda rule: -scores[rule])
        is_tied = len(ranked) > 1 and scores[ranked[0]] == scores[ranked[1]]
        return ranked[0] if ranked and scores[ranked[0]] > 0 and not is_tied else ""

    def strange(self, text: str) -> list[str]:
        """The words of a text that no rule has, in order."""
        return [word for word in dict.fromkeys(normalize(text)) if word not in self.known | LITTLE]


def _first_example(grammar: Rules, rule: str) -> set[str]:
    """What a rule is about in any case: "turn left" is about turning, whatever else is turned."""
    return {stem(word) for text in grammar.rules[rule].examples[:1] for word in normalize(text)}


def stem(word: str) -> str:
    """A word without an ending: "turning" is "turn"."""
    for ending in ENDINGS:
        if word.endswith(ending) and len(word) - len(ending) >= 3:
            return word.removesuffix(ending)
    return word
