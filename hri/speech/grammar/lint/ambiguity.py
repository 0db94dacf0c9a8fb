"""Sentences that mean two things, found by walking all sentences at once."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Generator, Iterator, Mapping
from dataclasses import dataclass
from itertools import islice

from hri.speech.grammar.automaton import FINAL, START, Apply, Defer, Take
from hri.speech.grammar.doc_comments import ANY_COMMAND
from hri.speech.grammar.grammar import Grammar
from hri.speech.grammar.matching import Matcher, Parse, as_written, parses

MOST_STEPS = 30_000
"""Nodes of the automaton that are visited for sentences with two readings."""
MOST_TRIED = 1000
"""Sentences whose readings are compared; many may mean the same in all their readings."""
MOST_SAMPLED = 200
"""Sentences of a grammar too large to be walked, of which some are tried."""
MOST_READ = 6_000_000
"""Arcs of the automaton times sentences that are tried: each may be read along most of the arcs."""
MOST_ALIKE = 20
"""Beginnings with several ways to the same nodes to continue from: their meanings depend on the
words before, which the nodes do not show.
"""


@dataclass(frozen=True, slots=True)
class Ambiguity:
    """A sentence with two meanings; the first is what it counts as."""

    sentence: str
    first: Parse
    second: Parse


def ambiguities(grammar: Grammar) -> Iterator[Ambiguity]:
    """Sentences of two meanings, the shortest first.

    One for each two rules and names of tags, since one example shows where they collide. In a
    grammar that is too large to be walked to its end, some sentences are tried as well.
    """
    if not _can_differ(grammar):
        return
    told: set[object] = set()
    for sentence in islice(_tried(grammar), MOST_TRIED):
        found = ambiguity(grammar, sentence)
        if found is not None:
            readings = (found.first, found.second)
            kind = frozenset((reading.rule, frozenset(reading.tags)) for reading in readings)
            if kind not in told:
                told.add(kind)
                yield found


def _can_differ(grammar: Grammar) -> bool:
    """Whether there is more than one thing that can be meant: two rules, or tags."""
    actions = {action for actions in grammar.automaton.actions for action in actions}
    has_tags = any(isinstance(action, Apply | Defer | Take) for action in actions)
    return has_tags or len(grammar.public_rules) > 1


def _tried(grammar: Grammar) -> Iterator[str]:
    is_all = yield from suspects(grammar.made(as_written))
    if not is_all:
        arcs = len(grammar.automaton.targets)
        yield from grammar.sample(min(MOST_SAMPLED, MOST_READ // arcs))


def ambiguity(grammar: Grammar, sentence: str) -> Ambiguity | None:
    """The two meanings of a sentence, if it has two.

    Two rules with the mark "part" are not heard side by side, so one sentence may be of both. It
    may also be of another rule and of an answer (which counts while a question is open), a
    follow-up to a command, or a typed-only rule; and of two rules that count after different
    commands.
    """
    readings = parses(grammar, sentence)
    parts, answers, after, typed = map(grammar.marked, ("part", "answer", "after", "typed"))
    for other in readings[1:]:
        first = readings[0]
        rules = {first.rule, other.rule}
        are_apart = len(rules) == 2 and (
            rules <= parts or any(len(rules & some) == 1 for some in (answers, after, typed))
        )
        are_apart |= follow_others(grammar, rules)
        if not are_apart and not other.means_the_same(first, beside_slots=True):
            return Ambiguity(sentence, first, other)
    return None


def follow_others(grammar: Grammar, rules: set[str]) -> bool:
    """Whether rules are marked @after, and no two of them after the same command."""
    named = [name for key in rules for name in grammar.rules[key].after]
    are_marked = all(grammar.rules[key].after for key in rules)
    return are_marked and ANY_COMMAND not in named and len({*named}) == len(named)


Ways = Mapping[int, int]
"""In how many ways some words lead to each node; 2 stands for more."""


def suspects(matcher: Matcher) -> Generator[str, None, bool]:
    """Sentences with two ways through the automaton, the shortest first.

    Words that lead to the same nodes, each in one way, are walked on from only once, those that
    lead there in several ways MOST_ALIKE times. After MOST_STEPS nodes the walk ends; returns
    whether nothing was left then.
    """
    pending: deque[tuple[Ways, tuple[str, ...]]] = deque([({START: 1}, ())])
    visited: Counter[frozenset[tuple[int, int]]] = Counter()
    steps = 0
    while pending and steps < MOST_STEPS:
        ways, words = pending.popleft()
        ways = _silently(matcher, ways)
        steps += len(ways)
        if ways.get(FINAL, 0) > 1:
            yield " ".join(words)
        for word, further in _after(matcher, ways).items():
            key = frozenset(further.items())
            visited[key] += 1
            if visited[key] <= (MOST_ALIKE if max(further.values()) > 1 else 1):
                pending.append((further, (*words, word)))
    return not pending


def _silently(matcher: Matcher, ways: Ways) -> Ways:
    """The nodes themselves, and those that are reached from them without a word."""
    found: dict[int, int] = {}
    pending = list(ways.items())
    while pending:
        node, more = pending.pop()
        more = min(more, 2 - found.get(node, 0))
        if more:
            found[node] = found.get(node, 0) + more
            targets = matcher.automaton.targets
            pending += [(targets[arc], more) for arc in matcher.leaving(node)[0]]
    return found


def _after(matcher: Matcher, ways: Ways) -> dict[str, dict[int, int]]:
    """The nodes behind each word that may follow."""
    targets = matcher.automaton.targets
    found: dict[str, dict[int, int]] = {}
    for node, count in ways.items():
        for word, arcs in matcher.leaving(node)[1].items():
            further = found.setdefault(word, {})
            for arc in arcs:
                target = targets[arc]
                further[target] = min(2, further.get(target, 0) + count)
    return found
