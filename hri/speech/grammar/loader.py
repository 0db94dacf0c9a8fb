"""Reads a grammar file and all it imports, and finds the rule behind every name.

A grammar `com.acme.colors` is looked for as `colors.jsgf` and as `com/acme/colors.jsgf`: beside
the file that imports it, in the folders above it as far as its own package goes, beside the main
file, where PocketSphinx and Sphinx-4 begin for all files, in `grammars/` of the folders of HRI_PATH
and among the built-in ones. The suffix may be `.gram`, as theirs is, or that of the importing file.

A grammar with `/** @extends companion */` before its `grammar` understands the commands of that one
as well. Its rule hides one of the same name there, and may still call it as
`<companion.greet>`.

`<name.spoken>` is a free slot (`hri.speech.grammar.free_slots`), beside the rule `<name>` where
there is one; where a grammar `name` has a public rule `spoken`, it is that rule.

A rule is called by its name alone, by `<colors.red>`, or by `<com.acme.colors.red>`; the last
needs no import (JSGF 1.0, 3.3). A grammar's own rules hide imported ones of the same name.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from glob import escape
from pathlib import Path
from typing import NamedTuple

from hri.core import paths
from hri.core.errors import AuthoringError, HriError, Place, did_you_mean
from hri.core.reading import read_text
from hri.speech.grammar import analysis, paraphrases
from hri.speech.grammar.doc_comments import TOPIC
from hri.speech.grammar.encoding import read_source
from hri.speech.grammar.expressions import (
    Alternative,
    Anything,
    Expression,
    RuleReference,
    SourceSpan,
    mapped,
    walk,
)
from hri.speech.grammar.framing import framed
from hri.speech.grammar.grammar import Grammar
from hri.speech.grammar.jsgf import (
    Document,
    Import,
    KnownListImport,
    NameListImport,
    RuleDefinition,
    read_jsgf,
)
from hri.speech.grammar.name_lists import read_known, read_names
from hri.speech.grammar.paraphrases import Paraphrases, read_paraphrases
from hri.speech.grammar.rules import Rule
from hri.speech.grammar.words import free_words, misspelt_slot, slot_name

SUFFIXES = paths.suffixes("grammars")
MOST_FILES = 100
"""Files that one grammar may import, directly or not."""
MOST_KEPT = 8
"""Grammars that are kept, with all that was made of them, until the same files are read again."""

_Sources = tuple[Path, tuple[tuple[Path, str | Expression], ...]]
"""The path of a grammar, and the files that it was read from with their contents, in order."""
_kept: dict[_Sources, Grammar] = {}


def load_grammar(name: str | Path, beside: Sequence[Path] = ()) -> Grammar:
    """The grammar of a file and of all it imports, by path or by name over the search folders.

    The commands of the files `beside` it, such as those of skills, count as well; none may have the
    name of another command, and what may be said around a command may be said around theirs.
    Raises AuthoringError for the first mistake in it, HriError when it cannot be read.
    """
    path = name if isinstance(name, Path) else paths.find("grammars", name)
    grammar, errors = read_grammar(path, beside)
    errors = errors or grammar.made(analysis.errors)
    if errors:
        raise errors[0]
    return grammar


def read_grammar(path: Path, beside: Sequence[Path] = ()) -> tuple[Grammar, list[AuthoringError]]:
    """The grammar as far as it can be read, and the mistakes in its writing.

    What the rules say is not looked at yet: see `hri.speech.grammar.lint.linter`.
    Raises HriError when the file, or one that it imports, cannot be read at all.
    """
    return _Loader().load(path, beside)


@dataclass(frozen=True, eq=False)
class _Source:
    """A file as it was written, and its rules as the last grammar that was read had them."""

    document: Document
    rules: dict[int, tuple[_Meaning, Rule]] = field(default_factory=dict)
    """By the number of the definition: most grammars are read again with the same names."""

    @cached_property
    def references(self) -> tuple[tuple[RuleReference, ...], ...]:
        """Those of each definition, in the order of writing."""
        return tuple(
            tuple(node for node in walk(rule.expression) if isinstance(node, RuleReference))
            for rule in self.document.rules
        )

    def rule(self, number: int, meaning: _Meaning) -> Rule:
        """A definition with what its names mean."""
        kept, rule = self.rules.get(number, (None, None))
        if rule is None or kept != meaning:
            rule = meaning.rule(self.document.rules[number], self.document.path)
            self.rules[number] = (meaning, rule)
        return rule


@lru_cache(maxsize=MOST_FILES)
def _source(text: str, path: Path) -> _Source:
    return _Source(read_jsgf(text, path))


class _Target(NamedTuple):
    """What a name between < and > means."""

    key: str | None
    """Of the rule; None without one, for free words."""
    is_free: bool = False
    """Whether words that nobody listed may stand there, beside those of the rule."""


def _free(node: RuleReference) -> Anything:
    """The free words that a name stands for, such as `any` or `name.spoken 1-2`."""
    written = f"<{node.name}>"
    least, most = free_words(written) or (1, 1)
    return Anything(node.span, least, most, slot_name(written))


class _Meaning(NamedTuple):
    """All that a rule depends on beside its definition."""

    key: str
    is_public: bool
    before: RuleReference | None
    after: RuleReference | None
    names: tuple[tuple[str, _Target], ...]
    """What it refers to."""

    def rule(self, definition: RuleDefinition, path: Path) -> Rule:
        """The rule that this definition is."""
        targets = dict(self.names)

        def resolved(node: RuleReference) -> Expression:
            key, is_free = targets[node.name]
            rule = node if key in (None, node.name) else replace(node, name=key)
            if not is_free:
                return rule
            free = _free(node)
            return free if key is None else Alternative((rule, free), (1.0, 1.0), node.span)

        return Rule(
            key=self.key,
            expression=mapped(
                framed(definition.expression, self.before, self.after), RuleReference, resolved
            ),
            is_public=self.is_public,
            span=definition.span,
            path=path,
            doc=definition.doc.text,
            doc_tags=definition.doc.tags,
        )


@dataclass(frozen=True, eq=False)
class _File:
    """One grammar file and what the names in it mean."""

    source: _Source
    document: Document
    prefix: str
    """Stands before the names of its rules in their keys; empty for the main file."""
    is_heard: bool = False
    """Whether its public rules are commands: the main file's are, and those of what it extends."""
    own: dict[str, str] = field(default_factory=dict)
    """Keys of the rules it defines, by name."""
    imported: dict[str, list[str]] = field(default_factory=dict)
    """Keys of imported rules by the names this file may call them; two are one too many."""
    brought: list[tuple[Import | NameListImport | KnownListImport, set[str]]] = field(
        default_factory=list
    )
    """Its imports, and the keys of what they bring."""
    used: set[str] = field(default_factory=set)
    """Keys of the rules it refers to, and the free slots it has."""
    lost: list[str] = field(default_factory=list)
    """Imported grammars that are missing; any name may be theirs."""

    def place(self, span: SourceSpan) -> Place:
        return Place(self.document.path, span.line, span.column)

    def idle_imports(self) -> tuple[Import | NameListImport | KnownListImport, ...]:
        """Those that bring nothing it refers to."""
        return tuple(use for use, keys in self.brought if self.used.isdisjoint(keys))

    def public_names(self) -> dict[str, str]:
        """Keys of the rules that others may use, by name."""
        names = [rule.name for rule in self.document.rules if rule.is_public]
        return {name: self.own[name] for name in (*names, *self.document.broken)}


