"""`hri grammar listen`: recognizes speech from files, the microphone or the keyboard."""

from __future__ import annotations

import argparse
import json
import math
import shutil
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import Any, TextIO

import numpy as np

from hri.cli.grammar import FILE_HELP
from hri.cli.grammar.engine import add_engine_arguments, add_strictness, started_engine
from hri.core import registry
from hri.core.clock import RealClock
from hri.core.errors import HriError, NotAvailable
from hri.core.quoting import escaped, report
from hri.core.signals import Rejection, Samples, Utterance
from hri.hal.audio_level import QUIETEST
from hri.hal.drivers.channels import CHOICES
from hri.hal.drivers.recording_level import loudest
from hri.hal.drivers.wav_file import load_sound
from hri.hal.microphone import Microphone
from hri.hal.recognizer import Recognizer, Segment
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.automatic_level import too_quiet
from hri.speech.grammar import Grammar, load_grammar
from hri.speech.grammar.tags import spell_tags
from hri.speech.hearing import hear
from hri.speech.recognizers.typed import TypedRecognizer
from hri.speech.turn import Turn
from hri.speech.turn_taking import TurnTaking
from hri.speech.understanding import SILENT_AFTER, Heard, understand

EXAMPLES = """\
examples:
  hri grammar listen companion                       speak; Ctrl-C ends it
  hri grammar listen companion --wav a.wav b.mp3     recordings, each of any number of sentences
  hri grammar listen my.jsgf --wav *.wav --json      one object per piece of speech
  hri grammar listen my.jsgf --typed < lines.txt

The objects: file, start_s and end_s (seconds from its beginning), accepted, text, rule, tags,
confidence, reason (empty, or why it was not accepted), latency_s, and with low confidence sure (the
tags that are certain nevertheless), unsure (the names of those that are not) and choices (two
commands that are as likely), level_dbfs (of the loudest tenth of a second; null for typed lines).
Put FILE before --wav, which takes all the paths that follow it.

Status 0: everything was accepted. 1: something was not. 2: a file is wrong."""

