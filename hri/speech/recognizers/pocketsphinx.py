"""The recogniser of CMU: its English model comes inside the wheel, so it works at once."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
from collections.abc import Mapping
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from hri.core.errors import HriError
from hri.core.signals import Samples
from hri.hal.recognizer import Grammar, Hypothesis, Recognizer, Segment
from hri.speech.confidence import FRAME, PathFigures, confidence
from hri.speech.endpoint import Endpointer
from hri.speech.pronunciation.letter_to_sound import pronounce
from hri.speech.recognizers.voice_activity import VoiceActivityEndpointer

NOISE_FLOOR = 20.0
"""Standard deviation of the noise laid under all sound, of 32767."""
_PROGRAM = Path(__file__).with_name("decoding_process.py")


@cache
def dictionary() -> Mapping[str, tuple[str, ...]]:
    """Phones of the 125,000 English words that the engine knows (CMU dictionary)."""
    from pocketsphinx import get_model_path

    known: dict[str, tuple[str, ...]] = {}
    with open(get_model_path("en-us/cmudict-en-us.dict"), encoding="utf-8") as lines:
        for line in lines:
            word, *phones = line.split()
            known.setdefault(word, tuple(phones))
    return known


class PocketSphinxRecognizer(Recognizer):
    """Decodes finished pieces of speech in a process of its own, so that nothing waits for it."""

    def _open(self) -> None:
        self._endpointer: Endpointer = VoiceActivityEndpointer(self.rate)
        self._process: subprocess.Popen[bytes] | None = None
        self._grammar_request: dict[str, Any] | None = None
        self._talk = threading.Lock()

    def start(self, grammar: Grammar) -> None:
        with self._talk:
            missing = self._ask({"lookup": sorted(grammar.words())})["missing"]
            pronunciations = {word: " ".join(pronounce(word)) for word in missing}
            request = {"jsgf": grammar.flat_jsgf(), "pronunciations": pronunciations}
            answer = self._ask(request)
            if answer["error"]:
                what = f'PocketSphinx refuses the grammar "{grammar.name}": {answer["error"]}'
                raise HriError(f"{what} - try `hri grammar check`")
            self._grammar_request = request

    def listen(self, samples: Samples, end: float) -> list[Segment]:
        return self._endpointer.listen(samples, end)

    def flush(self) -> list[Segment]:
        return self._endpointer.flush()

    @property
    def is_hearing(self) -> bool:
        return self._endpointer.is_hearing

    def decode(self, segment: Segment) -> Hypothesis:
        if segment.samples is None:
            return Hypothesis(segment.text, 1.0)
        sound = with_floor(segment.samples).tobytes()
        with self._talk:
            answer = self._ask({"bytes": len(sound)}, sound)
        words = answer["words"]
        figures = PathFigures(
            score=answer["score"],
            word_frames=sum(frames for _, frames in words),
            frames=round(len(segment.samples) / self.rate / FRAME),
        )
        return Hypothesis(" ".join(word for word, _ in words), confidence(figures))

    def _ask(self, request: dict[str, Any], payload: bytes = b"") -> dict[str, Any]:
        """The process's answer; when it died, a new one gets the grammar and is asked again."""
        for _ in range(2):
            if self._process is None:
                self._process = _new_process()
                if self._grammar_request is not None:
                    _exchange(self._process, self._grammar_request)
            answer = _exchange(self._process, request, payload)
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


def with_floor(samples: Samples) -> Samples:
    """The sound with faint noise under it, always the same.

    The model has never met digital silence; synthetic voices and gated microphones have it around
    their words, and a third of those words was lost without this.
    """
    noise = np.random.default_rng(0).normal(0.0, NOISE_FLOOR, len(samples))
    return np.clip(samples + noise, -32768, 32767).astype(np.int16)


def _new_process() -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        # -P: the folder of the script must not hide the package of the same name.
        [sys.executable, "-P", str(_PROGRAM)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
    )


def _exchange(
    process: subprocess.Popen[bytes], request: dict[str, Any], payload: bytes = b""
) -> dict[str, Any] | None:
    """Send a request and wait for the answer; None when the process has ended."""
    assert process.stdin is not None
    assert process.stdout is not None
    try:
        process.stdin.write(json.dumps(request).encode() + b"\n" + payload)
        process.stdin.flush()
    except OSError:
        return None
    line = process.stdout.readline()
    return json.loads(line) if line else None
