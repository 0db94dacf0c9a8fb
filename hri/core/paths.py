"""Finds authored files: in the user's folders first, then among the built-in ones."""

from __future__ import annotations

import difflib
import os
from collections.abc import Iterator, Sequence
from contextlib import suppress
from functools import cache
from pathlib import Path

from hri.core.errors import HriError, did_you_mean

VARIABLES = ("HRI_PATH", "EVOLUTION_CONFIG_PATH")

SUFFIXES = {"grammars": (".jsgf", ".gram"), "config": (".xml",)}
"""What a name without a suffix gets, the first that is there, by kind; else ".toml". Sphinx and
Java name their JSGF files ".gram"."""
MARKS = {"apps": "app.toml", "faces": "face.toml", "skills": "skill.toml"}
"""By kind of which each one is a folder, the file that such a folder has."""
FOLDERS = tuple(MARKS)


def exists(path: Path) -> bool:
    """Whether something is there; under a name that no file can have, nothing is."""
    try:
        return path.exists()
    except (OSError, ValueError):
        return False


def is_file(path: Path) -> bool:
    """Whether a regular file is there; under a name that no file can have, none is."""
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


@cache
def house() -> Path:
    """The folder with `faces/`, `grammars/`, ...: the checkout, or `hri/data` of a wheel."""
    package = Path(__file__).resolve().parents[1]
    checkout = package.parent
    if (checkout / "pyproject.toml").is_file() and (checkout / "faces").is_dir():
        return checkout
    return package / "data"


def search_folders() -> Iterator[Path]:
    """The folders of HRI_PATH, then of EVOLUTION_CONFIG_PATH, then the built-in folder."""
    for variable in VARIABLES:
        for folder in os.environ.get(variable, "").split(os.pathsep):
            if folder:
                yield expanded(folder)
    yield house()


def find(kind: str, name: str, own: Sequence[Path] = ()) -> Path:
    """The file or folder of an authored thing: `find("faces", "robot")`.

    The suffix of the kind may be left out. A file in the `own` folders comes before all others. A
    path to something that exists is taken as it is. Else the first search folder that has
    `kind/name` (or `name` itself, for folders laid out like `config/`) wins, and last the folder
    that the program was started in.
    Raises HriError when there is none.
    """
    if not name:
        raise HriError(f"an empty name for something in {kind} - {_meant(kind, name, own)}")
    try:
        direct = expanded(name)
        is_there = direct.exists()
    except (OSError, ValueError) as error:
        raise HriError(f'"{name[:60]}" is not a valid file name - shorten or fix it') from error
    spelled = [name] if kind in FOLDERS else [name + suffix for suffix in suffixes(kind)]
    for folder in own:
        for candidate in _places(folder, kind, (name, *spelled)):
            if is_file(candidate):
                return candidate
    if is_there and (os.sep in name or direct.suffix or name in (os.curdir, os.pardir)):
        return direct
    for folder in search_folders():
        for candidate in _places(folder, kind, (name, *spelled)):
            if exists(candidate) and candidate != folder:
                return candidate
    for beside in map(expanded, spelled):
        if exists(beside) and beside.is_dir() == (kind in FOLDERS):
            return beside
    is_below = os.sep in name and direct.parent.is_dir()
    has_form_of_path = name.startswith((".", os.sep, "~")) or name.endswith(os.sep)
    if has_form_of_path or (is_below and direct.suffix):
        raise HriError(f"{name}: no such file or folder - check the path")
    raise HriError(f'no "{name}" in {kind} - {_meant(kind, name, own)}')


def _places(folder: Path, kind: str, spelled: Sequence[str]) -> Iterator[Path]:
    """Where a folder may have something, by its names."""
    return (below / spelling for below in (folder / kind, folder) for spelling in spelled)


def suffixes(kind: str) -> tuple[str, ...]:
    """The suffixes of the files of a kind."""
    return SUFFIXES.get(kind, (".toml",))


