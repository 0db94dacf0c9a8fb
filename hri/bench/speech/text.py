"""How fast a grammar's text is checked, and a sentence is found in it."""

from __future__ import annotations

import random
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from hri.bench.speech import samples
from hri.bench.speech.samples import ROBOT
from hri.bench.table import Row, amount, at_most
from hri.speech.grammar import Grammar, load_grammar, read_grammar
from hri.speech.grammar.expansion import random_sentence
from hri.speech.grammar.lint.linter import check
from hri.speech.grammar.matching import parse

RULES = 1000
SENTENCES = 2000


def rows() -> Iterator[Row]:
    """Parsing and checking."""
    grammar = load_grammar(ROBOT)
    own = median_s(lambda sentence: parse(grammar, sentence), sentences(grammar))
    yield amount("parse a sentence, median", own * 1e6, "us", at_most(100.0))
    yield amount(f"check a grammar of {RULES} rules", _check_s(), "s", at_most(0.2))


def sentences(grammar: Grammar) -> list[str]:
    """Different sentences of a grammar, the same in every run."""
    chance = random.Random(0)
    return list({random_sentence(grammar, chance): None for _ in range(SENTENCES)})


def median_s(find: Callable[[str], object], sentences: list[str]) -> float:
    """Seconds for one sentence; each is met once, and must be found."""
    find(sentences[0])  # what is made at the first time
    taken = []
    for sentence in sentences:
        begun = time.perf_counter()
        found = find(sentence)
        taken.append(time.perf_counter() - begun)
        assert found is not None, sentence
    return float(np.median(taken))


def _check_s() -> float:
    """Seconds of the processor, the median of five."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "many.jsgf"
        path.write_text(many_rules(RULES))
        taken = []
        for _ in range(5):
            begun = time.process_time()
            grammar, errors = read_grammar(path)
            findings = check(grammar)
            taken.append(time.process_time() - begun)
            assert not errors
            assert not [finding for finding in findings if finding.severity == "error"]
    return float(np.median(taken))


def many_rules(count: int) -> str:
    """A grammar with a number of rules: half are commands, the others the names they are about."""
    names = samples.names(count // 2)
    lines = ["#JSGF V1.0;", "grammar many;"]
    for number, name in enumerate(names):
        lines.append(f"/** Meets {name}. */")
        lines.append(f"public <meet{number}> = [please] (find | meet) <name{number}> [now];")
        lines.append(f'<name{number}> = {name} {{who="{name}"}} | mister {name.split()[1]};')
    return "\n".join(lines) + "\n"
