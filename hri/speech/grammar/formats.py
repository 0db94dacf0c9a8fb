"""What a file without the header of JSGF is: how grammars of other programs begin."""

from __future__ import annotations

import re
from typing import NamedTuple

LOOKED_AT = 20_000
"""Characters of a file that are looked at."""


class Format(NamedTuple):
    """A kind of file that is not JSGF."""

    name: str
    remedy: str
    """How its rules are written in JSGF."""
    pattern: re.Pattern[str]
    """What stands in its beginning, and in no other file."""


def _format(name: str, remedy: str, pattern: str) -> Format:
    return Format(name, remedy, re.compile(pattern, re.MULTILINE | re.IGNORECASE))


_XML = r"\A\s*+(?:<\?xml[^>]*+>\s*+)?(?:(?><!--[\s\S]*?-->|<!DOCTYPE[^>]*+>)\s*+)*+"
_COMMENTS = r"\A(?:\s++|[#;](?!JSGF)[^\n]*+)*+"
_SENTENCES = 'write "public <name> = ...;" around its sentences'
_AS_RULE = 'write them as "public <command> = turn left | turn right;"'
_IN_JSGF = "write it in JSGF: "
_NAME_JSGF = "name a grammar in JSGF, which is a text of rules"
FORMATS = (
    _format("a table of words (Kaldi, Vosk)", _AS_RULE, r"\A\s*+<eps>[ \t]+0\b"),
    _format(
        "SRGS, a grammar in XML",
        f"{_IN_JSGF}<one-of> is (a | b), repeat='0-1' is [a], <ruleref uri='#b'/> is <b>,"
        " <tag> is {tag=value}",
        rf"{_XML}<(\w+:)?grammar\b",
    ),
    _format(
        "SRGS, a grammar in ABNF",
        f"{_IN_JSGF}#ABNF 1.0 is #JSGF V1.0, $name is <name>, a<0-1> is [a], the rest is alike",
        r"\A\s*+#ABNF\b",
    ),
    _format("VoiceXML", "take its grammar out, and write it in JSGF", rf"{_XML}<vxml\b"),
    _format("XML", _NAME_JSGF, rf"{_XML}<[a-z][\w:.-]*+(\s[^>]*+)?>(?!\s*(::)?=)"),
    _format(
        "a file of sentences of Home Assistant (hassil, YAML)",
        f"{_SENTENCES}: (a | b) and [a] stay as they are, {{name}} is <name>",
        r"\A(?=[\s\S]*^[ \t]*(intents|lists|expansion_rules|skip_words)[ \t]*:)"
        r"(?=[\s\S]*^[ \t-]*(language|sentences|values|expansion_rules|data|conversation)[ \t]*:)",
    ),
    _format(
        "training data of Rasa or Snips",
        f"{_SENTENCES}, and [text](name) as text {{name=text}}",
        rf"\A\s*+##[ \t]*(intent|lookup|synonym)\b|{_COMMENTS}(---\s*+)?(version[ \t]*:.*\s+)?"
        r"(nlu[ \t]*:|type[ \t]*:[ \t]*(intent|entity)\b)",
    ),
    _format(
        "a file with [sections], as the sentences of Rhasspy",
        f"{_SENTENCES} of each [Intent]: (a | b), [a] and <name> stay, (a){{slot}} is a {{slot=a}}",
        rf"{_COMMENTS}\[[^\[\]\n|\"{{}}]++\][ \t]*+$",
    ),
    _format(
        "a grammar in BNF or GBNF",
        f'{_IN_JSGF}<a> ::= b is public <a> = b;, a quoted "word" needs no quotes, (a)? is [a]',
        rf"{_COMMENTS}(<[^<>\n]++>|[A-Za-z][\w-]*+)\s*+::=",
    ),
    _format(
        'a file of "name: value" lines, as YAML',
        _NAME_JSGF,
        rf"{_COMMENTS}(---[ \t]*+$|[A-Za-z_][\w-]*+:([ \t]|$))",
    ),
    _format(
        'a file of "name = value" lines, as EBNF',
        f'{_IN_JSGF}a = "b" is public <a> = b;, and the first line is "#JSGF V1.0;"',
        rf"{_COMMENTS}(?:\(\*[^*]*+\*\)\s*+)*+(?!public\b|grammar\b)[A-Za-z][\w -]*+=(?!=)",
    ),
    _format(
        "a graph of states (Sphinx FSG)",
        "it was made of a grammar: name that one",
        r"^[ \t]*FSG_BEGIN\b",
    ),
    _format(
        "a language model (ARPA)",
        f"the recognizer needs sentences: {_AS_RULE}",
        r"^\\data\\[ \t\r]*$",
    ),
    _format(
        "a grammar of Nuance (GSL)",
        f"{_IN_JSGF}.Name [(a b) c] is public <name> = a b | c;, ?a is [a]",
        r"\A\s*+;[ \t]*GSL",
    ),
    _format(
        "a list of words, as Vosk takes them (JSON)",
        f"{_AS_RULE}",
        r'\A\s*+\[\s*+(?:"(?:\\.|[^"\\])*+"[\s,]*+)*+\]\s*+\Z',
    ),
    _format("JSON", _NAME_JSGF, r'\A\s*+[\[{]\s*+["\[{\]}]'),
    _format(
        "a program in Python",
        _NAME_JSGF,
        rf"{_COMMENTS}(from[ \t]+[\w.]++[ \t]+import|import[ \t]+[\w.]++[ \t]*+$)",
    ),
    _format(
        "a list of words or sentences",
        f'{_AS_RULE}, or import the file: import "words.txt" as <word>;',
        r"""\A\s*+[^\s=;|*+<>()\[\]{}/"#\\:][^=;|*+<>()\[\]{}/"#\\:]*+\Z""",
    ),
)
"""The more special ones first."""


def format_of(text: str) -> Format | None:
    """What a file without the header of JSGF is; None for one that may be JSGF, or anything."""
    begin = text.removeprefix("\ufeff")[:LOOKED_AT]
    return next((known for known in FORMATS if known.pattern.search(begin)), None)
