"""`hri grammar expand`: lists the sentences of a grammar."""

from __future__ import annotations

import argparse
import math
import random
from collections.abc import Iterator
from functools import partial

from hri.cli.grammar import FILE_HELP
from hri.cli.terminal.messages import Within
from hri.cli.terminal.progress_line import waiting
from hri.core.errors import HriError, did_you_mean
from hri.core.quoting import report
from hri.speech.grammar import Grammar, load_grammar
from hri.speech.grammar.expansion import (
    ShownWays,
    count_sentences,
    count_ways,
    random_sentence,
    sentences,
)
from hri.speech.grammar.lint.expectations import meaning_of
from hri.speech.grammar.matching import parse
from hri.speech.grammar.tags import spell_tags

EXAMPLES = """\
examples:
  hri grammar expand companion -n 40               the first forty, the commands taking turns
  hri grammar expand companion --rule move --tags  of one command, with their meaning
  hri grammar expand companion --random 20 --seed 7
  hri grammar expand companion --count"""

MOST_STALE = 1000
"""Repeated draws in a row after which sampling gives up."""
MOST_DIGITS = 15
"""Digits of a number that is printed exactly."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE", help=FILE_HELP)
    how = parser.add_mutually_exclusive_group()
    how.add_argument(
        "-n", type=Within(int, 1), default=20, metavar="N", help="how many to list (20)"
    )
    how.add_argument(
        "--random",
        type=Within(int, 1),
        metavar="N",
        help="draw this many different sentences by weight",
    )
    how.add_argument("--count", action="store_true", help="print the number of sentences")
    parser.add_argument("--seed", type=int, default=0, metavar="S", help="random seed (0)")
    parser.add_argument("--rule", metavar="RULE", help="sentences of this rule only")
    parser.add_argument("--tags", action="store_true", help="also print the meaning of each")


def run(options: argparse.Namespace) -> int:
    grammar = load_grammar(options.file)
    rules = _rules(grammar, options.rule)
    if options.count:
        with waiting("counting"):
            told = _count(grammar, rules)
        report(told)
        return 0
    said = _drawn(grammar, rules, options) if options.random is not None else None
    is_part = options.rule is not None and rules[0] not in grammar.public_rules
    tell = (
        partial(_with_tags, grammar.with_commands(rules[:1]))
        if is_part
        else partial(_expected, grammar)
    )
    is_any = False
    for sentence in said or sentences(grammar, rules, options.n, ShownWays):
        is_any = True
        report(tell(sentence) if options.tags else sentence)
    if not is_any:
        raise HriError(f"{grammar.path}: no sentence to list - see `hri grammar check`")
    return 0


def _rules(grammar: Grammar, rule: str | None) -> tuple[str, ...]:
    if rule is None:
        return grammar.public_rules
    name = rule.strip("<>")
    if name not in grammar.rules:
        raise HriError(f"no rule <{name}> - {did_you_mean(name, grammar.rules)}")
    return (name,)


def _drawn(grammar: Grammar, rules: tuple[str, ...], options: argparse.Namespace) -> Iterator[str]:
    chance = random.Random(options.seed)
    seen: set[str] = {""}
    stale = 0
    while len(seen) <= options.random and stale < MOST_STALE:
        sentence = random_sentence(grammar, chance, rules, ShownWays)
        stale = stale + 1 if sentence in seen else 0
        if not stale:
            seen.add(sentence)
            yield sentence


def _count(grammar: Grammar, rules: tuple[str, ...]) -> str:
    ways = count_ways(grammar, rules)
    if ways == float("inf"):
        return "unlimited sentences: there are repeats, recursion, or too many choices to count"
    different = count_sentences(grammar, rules)
    if different is None:
        return f"{in_words(ways)} ways to say something"
    return f"{different:,} sentences, {ways:,} ways to say them"


def in_words(ways: float) -> str:
    """A number from `count_ways` as text."""
    if ways == math.inf:
        return "no end"
    digits = str(ways)
    return f"{ways:,}" if len(digits) <= MOST_DIGITS else f"about 10^{len(digits) - 1}"


def _with_tags(part: Grammar, sentence: str) -> str:
    """Sentences of a rule that is not a command."""
    found = parse(part, sentence)
    return sentence if found is None else f"{sentence} {{{spell_tags(found.tags)}}}"


def _expected(grammar: Grammar, sentence: str) -> str:
    """As a line of a file of expectations, fit for `hri grammar test`."""
    found = parse(grammar, sentence)
    return sentence if found is None else f"+ {sentence} => {meaning_of(found)}"
