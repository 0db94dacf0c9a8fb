"""An app is a folder: `app.toml` names its networks and its tasks, the rest is its own files."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from types import ModuleType

from hri.behavior.network import Network, load_network
from hri.core import paths
from hri.core.errors import HriError, did_you_mean
from hri.core.python_file import load_module
from hri.core.toml import load_toml
from hri.task.context import TaskContext
from hri.task.task import Job, find_task


@dataclass(frozen=True)
class App:
    """What `app.toml` says."""

    folder: Path
    about: str
    networks: tuple[Path, ...]
    tasks: tuple[str, ...]
    """Coroutine functions in the app's `tasks.py`, or names of the group `hri.tasks`; all run
    beside each other."""
    trusted: tuple[str, ...] = ()
    """Ports of the bridge that anybody may write to (`hri.behavior.doors`)."""
    events: tuple[str, ...] = ()
    """Names of events that may come from outside, beside those of 2003."""

    def load_networks(self) -> list[Network]:
        """The networks, checked and in dependency order."""
        return [load_network(path) for path in self.networks]

    def load_tasks(self) -> list[Job]:
        """The coroutine functions. Raises HriError for a name that `tasks.py` does not have."""
        return [self._task(name) for name in self.tasks]

    def _task(self, name: str) -> Job:
        if "." in name:
            declared = find_task(name)
            try:
                declared.bound()
            except HriError as error:
                what = str(error).partition(" - ")[0]
                remedy = "call it from a task of tasks.py"
                raise HriError(f"{self.folder / 'app.toml'}: {what} - {remedy}") from error
            return declared
        if not hasattr(self.module, name):
            known = [known for known in vars(self.module) if not known.startswith("_")]
            where = self.folder / "tasks.py"
            raise HriError(f'{where}: no task "{name}" - {did_you_mean(name, known)}')
        own: Job = getattr(self.module, name)
        return own

    def check(self, context: TaskContext) -> None:
        """Let the app read its own files, with `check(context)` of its tasks if it has one."""
        if self.tasks and hasattr(self.module, "check"):
            self.module.check(context)

    @cached_property
    def module(self) -> ModuleType:
        """`tasks.py`, in a package of its own so that it can import its neighbors."""
        package = f"hri_app_{self.folder.name}"
        load_module(package, self.folder / "__init__.py", [str(self.folder)])
        return load_module(f"{package}.tasks", self.folder / "tasks.py", None)


def load_app(name: str) -> App:
    """Read an app by name or path. Raises HriError or AuthoringError."""
    folder = paths.find("apps", name)
    table = load_toml(folder / "app.toml", "app")
    about = table.string("about", "")
    networks = tuple(_beside(folder, name) for name in table.strings("networks"))
    tasks = tuple(table.strings("tasks", []))
    trusted = tuple(table.strings("trusted", []))
    events = tuple(table.strings("events", []))
    table.finish()
    return App(folder, about, networks, tasks, trusted, events)


def _beside(folder: Path, name: str) -> Path:
    """A network of the app's folder, or one found by name."""
    own = folder / name
    return own if paths.is_file(own) else paths.find("config", name)
