"""The child process of `checking`: reads a request on standard input, answers with what is wrong.

`{"kind": "grammar", "name": "grammars/mine.jsgf", "path": "...", "text": null or "...",
"app": "..."}` is answered by `{"wrong": ["file:line:column: ..."], "remarks": [...]}`.
"""

from __future__ import annotations

import json
import os
import re
import resource
import shutil
import sys
import tempfile
import tomllib
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hri.core import paths
from hri.core.errors import AuthoringErrors, HriError
from hri.core.quoting import message_line
from hri.core.xml import Element, parse_xml

MOST_TOLD = 20
"""Lines of each sort."""
MOST_MEMORY = 2_000_000_000
"""Bytes that the child may take."""
LONGEST_CPU = 40
"""Seconds of the processor."""
MOST_COPIED = 20_000_000
"""Bytes of a face that is copied to be looked at with one file changed."""
NAMESPACE = "http://www.w3.org/"
_QUOTED = re.compile(r"\"([^\"\n]*)\"|<([^<>\n]*)>")
"""What may name something else in a grammar."""

Found = tuple[list[str], list[str]]
"""What is wrong, and remarks."""


@dataclass(frozen=True, slots=True)
class Asked:
    """A file to look at."""

    kind: str
    name: str
    path: Path
    app: str
    """The folder of the app that runs."""


def main() -> int:
    """Look at one file, within limits of memory and time."""
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (LONGEST_CPU, LONGEST_CPU))
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what is looked at may print
    request = json.loads(sys.stdin.buffer.read())
    text = request.pop("text")
    asked = Asked(**{**request, "path": Path(request["path"])})
    with tempfile.TemporaryDirectory(prefix="hri-check-") as made:
        folder = Path(made).resolve()
        _stand_in(folder)
        wrong, remarks = _told(asked) if text is None else _of_text(asked, text, folder)
        hidden = {str(folder): "", str(asked.path.parent): os.path.dirname(asked.name)}
        answer = {
            "wrong": [_line(one, hidden) for one in wrong[:MOST_TOLD]],
            "remarks": [_line(one, hidden) for one in remarks[:MOST_TOLD]],
        }
    with answers:
        json.dump(answer, answers)
    return 0


def _stand_in(folder: Path) -> None:
    """Let relative names lead to this folder, which is empty, and no more to the user's."""
    for variable in paths.VARIABLES:
        named = filter(None, os.environ.get(variable, "").split(os.pathsep))
        os.environ[variable] = os.pathsep.join(str(paths.expanded(one).absolute()) for one in named)
    os.chdir(folder)


def _line(text: str, hidden: Mapping[str, str]) -> str:
    """A line that names no folder of this machine."""
    for path, name in hidden.items():
        text = text.replace(path + os.sep, f"{name}/" if name else "")
    return message_line(text.replace(str(paths.house()) + os.sep, ""))


def _told(asked: Asked) -> Found:
    try:
        return CHECKS[asked.kind](asked)
    except AuthoringErrors as several:
        return [str(one) for one in several.errors], []
    except HriError as error:
        return [str(error)], []


def _of_text(asked: Asked, text: str, folder: Path) -> Found:
    """What would be wrong if the file had this text."""
    try:
        foreign = list(_foreign(asked, text))
    except HriError as error:
        return [str(error)], []
    if foreign:
        what = f'"{foreign[0]}" leads out of the folders of authored files'
        return [f"{asked.name}: {what} - name what lies in them"], []
    # Before all others, so that the text counts wherever the file is looked for.
    before = os.environ["HRI_PATH"]
    os.environ["HRI_PATH"] = os.pathsep.join(filter(None, (str(folder), before)))
    changed = folder / asked.name
    if asked.kind == "face":
        top = Path(*Path(asked.name).parts[:2])
        _copy_face(_top_of_face(asked), folder / top)
    elif asked.kind == "replies":
        changed = folder / "apps" / "proposed" / "replies.toml"
    changed.parent.mkdir(parents=True, exist_ok=True)
    if asked.kind == "replies":
        (changed.parent / "app.toml").write_text(
            f'about = "a proposal"\nextends = {json.dumps(asked.app)}\n', encoding="utf-8"
        )
    changed.write_text(text, encoding="utf-8")
    app = str(changed.parent) if asked.kind == "replies" else asked.app
    return _told(Asked(asked.kind, asked.name, changed, app))


