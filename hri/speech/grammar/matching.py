"""Text to meaning: whether a grammar allows a sentence, its parse trees, and the tags of its words.

The sentence is followed through the grammar's automaton, all ways at once. What a set of ways
leads to is worked out when it is first needed and kept, so that a word of a known sentence costs
one look into a dictionary. Then the ways that did not reach the end are dropped, and the readings
are taken from what is left, so that none is a dead end. The work grows with words x arcs, however
many readings there are.

Readings come in the order they were written: of two alternatives the first, an optional part
rather than none, one more round of a repeat rather than its end. Weights have no say in it; only
what has the weight 0 is not there at all. Where words are free, those readings come first that
have a rule for most of the words.
"""

from __future__ import annotations

import difflib
import itertools
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import IntEnum, auto
from functools import cached_property
from typing import NamedTuple

from hri.speech.grammar.automaton import (
    FINAL,
    START,
    Actions,
    Apply,
    Automaton,
    Defer,
    Enter,
    Leave,
    Take,
    build,
    build_as_written,
    build_spoken,
)
from hri.speech.grammar.denial import is_denied
from hri.speech.grammar.free_slots import Limits, limits
from hri.speech.grammar.numerals import sayings
from hri.speech.grammar.rules import Rules
from hri.speech.grammar.spellings import (
    Spelling,
    as_it_stands,
    contracted_forms,
    longest_of,
    spellings,
)
from hri.speech.grammar.tags import TagEntry, Value, are_same, evaluate
from hri.speech.grammar.words import ANY, as_typed, typed

MOST_WORDS = 200
"""A longer text is not a command."""
MOST_PARSES = 20
"""Readings of one sentence that are listed."""
MOST_FREE = 200
"""Readings of one sentence that are looked at for the one with the fewest free words."""
MOST_TRIED = 500
"""Readings of one sentence by one rule that are looked at for one whose free slots fit."""
MOST_COMPARED = 500
"""Words that may follow; of more, only those much like the wrong one are compared with it."""
LEAST_ALIKE = 0.75
"""Share of letters in common with a word that may be meant: "forwrd" is one, "it's" is not "it"."""
FEW_WORDS = 8
"""Words that leave a node, up to which they are copied to the state that the node belongs to."""
MOST_NODES = 400_000
"""Nodes in all states that are kept, about 50 MB; beyond it they are worked out again."""

Groups = tuple[tuple[TagEntry, ...], ...]


@dataclass(frozen=True, slots=True)
class Tree:
    """A rule of the grammar and its matched words."""

    rule: str
    start: int
    """The number of its first word in the sentence, from 0."""
    end: int
    """The number behind its last word; `start` when it was passed in silence."""
    children: tuple[Tree | str, ...]
    """Words and rules, in order."""

    def walk(self) -> Iterator[tuple[int, Tree]]:
        """This rule and all below it as they were said, each with its depth, this one with 0."""
        pending = [(0, self)]
        while pending:
            depth, tree = pending.pop()
            yield depth, tree
            below = [child for child in tree.children if isinstance(child, Tree)]
            pending += [(depth + 1, child) for child in reversed(below)]


@dataclass(frozen=True, slots=True)
class SlotWords:
    """Words of a sentence that stand in a free slot."""

    name: str
    """Of the slot, and of the tag that has its text."""
    text: str
    """As they were typed: in capitals and small letters, with one space between."""
    start: int
    """The number of the first word in the sentence, from 0."""
    end: int
    """The number behind the last."""


