"""All that is kept about people, in one list, and how it is forgotten: as a whole, or by name.

Whatever else the program writes is about the robot and its own voice.
"""

from __future__ import annotations

import os
import re
import sys
import tempfile
from abc import ABC, abstractmethod
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from hri.conversation import alarm_file, memory_file
from hri.conversation.people import KnownPerson
from hri.core import paths
from hri.core.errors import HriError
from hri.core.growing_files import is_growing
from hri.core.privacy import is_named, is_same_name
from hri.core.reading import opened, parse_json, read_bytes
from hri.core.recorded import BY_DATE, RECORDINGS, parts
from hri.core.stored_data_index import Kind, noted, tidy
from hri.core.writing import PRIVATE, delete, leftovers, write_text
from hri.emotion import persistence
from hri.hal import choices
from hri.robot.provenance import read_record
from hri.speech.pronunciation.guesses import GUESSES
from hri.speech.pronunciation.lexicon import user_lexicon
from hri.vision.color.color_model import own_color_files
from hri.vision.objects.model_file import load_models, own_models, save_models
from hri.vision.objects.object_model import ObjectModel
from hri.vision.tracking.face_recognition import Acquaintances

DRAFTS = ".*.draft"
"""Names of drafts of networks."""
LONGEST_LINE = 1 << 23
"""Bytes that are searched for a name at once."""


class Kept(ABC):
    """One kind of saved data."""

    about: str
    """What it is, for people."""

    @abstractmethod
    def places(self) -> list[Path]:
        """The files and folders that there are."""

    def people(self) -> set[str]:
        """Everyone it knows by name; nobody where it holds only texts."""
        return set()

    @abstractmethod
    def concerns(self, place: Path, person: str) -> bool:
        """Whether something of a person is kept there."""

    @abstractmethod
    def forget(self, place: Path, person: str) -> None:
        """Erase the data of a person there. Raises HriError."""

    def needs_yes(self, person: str | None) -> bool:
        """Whether someone made it on purpose, so that it goes only after a yes."""
        return False

    def delete(self, place: Path) -> None:
        """Erase all that is kept there. Raises HriError."""
        delete(place, *leftovers(place))


class Feelings(Kept):
    """Mood, causes, drives and relations, in each file that a robot kept."""

    about = "feelings, and the robot's opinions of people"

    def places(self) -> list[Path]:
        files = dict.fromkeys((persistence.memory_file(), *noted("feelings")))
        return [file for file in files if persistence.traces(file)]

    def people(self) -> set[str]:
        return set().union(*map(self._people_of, self.places()))

    def concerns(self, place: Path, person: str) -> bool:
        is_known = any(is_same_name(person, known) for known in self._people_of(place))
        return is_known or any(_mentions(file, person) for file in persistence.traces(place))

    def forget(self, place: Path, person: str) -> None:
        """Of the file itself the person, of what lies beside it, or cannot be used, the whole."""
        with suppress(HriError):
            persistence.forget(place, person)
        delete(*(file for file in persistence.traces(place) if _mentions(file, person)))

    def delete(self, place: Path) -> None:
        persistence.forget(place)

    @staticmethod
    def _people_of(place: Path) -> set[str]:
        with suppress(HriError):
            if (memory := persistence.recall(place)) is not None:
                return persistence.people(memory.imprint)
        return set()


class Memories(Kept):
    """Everyone who allowed to be remembered, and what they told."""

    about = "the people that the robot remembers"

    def places(self) -> list[Path]:
        files = dict.fromkeys((memory_file.people_file(), *noted("people")))
        return [file for file in files if memory_file.traces(file)]

    def people(self) -> set[str]:
        return {one.name for place in self.places() for one in memory_file.people_of(place)}

    def concerns(self, place: Path, person: str) -> bool:
        people = memory_file.people_of(place)
        if any(one.is_called(person) or one.without(person) != one for one in people):
            return True
        return any(_has_bytes(file, person) for file in memory_file.spoiled(place))

    def forget(self, place: Path, person: str) -> None:
        """Of the file itself the person, of what lies beside it, or cannot be used, the whole."""
        delete(*(file for file in memory_file.spoiled(place) if _has_bytes(file, person)))
        if os.path.lexists(place):
            memory_file.change(place, partial(memory_file.without, name=person))

    def delete(self, place: Path) -> None:
        memory_file.forget_all(place)


