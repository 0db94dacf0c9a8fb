"""Reads `replies.toml` and checks it against the grammar, the stimuli and the face."""

from __future__ import annotations

import string
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path

from hri.core.errors import did_you_mean
from hri.core.toml import Table, load_toml

ACTIONS = ("move", "turn", "come", "follow", "stop", "quiet", "sleep", "wake")
FILLED_IN = ("text", "name", "time", "battery", "why", "feeling", "commands")
"""What may stand in braces, beside the tags of the grammar."""


@dataclass(frozen=True)
class Reply:
    """What is done when a rule was heard."""

    say: tuple[str, ...] = ()
    feel: str = ""
    intensity: float = 1.0
    show: str = ""
    action: str = ""


@dataclass(frozen=True)
class Question:
    """A yes/no question and what is said to the answer."""

    ask: str
    yes: str
    no: str


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


UNASKED = ("blocked", "bump", "battery_low", "nobody")


def load_replies(path: Path, vocabulary: Vocabulary) -> Replies:
    """Raises AuthoringError with the place of the first mistake."""
    table = load_toml(path, "file of replies")
    name = table.string("name")
    replies = {}
    for rule, entry in table.tables("reply"):
        if rule not in vocabulary.rules:
            known = sorted(vocabulary.rules)
            raise entry.error(None, f'the grammar has no rule "{rule}"', did_you_mean(rule, known))
        replies[rule] = _reply(entry, vocabulary)
    for rule in vocabulary.rules:
        if rule not in replies:
            what = f"no reply to the rule <{rule}> of the grammar"
            raise table.error(None, what, f"add a table [reply.{rule}], an empty one to do nothing")
    spoken = table.table("unasked")
    unasked = {key: spoken.string(key) for key in UNASKED}
    spoken.finish()
    questions = tuple(_question(entry) for entry in table.array("question"))
    table.finish()
    return Replies(name, replies, unasked, questions)


def _reply(entry: Table, vocabulary: Vocabulary) -> Reply:
    say = entry.data.get("say")
    texts = entry.strings("say") if isinstance(say, list) else [entry.string("say", "")]
    for text in texts:
        _check_braces(entry, text, vocabulary.tags)
    show = entry.string("show", "")
    if show and not show.startswith("{") and show not in vocabulary.expressions:
        remedy = did_you_mean(show, sorted(vocabulary.expressions))
        raise entry.error("show", f'the face has no expression "{show}"', remedy)
    feel = entry.string("feel", "")
    if feel and feel not in vocabulary.stimuli:
        remedy = did_you_mean(feel, sorted(vocabulary.stimuli))
        raise entry.error("feel", f'no stimulus "{feel}"', remedy)
    intensity = entry.number("intensity", 1.0, minimum=0, maximum=1)
    action = entry.string("action", "", among=ACTIONS)
    entry.finish()
    return Reply(tuple(text for text in texts if text), feel, intensity, show, action)


def _question(entry: Table) -> Question:
    question = Question(entry.string("ask"), entry.string("yes", ""), entry.string("no", ""))
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
