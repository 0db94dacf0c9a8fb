"""The recognizer of CMU: its English model comes inside the wheel, so it works at once."""

from __future__ import annotations

import json
import subprocess
import threading
from collections.abc import Collection
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from hri.core import child
from hri.core.errors import HriError
from hri.core.signals import Samples
from hri.hal.recognizer import Grammar, HeardWord, Hypothesis, Segment
from hri.speech.engine_models import find_pocketsphinx
from hri.speech.grammar.words import free_words
from hri.speech.language import require_english
from hri.speech.path_confidence import FRAME, PathFigures, confidence
from hri.speech.pronunciation.lexicon import Lexicon, load_lexicon
from hri.speech.recognizers.endpointed import EndpointedRecognizer

NOISE_FLOOR = 20.0
"""Standard deviation of the noise laid under all sound, of 32767."""
KEPT_QUIET = 0.1
"""Seconds of the pause behind the voice that the decoder gets: more of it it fills with words."""
PATIENCE = 30.0
"""Seconds for an answer, then the process is ended: the longest piece of speech takes 6."""
_PROGRAM = Path(__file__).with_name("decoding_process.py")


class PocketSphinxRecognizer(EndpointedRecognizer):
    """Decodes finished pieces of speech in a separate process, so that nothing waits for it."""

    def _open(self) -> None:
        find_pocketsphinx()
        super()._open()
        self._process: subprocess.Popen[bytes] | None = None
        self._taken: _Taken | None = None
        self._talk = threading.Lock()

    def start(self, grammar: Grammar) -> None:
        require_english(grammar, self.manager.notice)
        with self._talk:
            words = sorted(word for word in grammar.graph().words if free_words(word) is None)
            missing = self._ask({"lookup": words})["missing"]
            self._take(
                grammar, _pronunciations(load_lexicon(), words, missing), _while_idle(grammar)
            )

    def _take(
        self, grammar: Grammar, pronunciations: dict[str, str], rules: frozenset[str] | None
    ) -> None:
        """Let the process listen for these rules alone: each of its frames takes as long as the
        grammar is large, and the answers to questions make that of the companion six times as
        large.
        """
        request = {"jsgf": grammar.flat_jsgf(rules), "pronunciations": pronunciations}
        answer = self._ask(request)
        if answer["error"]:
            what = f'PocketSphinx refuses the grammar "{grammar.name}": {answer["error"]}'
            raise HriError(f"{what} - try `hri grammar check`")
        self._taken = _Taken(grammar, pronunciations, rules, request)

    def _decode(
        self, segment: Segment, samples: Samples, rules: Collection[str] | None
    ) -> Hypothesis:
        samples = samples[: len(samples) - round(max(0.0, segment.quiet - KEPT_QUIET) * self.rate)]
        sound = with_floor(samples).tobytes()
        active = None if rules is None else frozenset(rules)
        with self._talk:
            if (taken := self._taken) is None:
                raise self.not_available("it has no grammar", "call start with a grammar first")
            try:
                if taken.rules != active:
                    self._take(taken.grammar, taken.pronunciations, active)
                answer = self._ask({"bytes": len(sound)}, sound)
            except _TooSlow:
                # The next piece may well be another thing; this one would only hang again.
                return Hypothesis("", 0.0)
        words = answer["words"]
        figures = PathFigures(
            score=answer["score"],
            word_frames=sum(frames for _, _, frames in words),
            frames=round(len(samples) / self.rate / FRAME),
        )
        end = len(samples) / self.rate  # the last window of the decoder may reach beyond it
        heard = tuple(
            HeardWord(word, first * FRAME, min(end, (first + frames) * FRAME))
            for word, first, frames in words
        )
        return Hypothesis(" ".join(word.text for word in heard), confidence(figures), heard)

    def _ask(self, request: dict[str, Any], payload: bytes = b"") -> dict[str, Any]:
        """The process's answer; when it died, a new one gets the grammar and is asked again.

        Raises _TooSlow when it does not answer in time.
        """
        for _ in range(2):
            try:
                if self._process is None:
                    self._process = _new_process()
                    if self._taken is not None:
                        _exchange(self._process, self._taken.request)
                answer = _exchange(self._process, request, payload)
            except _TooSlow:
                self._end_process()
                raise
            if answer is not None:
                return answer
            self._end_process()
        raise self.not_available("the decoder ends unexpectedly", "reinstall pocketsphinx")

    def _end_process(self) -> None:
        process, self._process = self._process, None
        if process is not None and process.stdin is not None and process.stdout is not None:
            with suppress(OSError):  # It may have ended before it read all.
                process.stdin.close()
            process.stdout.close()
            process.wait()

    def _close(self) -> None:
        with self._talk:
            self._end_process()


@dataclass(frozen=True)
class _Taken:
    """What the process listens for."""

    grammar: Grammar
    pronunciations: dict[str, str]
    """Those that it was given."""
    rules: frozenset[str] | None
    request: dict[str, Any]
    """What a new process is asked first."""


class _TooSlow(HriError):
    """The process did not answer in time, and was ended."""


def _while_idle(grammar: Grammar) -> frozenset[str] | None:
    """The rules that count while no question is open; all where there are no others."""
    graph = grammar.graph()
    return frozenset(graph.entries.keys() - graph.expected) or None


def _pronunciations(lexicon: Lexicon, words: list[str], missing: list[str]) -> dict[str, str]:
    """What the engine's own dictionary lacks: words it does not know, and the user's ways of saying
    others. Beyond the first way of a word it wants a number, or whatever, in brackets behind it.
    """
    told = {}
    for word in words:
        if word in missing or lexicon.origin(word) == "user":
            for number, phones in enumerate(lexicon.pronunciations(word), 1):
                is_first = word in missing and number == 1
                told[word if is_first else f"{word}(own{number})"] = " ".join(phones)
    return told


def with_floor(samples: Samples) -> Samples:
    """The sound with faint noise under it, always the same.

    The model has never met digital silence; synthetic voices and gated microphones have it around
    their words, and a third of those words was lost without this.
    """
    noise = np.random.default_rng(0).normal(0.0, NOISE_FLOOR, len(samples))
    return np.clip(samples + noise, -32768, 32767).astype(np.int16)


def _new_process() -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        child.command(_PROGRAM),
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env=child.environment(),
    )


def _exchange(
    process: subprocess.Popen[bytes], request: dict[str, Any], payload: bytes = b""
) -> dict[str, Any] | None:
    """Send a request and wait for the answer; None when the process has ended.

    Raises _TooSlow, and ends it, when there is none in time.
    """
    assert process.stdin is not None
    assert process.stdout is not None
    try:
        process.stdin.write(json.dumps(request).encode() + b"\n" + payload)
        process.stdin.flush()
    except OSError:
        return None
    is_late = threading.Event()

    def give_up() -> None:
        is_late.set()
        process.kill()

    patience = threading.Timer(PATIENCE, give_up)
    patience.start()
    try:
        line = process.stdout.readline()
    finally:
        patience.cancel()
    if is_late.is_set():
        raise _TooSlow(f"PocketSphinx gives no answer in {PATIENCE:g} s - try a smaller grammar")
    return json.loads(line) if line else None
