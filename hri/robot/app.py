"""An app is a folder: `app.toml` names its networks and its tasks, the rest is its own files."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from types import ModuleType
from typing import Any

from hri.behavior.network import Network, load_network
from hri.core import paths, registry
from hri.core.errors import AuthoringError, HriError, Place, did_you_mean
from hri.core.toml import load_toml
from hri.task.context import TaskContext

Task = Callable[..., Awaitable[Any]]


@dataclass(frozen=True)
class App:
    """What `app.toml` says."""

    folder: Path
    about: str
    networks: tuple[Path, ...]
    tasks: tuple[str, ...]
    """Coroutine functions in the app's `tasks.py`, or names of the group `hri.tasks`; all run
    beside each other."""

    def load_networks(self) -> list[Network]:
        """The networks, checked and in dependency order."""
        return [load_network(path) for path in self.networks]

    def load_tasks(self) -> list[Task]:
        """The coroutine functions. Raises HriError for a name that `tasks.py` does not have."""
        return [self._task(name) for name in self.tasks]

    def _task(self, name: str) -> Task:
        if "." in name:
            declared: Task = registry.find("hri.tasks", name)
            return declared
        if not hasattr(self.module, name):
            known = [known for known in vars(self.module) if not known.startswith("_")]
            where = self.folder / "tasks.py"
            raise HriError(f'{where}: no task "{name}" - {did_you_mean(name, known)}')
        own: Task = getattr(self.module, name)
        return own

    def check(self, context: TaskContext) -> None:
        """Let the app read its own files, with `check(context)` of its tasks if it has one."""
        if self.tasks and hasattr(self.module, "check"):
            self.module.check(context)

    @cached_property
    def module(self) -> ModuleType:
        """`tasks.py`, in a package of its own so that it can import its neighbors."""
        package = f"hri_app_{self.folder.name}"
        _load_module(package, self.folder / "__init__.py", [str(self.folder)])
        return _load_module(f"{package}.tasks", self.folder / "tasks.py", None)


def _load_module(name: str, path: Path, search: list[str] | None) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, path, submodule_search_locations=search)
    if spec is None or spec.loader is None or not path.is_file():
        raise HriError(f"{path}: cannot be imported - the app needs this file")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except SyntaxError as error:
        place = Place(path, error.lineno or 1, error.offset or 1)
        raise AuthoringError(place, error.msg, "mend the Python here") from error
    except ImportError as error:
        raise HriError(f"{path}: {error} - install it, or mend the import") from error
    return module


def load_app(name: str) -> App:
    """Read an app by name or path. Raises HriError or AuthoringError."""
    folder = paths.find("apps", name)
    table = load_toml(folder / "app.toml", "app")
    about = table.string("about", "")
    networks = tuple(_beside(folder, name) for name in table.strings("networks"))
    tasks = tuple(table.strings("tasks", []))
    table.finish()
    return App(folder, about, networks, tasks)


def _beside(folder: Path, name: str) -> Path:
    """A network of the app's folder, or one found by name."""
    own = folder / name
    return own if own.is_file() else paths.find("config", name)
