"""The recognition of a clip, compared with the speech in it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from hri.bench.speech.listening import Heard
from hri.bench.speech.samples import Clip
from hri.speech.grammar import Grammar
from hri.speech.grammar.matching import parse


@dataclass(frozen=True, slots=True)
class Outcome:
    """A clip and what was made of it."""

    clip: Clip
    heard: Sequence[Heard]

    @property
    def accepted(self) -> list[Heard]:
        return [heard for heard in self.heard if heard.is_accepted]

    @property
    def is_right(self) -> bool:
        """One thing was understood, and it is what was said: word for word, or slot for slot."""
        if len(self.accepted) != 1:
            return False
        only = self.accepted[0]
        if self.clip.slots:
            return slots(only.tags) == self.clip.slots
        return only.text == self.clip.sentence

    @property
    def is_mistaken(self) -> bool:
        """Something was understood that was not said."""
        return bool(self.accepted) and not self.is_right

    def means_the_same(self, grammar: Grammar) -> bool:
        """One thing was understood, with the same meaning as the spoken sentence."""
        if len(self.accepted) != 1:
            return False
        only, said = self.accepted[0], parse(grammar, self.clip.sentence)
        return said is not None and (only.rule, only.tags) == (said.rule, said.tags)

    def told(self) -> str:
        """For people: the clip and what was heard in it."""
        heard = "; ".join(heard.told() for heard in self.heard) or "nothing"
        return f"{self.clip.name}: {heard}"


def slots(tags: Mapping[str, Any]) -> dict[str, str]:
    """The slots of an order, as the labels write them: how much of what is one slot."""
    found = {name: str(value) for name, value in tags.items()}
    for amount, what in (("milkAmount", "milk"), ("sugarAmount", "sugar")):
        if what in found:
            found[amount] = f"{found.get(amount, '')} {found.pop(what)}".strip()
    return found