METER = 20
"""Characters of the level meter."""
TICK = 0.1
"""Seconds between reads of the microphone."""
LONGEST_LINE = 1000
"""Characters of a typed line; a longer one counts as several."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE", help=FILE_HELP)
    source = parser.add_mutually_exclusive_group()
    source.add_argument(
        "--wav", nargs="+", type=Path, metavar="F", help="recordings, processed as fast as possible"
    )
    source.add_argument("--mic", action="store_true", help="microphone (default source)")
    source.add_argument("--typed", action="store_true", help="lines of the standard input")
    add_engine_arguments(parser)
    parser.add_argument("--device", default="", help="the microphone, by number or part of name")
    parser.add_argument(
        "--channel", choices=CHOICES, default=CHOICES[0], help="side of a stereo sound"
    )
    add_strictness(parser)
    parser.add_argument("--json", action="store_true", help="print one JSON object per line")
    parser.add_argument(
        "--question",
        action="store_true",
        help="a question is open: rules marked @answer are active",
    )


def run(options: argparse.Namespace) -> int:
    grammar = load_grammar(options.file)
    show = _show_json if options.json else _show
    turn = Turn(is_question_open=options.question)
    if options.typed:
        return _hear_lines(grammar, turn, options.strictness, show)
    with started_engine(options, grammar) as engine:
        if options.wav:
            return _hear_files(options, engine, grammar, turn, show)
        return _hear_microphone(options, engine, grammar, turn, show)


Show = Callable[[str, Heard], object]
"""Prints the results of a file, as text or JSON."""


def _hear_files(
    options: argparse.Namespace, engine: Recognizer, grammar: Grammar, turn: Turn, show: Show
) -> int:
    """Exit status 0 when all speech was accepted, 1 when not, 2 when a file could not be read."""
    status = 0
    for path in options.wav:
        try:
            samples, rate = load_sound(path, engine.rate, options.channel)
        except HriError as error:
            _complain(error)
            status = 2
            continue
        heard = list(
            hear(samples, rate, engine, grammar, options.strictness, turn, stopwatch=perf_counter)
        )
        for one in heard or [_nothing(samples, rate)]:
            show(str(path), one)
            if isinstance(one, Rejection):
                status = max(status, 1)
    return status


def _nothing(samples: Samples, rate: int) -> Rejection:
    """The result for a recording without speech."""
    level = round(loudest(samples, rate), 1)
    detail = too_quiet(level)
    return Rejection("no speech", end=len(samples) / rate, detail=detail, level_db=level)


def _hear_lines(grammar: Grammar, turn: Turn, strictness: float, show: Show) -> int:
    with ResourceManager((), RealClock()) as manager:
        keyboard = TypedRecognizer(Description("keyboard", "Hri.Typed"), manager)
        keyboard.activate()
        keyboard.start(grammar)
        status = 0
        while line := sys.stdin.readline(LONGEST_LINE):
            if words := line.strip():
                segment = Segment(0.0, 0.0, text=words)
                heard = understand(keyboard, grammar, segment, strictness, turn, perf_counter)
                show("", heard)
                status = max(status, int(isinstance(heard, Rejection)))
    return status


def _hear_microphone(
    options: argparse.Namespace, engine: Recognizer, grammar: Grammar, turn: Turn, show: Show
) -> int:
    """Until Ctrl-C."""
    clock = RealClock()
    with ResourceManager((), clock, notice=_complain) as manager:
        microphone = _open_microphone(options, manager)
        status_line = _StatusLine(sys.stderr)
        try:
            ear = microphone.listen(engine.rate)
            turns = TurnTaking(engine)
            while True:
                clock.advance(TICK)
                samples = ear.read(clock.now())
                for segment in engine.listen(samples, clock.now()):
                    begun = perf_counter()
                    reading = turns.end(segment, grammar, options.strictness, turn)
                    status_line.clear()
                    for heard in reading.heard:
                        show("", replace(heard, latency=perf_counter() - begun))
                words = _words_so_far(engine, turns, grammar, turn, options.strictness)
                status_line.show(samples, words, is_hearing=engine.is_hearing)
        except KeyboardInterrupt:
            status_line.clear()
            return 0
        finally:
            microphone.deactivate()


def _words_so_far(
    engine: Recognizer, turns: TurnTaking, grammar: Grammar, turn: Turn, strictness: float
) -> str:
    segment = engine.open_segment
    if segment is None:
        return ""
    if segment.quiet < SILENT_AFTER:
        return engine.advance(segment, turn.rules(grammar))
    reading = turns.read(segment, grammar, strictness, turn)
    engine.wait(segment, reading.pauses)
    return reading.heard[-1].text if reading.heard else ""


def _open_microphone(options: argparse.Namespace, manager: ResourceManager) -> Microphone:
    driver: Any = registry.find("hri.resources", "Hri.Microphone")
    parameters = {"device": options.device, "channel": options.channel}
    microphone: Microphone = driver(
        Description("microphone", "Hri.Microphone", parameters), manager
    )
    try:
        microphone.activate()
    except NotAvailable as error:
        if options.mic:
            raise
        raise NotAvailable(f"{error}; or hear --wav F, or --typed lines") from error
    return microphone


class _StatusLine:
    """Level meter and the words so far, in one line that is overwritten; for terminals only."""

    def __init__(self, out: TextIO) -> None:
        self._out = out if out.isatty() else None

    def show(self, samples: Samples, words: str, *, is_hearing: bool) -> None:
        if self._out is None or not len(samples):
            return
        power = float(np.mean(samples.astype(np.float64) ** 2)) / 32768.0**2
        level = 10.0 * math.log10(max(power, 1e-12))
        bar = "#" * round(METER * min(1.0, max(0.0, 1.0 - level / QUIETEST)))
        sign = "*" if is_hearing else " "
        line = f"[{bar:<{METER}}] {level:4.0f} dB {sign} "
        room = shutil.get_terminal_size().columns - len(line) - 1
        # The most recent words are at the end.
        self._out.write(f"\r\x1b[K{line}{escaped(words[-room:]) if room > 0 else ''}")
        self._out.flush()

    def clear(self) -> None:
        if self._out is not None:
            self._out.write("\r\x1b[K")
            self._out.flush()


def _show(file: str, heard: Heard) -> None:
    place = f"{file} {heard.start:.2f}-{heard.end:.2f} s: " if file else ""
    if isinstance(heard, Utterance):
        tags = spell_tags(heard.tags)
        meaning = f"{heard.rule}: {heard.text}" + (f" {{{tags}}}" if tags else "")
        report(f"{place}{meaning}  ({heard.confidence:.2f})", flush=True)
        return
    words = f' "{heard.text}" ({heard.confidence:.2f})' if heard.text else ""
    detail = f" - {heard.detail}" if heard.detail else ""
    report(f"{place}{heard.reason}{words}{detail}", flush=True)


def _show_json(file: str, heard: Heard) -> None:
    accepted = heard if isinstance(heard, Utterance) else None
    rejected = heard if isinstance(heard, Rejection) else None
    line = {
        "file": file,
        "start_s": round(heard.start, 3),
        "end_s": round(heard.end, 3),
        "accepted": accepted is not None,
        "text": heard.text,
        "rule": accepted.rule if accepted else "",
        "tags": dict(accepted.tags) if accepted else {},
        "confidence": round(heard.confidence, 4),
        "reason": rejected.reason if rejected else "",
        "latency_s": round(heard.latency, 4),
        "sure": dict(rejected.sure) if rejected else {},
        "unsure": list(rejected.unsure) if rejected else [],
        "choices": list(rejected.choices) if rejected else [],
        "begun": rejected.begun if rejected else "",
        "may_go_on": bool(accepted and accepted.may_go_on),
        "continues": bool(accepted and accepted.continues),
        "level_dbfs": heard.level_db,
    }
    print(json.dumps(line), flush=True)


def _complain(what: object) -> None:
    report(str(what), sys.stderr)