class _Loader:
    """Opens files one after the other, then gives every rule its key and its references keys."""

    def __init__(self) -> None:
        self._errors: list[AuthoringError] = []
        self._warnings: list[AuthoringError] = []
        self._rules: dict[str, Rule] = {}
        self._known: dict[str, dict[str, None]] = {}
        """What free slots usually are, by their names."""
        self._broken: set[str] = set()
        self._files: dict[Path, _File] = {}
        self._pending: list[_File] = []
        self._taken: set[str] = set()
        """Names that stand for a rule without a prefix."""
        self._sources: list[tuple[Path, str | Expression]] = []
        self._root = Path()
        """The folder of the main file."""
        self._found: dict[tuple[Path, str], Path | None] = {}
        """Where the grammars are that files name: a name is mostly met many times."""

    def load(self, path: Path, beside: Sequence[Path]) -> tuple[Grammar, list[AuthoringError]]:
        self._root = path.parent
        main = self._read(path, prefix="", is_heard=True)
        self._extend(main, (main,))
        for other in beside:
            self._join(main, other)
        while self._pending:
            file = self._pending.pop(0)
            for use in file.document.imports:
                self._import(file, use)
            self._define(file)
        name = main.document.name.rpartition(".")[2] or path.stem
        broken = frozenset(self._broken)
        grammar = Grammar(
            name,
            path,
            self._rules,
            broken,
            locale=main.document.locale,
            idle_imports=main.idle_imports(),
            names=frozenset({*main.own, *main.imported}),
            warnings=tuple(self._warnings),
            known_lists=tuple(main.document.known_lists),
            known={slot: tuple(texts) for slot, texts in self._known.items()},
            paraphrases=tuple(self._paraphrases()),
        )
        return grammar if self._errors else self._same_as_before(grammar), self._errors

    def _paraphrases(self) -> Iterator[Paraphrases]:
        """Those of the files whose public rules are commands."""
        for file in self._files.values():
            path = file.document.path
            beside = path.with_name(path.stem + paraphrases.SUFFIX)
            if not file.is_heard or not paths.is_file(beside):
                continue
            text = read_text(beside, "list of paraphrases")
            self._sources.append((beside, text))
            found = read_paraphrases(text, beside)
            self._errors += [*found.errors, *found.unknown(file.public_names())]
            yield found

    def _same_as_before(self, grammar: Grammar) -> Grammar:
        """The grammar that was read from the same files before, if it is kept."""
        sources = (grammar.path, tuple(self._sources))
        known = _kept.pop(sources, grammar)
        _kept[sources] = known
        for oldest in list(_kept)[:-MOST_KEPT]:
            _kept.pop(oldest, None)
        return known

    def _read(self, path: Path, prefix: str, is_heard: bool = False) -> _File:
        text, doubt = read_source(path)
        source = _source(text, path)
        # A separate copy, since its frames may come from what it extends.
        document = replace(source.document)
        self._sources.append((path, text))
        self._errors += document.errors
        self._warnings += [*filter(None, [doubt]), *document.warnings]
        file = self._files[path.resolve()] = _File(source, document, prefix, is_heard)
        self._pending.append(file)
        commands = {rule.name for rule in document.rules if rule.is_public and is_heard}
        names = [rule.name for rule in document.rules] + [use.name for use in document.name_lists]
        for name in (*names, *document.broken):
            is_command = name in commands and name not in self._taken
            file.own[name] = name if is_command else prefix + name
        self._taken |= {name for name, key in file.own.items() if name == key}
        self._broken.update(file.own[name] for name in document.broken)
        return file

    def _report(self, file: _File, span: SourceSpan, what: str, remedy: str) -> None:
        self._errors.append(AuthoringError(file.place(span), what, remedy))

    # Other grammars

    def _extend(self, file: _File, below: tuple[_File, ...]) -> None:
        """Make the commands of what a file extends commands of this grammar, and known to it."""
        for use in file.document.extends:
            other = self._open(file, use.grammar, is_heard=True)
            if other is None:
                self._miss(file, use.grammar, use.span)
                continue
            if other in below:
                what = f'"{use.grammar}" extends itself'
                self._report(file, use.span, what, "extend a grammar of another name")
                continue
            self._extend(other, (*below, other))
            file.document.before = file.document.before or other.document.before
            file.document.after = file.document.after or other.document.after
            self._bring(file, use.grammar, other.public_names())

    def _join(self, main: _File, path: Path) -> None:
        """Make the commands of another file commands of this grammar.

        They count before small talk, whose rules all have a topic.
        """
        if path.resolve() in self._files:
            return
        chat = next(filter(_is_small_talk, self._pending), None)
        file = self._read(path, self._free_prefix(path.parent.name), is_heard=True)
        if chat is not None:
            self._pending.insert(self._pending.index(chat), self._pending.pop())
        for rule in file.document.rules:
            if rule.is_public and file.own[rule.name] != rule.name:
                what = f"another grammar has a command <{rule.name}>"
                self._report(file, rule.span, what, "give this one another name")
        self._extend(file, (main, file))
        file.document.before = file.document.before or main.document.before
        file.document.after = file.document.after or main.document.after

    def _free_prefix(self, name: str) -> str:
        prefix = f"{name}."
        while any(other.prefix == prefix for other in self._files.values()):
            prefix = f"{prefix[:-1]}'."
        return prefix

    def _import(self, file: _File, use: Import) -> None:
        """Make the rules of an import visible in a file."""
        other = self._open(file, use.grammar)
        if other is None:
            self._miss(file, use.grammar, use.span)
            return
        public = other.public_names()
        if use.rule != "*" and use.rule not in public:
            self._report(file, use.span, *_not_public(other, use.grammar, use.rule))
            public[use.rule] = other.prefix + use.rule
            self._broken.add(public[use.rule])
        if use.rule != "*":
            public = {use.rule: public[use.rule]}
        file.brought.append((use, set(public.values())))
        self._bring(file, use.grammar, public)

    def _miss(self, file: _File, grammar: str, span: SourceSpan) -> None:
        near = did_you_mean(grammar, _grammars_near(file), "")
        short = grammar.rpartition(".")[2]
        suffix = file.document.path.suffix or SUFFIXES[0]
        remedy = f"put {short}{suffix} into the same folder"
        other = next(file.document.path.parent.glob(f"{escape(short)}.*"), None)
        if near.startswith("did you mean"):
            remedy = near
        elif other is not None:
            remedy = f"name {other.name} {short}{suffix} if it is JSGF, or write it in JSGF"
        self._report(file, span, f'no grammar "{grammar}"', remedy)
        file.lost.append(grammar)

    @staticmethod
    def _bring(file: _File, grammar: str, public: Mapping[str, str]) -> None:
        """Let a file call rules of another grammar, by their names and with that grammar's."""
        short = grammar.rpartition(".")[2]
        for name, key in public.items():
            for called in {name, f"{short}.{name}", f"{grammar}.{name}"}:
                keys = file.imported.setdefault(called, [])
                if key not in keys:
                    keys.append(key)

    def _find(self, file: _File, grammar: str) -> Path | None:
        key = (file.document.path, grammar)
        if key not in self._found:
            self._found[key] = _find_grammar(file.document, grammar, self._root)
        return self._found[key]

    def _open(self, file: _File, grammar: str, is_heard: bool = False) -> _File | None:
        """The file of a grammar, read when it is a new one; None when there is none."""
        path = self._find(file, grammar)
        if path is None:
            return None
        known = self._files.get(path.resolve())
        if known is not None:
            return known
        if len(self._files) >= MOST_FILES:
            what = f"more than {MOST_FILES} grammar files"
            raise AuthoringError(Place(file.document.path), what, "import fewer")
        return self._read(path, self._free_prefix(grammar), is_heard)

    # Rules

    def _define(self, file: _File) -> None:
        document = file.document
        for use in document.name_lists:
            file.brought.append((use, {file.own[use.name]}))
            self._add(file, use.span, self._list_rule(file, use))
        for known in document.known_lists:
            file.brought.append((known, {f"{known.slot}.spoken"}))
            self._know(file, known)
        for number, definition in enumerate(document.rules):
            key = file.own[definition.name]
            before, after = _frames_of(definition, document)
            nodes = [*file.source.references[number], *filter(None, (before, after))]
            meaning = _Meaning(
                key,
                definition.is_public and file.is_heard and key == definition.name,
                before,
                after,
                tuple({node.name: self._resolve(file, node) for node in nodes}.items()),
            )
            self._add(file, definition.span, file.source.rule(number, meaning))

    def _add(self, file: _File, span: SourceSpan, rule: Rule | None) -> None:
        if rule is None:
            return
        first = self._rules.setdefault(rule.key, rule)
        if first is not rule:
            name = rule.key.removeprefix(file.prefix)
            line = first.span.line
            self._report(
                file, span, f"<{name}> is already defined in line {line}", "rename one of the two"
            )

    def _list_rule(self, file: _File, use: NameListImport) -> Rule | None:
        """The rule of a list of names; None, and its key is broken, when it cannot be read."""
        key = file.own[use.name]
        with self._list_file(file, use) as path:
            if path is not None:
                names, errors = read_names(path, use.name)
                self._sources.append((path, names))
                self._errors += errors
                return Rule(key, names, is_public=False, span=use.span, path=path)
        self._broken.add(key)
        return None

    def _know(self, file: _File, use: KnownListImport) -> None:
        """Take what a free slot usually is from a file."""
        with self._list_file(file, use) as path:
            if path is not None:
                known, errors = read_known(path)
                self._sources.append((path, "\n".join(known)))
                self._errors += errors
                self._known.setdefault(use.slot, {}).update(dict.fromkeys(known))

    @contextmanager
    def _list_file(
        self, file: _File, use: NameListImport | KnownListImport
    ) -> Iterator[Path | None]:
        """The file of an import, None where it is missing; why it cannot be read is told."""
        path = next((path for path in _places_of(file.document.path, use.file)), None)
        if path is None:
            self._report(file, use.span, *_no_list(file.document.path, use.file))
        try:
            yield path
        except AuthoringError as error:
            self._errors.append(error)
        except HriError as error:
            self._report(file, use.span, str(error), "fix the file, or take the import out")

    def _resolve(self, file: _File, node: RuleReference) -> _Target:
        """What a reference means; the rule of an unknown one is a key that nobody has.

        `<any>` and `<name.spoken>` are rules of these names where there are such.
        """
        slot = slot_name(f"<{node.name}>")
        if slot and not self._is_rule(file, node.name):
            file.used.add(f"{slot}.spoken")
            if slot not in file.own and slot not in file.imported:
                return _Target(None, is_free=True)
            node = replace(node, name=slot)
        elif node.name == "any" and not {*file.own, *file.imported} & {node.name}:
            return _Target(None, is_free=True)
        else:
            slot = ""
        key = self._key(file, node)
        file.used.add(key)
        return _Target(key, is_free=bool(slot))

    def _is_rule(self, file: _File, name: str) -> bool:
        """Whether a name that may be a free slot's is the public rule `spoken` of a grammar."""
        grammar, _, rule = name.rpartition(".")
        if name in file.imported or (file.document.name == grammar and rule in file.own):
            return True
        path = self._find(file, grammar)
        if path is None or " " in name:
            return False
        try:
            rules = _source(read_source(path).text, path).document.rules
        except HriError:  # Whatever it is, it has no such rule.
            return False
        return any(one.name == rule and one.is_public for one in rules)

    def _key(self, file: _File, node: RuleReference) -> str:
        name = node.name
        if name in file.own:
            return file.own[name]
        keys = file.imported.get(name) or self._qualified(file, node)
        if len(keys) > 1:
            what = f"<{name}> is imported twice"
            remedy = f"say which: {' or '.join(f'<{key}>' for key in keys)}"
            self._report(file, node.span, what, remedy)
        if keys:
            return keys[0]
        if file.lost:
            self._broken.add(file.prefix + name)
        return file.prefix + name

    def _qualified(self, file: _File, node: RuleReference) -> list[str]:
        """The keys behind `grammar.rule`: of this file, or of one that was not imported."""
        grammar, _, name = node.name.rpartition(".")
        full = file.document.name
        if grammar in (full, full.rpartition(".")[2]) and name in file.own:
            return [file.own[name]]
        if not grammar or grammar in file.lost:
            return []
        other = self._open(file, grammar)
        if other is None:
            return []
        public = other.public_names()
        if name not in public:
            self._report(file, node.span, *_not_public(other, grammar, name))
            self._broken.add(other.prefix + name)
        return [other.prefix + name]