class Promises(Kept):
    """Timers, alarms and reminders, with what people are to be reminded of."""

    about = "timers, alarms and reminders"

    def places(self) -> list[Path]:
        return [alarm_file.alarm_file()] if alarm_file.traces(alarm_file.alarm_file()) else []

    def concerns(self, place: Path, person: str) -> bool:
        return any(_mentions(file, person) for file in alarm_file.traces(place))

    def forget(self, place: Path, person: str) -> None:
        """Of the file itself the entries with the name, of the files beside it the whole."""
        beside = [file for file in alarm_file.traces(place) if file != place]
        delete(*(file for file in beside if _mentions(file, person)))
        try:
            alarm_file.forget(place, person)
        except HriError:
            self.delete(place)

    def delete(self, place: Path) -> None:
        alarm_file.forget_all(place)


class Exports(Kept):
    """The memory of people, written to where someone wanted it."""

    about = "an export of the memory of people"

    def places(self) -> list[Path]:
        return noted("exports")

    def concerns(self, place: Path, person: str) -> bool:
        return _mentions(place, person)

    def needs_yes(self, person: str | None) -> bool:
        return True

    def forget(self, place: Path, person: str) -> None:
        self.delete(place)


class Faces(Kept):
    """Faces that were given a name, as numbers."""

    about = "faces and their names"

    def places(self) -> list[Path]:
        return noted("faces")

    def people(self) -> set[str]:
        return set().union(*map(self._people_of, self.places()))

    def concerns(self, place: Path, person: str) -> bool:
        is_known = any(is_same_name(person, name) for name in self._people_of(place))
        return is_known or _mentions(place, person)

    def forget(self, place: Path, person: str) -> None:
        """The person; the whole file when it cannot be used."""
        try:
            known = Acquaintances.load(place)
        except HriError:
            self.delete(place)
            return
        for name in known.names:
            if is_same_name(person, name):
                known.forget(name)
        known.save(place)

    @staticmethod
    def _people_of(place: Path) -> set[str]:
        with suppress(HriError):
            return set(Acquaintances.load(place).names)
        return set()


class Lines(Kept):
    """A text file with a line for each word."""

    def concerns(self, place: Path, person: str) -> bool:
        return any(_is_of(person, line) for line in lines_of(place))

    def forget(self, place: Path, person: str) -> None:
        rest = [line for line in lines_of(place) if not _is_of(person, line)]
        write_text(place, "".join(f"{line}\n" for line in rest), PRIVATE)


class LookedUpWords(Lines):
    """A cache: how words that no dictionary has are said, names among them."""

    about = "words that were looked up"

    def places(self) -> list[Path]:
        return sorted(paths.cache_folder().glob(GUESSES))


class OwnWords(Lines):
    """How the user says words, names among them."""

    about = "your lexicon"

    def places(self) -> list[Path]:
        return _there(user_lexicon())

    def needs_yes(self, person: str | None) -> bool:
        return person is None


class Devices(Kept):
    """A device may bear the name of whose it is."""

    about = "your choice of devices"

    def places(self) -> list[Path]:
        return _there(choices.choices_file())

    def needs_yes(self, person: str | None) -> bool:
        return person is None

    def concerns(self, place: Path, person: str) -> bool:
        return _mentions(place, person)

    def forget(self, place: Path, person: str) -> None:
        """The devices named so; the whole file when it cannot be used."""
        try:
            chosen = choices.load_choices()
        except HriError:
            self.delete(place)
            return
        rest = {id: name for id, name in chosen.items() if not is_named(person, name)}
        choices.save_choices(rest)


class Objects(Kept):
    """Objects that were shown, with cutouts of pictures; one may bear the name of whose it is."""

    about = "objects that you taught"

    def places(self) -> list[Path]:
        return list(dict.fromkeys((*_there(own_models()), *noted("objects"))))

    def needs_yes(self, person: str | None) -> bool:
        return person is None

    def concerns(self, place: Path, person: str) -> bool:
        """As it is loaded: another tool may have packed it so that no name stands in the file."""
        try:
            return any(_is_object_of(person, one) for one in load_models(place).objects)
        except HriError:
            return _mentions(place, person)

    def forget(self, place: Path, person: str) -> None:
        """The objects named so, and those from files named so; all when it cannot be used."""
        try:
            models = load_models(place)
        except HriError:
            self.delete(place)
            return
        for one in models.objects:
            if _is_object_of(person, one):
                models = models.without(one.name)
        save_models(place, models)


