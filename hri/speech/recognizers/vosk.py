"""Vosk, with a model directory of the user's: any of its languages, any size."""

from __future__ import annotations

import json
import os
import threading
from collections.abc import Callable, Collection
from pathlib import Path
from typing import Any

from hri.core import paths
from hri.core.errors import HriError
from hri.core.models import models_folder
from hri.core.native_path import native_path
from hri.core.signals import Samples
from hri.hal.recognizer import Grammar, HeardWord, Hypothesis, Segment
from hri.speech.engine_models import DOWNLOADS, find_vosk
from hri.speech.language import foreign
from hri.speech.recognizers.endpointed import EndpointedRecognizer

VARIABLE = "HRI_VOSK_MODEL"
DEFAULT_FOLDER = Path("~/.local/share/hri/vosk")
PARTS = ("am/final.mdl", "conf/mfcc.conf")
"""Files that Vosk knows a model by; it looks for the others when it loads them."""
MOST_SENTENCES = 5000
"""Most sentences given to the engine; it learns word pairs from them, so more add little."""


def find_model(folder: str = "") -> Path | None:
    """The model directory: as given, of the environment, the user's, or fetched; None without."""
    for candidate in (folder, os.environ.get(VARIABLE, ""), str(DEFAULT_FOLDER)):
        path = paths.expanded(candidate)
        if candidate and (path / "conf").is_dir():
            return path
    return find_vosk()


class VoskRecognizer(EndpointedRecognizer):
    """Decodes finished pieces of speech; Vosk lets go of the interpreter while it works."""

    parameters = (*EndpointedRecognizer.parameters, "model")

    def _open(self) -> None:
        super()._open()
        folder = self.description.text("model")
        path = find_model(folder)
        if path is None or (folder and path != paths.expanded(folder)):
            what = f"no Vosk model in {folder or models_folder()}"
            remedy = f"hri models fetch {DOWNLOADS[0].name}, or set {VARIABLE}"
            raise self.not_available(what, remedy)
        for part in PARTS:
            if not (path / part).is_file():
                raise self.not_available(f"{path}: {part} is missing", "unpack the model again")
        self._path = path
        self._one = threading.Lock()
        self._model: Any = None
        self._engine: Any = None

    def start(self, grammar: Grammar) -> None:
        import vosk

        with self._one:
            if self._model is None:
                vosk.SetLogLevel(-1)
                try:
                    with native_path(self._path) as name:
                        self._model = vosk.Model(model_path=name)
                except Exception as error:  # That is the class it raises.
                    remedy = "unpack the model again"
                    raise self.not_available(f"{self._path}: {error}", remedy) from error
            phrases = known_sentences(grammar, self._knows)
            # With an empty list Vosk ends the process.
            if not phrases or is_of_another_language(grammar, self._knows):
                what = f'{self._path}: this model lacks most words of "{grammar.name}"'
                raise HriError(f"{what} - take a model of its language, see docs/speech.md")
            # Vosk does not know what JSON escapes.
            told = json.dumps(phrases, ensure_ascii=False)
            self._engine = vosk.KaldiRecognizer(self._model, self.rate, told)
            self._engine.SetWords(True)

    def _knows(self, word: str) -> bool:
        return bool(self._model.vosk_model_find_word(word) >= 0)

    def _decode(
        self, segment: Segment, samples: Samples, rules: Collection[str] | None
    ) -> Hypothesis:
        with self._one:
            self._engine.Reset()
            self._engine.AcceptWaveform(samples.tobytes())
            return hypothesis(json.loads(self._engine.FinalResult()))


def is_of_another_language(grammar: Grammar, knows: Callable[[str], bool]) -> bool:
    """Whether a model lacks most words of a grammar that is not English."""
    words = grammar.words()
    return 2 * sum(map(knows, words)) < len(words) and bool(foreign(grammar))


def known_sentences(grammar: Grammar, knows: Callable[[str], bool]) -> list[str]:
    """The sentences whose words the model all knows: Vosk would silently drop the others' words."""
    known = {word for word in grammar.words() if knows(word)}
    sentences = [sentence.split() for sentence in grammar.sample(MOST_SENTENCES)]
    found = [" ".join(words) for words in sentences if known.issuperset(words)]
    # Words of a large grammar may be in none of those; alone they can at least be heard.
    return found + sorted(known.difference(*sentences))


def hypothesis(result: dict[str, Any]) -> Hypothesis:
    """Vosk's answer with the times of its words, as certain as its least certain one."""
    words = result.get("result", [])
    least = min((float(word["conf"]) for word in words), default=0.0)
    heard = tuple(
        HeardWord(str(word["word"]), float(word["start"]), float(word["end"])) for word in words
    )
    return Hypothesis(str(result.get("text", "")), min(max(least, 0.0), 1.0), heard)
