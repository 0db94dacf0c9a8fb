"""Whether more words may follow a spoken sentence of a grammar and change what it means."""

from __future__ import annotations

from collections.abc import Iterator

from hri.speech.grammar.automaton import START, Actions, Enter, Leave
from hri.speech.grammar.matching import Matcher, as_spoken
from hri.speech.grammar.rules import Rules
from hri.speech.grammar.words import free_words, slot_name, typed


def may_go_on(grammar: Rules, rule: str, text: str, command: str) -> bool:
    """Whether words may follow that give a sentence of a public rule another rule or other tags.

    `command` has the words of the sentence without those around it, which change nothing: free
    words, and what is said aside. But all of `text` may be said aside before a sentence of another
    rule, as "hello robot" is before "turn left". Where in doubt words may follow: tags are not
    compared with those that are there. Raises what `build` raises.
    """
    walk = _Walk(grammar)
    for public, entry in walk.matcher.automaton.entries.items():
        nodes = walk.along(entry, command)
        if nodes and walk.changes(nodes, public == rule):
            return True
    return walk.goes_on(walk.along(START, text, without=rule))


class _Walk:
    """Goes along the words that mean something."""

    def __init__(self, grammar: Rules) -> None:
        self.matcher: Matcher = grammar.made(as_spoken)
        rules = grammar.rules.items()
        self._slots = frozenset(filter(slot_name, self.matcher.words))
        self._aside = frozenset(name for name, rule in rules if "aside" in rule.marks)

    def along(self, node: int, words: str, without: str = "") -> set[int]:
        """The nodes behind words that begin at a node; none where no sentence begins with them.

        Not by words said aside; or by these, too, but not by those of one public rule.
        """
        nodes, in_slots = {node}, set[int]()
        for word in typed(words):
            nodes = self._silently(nodes, without)
            # A slot may go on with any word, so its arcs stay open.
            in_slots |= {arc for slot in self._slots for arc in self._said(nodes, slot, without)}
            targets = self.matcher.automaton.targets
            nodes = {targets[arc] for arc in (*self._said(nodes, word, without), *in_slots)}
        return nodes

    def _said(self, nodes: set[int], word: str, without: str) -> Iterator[int]:
        """The arcs by which a word leaves the nodes."""
        for node in nodes:
            for arc in self.matcher.leaving(node)[1].get(word, ()):
                if without or not self._is_aside(arc):
                    yield arc

    def goes_on(self, nodes: set[int]) -> bool:
        """Whether a word may follow one of the nodes."""
        return any(True for _ in self._spoken(self._silently(nodes)))

    def changes(self, nodes: set[int], is_same_rule: bool) -> bool:
        """Whether a word may follow one of the nodes, by another rule or with tags."""
        automaton = self.matcher.automaton
        behind = set()
        for arc in self._spoken(self._silently(nodes)):
            if not is_same_rule or _has_tags(automaton.actions[arc]):
                return True
            behind.add(automaton.targets[arc])
        # Behind a word every arc counts, with a word or without.
        pending, seen = list(behind), behind
        while pending:
            node = pending.pop()
            silent, table = self.matcher.leaving(node)
            for arc in (*silent, *(arc for arcs in table.values() for arc in arcs)):
                if self._is_aside(arc):
                    continue
                if _has_tags(automaton.actions[arc]):
                    return True
                if (target := automaton.targets[arc]) not in seen:
                    seen.add(target)
                    pending.append(target)
        return False

    def _silently(self, nodes: set[int], without: str = "") -> set[int]:
        """The nodes, and those behind them that need no word."""
        seen, pending = set(nodes), list(nodes)
        targets = self.matcher.automaton.targets
        while pending:
            for arc in self.matcher.leaving(pending.pop())[0]:
                is_barred = self._begins(arc, without) if without else self._is_aside(arc)
                if targets[arc] not in seen and not is_barred:
                    seen.add(targets[arc])
                    pending.append(targets[arc])
        return seen

    def _spoken(self, nodes: set[int]) -> Iterator[int]:
        """The arcs with a word that leave the nodes."""
        for node in nodes:
            for word, arcs in self.matcher.leaving(node)[1].items():
                if free_words(word) is None:
                    yield from (arc for arc in arcs if not self._is_aside(arc))

    def _begins(self, arc: int, rule: str) -> bool:
        return Enter(rule, is_last=True, is_command=True) in self.matcher.automaton.actions[arc]

    def _is_aside(self, arc: int) -> bool:
        actions = self.matcher.automaton.actions[arc]
        return any(isinstance(one, Enter) and one.rule in self._aside for one in actions)


def _has_tags(actions: Actions) -> bool:
    return any(not isinstance(one, Enter | Leave) for one in actions)
