"""What may be said while a form is filled: answers, and all that corrects, empties or ends them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from hri.conversation.forms import NOTHING, Form
from hri.core import paths
from hri.core.signals import Utterance
from hri.robot.verbs import in_words
from hri.speech.answering import AFTER, BEFORE, CANCEL, CORRECTING, answering
from hri.speech.grammar import Grammar, Rule, load_grammar, parse
from hri.speech.grammar.doc_comments import DocTag
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
from hri.speech.grammar.framing import framed
from hri.speech.grammar.merging import with_parts_of
from hri.speech.grammar.tags import TagEntry
from hri.speech.grammar.words import normalize

YES, NO = "answers.yes", "answers.no"
SLOT = "form.slot"
"""The rule of what names a slot that is to be asked for again: "change the size"."""
EMPTY = "form.empty"
"""The rule of what leaves a slot empty: "no toppings"."""
SEVERAL = "form.several"
"""The rule of answers among other words, which are typed: "a small one dear with olives please"."""
NAMES = "form.names"
"""The part that names a slot."""
NAMED = "form.named"
"""The rule of what may stand before an answer: "no wait", "the size should be"."""
CHANGING = ("change", "i want to change", "i'd like to change", "can we change")
"""What may be said before the name of a slot."""
LINKING = ("to", "is", "it's", "should be", "has to be", "as")
"""What may be said between the name of a slot and its value."""
WITHOUT = ("no", "without", "without any", "leave out the", "skip the", "hold the", "i don't want")
"""What may be said before the name of a slot that is left empty."""
MOST_BETWEEN, MOST_BEHIND = 4, 6
"""Other words between two answers, and behind the last."""
NEGATING = frozenset(("no", "not", "don't", "without", "never", "instead", "except", "isn't"))
"""One of these among the other words leaves open what is wanted."""


def form_grammar(form: Form, grammar: Grammar) -> Grammar:
    """The grammar of a form as it is heard.

    It has yes and no, words that correct an answer, the names of slots ("change the size"), also
    before a value ("the size should be large"), and words for a slot that stays empty.
    """
    found = with_parts_of(grammar, load_grammar(paths.house() / "grammars" / "answers.jsgf"))
    rules = dict(found.rules)
    for key in (YES, NO):
        rules[key] = replace(rules[key], is_public=True)
    asked = answering(replace(found, rules=rules), NAMED)
    if CANCEL not in asked.rules:  # another language
        return asked
    own = {key: asked.rules[key] for key in grammar.public_rules}
    words = _Words(next(iter(own.values())))
    made = {EMPTY: words.empty(form), SLOT: words.slot()}
    made |= {NAMES: words.names(form), NAMED: words.named(), SEVERAL: words.several((*own, EMPTY))}
    # "Never mind" is also a no, to a question of yes or no alone, and "nothing" empties no slot
    # by its name.
    first = {key: asked.rules[key] for key in (CANCEL, NO)}
    return replace(asked, rules={**own, **first, **made, **asked.rules, **made})


def is_clear(grammar: Grammar, answer: Utterance) -> bool:
    """Whether nothing that was said among answers turns one of them around."""
    found = parse(grammar, answer.text, {SEVERAL}) if answer.rule == SEVERAL else None
    said = [] if found is None else found.text.split()
    return found is None or NEGATING.isdisjoint(said[number] for number in found.free)


class _Words:
    """Makes the rules of a form, which are placed where a rule of its grammar is."""

    def __init__(self, like: Rule) -> None:
        self._like, self._span = like, like.span

    def names(self, form: Form) -> Rule:
        """The name of a slot, which is the tag `slot`."""
        article = self._maybe(self._any_of(("the", "my")))
        names = self._either(
            self._tagged(self._words(in_words(slot.name)), "slot", slot.name) for slot in form.slots
        )
        row = (self._maybe(self._any_of(CHANGING)), article, names)
        return self._rule(NAMES, Sequence(row, self._span), is_public=False)

    def slot(self) -> Rule:
        return self._rule(SLOT, framed(self._to(NAMES), self._to(CORRECTING), self._to(AFTER)))

    def named(self) -> Rule:
        """What may stand before an answer, with the name of its slot or without."""
        linking, before = self._maybe(self._any_of(LINKING)), self._maybe(self._to(BEFORE))
        row = (self._maybe(self._to(CORRECTING)), self._to(NAMES), linking, before)
        expression = self._either((self._to(CORRECTING), Sequence(row, self._span)))
        return self._rule(NAMED, expression, is_public=False)

    def empty(self, form: Form) -> Rule:
        """What leaves a slot empty that may be; no sentence without such a slot."""
        choices = []
        for slot in form.slots:
            if slot.none is not None:
                said = [f"{words} {in_words(slot.name)}" for words in WITHOUT]
                said += filter(None, [" ".join(normalize(slot.none))])
                choices.append(self._tagged(self._any_of(said), slot.name, NOTHING))
        expression = framed(self._either(choices), self._to(BEFORE), self._to(AFTER))
        return self._rule(EMPTY, expression, is_public=bool(choices))

    def several(self, answers: Iterable[str]) -> Rule:
        item = self._either(map(self._to, answers))
        between, behind = (
            self._maybe(Anything(self._span, 1, most)) for most in (MOST_BETWEEN, MOST_BEHIND)
        )
        more = Repeat(Sequence((between, item), self._span), 0, self._span)
        rule = self._rule(SEVERAL, Sequence((item, more, behind), self._span))
        return replace(rule, doc_tags=(DocTag("typed", "", self._span),))

    def _rule(self, key: str, expression: Expression, is_public: bool = True) -> Rule:
        return replace(self._like, key=key, expression=expression, is_public=is_public, doc_tags=())

    def _words(self, text: str) -> Expression:
        return Sequence(tuple(Token(word, self._span) for word in text.split()), self._span)

    def _any_of(self, texts: Iterable[str]) -> Expression:
        return self._either(map(self._words, texts))

    def _either(self, choices: Iterable[Expression]) -> Expression:
        every = tuple(choices)
        return Alternative(every, (1.0,) * len(every), self._span)

    def _maybe(self, item: Expression) -> Expression:
        return Optional(item, self._span)

    def _tagged(self, item: Expression, name: str, value: str) -> Expression:
        return Tagged(item, (TagEntry(name, "=", value),), self._span)

    def _to(self, key: str) -> Expression:
        return RuleReference(key, self._span)
