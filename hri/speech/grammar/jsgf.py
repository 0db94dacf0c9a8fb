"""Reads grammars in JSGF 1.0 (Java Speech Grammar Format, Sun 1998; W3C note of 2000).

A hand-written tokenizer and recursive-descent parser. Every node knows where it stands, every
mistake says what was expected, and after a mistake reading goes on at the next rule, so that an
author sees all of them at once.

Five things go beyond the standard: marks in doc comments (`hri.speech.grammar.doc_comments`),
lists of names from a text file: `import "friends.txt" as <friend>;`, `@extends` in the doc comment
before `grammar`, numbers of free words: `<any 1-3>`, and free slots: `<name.spoken 1-2>`
(`hri.speech.grammar.free_slots`). What stands in tags, which the standard leaves open, is told in
`hri.speech.grammar.tags`.
"""

from __future__ import annotations

import math
import re
from bisect import bisect_left
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from hri.core.errors import AuthoringError, Place, did_you_mean
from hri.speech.grammar.doc_comments import NO_DOC, DocComment, read_doc_comment
from hri.speech.grammar.expressions import (
    Alternative,
    Anything,
    Expression,
    Optional,
    Repeat,
    RuleReference,
    Sequence,
    SourceSpan,
    Tagged,
    Token,
    depth,
)
from hri.speech.grammar.formats import format_of
from hri.speech.grammar.header import read_header
from hri.speech.grammar.lexemes import MOST_LEXEMES, TOO_MUCH, Lexeme, Lines, split
from hri.speech.grammar.tags import TagError, opaque, read_entries
from hri.speech.grammar.words import free_words, misspelt_slot, normalize, slot_name

EXTENDS, BEFORE, AFTER = "extends", "before", "after"
"""The doc tag before `grammar` that names a grammar whose commands are understood as well."""
DEEPEST = 50
"""Brackets within brackets; deeper is a mistake or an attack."""
DEEPEST_TREE = 120
"""Nodes below each other in one rule, repeats and tags included."""
LONGEST_FREE = 50
"""Words that may be free in a row."""
MOST_ERRORS = 100
"""Most mistakes reported for one file."""

_WEIGHT = re.compile(r"/\s*([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?[fF]?\s*/")
_PART = r"""[^\s.<>{}"*+|;=/\\()\[\]]+"""
_GRAMMAR_NAME = re.compile(rf"{_PART}(\.{_PART})*")
_FREE_WORDS = re.compile(r"<(any\s|[A-Za-z_]\w*\.spoken[\s>])")

_STRAY = {
    "<": ("this rule name has no end", 'write ">" after the name'),
    ">": ('this ">" has no "<"', "write rule names as <name>"),
    "{": ("this tag has no end", 'write "}" after it'),
    "}": ('this "}" has no "{"', "write tags as {name=value}"),
    '"': ("this quote has no end on its line", "write another quote after the words"),
    "/": ('a lone "/"', "write comments as // or /* */ and weights as /2.5/"),
}
_NO_WORD = {
    "#": ('"#" begins no comment here', "write comments as // or /* */"),
    "$": ('"$" stands in tags only', "write <name> for a rule, {tag=$name} for the value of a tag"),
}
"""What is wrong with words that begin with a sign of other languages."""


@dataclass(frozen=True, slots=True)
class RuleDefinition:
    """`public <name> = expression;` as it was written."""

    name: str
    expression: Expression
    is_public: bool
    span: SourceSpan
    """From its first word to its name."""
    doc: DocComment = NO_DOC
    """The /** */ comment before it."""


@dataclass(frozen=True, slots=True)
class Import:
    """`import <grammar.rule>;` or `import <grammar.*>;`."""

    grammar: str
    rule: str
    """"*" for all public rules."""
    span: SourceSpan


@dataclass(frozen=True, slots=True)
class NameListImport:
    """`import "file.txt" as <name>;`: a rule made of the lines of a file."""

    file: str
    name: str
    span: SourceSpan