@dataclass(frozen=True, slots=True)
class Parse:
    """A sentence that the grammar allows."""

    text: str
    """The grammar's words, lower case, one space between."""
    rule: str
    """The public rule that allows it."""
    tags: Mapping[str, Value] = field(default_factory=dict)
    tree: Tree = field(default_factory=lambda: Tree("", 0, 0, ()))
    free: tuple[int, ...] = ()
    """The numbers of its words that `<any>` and free slots stand for, from 0."""
    entries: Groups = field(default=(), repr=False, compare=False)
    """All tags of its words, in the order in which they take effect."""
    ends: tuple[int, ...] = field(default=(), repr=False, compare=False)
    """For each group of `entries`: how many words had been said when it took effect."""
    slots: tuple[SlotWords, ...] = ()
    """The words of its free slots, in order."""

    def tag_of(self, word: int) -> str:
        """The tag that a word, by its number, gives its value; empty for one that gives none.

        It is the next one that takes effect: in "to the left {side=left}" all three words give it.
        """
        following = (
            group for group, end in zip(self.entries, self.ends, strict=True) if end > word
        )
        name = next((entry.name for group in following for entry in group), "")
        taken = {
            taken: entry.name for group in self.entries for entry in group for taken in entry.takes
        }
        while name not in self.tags and name in taken:
            name = taken.pop(name)
        return name if name in self.tags else ""

    @property
    def around(self) -> tuple[int, ...]:
        """The numbers of its words that `<any>` stands for: those of free slots are a value."""
        taken = {place for slot in self.slots for place in range(slot.start, slot.end)}
        return tuple(place for place in self.free if place not in taken)

    @property
    def as_typed(self) -> str:
        """The text with the words of free slots as they were typed."""
        words = self.text.split()
        for slot in reversed(self.slots):
            words[slot.start : slot.end] = [slot.text]
        return " ".join(words)

    def means_the_same(self, other: Parse, *, beside_slots: bool = False) -> bool:
        """Whether both have the same rule and tags, or the same but for the words of free slots."""
        if self.rule != other.rule or not beside_slots or not (self.slots or other.slots):
            return self.rule == other.rule and are_same(self.tags, other.tags)
        return are_same(_beside_slots(self), _beside_slots(other))


def _beside_slots(found: Parse) -> dict[str, Value]:
    """The tags of a sentence if its free slots had no words."""
    taken = {_set_by(slot) for slot in found.slots}
    return evaluate(
        (TagEntry(group[0].name, "=", ""),) if group in taken else group for group in found.entries
    )


def _set_by(slot: SlotWords) -> tuple[TagEntry, ...]:
    return (TagEntry(slot.name, "=", slot.text),)


@dataclass(frozen=True, slots=True)
class Refusal:
    """How far a sentence went before it left the grammar."""

    understood: str
    """The words that begin a sentence of the grammar."""
    word: str
    """The word that does not fit behind them; empty when the sentence ended too soon."""
    expected: tuple[str, ...]
    """The words that fit there, in order of the alphabet; none where a sentence must end."""
    remedy: str
    """What to do."""
    near: str = ""
    """A word that fits there and is like it."""


def matcher_of(grammar: Rules) -> Matcher:
    """What follows the sentences of a grammar. Raises what `build` raises."""
    return Matcher(grammar.made(build), grammar.made(limits))


def as_spoken(grammar: Rules) -> Matcher:
    """What follows the sentences that a voice may say."""
    return Matcher(grammar.made(build_spoken))


def as_written(grammar: Rules) -> Matcher:
    """What does not go on with other words, and so has an opinion on which should have come."""
    return Matcher(grammar.made(build_as_written))


def parse(
    grammar: Rules,
    text: str,
    rules: Collection[str] | None = None,
    *otherwise: Collection[str] | None,
) -> Parse | None:
    """What a sentence means, by its first reading; None when no public rule allows all of it.

    `rules` are the public rules that count; None is all. When none of them allows the sentence,
    those of `otherwise` count, one collection after the other; the sentence is followed only once.
    Raises AuthoringError where `Grammar.automaton` does.
    """
    return next(grammar.made(matcher_of).readings(text, rules, *otherwise), None)


def parses(
    grammar: Rules, text: str, limit: int = MOST_PARSES, rules: Collection[str] | None = None
) -> tuple[Parse, ...]:
    """All readings of a sentence with different trees or tags, at most `limit`, the best first.

    A sentence is ambiguous when two of them differ in rule or tags. Those with more free words than
    others do not count. `rules` are the public rules that count; None is all. Raises AuthoringError
    where `Grammar.automaton` does.
    """
    found: dict[object, Parse] = {}
    fewest = MOST_WORDS
    for reading in itertools.islice(grammar.made(matcher_of).readings(text, rules), 10 * limit):
        fewest = min(fewest, len(reading.free))
        if len(reading.free) > fewest:
            break
        rules_said = tuple((depth, t.rule, t.start, t.end) for depth, t in reading.tree.walk())
        found.setdefault((rules_said, tuple(sorted(reading.tags.items()))), reading)
        if len(found) == limit:
            break
    return tuple(found.values())


def different(readings: Iterable[Parse]) -> tuple[Parse, ...]:
    """The first of those that mean the same, or that differ only in the words of free slots."""
    found: list[Parse] = []
    for reading in readings:
        if not any(reading.means_the_same(other, beside_slots=True) for other in found):
            found.append(reading)
    return tuple(found)


