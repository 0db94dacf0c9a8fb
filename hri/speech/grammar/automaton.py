"""A grammar as one flat automaton: which word may follow which, and what each step means.

The rules are written out where they are used. A rule that stands at the end of another (right
recursion is the common case) is written once and jumped to; one that stands in the middle of
itself, which no finite automaton can follow for ever, is written out NESTED_DEPTH rules deep. What
may be said before and behind many commands, "hey robot could you please", is written once for all
that have it: it leads to a hub, and from there to the words of each.
Arcs carry the actions that build the parse tree: a path from the start to the end is one reading
of one sentence, and of the arcs that leave a node the first one was written first.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from enum import Enum, auto
from functools import cached_property
from typing import NamedTuple

from hri.core.collection import without_collection
from hri.core.errors import AuthoringError
from hri.speech.grammar import analysis
from hri.speech.grammar.expressions import (
    Alternative,
    Anything,
    Expression,
    Optional,
    Repeat,
    RuleReference,
    Sequence,
    Tagged,
    Token,
)
from hri.speech.grammar.framing import NOTHING, Frame, Framed, unframed
from hri.speech.grammar.grammar_size import too_large
from hri.speech.grammar.rules import Rules
from hri.speech.grammar.tags import TagEntry
from hri.speech.grammar.words import ANY

MOST_ARCS = 300_000
"""Together with the rules that are written out: about 3 s and 150 MB while they are built. A list
of 100,000 names of two words has 200,000."""
NESTED_DEPTH = 5
"""How often a rule may stand inside itself, other than at its end; more than `expansion` goes."""

START, FINAL = 0, 1
_SILENCE = NOTHING
_HALF = math.log(0.5)
"""JSGF gives no odds for what is optional or repeated: both ways are equally likely."""
_AMONG = (1.0, 1.0, 0.0004)
"""Odds of nothing, of other words, and of other words with its name, before or behind a phrase that
counts anywhere, beside what free words cost. Names are said seldom, and much sounds like "robot".
"""


@dataclass(frozen=True, slots=True)
class Enter:
    """A rule begins."""

    rule: str
    is_last: bool
    """True at the end of another rule: it then ends where that one ends, without a Leave."""
    is_command: bool = False
    """The public rule that the whole sentence belongs to, with all that was said before."""


@dataclass(frozen=True, slots=True)
class Leave:
    """The innermost rule that was entered with `is_last` false ends, and all that began in it."""


@dataclass(frozen=True, slots=True)
class Apply:
    """Tags take effect."""

    entries: tuple[TagEntry, ...]


@dataclass(frozen=True, slots=True)
class Defer:
    """Tags take effect when the rule around them ends, before those that were deferred earlier."""

    entries: tuple[TagEntry, ...]


@dataclass(frozen=True, slots=True)
class Take:
    """A word of a free slot, which sets the tag of that name."""

    slot: str
    is_first: bool


Action = Enter | Leave | Apply | Defer | Take
Actions = tuple[Action, ...]


@dataclass(frozen=True, eq=False, slots=True)
class Automaton:
    """Nodes 0 to `size` - 1 and the arcs between them, sorted by the node they leave.

    No path without a word leads from a node back to it, none from START to FINAL, and every node
    lies on a way between the two.
    """

    size: int
    first: list[int]
    """The number of the first arc of each node, and behind it the number of arcs. [size + 1]"""
    targets: list[int]
    words: list[str | None]
    """None: passed without a word; ANY: with any one."""
    weights: list[float]
    """Natural logarithms; those of one node add up to one."""
    actions: list[Actions]
    entries: Mapping[str, int]
    """The node where the words of each public rule begin that can be said. The only arc that leads
    there comes from a hub, where the words end that are said before many rules; START leads to the
    first hub."""


class _Speaking(Enum):
    """Which ways through a node are wanted."""

    ANY = auto()
    SPOKEN = auto()
    """Those with a word: a repeat made of them never goes round in silence."""
    SILENT = auto()


@dataclass(frozen=True, slots=True)
class _Context:
    """One place where a rule is written out, and what is done where it ends."""

    number: int
    after: Actions
    inside: Mapping[str, int]
    """How often it lies inside each recursive rule."""


class _Job(NamedTuple):
    """Write the ways through `node` between two nodes of the automaton."""

    node: Expression
    start: int
    end: int
    speaking: _Speaking
    context: _Context
    is_last: bool = False
    """Whether nothing follows in the rule: `end` and `after` are those of the context."""
    before: Actions = ()
    after: Actions = ()
    weight: float = 0.0


@dataclass(slots=True)
class _Arcs:
    sources: list[int] = field(default_factory=list)
    targets: list[int] = field(default_factory=list)
    words: list[str | None] = field(default_factory=list)
    weights: list[float] = field(default_factory=list)
    actions: list[Actions] = field(default_factory=list)

    def add(self, job: _Job, target: int, word: str | None, actions: Actions) -> None:
        self.sources.append(job.start)
        self.targets.append(target)
        self.words.append(word)
        self.weights.append(job.weight)
        self.actions.append(actions)


def build(grammar: Rules) -> Automaton:
    """The automaton of all public rules; a choice of the weight 0 is left out.

    Raises AuthoringError for left recursion, and when there are more than MOST_ARCS arcs.
    """
    with without_collection():
        return _Builder(grammar, grammar.marked("anywhere")).build()


def build_spoken(grammar: Rules) -> Automaton:
    """The same without the rules that are only typed, and with one arc for free words in a row: no
    engine counts them in a sound. Its word is `Anything.written`.
    """
    written = grammar.made(build)
    if ANY not in written.words and not grammar.marked("typed"):
        return written
    with without_collection():
        anywhere = grammar.marked("anywhere") - grammar.marked("listed")
        return _Builder(grammar, anywhere, is_spoken=True).build()


def build_as_written(grammar: Rules) -> Automaton:
    """The same without the words around the rules that count @anywhere, and without the free words
    of those that are typed: any word would begin a sentence.
    """
    if not grammar.marked("anywhere") | grammar.marked("typed"):
        return grammar.made(build)
    with without_collection():
        return _Builder(grammar, frozenset(), is_listed=True).build()


class _Builder:
    """Works off jobs from a stack, so that no depth of rules can exhaust Python's.

    What was written first is worked off first, which keeps the arcs of a node in that order.
    """

    def __init__(
        self,
        grammar: Rules,
        anywhere: frozenset[str],
        *,
        is_spoken: bool = False,
        is_listed: bool = False,
    ) -> None:
        self._grammar, self._anywhere, self._is_spoken = grammar, anywhere, is_spoken
        self._is_listed = is_listed
        self._recursive = grammar.made(analysis.recursive_of)
        self._is_silent = analysis.Silence(grammar.made(analysis.silent_rules))
        for error in analysis.left_recursion(grammar):
            raise error
        self._arcs = _Arcs()
        self._size = 2
        self._written: dict[tuple[str, int, _Speaking], int] = {}
        """Where the rules at the end of others begin, by name and context."""
        self._entries: dict[str, int] = {}
        self._begun: dict[tuple[Frame, ...], int] = {(): START}
        """The hubs behind what may be said before sentences."""
        self._ending: dict[tuple[Frame, ...], int] = {(): FINAL}
        """Where what may be said behind them begins."""
        self._commands: Counter[tuple[Frame, ...]] = Counter()
        """Public rules whose sentences begin with these frames."""
        self._contexts = 0
        self._top, self._top_of_listed = self._context((), {}), self._context((), {})
        self._jobs: list[_Job] = []
        self._lists_only = False
        """Whether the free words of the rule that is being written are left out."""

    def build(self) -> Automaton:
        unspoken = self._grammar.marked("typed") if self._is_spoken else frozenset()
        rules = [key for key in self._grammar.public_rules if key not in unspoken]
        if (key := too_large(self._grammar, MOST_ARCS)) is not None:
            raise self._too_large(key)
        commands = {key: self._parts(key) for key in rules}
        self._commands = Counter(
            parts.before[:count]
            for parts in commands.values()
            for count in range(len(parts.before) + 1)
        )
        listed = self._grammar.marked("listed") | self._grammar.marked("typed")
        if not (self._is_spoken or self._is_listed):
            listed = frozenset()
        for key, parts in commands.items():
            hub, end = self._hub(parts.before), self._end(parts.after)
            self._work_off(key)
            self._lists_only = key in listed
            self._command(key, parts, hub, end)
            self._work_off(key)
            self._lists_only = False
        return _trimmed(self._size, self._arcs, self._entries)

    def _work_off(self, key: str) -> None:
        while self._jobs:
            self._work(self._jobs.pop())
            if len(self._arcs.sources) + self._contexts > MOST_ARCS:
                raise self._too_large(key)

    def _parts(self, key: str) -> Framed:
        """The words of a public rule, and what may be said around them."""
        expression = self._grammar.rules[key].expression
        parts = unframed(expression)
        if self._is_silent(parts.body):
            parts = Framed((), expression, ())
        if key in self._anywhere:
            others = self._others
            parts = Framed((others, *parts.before), parts.body, (*parts.after, others))
        return parts

    def _command(self, key: str, parts: Framed, hub: int, end: int) -> None:
        """A public rule between what may be said before its own words and behind them."""
        entry = self._entries[key] = self._new_node()
        enter = Enter(key, is_last=True, is_command=True)
        first = self._job(_SILENCE, hub, entry, -math.log(self._commands[parts.before]))
        self._arcs.add(first, entry, None, (enter,))
        body = self._job(parts.body, entry, end)
        body = body._replace(speaking=_Speaking.SPOKEN, is_last=not parts.after)
        if parts.before or parts.after:
            self._jobs.append(body)
        else:
            self._write_once(body, key, ())

    def _job(self, node: Expression, start: int, end: int, weight: float = 0.0) -> _Job:
        top = self._top_of_listed if self._lists_only else self._top
        return _Job(node, start, end, _Speaking.ANY, top, weight=weight)

    def _hub(self, frames: tuple[Frame, ...]) -> int:
        """Where frames lead that are said before sentences."""
        if frames not in self._begun:
            start = self._hub(frames[:-1])
            hub = self._begun[frames] = self._new_node()
            weight = math.log(self._commands[frames] / self._commands[frames[:-1]])
            self._jobs.append(self._job(frames[-1], start, hub, weight))
        return self._begun[frames]

    def _end(self, frames: tuple[Frame, ...]) -> int:
        """Where frames begin that are said behind sentences."""
        if frames not in self._ending:
            end = self._end(frames[1:])
            start = self._ending[frames] = self._new_node()
            self._jobs.append(self._job(frames[0], start, end))
        return self._ending[frames]

    def _too_large(self, key: str) -> AuthoringError:
        what = f"<{key}> written out takes more than {MOST_ARCS:,} steps"
        remedy = "use large rules in fewer places, best at the end of other rules"
        return AuthoringError(self._grammar.rules[key].place(), what, remedy)

    def _context(self, after: Actions, inside: Mapping[str, int]) -> _Context:
        self._contexts += 1
        return _Context(self._contexts, after, inside)

    def _new_node(self) -> int:
        self._size += 1
        return self._size - 1

    def _work(self, job: _Job) -> None:
        match job.node:
            case Token(text=text):
                if job.speaking is not _Speaking.SILENT:
                    self._arcs.add(job, job.end, text, job.before + job.after)
            case Anything() as node:
                if job.speaking is not _Speaking.SILENT:
                    self._anything(job, node)
            case Tagged(item=item, entries=entries):
                self._jobs.append(self._tagged(job, item, entries))
            case Sequence(items=()):
                if job.speaking is not _Speaking.SPOKEN:
                    self._arcs.add(job, job.end, None, job.before + job.after)
            case RuleReference(name=name):
                if name in self._grammar.rules:
                    self._reference(job, name)
            case Sequence(items=items):
                self._later(self._sequence(job, items))
            case Alternative(choices=choices, weights=weights):
                self._later(
                    job._replace(node=choice, weight=job.weight + share)
                    for choice, share in zip(choices, _shares(weights), strict=True)
                    if share > -math.inf
                )
            case Optional(item=item):
                weight = job.weight + _HALF
                self._later(job._replace(node=way, weight=weight) for way in (item, _SILENCE))
            case Repeat(item=item, minimum=minimum):
                self._later(self._repeat(job, item, minimum))

    def _anything(self, job: _Job, node: Anything) -> None:
        """Word by word; of all ways through them the shortest comes first."""
        if self._lists_only:
            return
        if node.slot:
            self._slot(job, node)
            return
        if self._is_spoken:
            self._arcs.add(job, job.end, node.written, job.before + job.after)
            return
        for number in range(1, node.most + 1):
            inside = self._new_node()
            self._arcs.add(job, inside, ANY, job.before)
            job = job._replace(start=inside, before=(), weight=_HALF)
            if number >= node.least:
                self._arcs.add(job, job.end, None, job.after)

    def _slot(self, job: _Job, node: Anything) -> None:
        """The same with the words taken as a value: of two slots the first has as few as can be."""
        take = (Take(node.slot, is_first=True),)
        if self._is_spoken:
            self._arcs.add(job, job.end, node.written, job.before + take + job.after)
            return
        for number in range(1, node.most + 1):
            if number >= node.least:
                self._arcs.add(job, job.end, ANY, job.before + take + job.after)
            if number < node.most:
                inside = self._new_node()
                self._arcs.add(job, inside, ANY, job.before + take)
                job = job._replace(start=inside, before=(), weight=_HALF)
                take = (Take(node.slot, is_first=False),)

    def _later(self, jobs: Iterator[_Job]) -> None:
        self._jobs += reversed(list(jobs))

    def _tagged(self, job: _Job, item: Expression, entries: tuple[TagEntry, ...]) -> _Job:
        if job.is_last and self._recursive and self._ends_in_recursion(item):
            return job._replace(node=item, before=(*job.before, Defer(entries)))
        return job._replace(node=item, is_last=False, after=(Apply(entries), *job.after))

    def _ends_in_recursion(self, node: Expression) -> bool:
        match node:
            case RuleReference(name=name):
                return name in self._recursive
            case Sequence(items=(*_, last)):
                return self._ends_in_recursion(last)
            case Alternative(choices=choices):
                return any(map(self._ends_in_recursion, choices))
            case Optional(item=item) | Tagged(item=item):
                return self._ends_in_recursion(item)
            case _:
                return False

    def _reference(self, job: _Job, name: str) -> None:
        """Let a rule follow: written out here, or jumped to when it ends where this one ends."""
        body, context = self._grammar.rules[name].expression, job.context
        is_recursive = name in self._recursive
        if not job.is_last:
            inside = context.inside
            if is_recursive:
                inside = {**inside, name: inside.get(name, 0) + 1}
                if inside[name] > NESTED_DEPTH:
                    return
            context = self._context((Leave(), *job.after), inside)
        inner = job._replace(node=body, context=context, is_last=True, after=context.after)
        enter = (*job.before, Enter(name, job.is_last))
        if not (job.is_last or is_recursive):
            self._jobs.append(inner._replace(before=enter))
            return
        self._write_once(inner, name, enter)

    def _write_once(self, job: _Job, name: str, actions: Actions) -> None:
        """Let a rule follow that is written out the first time, and then jumped to."""
        place = (name, job.context.number, job.speaking)
        entry = self._written.get(place)
        if entry is None:
            entry = self._written[place] = self._new_node()
            self._jobs.append(job._replace(start=entry, before=(), weight=0.0))
        self._arcs.add(job, entry, None, actions)

    @cached_property
    def _others(self) -> Frame:
        """Other words before or behind what counts among them; of these, its name is known."""
        words = Anything(NOTHING.span)
        ways: list[Expression] = [_SILENCE, words]
        names = [key for key, rule in self._grammar.rules.items() if "name" in rule.marks]
        if names:
            span = words.span
            name = Alternative(
                tuple(RuleReference(key, span) for key in names), (1.0,) * len(names), span
            )
            more = Optional(words, span)
            ways += [Sequence((name, words), span), Sequence((words, name, more), span)]
        return Frame(tuple(ways), (*_AMONG[:2], *(_AMONG[2] for _ in ways[2:])), words.span)

    def _sequence(self, job: _Job, items: tuple[Expression, ...]) -> Iterator[_Job]:
        if job.speaking is not _Speaking.SPOKEN:
            yield from self._chain(job, items, job.speaking)
        elif all(map(self._is_silent, items)):
            yield from self._spoken_chain(job, items)
        else:
            yield from self._chain(job, items, _Speaking.ANY)

    def _chain(
        self, job: _Job, items: tuple[Expression, ...], speaking: _Speaking
    ) -> Iterator[_Job]:
        """One item after the other."""
        at = job._replace(speaking=speaking)
        for item in items[:-1]:
            middle = self._new_node()
            yield at._replace(node=item, end=middle, is_last=False, after=())
            at = at._replace(start=middle, before=(), weight=0.0)
        yield at._replace(node=items[-1])

    def _spoken_chain(self, job: _Job, items: tuple[Expression, ...]) -> Iterator[_Job]:
        """The same when each item may be silent but not all: two chains, before a word and after.

        The spoken ways through an item lead from the first chain to the second.
        """
        silent, spoken = job, None
        for item in items[:-1]:
            inner = silent._replace(node=item, is_last=False, after=())
            before, behind = self._new_node(), self._new_node()
            yield inner._replace(end=behind)
            yield inner._replace(end=before, speaking=_Speaking.SILENT)
            if spoken is not None:
                yield spoken._replace(node=item, end=behind, is_last=False, after=())
            silent = job._replace(start=before, before=(), weight=0.0)
            spoken = silent._replace(start=behind, speaking=_Speaking.ANY)
        yield silent._replace(node=items[-1])
        if spoken is not None:
            yield spoken._replace(node=items[-1])

    def _repeat(self, job: _Job, item: Expression, minimum: int) -> Iterator[_Job]:
        may_be_silent = job.speaking is not _Speaking.SPOKEN
        if minimum == 1 and may_be_silent and self._is_silent(item):
            yield job._replace(node=item, speaking=_Speaking.SILENT)
        if job.speaking is _Speaking.SILENT:
            if minimum == 0:
                yield job._replace(node=_SILENCE)
            return
        head = self._new_node()
        needs_one = minimum == 1 or job.speaking is _Speaking.SPOKEN
        behind = self._new_node() if needs_one else head
        silence = job._replace(node=_SILENCE, speaking=_Speaking.ANY, is_last=False)
        yield silence._replace(end=head, after=())
        inside = silence._replace(start=head, end=behind, before=(), after=(), weight=_HALF)
        yield inside._replace(node=item, speaking=_Speaking.SPOKEN)
        if needs_one:
            yield inside._replace(start=behind, end=head)
        yield inside._replace(start=behind, end=job.end, after=job.after)


def _shares(weights: tuple[float, ...]) -> list[float]:
    """The logarithms of weights made to add up to one, however large or small they are."""
    largest = max(weights, default=0.0) or 1.0
    total = math.log(sum(weight / largest for weight in weights) or 1.0) + math.log(largest)
    return [math.log(weight) - total if weight > 0.0 else -math.inf for weight in weights]


def _trimmed(size: int, arcs: _Arcs, written: Mapping[str, int]) -> Automaton:
    """The arcs that lie on a way from START to FINAL, sorted, their weights adding up to one."""
    into: list[list[int]] = [[] for _ in range(size)]
    out_of: list[list[int]] = [[] for _ in range(size)]
    for number, (source, target) in enumerate(zip(arcs.sources, arcs.targets, strict=True)):
        into[target].append(number)
        out_of[source].append(number)
    alive = _reached(START, out_of, arcs.targets) & _reached(FINAL, into, arcs.sources)
    names = {node: number for number, node in enumerate(sorted(alive | {START, FINAL}))}
    automaton = Automaton(
        len(names), [0], [], [], [], [], {k: names[n] for k, n in written.items() if n in names}
    )
    for node in names:
        leaving = [number for number in out_of[node] if arcs.targets[number] in alive]
        total = math.log(sum(math.exp(arcs.weights[number]) for number in leaving) or 1.0)
        for number in leaving:
            automaton.targets.append(names[arcs.targets[number]])
            automaton.words.append(arcs.words[number])
            automaton.weights.append(min(arcs.weights[number] - total, 0.0))
            automaton.actions.append(arcs.actions[number])
        automaton.first.append(len(automaton.targets))
    return automaton


def _reached(node: int, arcs_at: list[list[int]], ends: list[int]) -> set[int]:
    found, pending = {node}, [node]
    while pending:
        for number in arcs_at[pending.pop()]:
            end = ends[number]
            if end not in found:
                found.add(end)
                pending.append(end)
    return found
