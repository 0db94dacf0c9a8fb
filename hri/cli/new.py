"""`hri new`: creates a small working driver, behavior, task, primitive, app or face. The folders of
`templates/` and `driver_templates/` work unchanged, under the name `thing`; a new one is a renamed
copy.
"""

from __future__ import annotations

import argparse
import importlib.util
import keyword
import re
import shutil
from dataclasses import dataclass
from pathlib import Path

from hri.core import paths
from hri.core.errors import HriError
from hri.core.quoting import report
from hri.core.writing import new_folder

TEMPLATES = Path(__file__).with_name("templates")
DRIVER_TEMPLATES = Path(__file__).with_name("driver_templates")
NAME = re.compile(r"[a-z][a-z0-9_]{0,39}")


@dataclass(frozen=True)
class Kind:
    """A kind of thing to create."""

    about: str
    steps: tuple[str, ...]
    """Commands to try, in the new folder."""


KINDS = {
    "driver": Kind(
        "a range sensor with its spec and a configuration that names it",
        (
            "HRI_PATH=. hri devices --config ./devices.xml",
            "HRI_PATH=. test_range_sensor --config ./devices.xml",
        ),
    ),
    "behavior": Kind(
        "a behavior with its schema and a network that runs it",
        ("HRI_PATH=. behave ./thing.xml --without-resources",),
    ),
    "task": Kind("a task that is a script as well", ("python thing.py",)),
    "primitive": Kind("a task that is a network, and a script as well", ("python thing.py",)),
    "app": Kind(
        "an app that hears, answers, nods and counts",
        (
            "hri run .                    # say: hello, count to five, goodbye",
            "hri run . --config typed     # type it instead; Ctrl-D ends it",
        ),
    ),
    "companion_app": Kind(
        "the companion, with a fortune teller and a timer of your own",
        (
            "hri run .                    # say: tell my fortune, set a timer for ten seconds",
            "hri run . --config typed     # type it instead; Ctrl-D ends it",
        ),
    ),
    "face": Kind(
        "a copy of the robot's face to redraw",
        ("hri face check faces/thing", "HRI_PATH=. hri companion --face thing"),
    ),
}

FROM = {("app", "companion"): "companion_app"}
"""The kinds that accept --from."""

RANGE_SENSOR = "range_sensor"
_LISTED = "HRI_PATH=. hri devices --config ./devices.xml"
DRIVERS = {
    RANGE_SENSOR: KINDS["driver"],
    "base": Kind(
        "a base with its serial protocol, under the supervisor, and a configuration", (_LISTED,)
    ),
    "battery": Kind("a battery with its spec and a configuration that names it", (_LISTED,)),
    "button": Kind("a button with its spec and a configuration that names it", (_LISTED,)),
    "camera": Kind(
        "a camera with its spec and a configuration that names it",
        (_LISTED, "HRI_PATH=. test_camera --config ./devices.xml"),
    ),
    "display": Kind("a display with its spec and a configuration that names it", (_LISTED,)),
    "microphone": Kind("a microphone with its spec and a configuration that names it", (_LISTED,)),
    "voice": Kind("a voice with its spec and a configuration that names it", (_LISTED,)),
}
"""What a driver can be of: the choices of --kind."""


@dataclass(frozen=True)
class Template:
    """What is copied."""

    folder: Path
    word: str
    """What it makes, for messages."""
    kind: Kind


def add_arguments(parser: argparse.ArgumentParser) -> None:
    named = [kind for kind in KINDS if kind not in FROM.values()]
    parser.add_argument("kind", choices=named, help="what to create")
    parser.add_argument(
        "name", metavar="NAME", help="letters, digits and _: wave_hand, or WaveHand"
    )
    parser.add_argument(
        "--from",
        dest="base",
        choices=[base for _, base in FROM],
        help="for an app: contain all of the companion, and add to it",
    )
    parser.add_argument(
        "--kind",
        dest="driver",
        choices=DRIVERS,
        help=f"for a driver: of what ({RANGE_SENSOR})",
    )
    parser.add_argument(
        "--to", type=Path, default=Path(), metavar="DIR", help="where to put its folder (here)"
    )


def run(options: argparse.Namespace) -> int:
    template = _template(options)
    if not options.to.is_dir():
        raise HriError(f"{options.to}: no such folder - make it, or check the path")
    folder = create(template, options.name, options.to)
    name = folder.name
    report(f"{folder}: {template.kind.about}. Next:")
    print()
    report(f"  cd {folder}")
    print("  python -m pytest    # if it is missing: pip install pytest")
    for step in template.kind.steps:
        report(f"  {_renamed(step, name)}")
    return 0


def create(template: Template, word: str, to: Path) -> Path:
    """Write a new folder into another one; where it is. Raises HriError for an unfit name."""
    name = _module_name(word)
    if not NAME.fullmatch(name):
        remedy = "start with a letter, then letters, digits and _: wave_hand"
        raise HriError(f'"{word}" is not a name - {remedy}')
    folder = to / name
    if folder.exists():
        raise HriError(f"{folder}: already exists - choose another name, or --to another folder")
    _refuse_taken(name, template)
    with new_folder(folder) as new:
        _write(template, name, new)
    return folder


def _template(options: argparse.Namespace) -> Template:
    """What is asked for. Raises HriError for kinds that do not accept --from or --kind."""
    kind, base, driver = options.kind, options.base, options.driver
    if base is not None and (kind, base) not in FROM:
        raise HriError(f"{kind} does not accept --from - leave it out")
    if driver is not None and kind != "driver":
        raise HriError(f"{kind} does not accept --kind - leave it out")
    if driver not in (None, RANGE_SENSOR):
        return Template(DRIVER_TEMPLATES / driver, driver, DRIVERS[driver])
    key = FROM.get((kind, base), kind)
    return Template(TEMPLATES / key, key, KINDS[key])


def _refuse_taken(name: str, template: Template) -> None:
    """Refuse a name that would hide a module, or a word that the new code uses. Raises HriError."""
    if keyword.iskeyword(name) or importlib.util.find_spec(name) is not None:
        what = f'"{name}" is a word or an installed module of Python'
        raise HriError(f'{what} - choose another name, such as "my_{name}"')
    taken = {name, _class_name(name)}
    code = [path.read_text("utf-8") for path in _files(template) if path.suffix in (".py", ".xml")]
    # Only a name that becomes an identifier in the code can clash with one.
    if any(taken & set(re.findall(r"\w+", text)) for text in code if "thing" in text.lower()):
        raise HriError(
            f'"{name}" is a word of the new {template.word} itself - choose another name'
        )


def _write(template: Template, name: str, folder: Path) -> None:
    for path in _files(template):
        target = folder / _renamed(str(path.relative_to(template.folder)), name)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(_renamed(path.read_text("utf-8"), name), "utf-8")
    if template.word == "face":
        shutil.copytree(paths.find("faces", "robot"), folder / "faces" / name)


def _files(template: Template) -> list[Path]:
    found = sorted(template.folder.rglob("*"))
    return [path for path in found if path.is_file() and path.suffix != ".pyc"]


def _renamed(text: str, name: str) -> str:
    return text.replace("thing", name).replace("Thing", _class_name(name))


def _module_name(name: str) -> str:
    """`WaveHand` as Python names a module: `wave_hand`."""
    return re.sub("(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


def _class_name(name: str) -> str:
    return "".join(word.capitalize() for word in name.split("_"))
