"""Reads grammars in JSGF 1.0 (Java Speech Grammar Format, Sun 1998; W3C note of 2000).

A hand-written tokenizer and recursive-descent parser. Every node knows where it stands, every
mistake says what was expected, and after a mistake reading goes on at the next rule, so that an
author sees all of them at once.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from hri.core.errors import AuthoringError, Place, did_you_mean
from hri.speech.grammar.expressions import (
    Alternative,
    Expression,
    Optional,
    Repeat,
    RuleReference,
    Sequence,
    Span,
    Tagged,
    Token,
)
from hri.speech.grammar.tags import read_entries

DEEPEST = 50
"""Brackets within brackets; deeper is a mistake or an attack."""

_HEADER = re.compile(r"#JSGF\s+V1\.0(\s+[\w.:-]+)?(\s+[\w-]+)?\s*;")

_LEXICON = re.compile(
    r"""(?P<space>\s+)
    |(?P<comment>//[^\n]*|/\*.*?\*/)
    |(?P<weight>/\s*[^/\n|;]*/)
    |(?P<rule><[^<>;|(){}\[\]\n]*>)
    |(?P<tag>\{(?:[^\\{}]|\\.)*\})
    |(?P<quoted>"(?:[^"\\\n]|\\.)*")
    |(?P<sign>[=;|*+()\[\]])
    |(?P<word>[^\s=;|*+<>()\[\]{}/"]+)
    |(?P<stray>.)""",
    re.VERBOSE | re.DOTALL,
)

_STRAY = {
    "<": ("this rule name has no end", 'write ">" after the name'),
    ">": ('this ">" has no "<"', "write rule names as <name>"),
    "{": ("this tag has no end", 'write "}" after it'),
    "}": ('this "}" has no "{"', "write tags as {name=value}"),
    '"': ("this quote has no end on its line", "write another quote after the words"),
    "/": ('a lone "/"', "write comments as // or /* */ and weights as /2.5/"),
}


@dataclass(frozen=True, slots=True)
class Lexeme:
    """A piece of the text; `kind` is a group of the lexicon, or "end"."""

    kind: str
    text: str
    start: int
    end: int


@dataclass(frozen=True, slots=True)
class RuleDefinition:
    """`public <name> = expression;` as it was written."""

    name: str
    expression: Expression
    is_public: bool
    span: Span
    doc: str = ""
    """The text of the /** */ comment before it."""


@dataclass(frozen=True, slots=True)
class Import:
    """`import <grammar.rule>;` or `import <grammar.*>;`."""

    grammar: str
    rule: str
    """"*" for all public rules."""
    span: Span


@dataclass(slots=True)
class Document:
    """One grammar file as it was written, with all its mistakes."""

    path: Path
    name: str = ""
    imports: list[Import] = field(default_factory=list)
    rules: list[RuleDefinition] = field(default_factory=list)
    errors: list[AuthoringError] = field(default_factory=list)


class _Mistake(Exception):
    """Leads from the mistake to the place where reading goes on."""


def read_jsgf(text: str, path: Path) -> Document:
    """The rules of a grammar's text; mistakes are collected in `errors`, none is raised."""
    return _Reader(text, path).read()


class _Reader:
    def __init__(self, text: str, path: Path) -> None:
        self.text = text
        self.document = Document(path)
        self._line_starts = [0, *(match.end() for match in re.finditer("\n", text))]
        self._docs: dict[int, str] = {}
        self._position = 0
        self._depth = 0

    # Places

    def _line_and_column(self, offset: int) -> tuple[int, int]:
        low, high = 0, len(self._line_starts)
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (middle, high) if self._line_starts[middle] <= offset else (low, middle)
        return low + 1, offset - self._line_starts[low] + 1

    def _span(self, start: int, end: int) -> Span:
        return Span(*self._line_and_column(start), *self._line_and_column(end))

    def _span_from(self, start: int) -> Span:
        return self._span(start, self._lexemes[max(self._position - 1, 0)].end)

    def _report(self, offset: int, what: str, remedy: str) -> _Mistake:
        place = Place(self.document.path, *self._line_and_column(offset))
        self.document.errors.append(AuthoringError(place, what, remedy))
        return _Mistake()

    # Lexemes

    def _split(self, start: int) -> Iterator[Lexeme]:
        for match in _LEXICON.finditer(self.text, start):
            kind = match.lastgroup or "stray"
            if kind == "comment":
                self._keep_doc(match)
            elif kind != "space":
                yield Lexeme(kind, match.group(), match.start(), match.end())
        yield Lexeme("end", "the end of the file", len(self.text), len(self.text))

    def _keep_doc(self, match: re.Match[str]) -> None:
        if match.group().startswith("/**"):
            lines = [line.strip(" \t*") for line in match.group()[3:-2].splitlines()]
            # Kept under the offset of what follows the comment and the white space behind it.
            rest = re.compile(r"\s*").match(self.text, match.end())
            self._docs[rest.end() if rest else match.end()] = " ".join(filter(None, lines))

    @property
    def _next(self) -> Lexeme:
        return self._lexemes[self._position]

    def _take(self, *signs: str) -> Lexeme | None:
        """The next lexeme if it is one of these signs or words; else None, and it stays."""
        lexeme = self._next
        if lexeme.kind in ("sign", "word") and lexeme.text in signs:
            self._position += 1
            return lexeme
        return None

    def _expect(self, sign: str, remedy: str) -> Lexeme:
        found = self._take(sign)
        if found is None:
            raise self._unexpected(f'"{sign}"', remedy)
        return found

    def _unexpected(self, expected: str, remedy: str) -> _Mistake:
        lexeme = self._next
        if lexeme.kind == "stray" and lexeme.text in _STRAY:
            return self._report(lexeme.start, *_STRAY[lexeme.text])
        shown = lexeme.text if lexeme.kind == "end" else f'"{lexeme.text[:40]}"'
        return self._report(lexeme.start, f"expected {expected}, found {shown}", remedy)

    # The grammar of grammars

    def read(self) -> Document:
        self._lexemes = list(self._split(self._header()))
        self._last = len(self._lexemes) - 1
        try:
            self._name()
        except _Mistake:
            self._recover()
        while self._next.kind != "end":
            try:
                self._definition()
            except _Mistake:
                self._recover()
        return self.document

    def _header(self) -> int:
        """Check the first line; the offset behind it."""
        start = len(self.text) - len(self.text.lstrip("\ufeff \t\r\n"))
        match = _HEADER.match(self.text, start)
        if match is not None:
            return match.end()
        self._report(start, "the header is missing", 'write "#JSGF V1.0;" as the first line')
        if not self.text.startswith("#", start):
            return start
        line_end = self.text.find("\n", start)
        return line_end if line_end >= 0 else len(self.text)

    def _name(self) -> None:
        remedy = 'write "grammar name;" after the header'
        if self._take("grammar") is None:
            self._unexpected('"grammar"', remedy)
            return
        lexeme = self._next
        if lexeme.kind != "word":
            raise self._unexpected("the grammar's name", remedy)
        self._position += 1
        self.document.name = lexeme.text
        self._expect(";", 'end it with ";"')

    def _recover(self) -> None:
        """Go on behind the next ";" or before what looks like the next rule."""
        while self._next.kind != "end" and not self._begins_definition():
            if self._take(";"):
                return
            self._position += 1

    def _begins_definition(self) -> bool:
        """Whether a new rule starts here: its "<name> =", or "public" or "import" before it."""
        one, two, three = (
            self._lexemes[min(self._position + ahead, self._last)] for ahead in range(3)
        )
        if one.kind == "word" and one.text == "public":
            one, two = two, three
        if one.kind == "word" and one.text == "import":
            return two.kind == "rule" and three.text == ";"
        return one.kind == "rule" and two.text == "="

    def _definition(self) -> None:
        start = self._next.start
        if self._take("import"):
            self._import(start)
            return
        is_public = self._take("public") is not None
        lexeme = self._next
        if lexeme.kind != "rule":
            remedy = "write a rule as <name> = words;"
            if lexeme.kind == "word":
                remedy = did_you_mean(lexeme.text, ("public", "import"), remedy)
            raise self._unexpected("a rule", remedy)
        self._position += 1
        name = self._rule_name(lexeme)
        self._expect("=", f'write "=" after <{name}>')
        expression = self._alternatives()
        self._expect(";", 'end the rule with ";", or mend what stands here')
        span = self._span(start, lexeme.end)
        definition = RuleDefinition(name, expression, is_public, span, self._docs.get(start, ""))
        self.document.rules.append(definition)

    def _import(self, start: int) -> None:
        lexeme = self._next
        grammar, _, rule = lexeme.text.strip("<> \t").rpartition(".")
        if lexeme.kind != "rule" or not grammar or not rule:
            remedy = "write import <grammar.rule>; or import <grammar.*>;"
            raise self._unexpected("a rule of another grammar", remedy)
        self._position += 1
        self.document.imports.append(Import(grammar, rule, self._span(start, lexeme.end)))
        self._expect(";", 'end it with ";"')

    def _rule_name(self, lexeme: Lexeme) -> str:
        name = lexeme.text[1:-1].strip()
        if not name or re.search(r'[\s=*+/"]', name):
            what = f"{lexeme.text} is no rule name"
            raise self._report(lexeme.start, what, "write letters, digits, _ and . between < and >")
        return name

    def _alternatives(self) -> Expression:
        start = self._next.start
        choices: list[Expression] = []
        weights: list[float] = []
        while True:
            weights.append(self._weight())
            choices.append(self._sequence())
            if not self._take("|"):
                break
        if len(choices) == 1:
            return choices[0]
        return Alternative(tuple(choices), tuple(weights), self._span_from(start))

    def _weight(self) -> float:
        lexeme = self._next
        if lexeme.kind != "weight":
            return 1.0
        self._position += 1
        try:
            weight = float(lexeme.text[1:-1])
        except ValueError:
            weight = math.nan
        if not 0.0 <= weight < math.inf:
            raise self._report(
                lexeme.start, f"{lexeme.text} is no weight", "write a number such as /2.5/"
            )
        return weight

    def _sequence(self) -> Expression:
        start = self._next.start
        items: list[Expression] = []
        while (item := self._repeated()) is not None:
            items.append(item)
        if not items:
            raise self._unexpected("words", 'write words, or <NULL> for "nothing"')
        return items[0] if len(items) == 1 else Sequence(tuple(items), self._span_from(start))

    def _repeated(self) -> Expression | None:
        """A word, rule or group with the repeats and tags behind it."""
        start = self._next.start
        item = self._item()
        while item is not None:
            if sign := self._take("*", "+"):
                item = Repeat(item, int(sign.text == "+"), self._span_from(start))
            elif self._next.kind == "tag":
                item = self._tagged(item, start)
            else:
                break
        return item

    def _tagged(self, item: Expression, start: int) -> Expression:
        lexeme = self._next
        self._position += 1
        content = re.sub(r"\\(.)", r"\1", lexeme.text[1:-1], flags=re.DOTALL)
        try:
            return Tagged(item, read_entries(content), self._span_from(start))
        except ValueError as error:
            remedy = "write {name=value}, more of them with spaces between"
            self._report(lexeme.start, str(error), remedy)
            return item

    def _item(self) -> Expression | None:
        lexeme = self._next
        if self._begins_definition():
            return None
        if lexeme.kind == "word":
            self._position += 1
            return Token(lexeme.text.lower(), self._span(lexeme.start, lexeme.end))
        if lexeme.kind == "quoted":
            self._position += 1
            return self._quoted(lexeme)
        if lexeme.kind == "rule":
            self._position += 1
            return self._reference(lexeme)
        if self._take("("):
            return self._group(lexeme, ")")
        if self._take("["):
            inside = self._group(lexeme, "]")
            return Optional(inside, self._span_from(lexeme.start))
        if lexeme.kind == "weight":
            what = "a weight in the middle of words"
            raise self._report(lexeme.start, what, "weights stand first in an alternative")
        return None

    def _reference(self, lexeme: Lexeme) -> Expression:
        name = self._rule_name(lexeme)
        span = self._span(lexeme.start, lexeme.end)
        if name == "NULL":
            return Sequence((), span)
        if name == "VOID":
            return Alternative((), (), span)
        return RuleReference(name, span)

    def _quoted(self, lexeme: Lexeme) -> Expression:
        span = self._span(lexeme.start, lexeme.end)
        words = lexeme.text[1:-1].replace("\\", "").lower().split()
        if not words:
            raise self._report(lexeme.start, "an empty quote", 'write <NULL> for "nothing"')
        tokens = tuple(Token(word, span) for word in words)
        return tokens[0] if len(tokens) == 1 else Sequence(tokens, span)

    def _group(self, opening: Lexeme, closing: str) -> Expression:
        self._depth += 1
        try:
            if self._depth > DEEPEST:
                what = f"brackets nested deeper than {DEEPEST}"
                raise self._report(opening.start, what, "use rules of their own")
            inside = self._alternatives()
        finally:
            self._depth -= 1
        if not self._take(closing):
            line, column = self._line_and_column(opening.start)
            remedy = f'close the "{opening.text}" of line {line}, column {column}'
            raise self._unexpected(f'"{closing}"', remedy)
        return inside