def meanings(grammar: Rules, text: str, rules: Collection[str] | None = None) -> tuple[Parse, ...]:
    """The readings of a sentence that mean different things; the first counts. Only where words are
    free none does: all are equally specific then.

    Else as `parses`.
    """
    return different(parses(grammar, text, rules=rules))


def refusal(grammar: Rules, text: str) -> Refusal | None:
    """Where a sentence leaves the grammar; None when it does not.

    Raises AuthoringError where `Grammar.automaton` does.
    """
    return departure(grammar, text) if parse(grammar, text) is None else None


def departure(grammar: Rules, text: str) -> Refusal | None:
    """The same for a sentence that `parse` has refused, which is not parsed again."""
    matcher = grammar.made(as_written)
    forms = matcher.forms(typed(text)[: MOST_WORDS + 1])
    words, state, position = max(map(matcher.followed, forms), key=lambda way: way[2])
    if position == len(words) <= MOST_WORDS and state.is_final and words:
        return _unfit(grammar, words)
    word = words[position] if position < len(words) else ""
    expected = state.expected()
    near = _near(word, expected)
    return Refusal(" ".join(words[:position]), word, expected, _remedy(word, near), near)


def _unfit(grammar: Rules, words: list[str]) -> Refusal | None:
    """The refusal of words that stand where free ones may, and do not fit the limits of a slot."""
    if not grammar.made(matcher_of).has_limits:
        return None
    return Refusal(" ".join(words[:-1]), words[-1], (), "its slot does not take these words")


def _remedy(word: str, near: str) -> str:
    """What to do about a word that does not fit; `near` is like it and fits there."""
    if any(sign.isdigit() for sign in word):
        return f'write numbers as words, "{next(sayings(word))}"'
    return f'did you mean "{near}"?' if near else "see `hri grammar expand`"


def _near(word: str, expected: Collection[str]) -> str:
    """The word that was meant, of those that fit; empty where none is like it."""
    if len(expected) > MOST_COMPARED:
        # A slip of the fingers leaves the first letter and most of the others.
        alike = range(len(word) - 1, len(word) + 2)
        expected = [known for known in expected if known[0] == word[:1] and len(known) in alike]
    return next(iter(difflib.get_close_matches(word, expected, n=1, cutoff=LEAST_ALIKE)), "")


class Step(NamedTuple):
    """One word further."""

    state: State
    moves: tuple[tuple[int, int], ...]
    """The nodes that the word leaves, and by which arcs."""


class State:
    """All nodes of the automaton that the same words lead to."""

    __slots__ = ("_index", "_matcher", "_steps", "_tables", "is_final", "silent_into", "size")

    def __init__(self, matcher: Matcher, nodes: tuple[int, ...]) -> None:
        self._matcher = matcher
        self._steps: dict[str, Step] = {}
        self.silent_into: dict[int, list[tuple[int, int]]] = {}
        """The nodes before each one, and the arcs that lead there without a word."""
        self._tables: list[tuple[int, Mapping[str, list[int]]]] = []
        """The nodes that many words leave, and the arcs by word; looked into one by one."""
        self._index: dict[str, list[tuple[int, int]]] = {}
        """The nodes that few words leave, and the arcs, by word: thousands of commands begin so."""
        seen, pending = set(nodes), list(nodes)
        targets = matcher.automaton.targets
        while pending:
            node = pending.pop()
            silent, table = matcher.leaving(node)
            if len(table) > FEW_WORDS:
                self._tables.append((node, table))
            else:
                for word, arcs in table.items():
                    self._index.setdefault(word, []).extend((node, arc) for arc in arcs)
            for arc in silent:
                target = targets[arc]
                self.silent_into.setdefault(target, []).append((node, arc))
                if target not in seen:
                    seen.add(target)
                    pending.append(target)
        self.is_final = FINAL in seen
        """Whether a sentence may end here."""
        self.size = len(seen)

    def step(self, word: str) -> Step | None:
        """Where a word leads; None when it does not fit."""
        if word not in self._matcher.words:
            word = ANY
        step = self._steps.get(word)
        if step is None:
            spread = ((node, arc) for node, table in self._tables for arc in table.get(word, ()))
            moves = (*self._index.get(word, ()), *spread)
            if word != ANY and (free := self.step(ANY)) is not None:
                moves += free.moves
            if moves:
                targets = self._matcher.automaton.targets
                nodes = tuple(sorted({targets[arc] for _, arc in moves}))
                step = self._steps[word] = Step(self._matcher.state(nodes), moves)
        return step

    def expected(self) -> tuple[str, ...]:
        """The words that fit here, in order of the alphabet."""
        fitting = {*self._index, *(word for _, table in self._tables for word in table)}
        return tuple(sorted(fitting - {ANY}))


