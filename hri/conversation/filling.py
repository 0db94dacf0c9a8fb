"""Fills a form by asking a person for what is missing, and whether it is right."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Any

from hri.conversation.forms import NOTHING, Form
from hri.core import paths
from hri.core.signals import Utterance
from hri.robot.verbs import Ending, ask_in_force, in_words, say
from hri.speech.answering import AFTER, CANCEL, CORRECTING, answering
from hri.speech.behaviors import Listener, Voice
from hri.speech.grammar import Grammar, Rule, load_grammar
from hri.speech.grammar.expressions import (
    Alternative,
    Expression,
    Optional,
    RuleReference,
    Sequence,
    Tagged,
    Token,
)
from hri.speech.grammar.framing import framed
from hri.speech.grammar.merging import with_parts_of
from hri.speech.grammar.tags import TagEntry
from hri.speech.tasks import answers_of
from hri.task.context import TaskContext

YES, NO = "answers.yes", "answers.no"
SLOT = "form.slot"
"""The rule of what names a slot that is to be asked for again."""
CHANGING = ("change", "i want to change", "i'd like to change", "can we change")
"""What may be said before the name of a slot."""
BREATH = 0.3
"""Seconds in which it begins to answer what else was said, and between looks at its voice."""


async def fill(context: TaskContext, form: Form, known: Mapping[str, Any]) -> dict[str, Any] | None:
    """The slots of a form, as a person confirmed them; None where they did not.

    `known` are tags of the sentence that began it. An answer may fill several slots, and may
    correct one that was filled; what was unclear is asked for alone. After a last no it says
    `refused`; the events of its questions show why else it was given up. Raises HriError for a
    grammar that cannot be used.
    """
    values = form.taken(known)
    async with answers_of(context, str(form.grammar), partial(form_grammar, form)):
        for _ in range(form.most_turns):
            slot = form.next_slot(values)
            if slot is None and not form.confirm:
                return values
            question = slot.ask if slot else form.filled_in(form.confirm, values)
            answer = await _answer(context, form, question, is_yes_or_no=slot is None)
            if isinstance(answer, Ending):
                return None
            if isinstance(answer, Utterance) and (tags := _told(form, answer)):
                values = _with(values, tags)
            elif slot is not None:
                if not _is_yes(answer) and slot.none is None:
                    break
                values |= {} if _is_yes(answer) else {slot.name: NOTHING}
            elif _is_yes(answer):
                return values
            elif (changed := await _changed(context, form)) is None:
                break
            else:
                values = _with(values, changed)
    if form.refused:
        await say(context, form.refused)
    return None


async def _changed(context: TaskContext, form: Form) -> dict[str, Any] | None:
    """The slots that are to be otherwise, after a no; None where nothing is."""
    answer = await _answer(context, form, form.change) if form.change else False
    return _told(form, answer) or None if isinstance(answer, Utterance) else None


def _told(form: Form, answer: Utterance) -> dict[str, Any]:
    """The slots that an answer fills; None for one that is to be asked for again."""
    if answer.rule == SLOT:
        return {answer.tags["slot"]: None}
    return form.taken(answer.tags)


def _with(values: Mapping[str, Any], told: Mapping[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in {**values, **told}.items() if value is not None}


async def _answer(
    context: TaskContext, form: Form, question: str, is_yes_or_no: bool = False
) -> bool | Utterance | Ending:
    """The answer to a question of a form; who says something else is asked again."""
    questions = {slot.name: slot.ask for slot in form.slots}
    ask = partial(ask_in_force, context, question, questions=questions, is_yes_or_no=is_yes_or_no)
    answer = await ask()
    if answer is Ending.OTHER and not _is_interrupted(context):
        await _after_what_is_said(context)
        answer = await ask()
    return answer


async def _after_what_is_said(context: TaskContext) -> None:
    """Let it answer first what else was said."""
    voice = context.behavior(Voice)
    await context.clock.sleep(BREATH)
    while not voice.is_idle:
        await context.clock.sleep(BREATH)


def _is_interrupted(context: TaskContext) -> bool:
    """Whether the last sentence was one that ends everything, such as "stop"."""
    listener = context.behavior(Listener)
    heard = listener.last_utterance
    return heard is None or heard.rule in listener.loaded_grammar.marked("interrupts")


def _is_yes(answer: bool | Utterance) -> bool:
    return answer is True or (isinstance(answer, Utterance) and answer.rule == YES)


def form_grammar(form: Form, grammar: Grammar) -> Grammar:
    """The grammar of a form as it is heard.

    It has yes and no, words that correct an answer, and the names of slots: "change the size".
    """
    found = with_parts_of(grammar, load_grammar(paths.house() / "grammars" / "answers.jsgf"))
    rules = dict(found.rules)
    for key in (YES, NO):
        rules[key] = replace(rules[key], is_public=True)
    asked = answering(replace(found, rules=rules), CORRECTING)
    if CANCEL not in asked.rules:  # another language
        return asked
    own = {key: asked.rules[key] for key in grammar.public_rules}
    # "Never mind" is also a no, to a question of yes or no alone.
    first = {**own, SLOT: _slots(form, own), CANCEL: asked.rules[CANCEL]}
    return replace(asked, rules={**first, **asked.rules})


def _slots(form: Form, rules: Mapping[str, Rule]) -> Rule:
    """The rule of what names a slot: "change the size", "the size"."""
    like = next(iter(rules.values()))
    span = like.span

    def words(text: str) -> Expression:
        return Sequence(tuple(Token(word, span) for word in text.split()), span)

    def any_of(*choices: Expression) -> Expression:
        return Alternative(choices, (1.0,) * len(choices), span)

    names = [
        Tagged(words(in_words(slot.name)), (TagEntry("slot", "=", slot.name),), span)
        for slot in form.slots
    ]
    before = Optional(any_of(*map(words, CHANGING)), span)
    row = (before, Optional(any_of(words("the"), words("my")), span), any_of(*names))
    around = (RuleReference(key, span) for key in (CORRECTING, AFTER))
    expression = framed(Sequence(row, span), *around)
    return replace(like, key=SLOT, expression=expression, is_public=True, doc_tags=())