@dataclass(frozen=True, slots=True)
class KnownListImport:
    """`import "file.txt" as <name.spoken>;`: what a free slot usually is."""

    file: str
    slot: str
    span: SourceSpan


@dataclass(frozen=True, slots=True)
class Extension:
    """`/** @extends companion */ grammar mine;`: its commands are understood as well."""

    grammar: str
    span: SourceSpan


@dataclass(slots=True)
class Document:
    """One grammar file as it was written, with all its mistakes."""

    path: Path
    name: str = ""
    encoding: str = ""
    locale: str = ""
    extends: list[Extension] = field(default_factory=list)
    before: RuleReference | None = None
    """`/** @before <polite> */ grammar mine;`: what may be said before each of its commands."""
    after: RuleReference | None = None
    """What may be said behind each, `@after`."""
    imports: list[Import] = field(default_factory=list)
    name_lists: list[NameListImport] = field(default_factory=list)
    known_lists: list[KnownListImport] = field(default_factory=list)
    rules: list[RuleDefinition] = field(default_factory=list)
    broken: set[str] = field(default_factory=set)
    """Names of rules that could not be read; the mistakes in them are told."""
    errors: list[AuthoringError] = field(default_factory=list)
    warnings: list[AuthoringError] = field(default_factory=list)
    """What is odd but costs no rule; one of a kind, with how many more there are."""


def read_jsgf(text: str, path: Path) -> Document:
    """The rules of a grammar's text; mistakes are collected in `errors`, none is raised."""
    return _JsgfReader(text, path).read()


def _with_number(odd: list[AuthoringError]) -> AuthoringError:
    """The first, with how many more there are."""
    first, *more = odd
    if not more:
        return first
    return AuthoringError(first.place, f"{first.what} (and {len(more)} more)", first.remedy)


class _Mistake(Exception):
    """Leads from the mistake to the place where reading goes on."""