_Ways = dict[int, list[int]]
"""The arcs that leave each node and lead to the end of the sentence."""
_Followed = tuple[Spelling, list[_Ways]]
"""A sentence, and the ways through it before each word and at its end."""


class _Said(IntEnum):
    """What a step says; a number, since its hash is taken at every arc."""

    NOTHING = auto()
    LISTED = auto()
    FREE = auto()


_Span = tuple[str, int, int]
"""The name of a slot, and the numbers of its first word and of the one behind its last."""
_History = tuple["_History | None", _Said, Actions]
"""The steps so far, the last one first: its kind of word, and its actions."""


def _listed_words(parse: Parse) -> int:
    return len(parse.text.split()) - len(parse.free)


class Letters:
    """Knows how the words of a text were typed, in capitals and small letters."""

    def __init__(self, text: str) -> None:
        self._text = text

    @cached_property
    def _typed(self) -> list[str]:
        return as_typed(self._text)

    def of(self, form: Spelling, start: int, end: int) -> str:
        """Some words of a form of the text as they were typed.

        Where a typed word stands for more of the form than these, they are given as they stand.
        """
        words, origins = form
        begin, behind = origins[start][0], origins[end - 1][1]
        is_cut = (start > 0 and origins[start - 1][1] > begin) or (
            end < len(words) and origins[end][0] < behind
        )
        return " ".join(words[start:end] if is_cut else self._typed[begin:behind])


