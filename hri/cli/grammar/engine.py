"""The recognizer chosen on the command line."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from typing import Any

from hri.cli.terminal.messages import Within
from hri.cli.terminal.progress_line import waiting
from hri.core import registry
from hri.core.clock import RealClock
from hri.core.errors import HriError
from hri.core.quoting import report
from hri.hal.recognizer import Recognizer
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.acceptance import STRICTNESS
from hri.speech.grammar import Grammar

ENGINES = {
    "automatic": "Hri.Recognizer",
    "ctc": "Hri.Ctc",
    "pocketsphinx": "Hri.PocketSphinx",
    "vosk": "Hri.Vosk",
}
"""Recognizers that hear sound, by the names of `--engine`."""


def add_engine_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--engine", choices=ENGINES, default="automatic", help="the recognizer")
    parser.add_argument("--model", default="", metavar="DIR", help="model directory, for Vosk")


def add_strictness(parser: argparse.ArgumentParser) -> None:
    about = f"least confidence to accept, 0 to 1 ({STRICTNESS})"
    limits = Within(float, 0, 1)
    parser.add_argument("--strictness", type=limits, default=STRICTNESS, metavar="X", help=about)


def _engine_of(options: argparse.Namespace) -> str:
    """The engine's name: `--model` implies the engine that can use it."""
    name: str = options.engine
    if options.model and name not in ("automatic", "vosk"):
        raise HriError(f"--engine {name} takes no --model - leave one of them out")
    return "vosk" if options.model else name


@contextmanager
def started_engine(options: argparse.Namespace, grammar: Grammar) -> Iterator[Recognizer]:
    """The recognizer of `options`, listening for a grammar; closed at the end."""
    kind = ENGINES[_engine_of(options)]
    parameters = {"model": options.model} if options.model else {}
    with ResourceManager((), RealClock(), notice=partial(report, file=sys.stderr)) as manager:
        driver: Any = registry.find("hri.resources", kind)
        engine: Recognizer = driver(Description("recognizer", kind, parameters), manager)
        engine.activate()
        try:
            with waiting("compiling the grammar"):
                engine.start(grammar)
            yield engine
        finally:
            engine.deactivate()