def _frames_of(
    definition: RuleDefinition, document: Document
) -> tuple[RuleReference | None, RuleReference | None]:
    """What may be said before a command and behind it; nothing around any other rule."""
    marks = {tag.name for tag in definition.doc.tags}
    if not definition.is_public or marks & {"part", "answer"}:
        return None, None
    return document.before, document.after


def _is_small_talk(file: _File) -> bool:
    """Whether all commands of a file have a topic."""
    rules = [rule for rule in file.document.rules if rule.is_public]
    return bool(rules) and all(TOPIC in [tag.name for tag in rule.doc.tags] for rule in rules)


def _not_public(other: _File, grammar: str, name: str) -> tuple[str, str]:
    """The mistake in the use of a rule, and its remedy."""
    if name in other.own:
        remedy = f'write "public" before it in {other.document.path.name}'
        return f'<{name}> of "{grammar}" is not public', remedy
    remedy = did_you_mean(name, other.public_names())
    if slot := misspelt_slot(f"{grammar}.{name}"):
        remedy = f'did you mean "{slot}"?'
    return f'"{grammar}" has no public rule <{name}>', remedy


def _find_grammar(importer: Document, grammar: str, root: Path) -> Path | None:
    """The file of a grammar that another one names; `root` is the folder of the main file."""
    levels = importer.name.count(".") + 1
    folders = [*list(importer.path.resolve().parents)[:levels], root]
    inside = Path(*grammar.split("."))
    spelled = [inside.with_name(inside.name + suffix) for suffix in _suffixes(importer.path)]
    places = (
        *(importer.path.parent / file.name for file in spelled),
        *(folder / file for folder in folders for file in spelled),
        *(place for file in spelled for place in _places_of(importer.path, str(file))),
    )
    return next(filter(paths.is_file, places), None)