class Matcher:
    """Follows sentences through an automaton; remembers what it has worked out."""

    def __init__(self, automaton: Automaton, limits: Mapping[str, Limits] | None = None) -> None:
        """`limits` says what may stand in free slots, by their names."""
        self.automaton = automaton
        self._limits = limits or {}
        self.has_limits = bool(limits)
        """Whether the words of any free slot must be such as its author wants."""
        self.words = frozenset(word for word in automaton.words if word not in (None, ANY))
        """All words that are listed."""
        self.is_open = ANY in automaton.words
        """Whether any words are free."""
        self._commands = {
            arc: action.rule
            for arc, actions in enumerate(automaton.actions)
            for action in actions
            if isinstance(action, Enter) and action.is_command
        }
        """The arcs that lead to the own words of public rules."""
        self._leaving: dict[int, tuple[list[int], Mapping[str, list[int]]]] = {}
        self._states: dict[tuple[int, ...], State] = {}
        self._room = MOST_NODES

    def begin(self) -> State:
        """Before the first word."""
        return self.state((START,))

    def state(self, nodes: tuple[int, ...]) -> State:
        """The state of these nodes and of those behind them that need no word."""
        state = self._states.get(nodes)
        if state is None:
            state = State(self, nodes)
            self._room -= state.size
            if self._room < 0:
                # Whoever is on the way keeps the old states until he is through.
                self._states, self._room = {}, MOST_NODES - state.size
            self._states[nodes] = state
        return state

    def leaving(self, node: int) -> tuple[list[int], Mapping[str, list[int]]]:
        """The silent arcs of a node, and the others by their words."""
        known = self._leaving.get(node)
        if known is None:
            silent: list[int] = []
            table: dict[str, list[int]] = {}
            first, words = self.automaton.first, self.automaton.words
            for arc in range(first[node], first[node + 1]):
                word = words[arc]
                if word is None:
                    silent.append(arc)
                else:
                    table.setdefault(word, []).append(arc)
            known = self._leaving[node] = (silent, table)
        return known

    @cached_property
    def _contracted(self) -> dict[str, str]:
        return contracted_forms(self.words)

    @cached_property
    def _longest(self) -> int:
        return longest_of(self._contracted)

    def forms(self, words: list[str]) -> Iterator[list[str]]:
        """A text as it stands, then what else it may stand for: "2" is "two"."""
        return (form.words for form in self._spellings(words))

    def _spellings(self, words: list[str]) -> Iterator[Spelling]:
        yield as_it_stands(words)
        yield from spellings(words, self.words, self._contracted, self._longest)

    def followed(self, words: list[str]) -> tuple[list[str], State, int]:
        """The words, where they lead, and how many of them fit."""
        state, position = self.begin(), 0
        for word in words:
            step = state.step(word)
            if step is None:
                break
            state, position = step.state, position + 1
        return words, state, position

    def readings(self, text: str, *rules: Collection[str] | None) -> Iterator[Parse]:
        """What a sentence means, reading by reading, by one collection of rules after the other.

        By each of them, each way of taking tags and rules comes once, and the first form of the
        sentence that means something is all that counts.
        """
        words = typed(text)
        followed = itertools.tee(self._followed_through(words), len(rules))
        letters = Letters(text)
        return itertools.chain.from_iterable(
            self._readings(each, of, letters) for each, of in zip(followed, rules, strict=True)
        )

    def _followed_through(self, words: list[str]) -> Iterator[_Followed]:
        for form in self._spellings(words):
            if (ways := self._ways(form.words)) is not None:
                yield form, ways

    def _readings(
        self, followed: Iterable[_Followed], rules: Collection[str] | None, letters: Letters
    ) -> Iterator[Parse]:
        free: list[Parse] = []
        for form, ways in followed:
            found = self._readings_of(form, ways, rules, letters)
            if (first := next(found, None)) is None:
                continue
            if self.is_open:
                # Another form counts where more of its words are listed, not where it has fewer.
                most = max(map(_listed_words, free), default=-1)
                read = (first, *itertools.islice(found, MOST_FREE))
                free += (one for one in read if _listed_words(one) > most)
            else:
                yield first
                yield from found
                return
        yield from sorted(free, key=lambda reading: len(reading.free))

    def _readings_of(
        self,
        form: Spelling,
        ways: list[_Ways],
        rules: Collection[str] | None,
        letters: Letters,
    ) -> Iterator[Parse]:
        words = form.words
        text = " ".join(words)
        for rule in self._rules_in(ways):
            if rules is None or rule in rules:
                for history in itertools.islice(self._histories(ways, rule), MOST_TRIED):
                    spans = _slots_in(history, len(words)) if self._has_slots else []
                    if not self._fit(words, spans):
                        continue
                    slots = tuple(
                        SlotWords(name, letters.of(form, start, end), start, end)
                        for name, start, end in spans
                    )
                    tree, groups, ends, free = _reading(words, history, slots)
                    found = Parse(text, rule, evaluate(groups), tree, free, groups, ends, slots)
                    if not is_denied(words, found.around if slots else free):
                        yield found

    def _fit(self, words: Sequence[str], spans: Iterable[_Span]) -> bool:
        """Whether the words of free slots are such as their authors want."""
        return all(
            self._limits.get(name, Limits(name)).allow(" ".join(words[start:end]))
            for name, start, end in spans
        )

    @cached_property
    def _has_slots(self) -> bool:
        actions = itertools.chain.from_iterable(self.automaton.actions)
        return any(isinstance(action, Take) for action in actions)

    def _rules_in(self, ways: list[_Ways]) -> list[str]:
        """The public rules that allow a sentence, in the order they were written."""
        commands = self._commands
        found = {
            commands[arc]
            for here in ways
            for arcs in here.values()
            for arc in arcs
            if arc in commands
        }
        return [rule for rule in self.automaton.entries if rule in found]

    def _ways(self, words: list[str]) -> list[_Ways] | None:
        """The ways through a sentence, before each word and at its end; None without any."""
        if not 0 < len(words) <= MOST_WORDS:
            return None
        state = self.begin()
        passed: list[tuple[State, tuple[tuple[int, int], ...]]] = []
        for word in words:
            step = state.step(word)
            if step is None:
                return None
            passed.append((state, step.moves))
            state = step.state
        if not state.is_final:
            return None
        alive = {FINAL}
        ways: _Ways = {}
        found = [ways]
        _add_silent_ways(state, alive, ways)
        targets = self.automaton.targets
        for state, moves in reversed(passed):
            before: set[int] = set()
            ways = {}
            for node, arc in moves:
                if targets[arc] in alive:
                    before.add(node)
                    ways.setdefault(node, []).append(arc)
            _add_silent_ways(state, before, ways)
            found.append(ways)
            alive = before
        return found[::-1]

    def _histories(self, ways: list[_Ways], rule: str) -> Iterator[_History | None]:
        """What the ways through a public rule do, in the order they were written.

        Ways that have done the same so far are followed together: thousands of them are one
        history when they differ in nothing that shows.
        """
        automaton, commands = self.automaton, self._commands
        stack: list[tuple[int, list[int], _History | None]] = [(0, [START], None)]
        while stack:
            position, nodes, history = stack.pop()
            further: dict[tuple[_Said, Actions], list[int]] = {}
            here, pending, seen = ways[position], nodes[::-1], set(nodes)
            while pending:
                node = pending.pop()
                arcs = here.get(node, ())
                if node == FINAL and position == len(ways) - 1:
                    yield history
                quiet: list[int] = []
                for arc in sorted(arcs) if len(arcs) > 1 else arcs:
                    if commands.get(arc, rule) != rule:
                        continue
                    said = _said(automaton.words[arc])
                    actions, target = automaton.actions[arc], automaton.targets[arc]
                    if said is not _Said.NOTHING or actions:
                        further.setdefault((said, actions), []).append(target)
                    elif target not in seen:
                        seen.add(target)
                        quiet.append(target)
                pending += reversed(quiet)
            for (said, actions), targets in reversed(further.items()):
                # A node that several ways lead to is followed once: they would double at each word.
                distinct = list(dict.fromkeys(targets))
                passed = position + (said is not _Said.NOTHING)
                stack.append((passed, distinct, (history, said, actions)))


