"""A grammar: rules that say which sentences are understood, and what they mean."""

from __future__ import annotations

import codecs
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from hri.core import paths
from hri.core.errors import AuthoringError, HriError, Place, did_you_mean, read_text
from hri.speech.grammar import analysis, expansion
from hri.speech.grammar.expressions import Expression, Span, Tagged, Token, rename, spell, walk
from hri.speech.grammar.jsgf import Document, Import, read_jsgf

LARGEST_FILE = 4_000_000
"""Bytes of a grammar file."""
MOST_FILES = 100
"""Files that one grammar may import, directly or not."""


@dataclass(frozen=True, slots=True)
class Rule:
    """One rule of a grammar, with where it came from."""

    key: str
    """Its name in `Grammar.rules`: short in the main file, `grammar.name` when imported."""
    expression: Expression
    is_public: bool
    span: Span
    path: Path
    doc: str = ""

    def place(self, span: Span | None = None) -> Place:
        """The spot of a node of this rule; without one, of the rule itself."""
        span = span or self.span
        return Place(self.path, span.line, span.column)


@dataclass(frozen=True)
class Grammar:
    """Rules by key; what the public ones allow is understood."""

    name: str
    path: Path
    rules: dict[str, Rule]

    @cached_property
    def public_rules(self) -> tuple[str, ...]:
        """Names of the public rules of the main file, in its order; imported ones only help."""
        return tuple(key for key, rule in self.rules.items() if rule.is_public)

    def words(self) -> frozenset[str]:
        """All words that can be said, lower case."""
        return frozenset(node.text for node in self._nodes() if isinstance(node, Token))

    def tag_names(self) -> frozenset[str]:
        """Names of all tags that an understood sentence may have."""
        tagged = [node for node in self._nodes() if isinstance(node, Tagged)]
        entries = [entry for node in tagged for entry in node.entries]
        used_up = {str(entry.value) for entry in entries if entry.is_reference}
        return frozenset({entry.name for entry in entries} - used_up)

    def _nodes(self) -> Iterator[Expression]:
        for key in analysis.reachable(self.rules, self.public_rules):
            yield from walk(self.rules[key].expression)

    def flat_jsgf(self) -> str:
        """The same sentences as JSGF with a single public rule, without tags, imports, quotes."""
        return flat_jsgf(self)

    def sentences(self, limit: int) -> Iterable[str]:
        """Sentences of the grammar, at most `limit`, the public rules taking turns."""
        return expansion.sentences(self, self.public_rules, limit)

    def sentences_of(self, rule: str, limit: int) -> Iterable[str]:
        """Sentences of one rule, at most `limit`."""
        return expansion.sentences(self, (rule,), limit)

    @cached_property
    def heights(self) -> dict[str, float]:
        """How many rules deep the shortest sentence of each rule is; infinite without any."""
        return analysis.heights(self.rules)


def flat_jsgf(grammar: Grammar) -> str:
    """See `Grammar.flat_jsgf`. PocketSphinx knows one public rule only and no dots in names."""
    keys = analysis.reachable(grammar.rules, grammar.public_rules)
    names = {
        key: f"r{number}_{re.sub(r'[^A-Za-z0-9]', '_', key)}" for number, key in enumerate(keys)
    }
    top = " | ".join(f"<{names[key]}>" for key in grammar.public_rules)
    lines = ["#JSGF V1.0;", "grammar flat;", f"public <sentence> = {top};"]
    for key in keys:
        expression = rename(grammar.rules[key].expression, lambda node: names[node.name])
        lines.append(f"<{names[key]}> = {spell(expression)};")
    return "\n".join(lines) + "\n"


def load_grammar(path: Path) -> Grammar:
    """The grammar of a file and of all it imports, ready to be used.

    Raises AuthoringError for the first mistake in it, HriError when it cannot be read.
    """
    grammar, errors = read_grammar(path)
    errors = errors or analysis.errors(grammar)
    if errors:
        raise errors[0]
    return grammar


def read_grammar(path: Path) -> tuple[Grammar, list[AuthoringError]]:
    """The grammar as far as it can be read, and the mistakes in its writing.

    What the rules say is not looked at yet: see `hri.speech.grammar.check`.
    Raises HriError when the file itself cannot be read.
    """
    return _Loader().load(path)


