"""Fills a form by asking a person for what is missing, and whether it is right."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

from hri.conversation.alarms import completed
from hri.conversation.examples import answers_shown
from hri.conversation.form_grammar import (
    AGREED,
    LESS,
    MORE,
    NO,
    REFUSED,
    SLOT,
    YES,
    form_grammar,
)
from hri.conversation.forms import NOTHING, Form, Slot
from hri.conversation.puzzlement import as_said
from hri.conversation.self_repair import Change, change_of, is_among_others, is_clear, own_words
from hri.core.signals import Utterance
from hri.robot.verbs import Ending, ask_in_force, say
from hri.speech.behaviors import Listener, Voice
from hri.speech.grammar import Grammar, parse
from hri.speech.tasks import answers_of
from hri.task.context import TaskContext

ASKED = "form.asked"
"""Slot of the board with the tag that a form asks for."""
CONFIRMED = "form.confirmed"
"""What stands there while it asks whether all is right."""
BREATH = 0.3
"""Seconds in which it begins to answer what else was said, and between looks at its voice."""


async def fill(
    context: TaskContext, form: Form, known: Mapping[str, Any], typed: str = ""
) -> dict[str, Any] | None:
    """The slots of a form, as a person confirmed them; None where they did not.

    `known` are tags of the sentence that began it; where that was `typed`, the words around its
    command may fill slots as well. An answer may fill several slots, and may
    correct one that was filled; what was unclear is asked for alone. After a last no it says
    `refused`; the events of its questions show why else it was given up. Raises HriError for a
    grammar that cannot be used.
    """
    values, answers = form.taken(known), _Answers(form)
    async with answers_of(context, str(form.grammar), answers.prepared):
        values = _with(values, answers.among(typed, values))
        for _ in range(form.most_turns):
            slot = form.next_slot(values)
            if slot is None and not form.confirm:
                return values
            answer = await _asked(context, form, slot, values)
            if isinstance(answer, Ending):
                return None
            told = answers.told(_grammar(context), answer, values)
            if told is None:
                continue
            if told:
                values = _with(values, told)
            elif slot is not None:
                if not _is_yes(answer) and slot.none is None:
                    break
                values |= {} if _is_yes(answer) else {slot.name: NOTHING}
            elif _is_yes(answer):
                return values
            elif (changed := await _changed(context, form, answers, values)) is None:
                break
            else:
                values = _with(values, changed)
    if form.refused:
        await say(context, form.refused)
    return None


async def _asked(
    context: TaskContext, form: Form, slot: Slot | None, values: Mapping[str, Any]
) -> bool | Utterance | Ending:
    """The answer to the question for a slot, or whether all is right."""
    asked = context.board.slot(ASKED)
    asked.set(CONFIRMED if slot is None else slot.name, context.clock.now())
    try:
        if slot is not None:
            return await _answer(context, form, slot.question(values), slot)
        return await _answer(context, form, form.filled_in(form.confirm, values), is_yes_or_no=True)
    finally:
        asked.clear()


async def _changed(
    context: TaskContext, form: Form, answers: _Answers, values: Mapping[str, Any]
) -> dict[str, Any] | None:
    """The slots that are to be otherwise, after a no; None where nothing is."""
    answer = await _answer(context, form, form.change) if form.change else False
    if isinstance(answer, Ending):
        return None
    told = answers.told(_grammar(context), answer, values)
    return told or None if told is not None else {}


class _Answers:
    """What answers do to the slots of a form."""

    def __init__(self, form: Form) -> None:
        self._form = form
        self._own: Grammar | None = None
        """The answers alone."""

    def prepared(self, grammar: Grammar) -> Grammar:
        """What is heard while the form is filled; in the worker that reads its grammar."""
        heard = form_grammar(self._form, grammar)
        self._own = own_words(heard)
        parse(self._own, "")  # Builds its automaton.
        return heard

    def told(
        self, grammar: Grammar, answer: bool | Utterance, values: Mapping[str, Any]
    ) -> dict[str, Any] | None:
        """The slots that an answer fills, with None for one that is to be asked for again.

        None for an answer that is not clear. `grammar` is the one in force.
        """
        if not isinstance(answer, Utterance):
            return {}
        if self._own is not None and is_among_others(grammar, answer):
            change = change_of(self._own, self._form, answer.text, values)
            if change is None or (told := change.told(values)):
                return None if change is None else told
        return self._of_rule(grammar, answer, values)

    def among(self, text: str, values: Mapping[str, Any]) -> dict[str, Any]:
        """The slots that a typed sentence fills beside these values."""
        change = change_of(self._own, self._form, text, values) if self._own is not None else None
        return {} if change is None else change.told(values)

    def _of_rule(
        self, grammar: Grammar, answer: Utterance, values: Mapping[str, Any]
    ) -> dict[str, Any] | None:
        told = self._form.taken(answer.tags)
        if answer.rule == SLOT or (answer.rule in (YES, NO) and "slot" in answer.tags):
            return {answer.tags["slot"]: None}  # "The size, no."
        if answer.rule == MORE:
            return Change(added=told).told(values)
        if answer.rule == LESS:
            may_be_other = answer.text.startswith("no ")
            return {
                name: _left(_listed(values, name), items, may_be_other)
                for name, items in told.items()
            }
        if answer.rule == AGREED:
            return {} if is_clear(grammar, answer) else None
        if answer.rule == REFUSED:
            slot = self._form.next_slot(values)
            return None if slot is not None and slot.none is None else {}
        return told


def _listed(values: Mapping[str, Any], name: str) -> tuple[Any, ...]:
    """What a slot of several values has by now."""
    return values.get(name) or ()


def _left(listed: tuple[Any, ...], items: tuple[Any, ...], may_be_other: bool) -> Any:
    """A list without some things. None of them in it may mean those instead: "no, olives"."""
    if not set(items) & set(listed):
        return items if may_be_other else listed or None
    return tuple(one for one in listed if one not in items) or NOTHING


def _with(values: Mapping[str, Any], told: Mapping[str, Any]) -> dict[str, Any]:
    """Values with others in their places; a day keeps the time that was said before it."""
    now = {name: completed(value, values.get(name)) for name, value in told.items()}
    return {name: value for name, value in {**values, **now}.items() if value is not None}


async def _answer(
    context: TaskContext,
    form: Form,
    question: str,
    slot: Slot | None = None,
    is_yes_or_no: bool = False,
) -> bool | Utterance | Ending:
    """The answer to a question of a form; who says something else is asked again."""
    ask = partial(
        ask_in_force,
        context,
        question,
        questions={slot.name: slot.ask for slot in form.slots},
        is_yes_or_no=is_yes_or_no,
        hint=partial(_hint, _grammar(context), slot),
    )
    answer = await ask()
    if answer is Ending.OTHER and not _is_interrupted(context):
        await _after_what_is_said(context)
        answer = await ask()
    return answer


def _hint(grammar: Grammar, slot: Slot | None) -> str:
    """What may be answered to the question for a slot; empty for other questions."""
    shown = [] if slot is None else answers_shown(grammar, slot.name)
    if not shown:
        return ""
    *first, last = [f'"{as_said(text)}"' for text in shown]
    return f"You can say {', '.join(first)} or {last}." if first else f"You can say {last}."


async def _after_what_is_said(context: TaskContext) -> None:
    """Let it answer first what else was said."""
    voice = context.behavior(Voice)
    await context.clock.sleep(BREATH)
    while not voice.is_idle:
        await context.clock.sleep(BREATH)


def _is_interrupted(context: TaskContext) -> bool:
    """Whether the last sentence was one that ends everything, such as "stop"."""
    heard = context.behavior(Listener).last_utterance
    return heard is None or heard.rule in _grammar(context).marked("interrupts")


def _grammar(context: TaskContext) -> Grammar:
    return context.behavior(Listener).loaded_grammar


def _is_yes(answer: bool | Utterance) -> bool:
    is_said = isinstance(answer, Utterance) and answer.rule in (YES, AGREED)
    return answer is True or is_said