class Colors(Kept):
    """Files of colors; one may bear the name of whose it is."""

    about = "a color that you taught"

    def places(self) -> list[Path]:
        return list(dict.fromkeys((*own_color_files(), *noted("colors"))))

    def needs_yes(self, person: str | None) -> bool:
        return person is None

    def concerns(self, place: Path, person: str) -> bool:
        return is_named(person, place.stem)  # it holds only numbers

    def forget(self, place: Path, person: str) -> None:
        self.delete(place)


class Recordings(Kept):
    """Folders of recordings, wherever they are."""

    about = "a recording"

    def places(self) -> list[Path]:
        """Those that were noted; those below the current folder may be older than the notes."""
        here = sorted(Path(RECORDINGS).resolve().glob(BY_DATE))
        return [folder for folder in dict.fromkeys((*noted("recording"), *here)) if parts(folder)]

    def concerns(self, place: Path, person: str) -> bool:
        logs = [file for file in parts(place) if file.suffix == ".jsonl"]
        return any(_mentions(log, person) for log in logs) or self._began_with(place, person)

    @staticmethod
    def _began_with(place: Path, person: str) -> bool:
        """Whether the robot had feelings about a person when a recording began."""
        with suppress(HriError):
            feelings = read_record(place).get("feelings")
            return any(is_named(person, text) for text in _texts_in(feelings))
        return False

    def needs_yes(self, person: str | None) -> bool:
        return True

    def forget(self, place: Path, person: str) -> None:
        """A recording goes whole: whose voice and looks a film answers to cannot be cut out."""
        self.delete(place)

    def delete(self, place: Path) -> None:
        """Raises HriError as long as a robot writes it."""
        if any(is_growing(file) for file in parts(place)):
            raise HriError(f"{place}: it is still being recorded - end the robot first")
        delete(*parts(place))
        with suppress(OSError):  # what else lies there is not ours
            place.rmdir()


class Drafts(Kept):
    """Networks that were changed in the studio and not saved."""

    about = "a draft of a network"

    def places(self) -> list[Path]:
        """In the user's folder, where networks are looked for, and wherever the studio kept one."""
        own = (paths.data_folder() / name for name in ("drafts", "networks"))
        folders = [Path(), *own, *noted("drafts")]
        found = [file for folder in folders for file in sorted(folder.glob(DRAFTS))]
        for root in paths.search_folders():
            for name in ("networks", "config", "apps"):
                found += sorted((root / name).glob(f"**/{DRAFTS}"))
        return list(dict.fromkeys(file.resolve() for file in found if _is_draft(file)))

    def concerns(self, place: Path, person: str) -> bool:
        return _mentions(place, person)

    def needs_yes(self, person: str | None) -> bool:
        return True

    def forget(self, place: Path, person: str) -> None:
        """A draft goes whole: without a name in it, it would be another network."""
        self.delete(place)


class Captures(Kept):
    """Files of a camera or a microphone that someone asked for; who is in them is not known."""

    def __init__(self, kind: Kind, about: str) -> None:
        self._kind, self.about = kind, about

    def places(self) -> list[Path]:
        return noted(self._kind)

    def concerns(self, place: Path, person: str) -> bool:
        return is_named(person, place.stem)

    def needs_yes(self, person: str | None) -> bool:
        return True

    def forget(self, place: Path, person: str) -> None:
        self.delete(place)


class Telemetry(Kept):
    """Ids of the machine, and unsent events with the path of the program.

    The natural voice's onnxruntime wrote them before its telemetry was switched off.
    """

    about = "telemetry of onnxruntime: ids of this machine, and events it has not sent"
    session = re.compile(rb"\d+\s+[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}\s*")
    """What its file of a session holds."""

    def places(self) -> list[Path]:
        if sys.platform == "darwin":
            base = paths.home() / "Library" / "Application Support"
        else:
            base = paths.cache_folder().parent
        folder = base / "Microsoft" / "DeveloperTools" / ".onnxruntime"
        session = Path(tempfile.gettempdir(), ".ses")
        found = [folder] if folder.is_dir() else []
        return [*found, session] if self._is_session(session) else found

    def concerns(self, place: Path, person: str) -> bool:
        return any(_mentions(file, person) for file in self._files(place))

    def forget(self, place: Path, person: str) -> None:
        self.delete(place)

    def delete(self, place: Path) -> None:
        delete(*self._files(place))
        with suppress(OSError):  # what else lies there is not onnxruntime's
            for folder in (place, *place.parents[:2]):
                folder.rmdir()

    def _is_session(self, file: Path) -> bool:
        """Whether it is onnxruntime's, and this user's: others write to the same folder."""
        with suppress(OSError):
            if file.is_file() and file.stat().st_uid == os.getuid():
                return self.session.fullmatch(file.read_bytes()[:200]) is not None
        return False

    @staticmethod
    def _files(place: Path) -> list[Path]:
        return [place] if place.is_file() else list(place.iterdir())


