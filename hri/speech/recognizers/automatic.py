"""The best recognizer this machine has."""

from __future__ import annotations

from collections.abc import Iterator

from hri.core.errors import NotAvailable
from hri.hal.recognizer import Grammar, Recognizer
from hri.speech.language import is_other_language
from hri.speech.recognizers.ctc.decoder import CtcRecognizer
from hri.speech.recognizers.delegating import DelegatingRecognizer
from hri.speech.recognizers.pocketsphinx import PocketSphinxRecognizer
from hri.speech.recognizers.vosk import VoskRecognizer, find_model


class AutomaticRecognizer(DelegatingRecognizer):
    """Our own where its weights are, else Vosk where a model directory is, else PocketSphinx.

    For a grammar in another language than English Vosk, where a model directory is.
    """

    parameters = tuple({*CtcRecognizer.parameters, *VoskRecognizer.parameters})

    _usual: Recognizer
    _foreign: Recognizer | None = None
    """Vosk beside it, once a grammar needed it."""

    def start(self, grammar: Grammar) -> None:
        engine = self._fitting(grammar)
        engine.start(grammar)
        self.engine = engine

    def _fitting(self, grammar: Grammar) -> Recognizer:
        if isinstance(self._usual, VoskRecognizer) or not is_other_language(grammar):
            return self._usual
        if self._foreign is None and (self.description.text("model") or find_model()):
            foreign = VoskRecognizer(self.description, self.manager)
            foreign.activate()
            self._foreign = foreign
        return self._foreign or self._usual

    def _open(self) -> None:
        self._foreign = None
        missing: NotAvailable | None = None
        for driver in self._drivers():
            engine = driver(self.description, self.manager)
            try:
                engine.activate()
            except NotAvailable as error:
                missing = missing or error
                continue
            self.engine = self._usual = engine
            if missing is not None:
                self.manager.notice(f"{missing} (using {driver.__name__} instead)")
            return
        assert missing is not None
        raise missing

    def _drivers(self) -> Iterator[type[Recognizer]]:
        yield CtcRecognizer
        if self.description.text("model") or find_model():
            yield VoskRecognizer
        yield PocketSphinxRecognizer

    def _close(self) -> None:
        self._usual.deactivate()
        if self._foreign is not None:
            self._foreign.deactivate()

    def describe(self) -> str:
        return f"{type(self.engine).__name__}, chosen automatically"
