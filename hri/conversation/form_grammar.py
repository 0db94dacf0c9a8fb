"""What may be said while a form is filled: answers, and all that corrects, empties or ends them."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace
from itertools import islice

from hri.conversation.examples import different
from hri.conversation.forms import NOTHING, Form
from hri.core import paths
from hri.robot.verbs import in_words
from hri.speech.answering import (
    AFTER,
    BEFORE,
    CANCEL,
    CANCEL_AMONG,
    CORRECTING,
    UNSURE,
    answering,
)
from hri.speech.grammar import Grammar, Parse, Rule, load_grammar, parse
from hri.speech.grammar.analysis import reachable
from hri.speech.grammar.doc_comments import DocTag
from hri.speech.grammar.expressions import (
    Alternative,
    Anything,
    Expression,
    Optional,
    Repeat,
    RuleReference,
    Sequence as Row,
    Tagged,
    Token,
    mapped,
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
ADDED = ("form.", "answers.", "asking.")
"""Beginnings of the names of rules that are not the form's own."""
ALL = "form.all"
"""The rule of what gives a slot of several values all of them: "everything"."""
AGREED, REFUSED = "form.agreed", "form.refused"
"""The rules of a yes and a no with more words behind it, which are typed: "no we already ate"."""
MORE, LESS = "form.more", "form.less"
"""The rules of what adds to a slot of several values, and takes away: "add bacon", "no olives"."""
SEVERAL = "form.several"
"""The rule of answers among other words, which are typed: "a small one dear with olives please"."""
FILLS = "fills"
"""The mark of rules that answer by their tags."""
GIVES_WAY = "gives_way"
"""The mark of rules that count only where none does that answers by its tags."""
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
ADDING = ("add", "and also", "also", "plus", "and add", "and", "put on", "with extra")
"""What may be said before another value of a slot that may have several."""
TAKING_AWAY = (
    *("no", "not", "without", "no more", "take off", "leave off", "leave out", "remove", "hold"),
    *("skip", "drop", "lose", "forget", "get rid of"),
)
"""What may be said before a value that is taken away; "no olives" may also be "no, olives"."""
EVERYTHING = ("everything", "all of them", "all of it", "all of those", "one of each", "the lot")
"""What may be said for all values of a slot that may have several."""
TOO = ("too", "as well", "also")
"""What may be said behind a value that is added."""
PLURAL = re.compile(r"[a-z]{2,}[^s'u]s")
"""Words that people also say without their last letter: "olives", of which a pizza may have one."""
MOST_LOOKED_AT = 20
"""Sentences of a rule that show whether its slot has several values, and which."""
MOST_BEFORE, MOST_BETWEEN, MOST_BEHIND = 8, 8, 8
"""Other words before an answer, between two of them, and behind the last."""


def form_grammar(form: Form, grammar: Grammar) -> Grammar:
    """The grammar of a form as it is heard.

    It has yes and no, words that correct an answer, the names of slots ("change the size"), also
    before a value ("the size should be large"), and words for a slot that stays empty.
    """
    found = with_parts_of(grammar, load_grammar(paths.house() / "grammars" / "answers.jsgf"))
    rules = dict(found.rules)
    for key in (YES, NO):
        rules[key] = replace(rules[key], is_public=True)
    for key in grammar.public_rules:
        rules[key] = _marked(rules[key], FILLS)
    listed = [key for key in grammar.public_rules if _is_listed(form, grammar, key)]
    for key in reachable(rules, listed):
        rules[key] = replace(rules[key], expression=_in_singular(rules[key].expression))
    asked = answering(replace(found, rules=rules), NAMED)
    if CANCEL not in asked.rules:  # another language
        return asked
    own = {key: asked.rules[key] for key in grammar.public_rules}
    words = _Words(next(iter(own.values())))
    made = {EMPTY: words.empty(form), SLOT: words.slot()}
    made |= {NAMES: words.names(form), NAMED: words.named(), ALL: words.all(form, grammar, listed)}
    made |= {SEVERAL: words.several((*own, EMPTY, ALL))}
    made |= {AGREED: words.answer(YES), REFUSED: words.answer(NO)}
    before = {MORE: words.items(MORE, ADDING, listed), LESS: words.items(LESS, TAKING_AWAY, listed)}
    # "Never mind" is also a no, to a question of yes or no alone, and "nothing" empties no slot
    # by its name.
    first = {key: asked.rules[key] for key in (CANCEL, CANCEL_AMONG, UNSURE, NO)}
    return replace(asked, rules={**before, **own, **first, **made, **asked.rules, **made})


