"""What `/** */` comments say about a rule: words for people, and marks for the listener.

    /** Toward whoever speaks.
     *  @careful
     *  @example come closer
     */
    public <come> = come (here | closer);

The marks are ours; `@example`, `@see`, `@author` and `@version` are of JSGF 1.0.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from types import MappingProxyType

from hri.speech.grammar.expressions import SourceSpan
from hri.speech.grammar.lexemes import Lines

MARKS = MappingProxyType(
    {
        "careful": "it moves the robot, so it must be heard without doubt",
        "answer": "it is only heard while a question is open",
        "fills": "it answers by its tags: of two such rules with the same tags either may count",
        "gives_way": "among other words it counts only where no rule does that answers by its tags",
        "interrupts": "it is heard while the robot speaks and under other grammars, too",
        "anywhere": "it counts among other words, too, when they are said to the robot",
        "after": "it is heard only for a while after one of the commands that it names",
        "as": "it stands for the command that it names, or for the last one, with tags changed",
        "typed": "it is heard only from a keyboard: it is too short for the ear",
        "listed": "free words in it and around it count only when they are typed",
        "wake": "other rules are heard only after it, and for a while after what was heard last",
        "aside": "what is said around a command and does not belong to it",
        "name": "what the robot is called; the app adds its name",
        "part": "part of commands in other grammars, not a command itself",
    }
)
"""The marks of a rule and what they mean."""
OF_PARTS = frozenset(("aside", "name"))
"""Those of rules that need not be commands."""

ANY_COMMAND = "any"
"""Behind `@after`: whatever was understood last."""
LAST = "last"
"""Behind `@as`: the command that was said last."""

SPOKEN = "spoken"
"""The tag that says what may stand in a free slot, `@spoken name 2-12 letters`."""

REMEMBER = "remember"
"""The tag that names what a sentence says of a person, `@remember likes`; an app may keep it."""

STANDARD_TAGS = ("example", "see", "author", "version")
"""Doc tags of JSGF 1.0 that are not marks."""

TOPIC = "topic"
"""The tag that names what a rule is about, `@topic teasing`; an app may leave a topic out."""

KNOWN_TAGS = (*MARKS, TOPIC, SPOKEN, REMEMBER, *STANDARD_TAGS)

_TAG = re.compile(r"(?<![^\s*])@([A-Za-z_]\w*)")
_STARS = re.compile(r"^[ \t]*\*+", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class DocTag:
    """`@name text` in a doc comment."""

    name: str
    text: str
    """What follows up to the next tag, in one line."""
    span: SourceSpan
    """Of the "@" and the name."""


@dataclass(frozen=True, slots=True)
class DocComment:
    """A doc comment: its words in one line, then its tags."""

    text: str = ""
    tags: tuple[DocTag, ...] = ()


NO_DOC = DocComment()


def read_doc_comment(comment: str, start: int, lines: Lines) -> DocComment:
    """The meaning of a comment, from its `/**` to its `*/`, that begins at an offset of a text."""
    inside = comment.removesuffix("*/")
    found = list(_TAG.finditer(inside, 3))
    ends = [*(match.start() for match in found), len(inside)]
    tags = (
        DocTag(
            match[1],
            _one_line(inside[match.end() : end]),
            lines.span(start + match.start(), start + match.end()),
        )
        for match, end in zip(found, ends[1:], strict=True)
    )
    return DocComment(_one_line(inside[3 : ends[0]]), tuple(tags))


def _one_line(text: str) -> str:
    return " ".join(_STARS.sub("", text).split())
