"""Reads `replies.toml` and checks it against the grammar, the stimuli and the face."""

from __future__ import annotations

import string
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TypeVar

from hri.core.errors import AuthoringError, AuthoringErrors, did_you_mean
from hri.core.toml import Table, load_toml

T = TypeVar("T")

ACTIONS = ("move", "turn", "come", "follow", "stop", "release", "quiet", "eyes", "sleep", "wake")
AFTER_YES = ("keep",)
"""What may be done after a yes: begin to keep what is felt."""
FILLED_IN = ("text", "name", "time", "battery", "why", "why_stopped", "feeling", "commands")
"""What may stand in braces, beside the tags of the grammar."""


@dataclass(frozen=True)
class Reply:
    """What is done when a rule was heard."""

    say: tuple[str, ...] = ()
    feel: str = ""
    intensity: float = 1.0
    show: str = ""
    gesture: str = ""
    action: str = ""


@dataclass(frozen=True)
class Question:
    """A yes/no question and what is said to the answer."""

    ask: str
    yes: str
    no: str
    action: str = ""
    """What is done after a yes."""


@dataclass(frozen=True)
class Replies:
    """All that the companion can say."""

    name: str
    replies: Mapping[str, Reply]
    """By public rule of the grammar."""
    unasked: Mapping[str, str]
    questions: tuple[Question, ...]


@dataclass(frozen=True)
class Vocabulary:
    """What the other authored files know: names that replies may use."""

    rules: Collection[str]
    tags: Collection[str]
    stimuli: Collection[str]
    expressions: Collection[str]
    gestures: Collection[str]


UNASKED = ("blocked", "bump", "battery_low", "nobody", "waiting", "no_stop")


def load_replies(path: Path, vocabulary: Vocabulary) -> Replies:
    """Raises AuthoringError with the place of a mistake; AuthoringErrors when there are several."""
    table = load_toml(path, "file of replies")
    mistakes = Mistakes()
    name = mistakes.keep(lambda: table.string("name")) or ""
    entries = dict(mistakes.keep(lambda: list(table.tables("reply"))) or ())
    missing = [rule for rule in vocabulary.rules if rule not in entries]
    replies = {}
    for rule, entry in entries.items():
        if rule in vocabulary.rules:
            replies[rule] = mistakes.keep(partial(_reply, entry, vocabulary)) or Reply()
        else:
            remedy = did_you_mean(rule, missing, "delete this table, or mend the grammar")
            mistakes.add(entry.error(None, f'the grammar has no rule "{rule}"', remedy))
    if missing:
        mistakes.add(_unanswered(table, missing))
    unasked = mistakes.keep(lambda: _unasked(table.table("unasked"))) or {}
    asked = mistakes.keep(lambda: table.array("question")) or ()
    questions = [mistakes.keep(partial(_question, entry)) for entry in asked]
    mistakes.keep(table.finish)
    mistakes.tell()
    return Replies(name, replies, unasked, tuple(filter(None, questions)))


class Mistakes:
    """All mistakes of a file: what has one is left out, and reading goes on behind it."""

    def __init__(self) -> None:
        self._errors: list[AuthoringError] = []

    def keep(self, read: Callable[[], T]) -> T | None:
        """What was read; None when there was a mistake in it."""
        try:
            return read()
        except AuthoringError as error:
            self.add(error)
            return None

    def add(self, error: AuthoringError) -> None:
        self._errors.append(error)

    def tell(self) -> None:
        """Raise what was found."""
        if len(self._errors) > 1:
            raise AuthoringErrors(self._errors)
        for error in self._errors:
            raise error


def _unanswered(table: Table, missing: Sequence[str]) -> AuthoringError:
    rules = f"rule{'s' * (len(missing) > 1)} {', '.join(f'<{rule}>' for rule in missing)}"
    each = " for each" * (len(missing) > 1)
    remedy = f"add a table [reply.{missing[0]}]{each}, an empty one to do nothing"
    return table.error(None, f"no reply to the {rules} of the grammar", remedy)


def _unasked(spoken: Table) -> dict[str, str]:
    unasked = {key: spoken.string(key) for key in UNASKED}
    spoken.finish()
    return unasked


def _reply(entry: Table, vocabulary: Vocabulary) -> Reply:
    say = entry.data.get("say")
    texts = entry.strings("say") if isinstance(say, list) else [entry.string("say", "")]
    for text in texts:
        _check_braces(entry, text, vocabulary.tags)
    show = entry.string("show", "")
    if show and not show.startswith("{") and show not in vocabulary.expressions:
        remedy = did_you_mean(show, sorted(vocabulary.expressions))
        raise entry.error("show", f'the face has no expression "{show}"', remedy)
    gesture = entry.string("gesture", "")
    if gesture and gesture not in vocabulary.gestures:
        remedy = did_you_mean(gesture, sorted(vocabulary.gestures))
        raise entry.error("gesture", f'the face has no gesture "{gesture}"', remedy)
    feel = entry.string("feel", "")
    if feel and feel not in vocabulary.stimuli:
        remedy = did_you_mean(feel, sorted(vocabulary.stimuli))
        raise entry.error("feel", f'no stimulus "{feel}"', remedy)
    intensity = entry.number("intensity", 1.0, minimum=0, maximum=1)
    action = entry.string("action", "", among=ACTIONS)
    entry.finish()
    return Reply(tuple(text for text in texts if text), feel, intensity, show, gesture, action)


def _question(entry: Table) -> Question:
    ask, yes, no = entry.string("ask"), entry.string("yes", ""), entry.string("no", "")
    question = Question(ask, yes, no, entry.string("action", "", among=AFTER_YES))
    entry.finish()
    return question


def _check_braces(entry: Table, text: str, tags: Collection[str]) -> None:
    known = (*FILLED_IN, *tags)
    try:
        names = [field for _, field, _, _ in string.Formatter().parse(text) if field is not None]
    except ValueError as error:
        raise entry.error("say", f"{error}", "close every {brace}") from error
    for name in names:
        if name not in known:
            raise entry.error("say", f"nothing fills in {{{name}}}", did_you_mean(name, known))
