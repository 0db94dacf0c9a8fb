"""What people may say to a question, beside the sentences of its grammar.

Around an answer there may be what `<asking.before>` and `<asking.after>` say, and any other words:
to "Which size?", "um a large one please with ham" is "large". `<asking.cancel>` and `<asking.none>`
end the question, `<asking.again>` has it said again; a sentence that the grammar has itself is its
own.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

from hri.core import paths
from hri.speech.grammar import Grammar, Rule, load_grammar
from hri.speech.grammar.analysis import settled
from hri.speech.grammar.doc_comments import DocTag
from hri.speech.grammar.expressions import Alternative, Anything, RuleReference, Sequence, Token
from hri.speech.grammar.fold import Fold
from hri.speech.grammar.framing import framed
from hri.speech.grammar.lint.audibility import FEWEST_PHONES
from hri.speech.grammar.merging import with_parts_of
from hri.speech.language import is_other_language
from hri.speech.pronunciation.lexicon import Lexicon, load_lexicon

SHARED = "asking.jsgf"
"""The grammar with what every question lets people say, which is English."""
CANCEL, CANCEL_AMONG, AGAIN = "asking.cancel", "asking.cancel_among", "asking.again"
UNSURE = "asking.unsure"
REFUSING = (CANCEL, CANCEL_AMONG, UNSURE, "asking.none")
"""Rules of what ends the question without an answer."""
BEFORE, AFTER = "asking.before", "asking.after"
"""Rules of what may be said around an answer."""
CORRECTING = "asking.correcting"
"""The rule of what may be said before an answer that replaces another one."""
EXACT = frozenset(("careful", "interrupts"))
"""Marks of rules that never count among other words unless they are marked so."""


def answering(grammar: Grammar, before: str = BEFORE) -> Grammar:
    """The grammar as it is heard while its question is open; in other languages as it is.

    `before` is the rule of what may be said before an answer.

    Its rules count @anywhere, except those that move the robot or interrupt, and those that have a
    sentence of fewer than FEWEST_PHONES sounds: "two" is heard in all kinds of speech. Numbers
    were found in 45 of 104 spoken sentences that did not answer, sizes of pizza in 3 of 80.
    """
    if is_other_language(grammar):
        return grammar
    found = with_parts_of(grammar, load_grammar(paths.house() / "grammars" / SHARED))
    lexicon = load_lexicon()
    sounds = settled(found, math.inf, lambda rule, known: _Sounds(known, lexicon)(rule.expression))
    rules = dict(found.rules)
    for key in grammar.public_rules:
        is_exact = sounds[key] < FEWEST_PHONES or not EXACT.isdisjoint(rules[key].marks)
        rules[key] = _as_answer(rules[key], before, is_exact)
    for key in (*REFUSING, AGAIN):
        rules[key] = replace(rules[key], is_public=True)
    return replace(found, rules=rules)


def _as_answer(rule: Rule, before: str, is_exact: bool) -> Rule:
    first, last = (RuleReference(key, rule.span) for key in (before, AFTER))
    marks = () if is_exact else (DocTag("anywhere", "", rule.span),)
    expression = framed(rule.expression, first, last)
    return replace(rule, expression=expression, doc_tags=(*rule.doc_tags, *marks))


class _Sounds(Fold[float]):
    """The phones of the shortest sentence; a word of no dictionary is taken for long enough."""

    def __init__(self, rules: Mapping[str, float], lexicon: Lexicon) -> None:
        """`rules` are those of the rules."""
        self._rules, self._lexicon = rules, lexicon

    def word(self, node: Token) -> float:
        return min(map(len, self._lexicon.known(node.text)), default=FEWEST_PHONES)

    def anything(self, node: Anything) -> float:
        return 0.0

    def reference(self, node: RuleReference) -> float:
        return self._rules.get(node.name, math.inf)

    def row(self, node: Sequence, parts: Iterator[float]) -> float:
        return sum(parts)

    def choice(self, node: Alternative, parts: Iterator[float]) -> float:
        return min(parts, default=math.inf)
