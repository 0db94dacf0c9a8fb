"""The same work by PocketSphinx, Vosk and hassil, in the same run."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from functools import partial
from importlib.metadata import version
from importlib.util import find_spec
from itertools import product

from benchmarks.speech.accuracy import GRAMMARS, ORDERED, UNDERSTOOD, Kind, hear, sounds
from hri.bench.speech.latency import Progress, Work, count_right, real_time_factor, works
from hri.bench.speech.listening import Listen
from hri.bench.speech.samples import ROBOT, Recordings
from hri.bench.speech.text import median_s, sentences
from hri.bench.table import Row, attempted, compared, share
from hri.core.errors import NotAvailable
from hri.speech.grammar import Grammar, load_grammar
from hri.speech.grammar.matching import parse
from hri.speech.recognizers.vosk import find_model

ENGINES = ("pocketsphinx", "vosk")
KINDS: dict[Kind, str] = {"orders": ORDERED, "commands": UNDERSTOOD}
CONDITIONS = ("clean", "12 dB", "6 dB")
EVERY = 4
"""Only every fourth command is said, since PocketSphinx is slow."""


def rows(
    recordings: Recordings | None, listen: Listen, step: int, progress: Progress
) -> Iterator[Row]:
    """Real-time factors, what is understood in noise, and parsing, each against other engines."""
    for work in works(recordings, step):
        for engine in ENGINES:
            what = f"{work.row}, against {engine}"
            progress(what)
            yield from attempted(what, partial(_against, work, engine, listen))
    for engine, kind, condition in product(ENGINES, KINDS, CONDITIONS):
        what = f"{KINDS[kind]}, {condition}, by {engine}"
        progress(what)
        every = step * EVERY if kind == "commands" else step
        count = partial(_understood, what, engine, kind, condition, every, recordings, listen)
        yield from attempted(what, count)
    yield from attempted("parse a sentence, median, against hassil", _hassil)


def _against(work: Work, engine: str, listen: Listen) -> Iterator[Row]:
    """Both engines, one after the other, so that the machine is alike for both."""
    _need(engine)
    said = work.said()
    own, _ = real_time_factor(work.grammar, said, listen)
    other, theirs = real_time_factor(work.grammar, said, partial(listen, engine=engine))
    row = compared(f"{work.row}, against {engine}", own, other, "s/s")
    yield row | {"right_by_other": count_right(said, theirs), "of": len(said)}


def _understood(
    what: str,
    engine: str,
    kind: Kind,
    condition: str,
    every: int,
    recordings: Recordings | None,
    listen: Listen,
) -> Iterator[Row]:
    """What another engine and our own understand of the same clips, and what they mistake."""
    _need(engine)
    said = sounds(recordings, kind, condition, every, draw=1)
    theirs = hear(GRAMMARS[kind], said, partial(listen, engine=engine))
    ours = hear(GRAMMARS[kind], said, listen)
    yield share(what, sum(one.is_right for one in theirs), len(said), None) | {
        "mistaken": sum(one.is_mistaken for one in theirs),
        "right_by_hri": sum(one.is_right for one in ours),
        "mistaken_by_hri": sum(one.is_mistaken for one in ours),
    }


def _need(engine: str) -> None:
    """Raises NotAvailable when an engine cannot run here."""
    if find_spec(engine) is None:
        raise NotAvailable(f"{engine} is not installed - pip install {engine}")
    if engine == "vosk" and find_model() is None:
        raise NotAvailable("no model directory of Vosk - see `hri models`")


def _hassil() -> Iterator[Row]:
    if find_spec("hassil") is None:
        raise NotAvailable("hassil is not installed")
    grammar = load_grammar(ROBOT)
    said = sentences(grammar)
    own, other = median_s(partial(parse, grammar), said), median_s(finder(grammar), said)
    row = compared("parse a sentence, median, against hassil", own * 1e6, other * 1e6, "us")
    yield row | {"hassil": version("hassil")}


def finder(grammar: Grammar) -> Callable[[str], object]:
    """What hassil makes of a sentence; None when it is not of the grammar.

    Apart from tags and weights, both write rules alike. Each public rule is an intent, which is how
    hassil is used and where it is at its fastest.
    """
    import hassil

    lines = re.sub(r"/[\d.e+-]+/ ?|;", "", grammar.flat_jsgf()).splitlines()
    rules = dict(line.split(" = ", 1) for line in lines if " = " in line)
    commands = rules["public <sentence>"].split(" | ")
    intents = hassil.Intents.from_dict(
        {
            "language": "en",
            "intents": {name: {"data": [{"sentences": [rules[name]]}]} for name in commands},
            "expansion_rules": {name.strip("<>"): body for name, body in rules.items()},
        }
    )
    return lambda sentence: hassil.recognize(sentence, intents)