def read_source(path: Path) -> str:
    """The text of a grammar file in the encoding its header names, UTF-8 without one."""
    if not path.is_file():
        raise HriError(f"{path}: no such grammar file - check the path")
    size = path.stat().st_size
    if size > LARGEST_FILE:
        raise HriError(f"{path}: {size} bytes are too many for a grammar - split it")
    match = re.match(rb"\s*#JSGF\s+V1\.0\s+([\w.:-]+)[^\n;]*;", path.read_bytes())
    encoding = match[1].decode() if match else "utf-8"
    try:
        if codecs.lookup(encoding).name in ("utf-8", "ascii"):
            return read_text(path, "grammar")
        return path.read_text(encoding)
    except LookupError as error:
        remedy = 'save it as UTF-8 and write "#JSGF V1.0 UTF-8 en;"'
        raise AuthoringError(Place(path), f'unknown encoding "{encoding}"', remedy) from error
    except UnicodeError as error:
        remedy = "save it as UTF-8 and say so in the header"
        raise AuthoringError(Place(path), f"this is no {encoding} text", remedy) from error


class _Loader:
    """Reads a file and all it imports, then gives every rule its key and resolves references."""

    def __init__(self) -> None:
        self.errors: list[AuthoringError] = []
        self.rules: dict[str, Rule] = {}
        self._files: dict[Path, _File] = {}

    def load(self, path: Path) -> tuple[Grammar, list[AuthoringError]]:
        main = self._read(path, prefix="")
        pending = [main]
        while pending:
            file = pending.pop()
            for use in file.document.imports:
                pending.extend(self._follow(file, use))
        for file in self._files.values():
            self._define(file)
        name = main.document.name.rpartition(".")[2] or path.stem
        return Grammar(name, path, self.rules), self.errors

    def _read(self, path: Path, prefix: str) -> _File:
        document = read_jsgf(read_source(path), path)
        self.errors += document.errors
        file = self._files[path.resolve()] = _File(document, prefix)
        return file

    def _follow(self, file: _File, use: Import) -> list[_File]:
        """Make the rules of an import visible; the file it names when that is a new one."""
        place = file.place(use.span)
        path = _find_import(file.document.path, use.grammar)
        if path is None:
            remedy = f"put {use.grammar.rpartition('.')[2]}.jsgf into the same folder"
            self.errors.append(AuthoringError(place, f'no grammar "{use.grammar}"', remedy))
            return []
        known = self._files.get(path.resolve())
        if known is None and len(self._files) >= MOST_FILES:
            raise AuthoringError(place, f"more than {MOST_FILES} grammar files", "import fewer")
        other = known or self._read(path, prefix=f"{use.grammar}.")
        public = [rule.name for rule in other.document.rules if rule.is_public]
        if use.rule not in ("*", *public):
            what = f'"{use.grammar}" has no public rule <{use.rule}>'
            self.errors.append(AuthoringError(place, what, did_you_mean(use.rule, public)))
        for name in public if use.rule == "*" else [use.rule]:
            file.visible[name] = file.visible[f"{use.grammar}.{name}"] = other.prefix + name
        return [] if known else [other]

    def _define(self, file: _File) -> None:
        document, visible = file.document, file.visible
        for definition in document.rules:
            key = file.prefix + definition.name
            visible[definition.name] = visible[f"{document.name}.{definition.name}"] = key
        for definition in document.rules:
            rule = Rule(
                key=file.prefix + definition.name,
                expression=rename(definition.expression, lambda n: visible.get(n.name, n.name)),
                is_public=definition.is_public and not file.prefix,
                span=definition.span,
                path=document.path,
                doc=definition.doc,
            )
            first = self.rules.setdefault(rule.key, rule)
            if first is not rule:
                what = f"<{definition.name}> is already defined in line {first.span.line}"
                self.errors.append(AuthoringError(rule.place(), what, "rename one of the two"))


@dataclass(frozen=True)
class _File:
    document: Document
    prefix: str
    """Stands before the names of its rules in their keys; empty for the main file."""
    visible: dict[str, str] = field(default_factory=dict)
    """Keys of rules by the names this file may call them."""

    def place(self, span: Span) -> Place:
        return Place(self.document.path, span.line, span.column)


def _find_import(importer: Path, grammar: str) -> Path | None:
    """The file of a grammar: beside the importing one, in its package, or in `grammars/`."""
    inside = Path(*grammar.split(".")).with_suffix(".jsgf")
    for candidate in (importer.parent / inside.name, importer.parent / inside):
        if candidate.is_file():
            return candidate
    try:
        return paths.find("grammars", str(inside))
    except HriError:
        return None
