"""Forms: dialogues as data. What is missing is asked for, the rest was told.

    [form.pizza]
    grammar = "pizza"                # its tags are the slots; the file lies beside this one
    confirm = "Shall I order a {size} pizza with {toppings}?"
    done = "I ordered it."
    event = "pizza.ordered"          # raised with the slots; `action` names a task that takes them

    [[form.pizza.slot]]
    name = "size"
    ask = "Which size?"

    [[form.pizza.slot]]
    name = "toppings"
    ask = "With which toppings?"
    none = "nothing on it"           # it may be left out: what stands for it then

As in VoiceXML 2.0, section 2.1.5, one sentence may fill several slots, in any order; the first one
that is empty is asked for.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from hri.conversation.alarms import lacks_time
from hri.conversation.authored_event import read_event
from hri.conversation.spoken_text import check_text
from hri.core import paths
from hri.core.errors import HriError, Mistakes, did_you_mean
from hri.core.toml import Table, load_toml
from hri.speech.grammar import load_grammar
from hri.speech.language import is_other_language

FILE = "forms.toml"
"""In the folder of an app or a skill."""
NOTHING = ""
"""Value of a slot that is to stay empty."""
CHANGE = "What should I change?"
"""Asked after a no where nothing else is to be asked."""
TURNS_EACH = 3
"""Turns for each slot, after which a form is given up."""


@dataclass(frozen=True)
class Slot:
    """One thing that is to be known."""

    name: str
    ask: str
    none: str | None = None
    """What stands for it where it is left out; None for one that is needed."""
    ask_time: str = ""
    """Asked where a tag `when` of `grammars/when.jsgf` is a day, or a part of one; empty to take
    it as it is."""

    def question(self, values: Mapping[str, Any]) -> str:
        """What is to be asked for it; empty where nothing is."""
        if self.name not in values:
            return self.ask
        return self.ask_time if lacks_time(str(values[self.name])) else ""


@dataclass(frozen=True)
class Form:
    """The slots of a dialogue, and what is done with them."""

    name: str
    path: Path
    """The file that says it."""
    grammar: Path
    slots: tuple[Slot, ...]
    confirm: str = ""
    """Asked in the end; empty to do it at once."""
    change: str = ""
    """Asked after a no; empty to end there. Unless said, CHANGE for several slots in English."""
    done: str = ""
    refused: str = ""
    """Said after a last no."""
    event: str = ""
    action: str = ""

    @property
    def most_turns(self) -> int:
        """Questions that it asks before it gives up."""
        return TURNS_EACH * (len(self.slots) + 1)

    def taken(self, tags: Mapping[str, Any]) -> dict[str, Any]:
        """Those tags that are slots of the form; in a list nothing twice."""
        return {slot.name: _once(tags[slot.name]) for slot in self.slots if slot.name in tags}

    def next_slot(self, values: Mapping[str, Any]) -> Slot | None:
        """The first slot of which something is to be asked."""
        return next((slot for slot in self.slots if slot.question(values)), None)

    def filled_in(self, text: str, values: Mapping[str, Any]) -> str:
        """A text of the form with the slots in it, as they are said; it begins with a capital."""
        said = {slot.name: _said(values.get(slot.name, NOTHING), slot) for slot in self.slots}
        filled = text.format_map(said)
        return filled[:1].upper() + filled[1:]


def _once(value: Any) -> Any:
    return tuple(dict.fromkeys(value)) if isinstance(value, tuple) else value


def _said(value: Any, slot: Slot) -> str:
    if value == NOTHING:
        return slot.none or ""
    if isinstance(value, Sequence) and not isinstance(value, str):
        *first, last = map(str, value)
        return f"{', '.join(first)} and {last}" if first else last
    return f"{value:g}" if isinstance(value, float) else str(value)


def load_forms(files: Sequence[Path]) -> dict[str, Form]:
    """The forms of all files, by name; a later one of a name replaces an earlier one.

    Raises AuthoringError, or AuthoringErrors for several mistakes.
    """
    mistakes, forms = Mistakes(), dict[str, Form]()
    for path in files:
        table = load_toml(path, "file of forms")
        for name, entry in table.tables("form"):
            if (form := mistakes.keep(partial(_form, name, entry))) is not None:
                forms[name] = form
        mistakes.keep(table.finish)
    mistakes.tell()
    return forms


def _form(name: str, entry: Table) -> Form:
    path = _grammar(entry, entry.string("grammar", name))
    grammar = load_grammar(path)
    tags = grammar.tag_names()
    slots = tuple(_slot(one, tags) for one in entry.array("slot"))
    if not slots:
        raise entry.error(None, f"the form {name} has no slot", f"add [[form.{name}.slot]]")
    names = [slot.name for slot in slots]
    texts = {key: entry.string(key, "") for key in ("confirm", "done", "refused")}
    # Who says no to a form of one slot may say the other value at once.
    is_asked = bool(texts["confirm"]) and len(slots) > 1 and not is_other_language(grammar)
    texts["change"] = entry.string("change", CHANGE if is_asked else "")
    for key, text in texts.items():
        check_text(entry, text, names, key)
    event, action = read_event(entry), entry.string("action", "")
    entry.finish()
    return Form(name, entry.path, path, slots, event=event, action=action, **texts)


def _grammar(entry: Table, name: str) -> Path:
    try:
        return paths.find("grammars", name, [entry.path.parent])
    except HriError as error:
        what, _, remedy = str(error).partition(" - ")
        raise entry.error("grammar", what, remedy) from error


def _slot(entry: Table, tags: Collection[str]) -> Slot:
    name = entry.string("name")
    if name not in tags:
        what = f'the grammar of the form gives no tag "{name}"'
        raise entry.error("name", what, did_you_mean(name, tags))
    none = entry.string("none") if "none" in entry else None
    slot = Slot(name, entry.string("ask"), none, entry.string("ask_time", ""))
    entry.finish()
    return slot