def _said(word: str | None) -> _Said:
    if word is None:
        return _Said.NOTHING
    return _Said.FREE if word == ANY else _Said.LISTED


def _add_silent_ways(state: State, alive: set[int], ways: _Ways) -> None:
    """Add the nodes and arcs that lead to those alive without a word."""
    pending = list(alive)
    while pending:
        for node, arc in state.silent_into.get(pending.pop(), ()):
            ways.setdefault(node, []).append(arc)
            if node not in alive:
                alive.add(node)
                pending.append(node)


class _Open(NamedTuple):
    """A rule whose end has not come yet, or tags that wait for it."""

    children: list[Tree | str]
    """Of the rule; for tags, those of the rule around them."""
    start: int
    rule: str | None
    entries: tuple[TagEntry, ...]
    is_last: bool


def _slots_in(history: _History | None, end: int) -> list[_Span]:
    """The free slots of one way through a sentence, which has its end behind that many words."""
    found: list[_Span] = []
    position, behind = end, None
    while history is not None:
        history, said, actions = history
        if said is _Said.NOTHING:
            continue
        position -= 1
        for action in actions:
            if isinstance(action, Take):
                behind = behind or position + 1
                if action.is_first:
                    found.append((action.slot, position, behind))
                    behind = None
    return found[::-1]


def _reading(
    words: list[str], history: _History | None, slots: Iterable[SlotWords]
) -> tuple[Tree, Groups, tuple[int, ...], tuple[int, ...]]:
    """The tree, the tags in order, the ends of their words, and the numbers of the free words of
    one way through a sentence.
    """
    steps: list[tuple[_Said, Actions]] = []
    while history is not None:
        history, said, actions = history
        steps.append((said, actions))
    groups: list[tuple[TagEntry, ...]] = []
    ends: list[int] = []
    top: list[Tree | str] = []
    children, position = top, 0
    open_rules: list[_Open] = []

    def close() -> _Open:
        nonlocal children
        ended = open_rules.pop()
        if ended.rule is None:
            groups.append(ended.entries)
            ends.append(position)
        else:
            children = open_rules[-1].children if open_rules else top
            tree = Tree(ended.rule, ended.start, position, tuple(ended.children))
            children.append(tree)
        return ended

    free: list[int] = []
    taken = iter(slots)
    for said, actions in reversed(steps):
        is_said = said is _Said.NOTHING
        if said is _Said.FREE:
            free.append(position)
        for action in actions:
            if isinstance(action, Enter) and action.is_command:
                # What was said before its own words belongs to it, too.
                open_rules.append(_Open(top.copy(), 0, action.rule, (), action.is_last))
                children = open_rules[-1].children
                top.clear()
            elif isinstance(action, Enter):
                children = []
                open_rules.append(_Open(children, position, action.rule, (), action.is_last))
            elif isinstance(action, Defer):
                open_rules.append(_Open(children, position, None, action.entries, True))
            else:
                # A rule begins before the word of an arc, and ends behind it.
                if not is_said:
                    children.append(words[position])
                    position += 1
                    is_said = True
                if isinstance(action, Apply):
                    groups.append(action.entries)
                    ends.append(position)
                elif isinstance(action, Take):
                    if action.is_first:
                        groups.append(_set_by(next(taken)))
                        ends.append(position)
                else:
                    assert isinstance(action, Leave)
                    while close().is_last:
                        pass
        if not is_said:
            children.append(words[position])
            position += 1
    while open_rules:
        close()
    tree = top[0]
    assert isinstance(tree, Tree)
    return tree, tuple(groups), tuple(ends), tuple(free)
