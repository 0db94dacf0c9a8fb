"""Two recognisers, of which the second must agree: fewer false alarms for twice the work."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from hri.hal.recognizer import Grammar, Hypothesis, Recognizer, Segment
from hri.speech.recognizers.delegating import DelegatingRecognizer

DISAGREEMENT = 0.5
"""What is left of the confidence when the second engine hears other words, or none."""


class VetoRecognizer(DelegatingRecognizer):
    """Hears what the recogniser `first` hears, as far as the recogniser `second` hears it as well.

    Both are ids of other recognisers of the configuration.
    """

    parameters = ("first", "second")

    def _open(self) -> None:
        self.engine, self.second = (self._named(name) for name in self.parameters)

    def _named(self, parameter: str) -> Recognizer:
        id = self.description.text(parameter)
        if id in ("", self.id):
            remedy = "name another recognizer of the configuration"
            raise self.description.error(parameter, f"no {parameter} recognizer", remedy)
        return self.use(id, Recognizer)

    def start(self, grammar: Grammar) -> None:
        self.engine.start(grammar)
        self.second.start(grammar)

    def decode(self, segment: Segment, rules: Collection[str] | None = None) -> Hypothesis:
        heard = self.engine.decode(segment, rules)
        if segment.samples is None or not heard.text:
            return heard
        if self.second.decode(segment, rules).text == heard.text:
            return heard
        return replace(heard, confidence=heard.confidence * DISAGREEMENT)

    def describe(self) -> str:
        return f"{self.engine.id}, unless {self.second.id} hears something else"
