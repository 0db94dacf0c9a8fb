"""Which grammar is in force: the topmost of a stack, once the recognizer has taken it.

A grammar is read and compiled in a worker, and the one before it stays in force meanwhile. One
that is refused leaves the stack as it was.

Rules marked @interrupts, such as "stop", stay in force under every other grammar: those of the
first grammar, also when another one took its place, and those of all that lie below.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from hri.core.clock import Worker
from hri.core.errors import HriError
from hri.speech.grammar import Grammar

LOOK_EVERY = 1.0
"""Seconds between looks whether a file has changed."""

Prepare = Callable[[Grammar], Grammar]
"""Turns the grammar in a file into the one to hear."""


def as_written(grammar: Grammar) -> Grammar:
    """The grammar as it is."""
    return grammar


@dataclass(eq=False)
class Layer:
    """A grammar on the stack, and what has become of it."""

    path: Path
    prepare: Prepare = field(default=as_written)
    grammar: Grammar | None = None
    """What its file says, once it has been read."""
    heard: Grammar | None = None
    """What is understood once it is in force: this, as it was prepared, and the interrupting rules
    of those below."""
    unheard: HriError | None = None
    """Why the recognizer does not take it; then it is in force for typed lines alone."""
    below: tuple[Layer, ...] = ()
    """The layers whose interrupting rules stay in force."""
    error: HriError | None = None
    """Why it was refused."""
    origin: Layer | None = None
    """The layer whose file this one read again: whoever put that one there may take this away."""
    replaces: Layer | None = None
    """What comes back when it is refused."""
    changed: float = 0.0
    """When its files were last changed, as the file system counts."""

    is_read: bool = False
    """Whether its file was read for this, which it is not when it comes into force once more."""

    @property
    def is_reloaded(self) -> bool:
        """Whether it came into force because its file was saved."""
        return self.is_read and self.origin is not None

    def stands_for(self, layer: Layer) -> bool:
        """Whether it is that layer, or was read again from its file."""
        return layer in (self, self.origin)


class GrammarStack:
    """Grammars one above the other, and the worker that lets the recognizer take them."""

    def __init__(self, worker: Worker[Layer], take: Callable[[Layer], None]) -> None:
        """`take` runs in the worker: it reads the grammar and gives it to the recognizer.

        It raises HriError for a grammar that cannot be used.
        """
        self._worker = worker
        self._take = take
        self._layers: list[Layer] = []
        self._first: Layer | None = None
        self._loading: Layer | None = None
        self._looked = 0.0
        self.in_force: Layer | None = None
        """None before the first grammar is ready."""

    def use(self, path: Path) -> Layer:
        """Put a grammar in the place of the topmost."""
        replaced = self._layers.pop() if self._layers else None
        self._layers.append(Layer(path, replaces=replaced))
        self._first = self._first or self._layers[-1]
        return self._layers[-1]

    def push(self, path: Path, prepare: Prepare = as_written) -> Layer:
        """Put a grammar above the others."""
        self._layers.append(Layer(path, prepare))
        return self._layers[-1]

    def pop(self, layer: Layer) -> None:
        """Take a grammar away, wherever it lies; the last one stays, a second call does nothing."""
        found = next((one for one in self._layers if one.stands_for(layer)), None)
        if found is not None and len(self._layers) > 1:
            self._layers.remove(found)

    def reload(self) -> Layer | None:
        """Read the topmost again."""
        if not self._layers:
            return None
        old = self._layers[-1]
        new = self.use(old.path)
        new.origin, new.prepare = old.origin or old, old.prepare
        if old is self._first:
            self._first = new
        return new

    def retake(self) -> None:
        """Give the topmost to the recognizer again, as it was read."""
        if self._layers:
            grammar = self._layers[-1].grammar
            self.reload()
            self._layers[-1].grammar = grammar

    @property
    def is_settled(self) -> bool:
        """Whether the topmost is in force."""
        return self._loading is None and bool(self._layers) and self._layers[-1] is self.in_force

    def update(self) -> Layer | None:
        """Take the next step; a grammar that has come into force or was refused just now.

        Raises errors other than those of a grammar, such as NotAvailable for a missing model.
        """
        finished = None
        loading = self._loading
        try:
            for layer in self._worker.poll():
                finished, self.in_force, layer.replaces = layer, layer, None
                self._loading = None
        except HriError as error:
            self._loading = None
            if self.in_force is None or loading is None:
                raise
            loading.error, finished = error, loading
            self._refuse(loading)
        if self._layers and self._layers[-1] is not self.in_force and not self._worker.is_busy:
            wanted = self._loading = self._layers[-1]
            wanted.below = self._below(wanted)
            self._worker.submit(lambda: self._taken(wanted))
        return finished

    def reload_when_changed(self, now: float) -> None:
        """Read the grammar in force again when one of its files was changed."""
        if now - self._looked < LOOK_EVERY or not self.is_settled or self.in_force is None:
            return
        self._looked = now
        grammar = self.in_force.grammar
        if grammar is not None and changed_at(grammar) not in (self.in_force.changed, 0.0):
            self.in_force.changed = changed_at(grammar)  # one look at each change
            self.reload()

    def close(self) -> None:
        """Wait for a grammar that is being taken, and end the worker."""
        self._worker.close()

    def _below(self, layer: Layer) -> tuple[Layer, ...]:
        """The first layer and those below a layer, the lowest first."""
        below = self._layers[: self._layers.index(layer)]
        first = self._first
        if first is None or first is layer or first in below:
            return tuple(below)
        return first, *below

    def _taken(self, layer: Layer) -> Layer:
        self._take(layer)
        if layer.grammar is not None:
            layer.changed = changed_at(layer.grammar)
        return layer

    def _refuse(self, layer: Layer) -> None:
        if layer not in self._layers:
            return
        place = self._layers.index(layer)
        if layer is self._first:
            self._first = layer.replaces
        self._layers[place : place + 1] = [layer.replaces] if layer.replaces else []


def changed_at(grammar: Grammar) -> float:
    """When the newest of a grammar's files was changed; 0 when one cannot be looked at."""
    files = {grammar.path, *(rule.path for rule in grammar.rules.values())}
    try:
        return max(file.stat().st_mtime for file in files)
    except OSError:
        return 0.0