KEPT: tuple[Kept, ...] = (
    Feelings(), Memories(), Promises(), Exports(), Faces(), LookedUpWords(), OwnWords(), Devices(),
    Objects(), Colors(), Recordings(),
    Captures("pictures", "a picture or film of the camera"),
    Captures("sounds", "a sound of the microphone"), Drafts(), Telemetry(),
)  # fmt: skip
"""The one list. What the program begins to keep about people is added here."""


@dataclass(frozen=True, slots=True)
class Trace:
    """Saved data at one place, of a person or of everyone."""

    kept: Kept
    place: Path
    person: str | None

    @property
    def needs_yes(self) -> bool:
        """Whether someone made it on purpose, so that it goes only after a yes."""
        return self.kept.needs_yes(self.person)

    def erase(self) -> None:
        """Forget it. Raises HriError when it cannot be read or written."""
        if self.person is None:
            self.kept.delete(self.place)
        else:
            self.kept.forget(self.place, self.person)
        tidy()


def traces(person: str | None = None) -> list[Trace]:
    """Where something is kept of a person, or at all. Raises HriError for what cannot be read."""
    return [
        Trace(kept, place, person)
        for kept in KEPT
        for place in kept.places()
        if person is None or kept.concerns(place, person)
    ]


def people() -> set[str]:
    """Everyone who is known by name."""
    return set().union(*(kept.people() for kept in KEPT))


def remembered() -> list[KnownPerson]:
    """Everyone who is remembered, in any place that can be used."""
    return [one for place in Memories().places() for one in memory_file.people_of(place)]


def told_by(person: str) -> set[str]:
    """The words of all facts of a person that are remembered."""
    return {fact.value for one in remembered() if one.is_called(person) for fact in one.facts}


def _there(file: Path) -> list[Path]:
    return [file] if os.path.lexists(file) or leftovers(file) else []


def lines_of(file: Path) -> Iterator[str]:
    """The lines of a text, whatever is in it; it need not fit into memory."""
    if not file.is_file():
        return
    with opened(file, "text", None) as text:
        while line := text.readline(LONGEST_LINE):
            yield line.decode("utf-8", "replace").rstrip("\r\n")


def _has_bytes(file: Path, person: str) -> bool:
    """Whether a file of any kind holds a name."""
    try:
        return person.encode().lower() in read_bytes(file, "file", memory_file.LARGEST).lower()
    except HriError:
        return False


def _is_draft(file: Path) -> bool:
    """Whether it is a draft of a network; other programs have drafts, too."""
    try:
        kept = parse_json(read_bytes(file, "draft"))
    except (HriError, ValueError):
        return file.parent == paths.data_folder() / "drafts"
    return isinstance(kept, dict) and {"path", "text"} <= kept.keys()


def _is_of(person: str, line: str) -> bool:
    """Whether a line of a lexicon is for one of the names of a person, or a comment has it."""
    word = line if line.startswith(("#", ";")) else line.partition("\t")[0].split(" ")[0]
    return any(is_named(name, word) for name in person.split())


def _is_object_of(person: str, model: ObjectModel) -> bool:
    """Whether its name, or that of a file it was learned from, has the name of a person."""
    texts = (model.name, *(view.source for view in model.views))
    return any(is_named(person, text) for text in texts)


def _mentions(file: Path, person: str) -> bool:
    """Whether a file of JSON or text names a person."""
    return any(is_named(person, text) for line in lines_of(file) for text in texts_of(line))


def texts_of(line: str) -> Iterator[str]:
    """What a line says: the texts of its JSON, or the line itself where it is not JSON."""
    try:
        yield from _texts_in(parse_json(line))
    except ValueError:
        yield line


def _texts_in(value: Any) -> Iterator[str]:
    match value:
        case str():
            yield value
        case dict():
            for key, item in value.items():
                yield from (key, *_texts_in(item))
        case list():
            for item in value:
                yield from _texts_in(item)
