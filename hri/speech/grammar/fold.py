"""What a part of a grammar comes to, worked out from the parts below it: the one walk over a tree.

A fold gives the value of a word, combines the values of the parts of a row or a choice, and so on;
the cases it leaves out follow from the rest. A new kind of node has its place here, with its value
for folds that leave it out.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from typing import Generic, TypeVar

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
    heard_choices,
)

V = TypeVar("V")


class Fold(ABC, Generic[V]):
    """One value for each node. Parts come one by one: a fold that knows enough takes no more."""

    def __call__(self, node: Expression) -> V:
        """The value of a node."""
        match node:
            case Token():
                return self.word(node)
            case Anything():
                return self.anything(node)
            case RuleReference():
                return self.reference(node)
            case Sequence(items=items):
                return self.row(node, map(self, items))
            case Alternative():
                return self.choice(node, map(self, heard_choices(node)))
            case Optional(item=item):
                return self.optional(node, self(item))
            case Repeat(item=item, minimum=minimum):
                often = self.repeated(node, self(item))
                return often if minimum else self.optional(Optional(node, node.span), often)
            case Tagged(item=item):
                return self.tagged(node, self(item))

    @abstractmethod
    def word(self, node: Token) -> V:
        """Of a word."""

    def anything(self, node: Anything) -> V:
        """Of free words: as of a word that is none of the grammar's."""
        return self.word(Token(node.text, node.span))

    @abstractmethod
    def reference(self, node: RuleReference) -> V:
        """Of a rule, by its name."""

    @abstractmethod
    def row(self, node: Sequence, parts: Iterator[V]) -> V:
        """Of one part after the other; without parts it is silence."""

    @abstractmethod
    def choice(self, node: Alternative, parts: Iterator[V]) -> V:
        """Of one of the parts that can be heard; without parts it can never be said."""

    def optional(self, node: Optional, part: V) -> V:
        """Of silence or a part."""
        silence = Sequence((), node.span)
        both = Alternative((silence, node.item), (1.0, 1.0), node.span)
        return self.choice(both, iter((self(silence), part)))

    def repeated(self, node: Repeat, part: V) -> V:
        """Of a part that is said once or more often."""
        return part

    def tagged(self, node: Tagged, part: V) -> V:
        """Of a part behind which tags are applied."""
        return part
