"""Two recognizers, of which the second must agree: fewer false alarms for twice the work."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from hri.core.errors import HriError
from hri.hal.recognizer import Alternative, Grammar, Hypothesis, Recognizer, Segment
from hri.speech.grammar import Grammar as WrittenGrammar
from hri.speech.grammar.matching import parse
from hri.speech.recognizers.delegating import DelegatingRecognizer


class ConsensusRecognizer(DelegatingRecognizer):
    """Hears what the recognizer `first` hears, as far as the recognizer `second` hears it as well.

    Words of the second that mean something else, or none, are an alternative of share 1: nothing
    is left of the confidence. Both are ids of other recognizers of the configuration.
    """

    parameters = ("first", "second")

    def _open(self) -> None:
        self.engine, self.second = (self._named(name) for name in self.parameters)
        self._grammar: Grammar | None = None

    def _named(self, parameter: str) -> Recognizer:
        id = self.description.text(parameter)
        if id in ("", self.id):
            remedy = "name another recognizer of the configuration"
            raise self.description.error(parameter, f"no {parameter} recognizer", remedy)
        return self.use(id, Recognizer)

    def start(self, grammar: Grammar) -> None:
        # What one refuses must not be in force for the other, or they would never agree again.
        self.second.start(grammar)
        try:
            self.engine.start(grammar)
        except HriError:
            if self._grammar is not None:
                self.second.start(self._grammar)
            raise
        self._grammar = grammar

    def decode(self, segment: Segment, rules: Collection[str] | None = None) -> Hypothesis:
        heard = self.engine.decode(segment, rules)
        if segment.samples is None or not heard.text:
            return heard
        other = self.second.decode(segment, rules).text
        if self._is_the_same(heard.text, other):
            return heard
        return replace(heard, alternatives=(Alternative(other, 1.0),))

    def _is_the_same(self, text: str, other: str) -> bool:
        """Whether two texts mean the same, be it in other words."""
        if text == other or not isinstance(self._grammar, WrittenGrammar):
            return text == other
        one, another = parse(self._grammar, text), parse(self._grammar, other)
        return one is not None and another is not None and one.means_the_same(another)

    def describe(self) -> str:
        return f"{self.engine.id}, unless {self.second.id} hears something else"
