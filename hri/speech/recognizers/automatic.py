"""The best recognizer this machine has."""

from __future__ import annotations

from collections.abc import Iterator

from hri.core.errors import NotAvailable
from hri.hal.recognizer import Recognizer
from hri.speech.recognizers.ctc.decoder import CtcRecognizer
from hri.speech.recognizers.delegating import DelegatingRecognizer
from hri.speech.recognizers.pocketsphinx import PocketSphinxRecognizer
from hri.speech.recognizers.vosk import VoskRecognizer, find_model


class AutomaticRecognizer(DelegatingRecognizer):
    """Our own where its weights are, else Vosk where a model directory is, else PocketSphinx."""

    parameters = tuple({*CtcRecognizer.parameters, *VoskRecognizer.parameters})

    def _open(self) -> None:
        missing: NotAvailable | None = None
        for driver in self._drivers():
            engine = driver(self.description, self.manager)
            try:
                engine.activate()
            except NotAvailable as error:
                missing = missing or error
                continue
            self.engine = engine
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
        self.engine.deactivate()

    def describe(self) -> str:
        return f"{type(self.engine).__name__}, chosen automatically"