def _copy_face(face: Path, to: Path) -> None:
    size = sum(one.stat().st_size for one in face.rglob("*") if one.is_file())
    if size > MOST_COPIED:
        raise HriError(f"{face.name}: a face of {size} bytes is not checked here - hri face check")
    shutil.copytree(face, to)


def _top_of_face(asked: Asked) -> Path:
    """The folder of a face, from the path of a file in it."""
    return asked.path.parents[len(Path(asked.name).parts) - 3]


# --- what a text refers to ---


def _foreign(asked: Asked, text: str) -> Iterator[str]:
    """References to files or addresses that lie elsewhere. Raises HriError for no such text."""
    return filter(_leads_out, REFERENCES[asked.path.suffix](asked, text))


def _leads_out(value: str) -> bool:
    is_url = "://" in value and not value.startswith(NAMESPACE)
    return is_url or value.startswith(("/", "~", "\\")) or ".." in re.split(r"[/\\]", value)


def _in_grammar(asked: Asked, text: str) -> Iterator[str]:
    for found in _QUOTED.finditer(text):
        yield found[1] or found[2] or ""


def _in_toml(asked: Asked, text: str) -> Iterator[str]:
    try:
        table = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise HriError(f"{asked.name}: {error} - fix the TOML") from error
    return _strings(table)


def _strings(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, Mapping):
        yield from map(str, value)
        for one in value.values():
            yield from _strings(one)
    elif isinstance(value, list):
        for one in value:
            yield from _strings(one)


def _in_xml(asked: Asked, text: str) -> Iterator[str]:
    return _attributes(parse_xml(text.encode("utf-8"), asked.path))


def _attributes(element: Element) -> Iterator[str]:
    for value in element.attributes.values():
        yield from value.split("\n")
    for child in element:
        yield from _attributes(child)


REFERENCES: Mapping[str, Callable[[Asked, str], Iterator[str]]] = {
    ".jsgf": _in_grammar,
    ".gram": _in_grammar,
    ".toml": _in_toml,
    ".xml": _in_xml,
    ".svg": _in_xml,
}


# --- the checks ---


def _check_grammar(asked: Asked) -> Found:
    from hri.speech.grammar import read_grammar
    from hri.speech.grammar.lint.linter import check

    grammar, mistakes = read_grammar(asked.path)
    if mistakes:
        return [str(error) for error in mistakes], []
    found = check(grammar)
    wrong = [str(one) for one in found if one.severity == "error"]
    return wrong, [str(one) for one in found if one.severity == "warning"]


def _check_replies(asked: Asked) -> Found:
    from hri.core.clock import FakeClock
    from hri.robot import Robot
    from hri.testing.dialogues import TYPED

    noticed: list[str] = []
    # All that an app has is read and compared; nothing is opened.
    Robot(asked.app, "simulated", clock=FakeClock(), devices=TYPED, notice=noticed.append)
    return [], noticed


def _check_face(asked: Asked) -> Found:
    from hri.face import load_face
    from hri.face.lint import findings
    from hri.face.mistakes import mistakes

    folder = _top_of_face(asked)
    if not (folder / "face.toml").is_file():  # gestures and the like, of all faces
        _ = list(_in_toml(asked, asked.path.read_text(encoding="utf-8")))
        return [], []
    if wrong := mistakes(folder):
        return [str(error) for error in wrong], []
    return [], [str(one) for one in findings(load_face(folder), folder)]


def _check_network(asked: Asked) -> Found:
    from hri.behavior.network_file import load_network

    load_network(asked.path).check()
    return [], []


def _check_emotion(asked: Asked) -> Found:
    from hri.core.toml import load_toml
    from hri.emotion.display import load_display
    from hri.emotion.personality import load_personality
    from hri.emotion.reachability import unmet_expectations
    from hri.emotion.stimulus import load_stimuli

    load_toml(asked.path, "emotion file")
    load_display()
    if asked.path.parent.name == "personalities":
        load_personality(str(asked.path))
    return [], [str(one) for one in unmet_expectations(load_stimuli())]


CHECKS: Mapping[str, Callable[[Asked], Found]] = {
    "grammar": _check_grammar,
    "replies": _check_replies,
    "face": _check_face,
    "network": _check_network,
    "emotion": _check_emotion,
}

if __name__ == "__main__":
    with suppress(BrokenPipeError):
        sys.exit(main())