def _suffixes(importer: Path) -> tuple[str, ...]:
    """Those of grammars that a file may import, the likeliest first: its own, if it is usual."""
    own = importer.suffix
    return (*sorted(SUFFIXES, key=lambda suffix: suffix != own), own)


def _places_of(importer: Path, file: str) -> Iterator[Path]:
    """Where a file is: beside a grammar, or in a search folder, or in `grammars/` there.

    A path or a link that leads out of these folders is passed over: a grammar may come from
    anyone, and must not read whatever lies on the machine.
    """
    folders = (
        below for folder in paths.search_folders() for below in (folder / "grammars", folder)
    )
    for folder in (importer.parent, *folders):
        place = folder / file
        if paths.is_file(place) and place.resolve().is_relative_to(folder.resolve()):
            yield place


def _no_list(importer: Path, file: str) -> tuple[str, str]:
    """Why a list is not read, and what to do."""
    if _leads_out(importer.parent, file):
        what = f'the list of names "{file}" is not read, for it leads out of the grammar\'s folder'
        return what, "copy the list itself into that folder"
    beside = sorted(importer.parent.glob("*.txt"))[:100]
    near = [entry.name for entry in beside if entry.name != file]
    return f'no list of names "{file}"', did_you_mean(file, near, "put it beside the grammar")


def _leads_out(folder: Path, file: str) -> bool:
    """Whether a path is absolute, goes upwards or over a link to somewhere else."""
    try:
        return not (folder / file).resolve().is_relative_to(folder.resolve())
    except (OSError, ValueError, RuntimeError):  # no name that a file can have, links in a circle
        return False


def _grammars_near(file: _File) -> list[str]:
    """Names of the grammars that could be meant."""
    known = set(_suffixes(file.document.path))
    folder = sorted(file.document.path.parent.glob("*"))
    beside = [entry.stem for entry in folder if entry.suffix in known][:100]
    return beside + [Path(name).stem for name in paths.names("grammars")]