def _meant(kind: str, name: str, folders: Sequence[Path]) -> str:
    """The remedy for a name that is not found: one like it, also in a folder of its kind."""
    if kind in FOLDERS:
        here = [f.parent.name for f in Path().glob(f"*/{MARKS[kind]}")]
        return did_you_mean(
            Path(name).stem, [*here, *(n for n in names(kind) if not Path(n).suffix)]
        )
    # Lists of names beside grammars are not grammars.
    own = ("", *suffixes(kind))
    fitting = [n for n in names(kind) if kind not in SUFFIXES or Path(n).suffix in own]
    beside = [file.name for folder in folders for file in sorted(folder.glob("*"))]
    fitting += [n for n in beside if n.endswith(suffixes(kind))]
    known = {Path(n).stem: Path(n).stem for n in fitting}
    for below in [found for found in names(kind) if not Path(found).suffix]:
        for found in names(f"{kind}/{below}"):
            if found.endswith(suffixes(kind)):
                known.setdefault(Path(found).stem, f"{below}/{Path(found).stem}")
    near = difflib.get_close_matches(Path(name).stem, known, n=1)
    if near:
        return f'did you mean "{known[near[0]]}"?'
    return did_you_mean(Path(name).stem, [known[stem] for stem in known])


def names(kind: str) -> list[str]:
    """All names of a kind over the search folders, sorted."""
    found: set[str] = set()
    for folder in search_folders():
        below = folder / kind
        if below.is_dir():
            found.update(entry.name for entry in below.iterdir() if not entry.name.startswith("."))
    return sorted(found)


USUAL = {
    "XDG_CONFIG_HOME": ".config",
    "XDG_CACHE_HOME": ".cache",
    "XDG_DATA_HOME": ".local/share",
    "XDG_STATE_HOME": ".local/state",
}
"""Folders of the XDG base directory specification, below the home folder where none is named."""


def settings_folder() -> Path:
    """Where the user's choices are kept."""
    return _base("XDG_CONFIG_HOME")


def cache_folder() -> Path:
    """Where what can be made again is kept."""
    return _base("XDG_CACHE_HOME")


def data_folder() -> Path:
    """Where what the user fetched is kept."""
    return _base("XDG_DATA_HOME")


def state_folder() -> Path:
    """Where what the robot remembers between runs is kept."""
    return _base("XDG_STATE_HOME")


def own_folders() -> tuple[Path, ...]:
    """All four."""
    return settings_folder(), cache_folder(), data_folder(), state_folder()


def _base(variable: str) -> Path:
    """Our folder of a kind; a relative one is ignored, as the XDG specification says.

    Raises HriError where there is no home folder either.
    """
    named = expanded(os.environ.get(variable, ""))
    return (named if named.is_absolute() else home() / USUAL[variable]) / "hri"


def settle() -> None:
    """Let libraries and child processes find home where we do: many take an empty one for here."""
    with suppress(HriError):
        os.environ["HOME"] = str(home())
    for variable in USUAL:
        if not expanded(os.environ.get(variable, "/")).is_absolute():
            del os.environ[variable]


def home() -> Path:
    """The user's home folder: $HOME if it is an absolute path, else the one that the system lists.

    Raises HriError when there is none.
    """
    with suppress(KeyError, RuntimeError):  # a user whom the system does not list
        for named in (os.environ.get("HOME", ""), _listed_home()):
            if Path(named).is_absolute():
                return Path(named)
    raise HriError("no home folder - set HOME to a folder of yours")


def _listed_home() -> str:
    try:
        import pwd
    except ImportError:  # Windows
        return str(Path.home())
    return pwd.getpwuid(os.getuid()).pw_dir


def expanded(path: Path | str) -> Path:
    """A path as the user wrote it, with the home folder instead of "~".

    Raises HriError for the home folder of an unknown user.
    """
    path = Path(path)
    if path.parts[:1] == ("~",):
        return home().joinpath(*path.parts[1:])
    try:
        return path.expanduser()
    except RuntimeError as error:
        raise HriError(f"{path}: there is no such user - check the path") from error
