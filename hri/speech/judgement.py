"""Whether what an engine made of a sound counts: our own parser and the strictness decide."""

from __future__ import annotations

from collections.abc import Collection

from hri.core.signals import Rejection, Utterance
from hri.hal.recognizer import Hypothesis, Segment
from hri.speech.grammar import Grammar
from hri.speech.grammar.matching import parse


def judge(
    grammar: Grammar,
    segment: Segment,
    hypothesis: Hypothesis,
    strictness: float,
    only: Collection[str] | None = None,
) -> Utterance | Rejection:
    """The utterance, or why it is none. While the robot speaks, `only` these rules count."""
    found = parse(grammar, hypothesis.text)
    reason = ""
    if not hypothesis.text:
        reason = "no speech"
    elif only is not None and (found is None or found.rule not in only):
        reason = "robot speaking"
    elif found is None:
        reason = "not in grammar"
    elif hypothesis.confidence < strictness:
        reason = "low confidence"
    if reason or found is None:
        return Rejection(reason, hypothesis.text, hypothesis.confidence, segment.start, segment.end)
    return Utterance(
        found.text, found.rule, found.tags, hypothesis.confidence, segment.start, segment.end
    )