class _JsgfReader:
    def __init__(self, text: str, path: Path) -> None:
        self.text = text
        self.document = Document(path)
        self._lines = Lines(text)
        self._position = 0
        self._brackets = 0
        self._odd: dict[str, list[AuthoringError]] = {}
        """What is odd, by its kind."""

    # Places and mistakes

    def _span(self, lexeme: Lexeme) -> SourceSpan:
        return self._lines.span(lexeme.start, lexeme.end)

    def _span_from(self, start: int) -> SourceSpan:
        return self._lines.span(start, self._lexemes[max(self._position - 1, 0)].end)

    def _report(self, offset: int, what: str, remedy: str) -> _Mistake:
        place = Place(self.document.path, *self._lines.place(offset))
        self.document.errors.append(AuthoringError(place, what, remedy))
        return _Mistake()

    def _remark(self, kind: str, offset: int, what: str, remedy: str) -> None:
        """Something that may be meant otherwise; the first of its kind is told."""
        place = Place(self.document.path, *self._lines.place(offset))
        self._odd.setdefault(kind, []).append(AuthoringError(place, what, remedy))

    def _unexpected(self, expected: str, remedy: str) -> _Mistake:
        lexeme = self._next
        if lexeme.text == TOO_MUCH:
            return _Mistake()  # Told once, by `read`.
        if lexeme.kind == "stray" and lexeme.text in _STRAY:
            return self._report(lexeme.start, *_STRAY[lexeme.text])
        if lexeme.text in (")", "]") and not self._brackets:
            opening = "(" if lexeme.text == ")" else "["
            what = f'this "{lexeme.text}" has no "{opening}"'
            return self._report(lexeme.start, what, "take it out, or open the group")
        shown = lexeme.text if lexeme.kind == "end" else f'"{lexeme.text[:40]}"'
        return self._report(lexeme.start, f"expected {expected}, found {shown}", remedy)

    # Lexemes

    @property
    def _next(self) -> Lexeme:
        return self._lexemes[self._position]

    def _take(self, sign: str) -> bool:
        """Whether the next lexeme is this sign or word; then it is passed."""
        lexeme = self._lexemes[self._position]
        is_there = lexeme.text == sign and lexeme.kind in ("sign", "word")
        self._position += is_there
        return is_there

    def _expect(self, sign: str, remedy: str) -> None:
        if not self._take(sign):
            raise self._unexpected(f'"{sign}"', remedy)

    def _expect_end(self, what: str, remedy: str = 'end it with ";"') -> None:
        """Pass the ";"; one that was forgotten is told where it should stand."""
        if self._take(";"):
            return
        is_at_end = self._next.kind == "end" and self._next.text != TOO_MUCH
        if is_at_end or self._begins_statement():
            end = self._lexemes[self._position - 1].end
            raise self._report(end, f'{what} has no ";" at its end', 'write ";" here')
        raise self._unexpected('";"', remedy)

    # The grammar of grammars

    def read(self) -> Document:
        begin = self._header()
        if begin is None:
            return self.document
        self._lexemes, comments = split(self.text, begin)
        self._last = len(self._lexemes) - 1
        self._docs = dict(self._doc_comments(comments))
        self._attempt(self._name)
        while self._next.kind != "end" and len(self.document.errors) < MOST_ERRORS:
            self._attempt(self._statement)
        if self._next.kind != "end":
            self._report(self._next.start, "too many mistakes", "fix those above first")
        elif self._next.text == TOO_MUCH:
            what = f"more than {MOST_LEXEMES} words and signs"
            self._report(self._next.start, what, "split the grammar, or import a list of names")
        self.document.errors.sort(key=lambda error: (error.place.line, error.place.column))
        self.document.warnings = [_with_number(odd) for odd in self._odd.values()]
        return self.document

    def _attempt(self, read: Callable[[], None]) -> None:
        """Read a part; after a mistake in it go on behind the next ";" or at the next rule."""
        try:
            read()
        except _Mistake:
            self._brackets = 0
            while self._next.kind != "end" and not self._begins_statement():
                if self._take(";"):
                    return
                self._position += 1

    def _doc_comments(self, comments: list[Lexeme]) -> Iterator[tuple[int, DocComment]]:
        """Doc comments by the offset of the lexeme behind them; ends are checked of all."""
        starts = [lexeme.start for lexeme in self._lexemes]
        for comment in comments:
            if comment.text.startswith("//"):
                continue
            if not comment.text.endswith("*/") or len(comment.text) < 4:
                self._report(comment.start, "this comment has no end", 'write "*/" after it')
            elif comment.text.startswith("/**") and len(comment.text) > 4:
                behind = starts[bisect_left(starts, comment.end)]
                yield behind, read_doc_comment(comment.text, comment.start, self._lines)

    def _header(self) -> int | None:
        """Read the first line; the offset behind it, None in a file of another format."""
        header = read_header(self.text)
        if header is not None:
            self.document.encoding, self.document.locale = header.encoding, header.locale
            return header.end
        start = len(self.text) - len(self.text.lstrip("\ufeff \t\r\n"))
        if (other := format_of(self.text)) is not None:
            self._report(start, f"this is {other.name}, not JSGF", other.remedy)
            return None
        if not self.text.startswith("#", start):
            self._report(start, "the header is missing", 'write "#JSGF V1.0;" as the first line')
            return start
        line_end = self.text.find("\n", start)
        line_end = line_end if line_end >= 0 else len(self.text)
        what = f'the header "{self.text[start:line_end].strip()[:40]}" is not understood'
        self._report(start, what, 'write "#JSGF V1.0;" or "#JSGF V1.0 UTF-8 en;"')
        return line_end

    def _name(self) -> None:
        remedy = 'write "grammar name;" after the header'
        doc = self._docs.get(self._next.start, NO_DOC)
        if not self._take("grammar"):
            self._unexpected('"grammar"', self._spelling("grammar", remedy))
            if not self._begins_statement():
                raise _Mistake
            return
        lexeme = self._next
        if lexeme.kind != "word" or not _GRAMMAR_NAME.fullmatch(lexeme.text):
            raise self._unexpected("the grammar's name", remedy)
        self._position += 1
        self.document.name = lexeme.text
        self.document.extends = list(self._extensions(doc))
        self.document.before = self._around(doc, BEFORE)
        self.document.after = self._around(doc, AFTER)
        self._expect_end("the grammar's name")

    def _extensions(self, doc: DocComment) -> Iterator[Extension]:
        for tag in doc.tags:
            if tag.name == EXTENDS and _GRAMMAR_NAME.fullmatch(tag.text):
                yield Extension(tag.text, tag.span)
            elif tag.name == EXTENDS:
                what = "@extends needs the name of one grammar"
                place = Place(self.document.path, tag.span.line, tag.span.column)
                remedy = f"write /** @{EXTENDS} companion */ before grammar"
                self.document.errors.append(AuthoringError(place, what, remedy))

    def _around(self, doc: DocComment, name: str) -> RuleReference | None:
        """The rule that a tag of the grammar's comment names."""
        tag = next((tag for tag in doc.tags if tag.name == name), None)
        if tag is None:
            return None
        named = re.fullmatch(rf"<({_PART}(?:\.{_PART})*)>", tag.text)
        if named is None:
            place = Place(self.document.path, tag.span.line, tag.span.column)
            what, remedy = f"@{name} needs the name of one rule", f"write @{name} <polite>"
            self.document.errors.append(AuthoringError(place, what, remedy))
            return None
        return RuleReference(named[1], tag.span)

    def _spelling(self, keyword: str, otherwise: str) -> str:
        """The remedy for a misspelt keyword."""
        lexeme = self._next
        return did_you_mean(lexeme.text, [keyword], otherwise)

    def _begins_statement(self) -> bool:
        """Whether a new rule or import starts here: `<name> =`, `public <name> =`, `import`."""
        one, two, three = (
            self._lexemes[min(self._position + ahead, self._last)] for ahead in range(3)
        )
        if one.kind == "word" and one.text == "public":
            one, two = two, three
        if one.kind == "word" and one.text == "import":
            return two.kind in ("rule", "quoted") and three.text in (";", "as")
        return one.kind == "rule" and two.text == "="

    def _statement(self) -> None:
        start = self._next.start
        if self._take("import"):
            self._import(start)
        else:
            self._rule(start)

    def _import(self, start: int) -> None:
        lexeme = self._next
        if lexeme.kind == "quoted":
            self._position += 1
            self._name_list(start, lexeme)
            return
        grammar, _, rule = lexeme.text.strip("<> \t").rpartition(".")
        if lexeme.kind != "rule" or not rule or not _GRAMMAR_NAME.fullmatch(grammar):
            remedy = (
                'write import <grammar.rule>; or import <grammar.*>; or import "file" as <rule>;'
            )
            raise self._unexpected("a rule of another grammar", remedy)
        self._position += 1
        self.document.imports.append(Import(grammar, rule, self._span_from(start)))
        self._expect_end("this import")

    def _name_list(self, start: int, file: Lexeme) -> None:
        remedy = 'write import "file.txt" as <name>;'
        if not self._take("as"):
            raise self._unexpected('"as"', remedy)
        text = re.sub(r"\\(.)", r"\1", file.text[1:-1])
        written = self._next.text
        if written.endswith(".spoken>") and (slot := slot_name(written)):
            self._position += 1
            known = KnownListImport(text, slot, self._span_from(start))
            self.document.known_lists.append(known)
        else:
            name = self._defined_name(remedy)
            self.document.name_lists.append(NameListImport(text, name, self._span_from(start)))
        self._expect_end("this import")

    def _rule(self, start: int) -> None:
        is_public = self._take("public")
        remedy = "write a rule as <name> = words;"
        if self._next.text.startswith("#"):
            raise self._report(start, *_NO_WORD["#"])
        if not is_public and self._next.kind == "word":
            remedy = did_you_mean(self._next.text, ("public", "import"), remedy)
        name = self._defined_name(remedy)
        span = self._span_from(start)
        try:
            self._expect("=", f'write "=" after <{name}>')
            expression = self._alternatives()
            self._expect_end(f"<{name}>", 'end the rule with ";", or fix what stands here')
            if depth(expression) > DEEPEST_TREE:
                what = f"<{name}> holds more than {DEEPEST_TREE} things within each other"
                raise self._report(start, what, "use separate rules")
        except _Mistake:
            self.document.broken.add(name)
            raise
        doc = self._docs.get(start, NO_DOC)
        self.document.rules.append(RuleDefinition(name, expression, is_public, span, doc))

    def _defined_name(self, remedy: str) -> str:
        lexeme = self._next
        if lexeme.kind != "rule":
            raise self._unexpected("a rule", remedy)
        self._position += 1  # Whatever is wrong with it: nobody is to find it again.
        name = self._rule_name(lexeme)
        if name in ("NULL", "VOID"):
            raise self._report(lexeme.start, f"<{name}> is defined by JSGF", "take another name")
        if "." in name:
            what = f"<{name}> is a name for a rule of another grammar"
            raise self._report(lexeme.start, what, "define a name without a dot")
        return name

    def _rule_name(self, lexeme: Lexeme) -> str:
        name = lexeme.text[1:-1].strip()
        if not name or re.search(r'[\s*"]', name) or not all(name.split(".")):
            what = f"{lexeme.text[:40]} is not a rule name"
            remedy = "write letters, digits, _ and . between < and >"
            joined = "_".join(name.split())
            if joined != name and _GRAMMAR_NAME.fullmatch(joined):
                remedy = f"write <{joined}>"
            if slot := misspelt_slot(name):
                remedy = f'did you mean "{slot}"?'
            raise self._report(lexeme.start, what, remedy)
        return name

    # What may be said

    def _alternatives(self) -> Expression:
        start = self._next.start
        choices: list[Expression] = []
        weights: list[float] = []
        bare: list[int] = []
        while True:
            if self._next.kind != "weight":
                bare.append(self._next.start)
            weights.append(self._weight())
            choices.append(self._sequence())
            if not self._take("|"):
                break
        if len(choices) == 1:
            return choices[0]
        if 0 < len(bare) < len(choices):
            what = "of these alternatives only some have a weight; this one counts as /1/"
            self._remark("weight", bare[0], what, "write a weight before each, or before none")
        return Alternative(tuple(choices), tuple(weights), self._span_from(start))

    def _weight(self) -> float:
        lexeme = self._next
        if lexeme.kind != "weight":
            return 1.0
        self._position += 1
        match = _WEIGHT.fullmatch(lexeme.text)
        weight = float(lexeme.text.strip("/ \t\r\nfF")) if match else math.nan
        if not 0.0 <= weight < math.inf:
            raise self._report(
                lexeme.start, f"{lexeme.text[:40]} is not a weight", "write a number such as /2.5/"
            )
        return weight

    def _sequence(self) -> Expression:
        start = self._next.start
        items: list[Expression] = []
        while (item := self._marked()) is not None:
            items.append(item)
        if not items:
            remedy = 'write words, or <NULL> for "nothing"'
            if self._next.kind == "tag" or self._next.text in ("*", "+"):
                remedy = "it stands behind the words it belongs to"
            raise self._unexpected("words", remedy)
        return items[0] if len(items) == 1 else Sequence(tuple(items), self._span_from(start))

    def _marked(self) -> Expression | None:
        """A word, rule or group with the repeats and tags behind it."""
        start = self._next.start
        item = self._item()
        while item is not None:
            lexeme = self._next
            if lexeme.kind == "tag":
                item = self._tagged(item, start)
            elif lexeme.kind == "sign" and lexeme.text in "*+":
                if self._lexemes[self._position - 1].text in ("*", "+"):
                    what = f'"{lexeme.text}" stands behind another repeat'
                    raise self._report(
                        lexeme.start, what, "write * for any number, + for at least one"
                    )
                self._position += 1
                item = self._repeat(item, int(lexeme.text == "+"), start)
            else:
                break
        return item

    def _repeat(self, item: Expression, minimum: int, start: int) -> Repeat:
        """A repeat of a repeat is one."""
        span = self._span_from(start)
        if isinstance(item, Repeat):
            return Repeat(item.item, min(minimum, item.minimum), span)
        return Repeat(item, minimum, span)

    def _tagged(self, item: Expression, start: int) -> Expression:
        lexeme = self._next
        self._position += 1
        content = re.sub(r"\\(.)", r"\1", lexeme.text[1:-1], flags=re.DOTALL)
        try:
            entries = read_entries(content)
        except TagError as error:
            # What is behind a backslash stands further on than it counts.
            offset = error.offset + lexeme.text[1 : max(error.offset, 0) + 1].count("\\")
            entries = opaque(content)
            what = f"{error}, so the tag is kept as a text" if entries else str(error)
            self._remark("tag", lexeme.start + 1 + offset, what, error.remedy)
        return Tagged(item, entries, self._span_from(start)) if entries else item

    def _item(self) -> Expression | None:
        lexeme = self._lexemes[self._position]
        kind = lexeme.kind
        if kind == "word":
            if lexeme.text in ("public", "import") and self._begins_statement():
                return None
            self._position += 1
            if lexeme.text[0] in _NO_WORD:
                raise self._report(lexeme.start, *_NO_WORD[lexeme.text[0]])
            return self._words(lexeme, lexeme.text)
        if kind == "rule":
            if self._begins_statement():
                return None
            self._position += 1
            return self._reference(lexeme)
        if kind == "quoted":
            self._position += 1
            return self._words(lexeme, re.sub(r"\\(.)", r"\1", lexeme.text[1:-1]))
        if lexeme.text == "(":
            return self._group(lexeme, ")")
        if lexeme.text == "[":
            inside = self._group(lexeme, "]")
            return Optional(inside, self._span_from(lexeme.start))
        if kind == "weight":
            what = "a weight in the middle of words"
            raise self._report(lexeme.start, what, "weights stand first in an alternative")
        return None

    def _words(self, lexeme: Lexeme, text: str) -> Expression:
        """One token as the words that are spoken; several for one in quotes."""
        span = self._span(lexeme)
        words = normalize(text)
        if not words:
            what = f"{lexeme.text[:40]} holds nothing that can be said"
            raise self._report(lexeme.start, what, 'take it out, or write <NULL> for "nothing"')
        tokens = tuple([Token(word, span) for word in words])
        return tokens[0] if len(tokens) == 1 else Sequence(tokens, span)

    def _reference(self, lexeme: Lexeme) -> Expression:
        if _FREE_WORDS.match(lexeme.text):
            return self._free_words(lexeme)
        name = self._rule_name(lexeme)
        span = self._span(lexeme)
        if name == "NULL":
            return Sequence((), span)
        if name == "VOID":
            return Alternative((), (), span)
        return RuleReference(name, span)

    def _free_words(self, lexeme: Lexeme) -> Expression:
        """`<any 2>` or `<name.spoken 1-3>`, of which the loader finds out whether it is a rule."""
        least, most = free_words(lexeme.text) or (0, 0)
        if not 1 <= least <= most <= LONGEST_FREE:
            name = lexeme.text[1:].split()[0].removesuffix(">")
            what = f"{lexeme.text[:40]} is not a number of words, 1 to {LONGEST_FREE}"
            remedy = f"write <{name} 2> for two words, <{name} 1-3> for one to three"
            raise self._report(lexeme.start, what, remedy)
        span = self._span(lexeme)
        node = Anything(span, least, most, slot_name(lexeme.text))
        return RuleReference(node.written[1:-1], span) if node.slot else node

    def _group(self, opening: Lexeme, closing: str) -> Expression:
        self._position += 1
        self._brackets += 1
        if self._brackets > DEEPEST:
            what = f"brackets nested deeper than {DEEPEST}"
            raise self._report(opening.start, what, "use separate rules")
        inside = self._alternatives()
        if not self._take(closing):
            line, column = self._lines.place(opening.start)
            remedy = f'close the "{opening.text}" of line {line}, column {column}'
            raise self._unexpected(f'"{closing}"', remedy)
        self._brackets -= 1
        return inside