def _shown(grammar: Grammar, key: str) -> list[Parse]:
    """Sentences of a rule, as they are understood; MOST_LOOKED_AT where it has more."""
    texts = islice(different(grammar, key), MOST_LOOKED_AT)
    return [found for text in texts if (found := parse(grammar, text, {key}))]


def _marked(rule: Rule, mark: str) -> Rule:
    return replace(rule, doc_tags=(*rule.doc_tags, DocTag(mark, "", rule.span)))


def _is_listed(form: Form, grammar: Grammar, key: str) -> bool:
    """Whether a rule gives values of one slot alone, which may have several."""
    tags = [form.taken(found.tags) for found in _shown(grammar, key)]
    names = {name for told in tags for name in told}
    return len(names) == 1 and all(
        isinstance(told.get(name), tuple) for told in tags for name in names
    )


def _in_singular(node: Expression) -> Expression:
    """The same with "olive" beside "olives"."""
    return mapped(node, Token, _with_singular)


def _with_singular(word: Token) -> Expression:
    if not PLURAL.fullmatch(word.text):
        return word
    return Alternative((word, replace(word, text=word.text[:-1])), (1.0, 1.0), word.span)


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
        return self._rule(NAMES, Row(row, self._span), is_public=False)

    def slot(self) -> Rule:
        return self._rule(SLOT, framed(self._to(NAMES), self._to(CORRECTING), self._to(AFTER)))

    def named(self) -> Rule:
        """What may stand before an answer, with the name of its slot or without."""
        linking, before = self._maybe(self._any_of(LINKING)), self._maybe(self._to(BEFORE))
        row = (self._maybe(self._to(CORRECTING)), self._to(NAMES), linking, before)
        expression = self._either((self._to(CORRECTING), Row(row, self._span)))
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

    def all(self, form: Form, grammar: Grammar, listed: Iterable[str]) -> Rule:
        """What gives a slot all values, where they are few."""
        choices = []
        for shown in (_shown(grammar, key) for key in listed):
            entries = [
                TagEntry(name, "+=", value)
                for found in shown
                for name, values in form.taken(found.tags).items()
                for value in values
            ]
            if len(shown) < MOST_LOOKED_AT:
                choices.append(Tagged(self._any_of(EVERYTHING), tuple(entries), self._span))
        expression = framed(self._either(choices), self._to(BEFORE), self._to(AFTER))
        return self._rule(ALL, expression, is_public=bool(choices))

    def items(self, key: str, before: Iterable[str], listed: Iterable[str]) -> Rule:
        """Things of a slot of several values, and what is to become of them."""
        things = [self._to(one) for one in listed]
        row = (self._any_of(before), self._maybe(self._words("the")), self._either(things))
        last = (self._maybe(self._any_of(TOO)),) if key == MORE else ()
        return self._rule(key, Row((*row, *last), self._span), is_public=bool(things))

    def answer(self, key: str) -> Rule:
        """A yes or a no, and what is typed behind it."""
        row = (self._to(key), Anything(self._span, 1, MOST_BEHIND))
        rule = self._typed(AGREED if key == YES else REFUSED, Row(row, self._span))
        return _marked(rule, GIVES_WAY)

    def several(self, answers: Iterable[str]) -> Rule:
        """Answers with other words before, between and behind them."""
        item = self._either(map(self._to, answers))
        before, between, behind = (
            self._maybe(Anything(self._span, 1, most))
            for most in (MOST_BEFORE, MOST_BETWEEN, MOST_BEHIND)
        )
        more = Repeat(Row((between, item), self._span), 0, self._span)
        row = Row((before, item, more, behind), self._span)
        return _marked(self._typed(SEVERAL, row), FILLS)

    def _typed(self, key: str, expression: Expression) -> Rule:
        return _marked(self._rule(key, expression), "typed")

    def _rule(self, key: str, expression: Expression, is_public: bool = True) -> Rule:
        return replace(self._like, key=key, expression=expression, is_public=is_public, doc_tags=())

    def _words(self, text: str) -> Expression:
        return Row(tuple(Token(word, self._span) for word in text.split()), self._span)

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
