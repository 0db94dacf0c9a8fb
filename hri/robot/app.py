"""An app is a folder: `app.toml` names its networks and its tasks, the rest is its own files.

`extends = "companion"` makes an app of another one: it has the networks, tasks and files of that
app, and its own beside them. An own network replaces one of the same file name, an own task one of
the same name.

    app.toml       the list of its parts
    tasks.py       its tasks
    grammar.jsgf   the grammar of its listeners, instead of the one that their network names
    replies.toml   its replies, where it extends the companion
    demo.toml      the visitors of `--demo`
    *.jsgf         other grammars, such as those of questions, which its tasks name
"""

from __future__ import annotations

import inspect
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property, partial
from pathlib import Path
from types import ModuleType
from typing import Self

from hri.behavior.network import Network
from hri.behavior.network_file import load_network
from hri.core import paths
from hri.core.errors import AuthoringError, HriError, Place, did_you_mean
from hri.core.python_file import load_module
from hri.core.toml import Table, load_toml
from hri.robot.event_tasks import start_on
from hri.speech.behaviors import Listener
from hri.speech.grammar import load_grammar
from hri.speech.listener import FOLDERS
from hri.task.context import TaskContext
from hri.task.task import TaskType, find_task
from hri.task.task_run import Job

GRAMMARS = tuple(f"grammar{suffix}" for suffix in paths.suffixes("grammars"))
"""Names that its grammar may have; the first that is there counts."""
REPLIES = "replies.toml"
"""What it replies, and the robot's name."""
NETWORK = ".xml"
SLOT = "app"
"""Slot of the board with the app that runs."""


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
    """Ports of the bridge that anyone may write to (`hri.behavior.doors`)."""
    events: tuple[str, ...] = ()
    """Names of events that may come from outside, beside those of 2003."""
    on: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """Names of tasks that an event starts, by its name, in which `*` stands for any characters."""
    silent_topics: tuple[str, ...] = ()
    """Topics of its grammar's rules, `@topic`, that it does not hear."""
    base: Self | None = None
    """The app that it extends; what that one has is in the fields above, too."""

    @property
    def name(self) -> str:
        """That of its folder, or of its network's file."""
        return self.folder.stem if self.is_network else self.folder.name

    @property
    def is_network(self) -> bool:
        """Whether it is a network alone; then `folder` is its file."""
        return self.folder.suffix == NETWORK

    @classmethod
    def of(cls, context: TaskContext) -> Self:
        """The app that runs. Raises HriError where none does."""
        app = context.board.slot(SLOT).value
        if not isinstance(app, cls):
            raise HriError("no app runs - start one with Robot(app=...)")
        return app

    def line(self) -> Iterator[App]:
        """The app, the one that it extends, and so on."""
        app: App | None = self
        while app is not None:
            yield app
            app = app.base

    def files(self, name: str) -> list[Path]:
        """The files of that name of all apps in its line, its own last."""
        found = [app.folder / name for app in self.line() if paths.is_file(app.folder / name)]
        return found[::-1]

    def grammar(self) -> Path | None:
        """Its own grammar, or that of the nearest app in its line that has one."""
        places = (app.folder / name for app in self.line() for name in GRAMMARS)
        return next(filter(paths.is_file, places), None)

    def robot_name(self) -> str:
        """What its replies call the robot; empty when none do, or when they cannot be read."""
        for path in reversed(self.files(REPLIES)):
            with suppress(HriError):
                if name := load_toml(path).string("name", ""):
                    return name
        return ""

    def load_networks(self) -> list[Network]:
        """The networks, checked and in dependency order."""
        networks = [load_network(path) for path in self.networks]
        grammar, name = self.grammar(), self.robot_name()
        for behavior in (one for network in networks for one in network.behaviors):
            if isinstance(behavior, Listener):
                behavior.set_parameter("robot_name", behavior.robot_name or name)
                behavior.set_parameter("silent_topics", " ".join(self.silent_topics))
                if grammar is not None:
                    behavior.set_parameter("grammar", str(grammar))
        self._refuse_unknown_topics(networks)
        return networks

    def _refuse_unknown_topics(self, networks: list[Network]) -> None:
        if not self.silent_topics:
            return
        behaviors = (one for network in networks for one in network.behaviors)
        names = [one.grammar for one in behaviors if isinstance(one, Listener)]
        known = {topic for name in names for topic in load_grammar(name).topics}
        for app in self.line():
            table = load_toml(app.folder / "app.toml")
            for topic in table.strings("silent_topics", []):
                if topic not in known:
                    what = f'no rule of the grammar has the topic "{topic}"'
                    raise table.error("silent_topics", what, did_you_mean(topic, known))

    def load_tasks(self) -> list[Job]:
        """What runs from the start: the tasks, and what starts others `[on]` events.

        Raises AuthoringError for a name that no `tasks.py` has, or a task that needs arguments.
        """
        starters = [
            partial(start_on, pattern, self._on_event(pattern, names))
            for pattern, names in self.on.items()
        ]
        return [*(self._without_arguments(name) for name in self.tasks), *starters]

    def task(self, name: str) -> Job:
        """A task by name: of its `tasks.py`, of those of the apps it extends, or "Hri.Speak".

        Raises HriError for one that is not there.
        """
        if "." in name:
            return find_task(name)
        modules = [app.module for app in self.line() if app.module is not None]
        # A task comes before what a module only imports.
        modules.sort(key=lambda module: name not in _tasks_of(module))
        for module in modules:
            if hasattr(module, name):
                job: Job = getattr(module, name)
                return job
        where = self.folder / "tasks.py"
        raise HriError(f'no task "{name}" in {where} - {did_you_mean(name, self.task_names())}')

    def task_type(self, name: str) -> TaskType:
        """The task as one that takes its arguments by name. Raises HriError as `task` does."""
        job = self.task(name)
        return job if isinstance(job, TaskType) else TaskType(name, job)

    def task_names(self) -> list[str]:
        """The tasks in its `tasks.py` and in those of the apps it extends, sorted."""
        modules = [app.module for app in self.line() if app.module is not None]
        return sorted({name for module in modules for name in _tasks_of(module)})

    def has_plain_function(self, name: str) -> bool:
        """Whether a `tasks.py` of its line has a function of that name that is not a task."""
        modules = [app.module for app in self.line() if app.module is not None]
        return any(
            inspect.isfunction(found := getattr(module, name, None))
            and not _is_task(found)
            and found.__module__ == module.__name__
            for module in modules
        )

    def _without_arguments(self, name: str) -> Job:
        try:
            job = self.task(name)
        except HriError as error:
            what, _, remedy = str(error).rpartition(" - ")
            raise AuthoringError(self._place_of_task(name), what, remedy) from error
        if isinstance(job, TaskType):
            try:
                job.bound()
            except HriError as error:
                what = str(error).partition(" - ")[0]
                remedy = "call it from a task of tasks.py"
                raise AuthoringError(self._place_of_task(name), what, remedy) from error
        return job

    def _on_event(self, pattern: str, names: tuple[str, ...]) -> tuple[TaskType, ...]:
        """What an event starts. Raises AuthoringError for a task that it may lack something for."""
        try:
            jobs = tuple(self.task_type(name) for name in names)
        except HriError as error:
            what, _, remedy = str(error).rpartition(" - ")
            raise AuthoringError(self._place_of_event(pattern), what, remedy) from error
        for job in jobs:
            for name, parameter in job.parameters.items():
                if parameter.default is inspect.Parameter.empty and name != "event":
                    what = f'[on] "{pattern}": {job.id} needs {name}, which an event may lack'
                    remedy = f"give {name} a default value"
                    raise AuthoringError(self._place_of_event(pattern), what, remedy)
        return jobs

    def _place_of_event(self, pattern: str) -> Place:
        """Where `[on]` of the app, or else of one that it extends, names an event."""
        tables = (load_toml(app.folder / "app.toml") for app in self.line())
        reactions = (table.table("on", optional=True) for table in tables)
        return next(on.place(pattern) for on in reactions if pattern in on)

    def _place_of_task(self, name: str) -> Place:
        """Where `tasks` of the app, or else of one that it extends, names a task."""
        tables = (load_toml(app.folder / "app.toml") for app in self.line())
        return next(table.place("tasks") for table in tables if name in table.strings("tasks", []))

    def check(self, context: TaskContext) -> None:
        """Let the apps read their own files, with `check(context)` of the tasks that have one."""
        now = context.clock.now()
        context.board.slot(SLOT).set(self, now)
        context.board.slot(FOLDERS).set(tuple(app.folder for app in self.line()), now)
        if self.tasks or self.on:
            for app in self.line():
                if app.module is not None and hasattr(app.module, "check"):
                    app.module.check(context)

    @cached_property
    def module(self) -> ModuleType | None:
        """`tasks.py`, in a separate package so that it can import its neighbors. None if an app
        that extends another does not have it.
        """
        if (self.base or self.is_network) and not paths.is_file(self.folder / "tasks.py"):
            return None
        package = f"hri_app_{self.folder.resolve().name}"
        beside = self.folder / "__init__.py"
        if self.base is None or paths.is_file(beside):
            load_module(package, beside, [str(self.folder)])
            return load_module(f"{package}.tasks", self.folder / "tasks.py", None)
        return load_module(f"{package}_tasks", self.folder / "tasks.py", None)


def _tasks_of(module: ModuleType) -> Iterator[str]:
    """Names of what can be meant by a task: not what the module only imports for itself."""
    offered = getattr(module, "__all__", ())
    for name, value in vars(module).items():
        is_own = getattr(value, "__module__", "") == module.__name__ and not name.startswith("_")
        if (is_own or name in offered) and _is_task(value):
            yield name


def _is_task(value: object) -> bool:
    return inspect.iscoroutinefunction(value) or isinstance(value, TaskType)


def load_app(name: str) -> App:
    """Read an app by name or path, and those it extends; the file of a network is an app of it.

    Raises HriError or AuthoringError.
    """
    if name.endswith(NETWORK):
        path = paths.find("config", name)
        return App(path, f"the network {path.name}", (path,), ())
    return _load(paths.find("apps", name), ())


def _load(folder: Path, above: tuple[str, ...]) -> App:
    file = folder / "app.toml"
    if folder.is_dir() and not paths.exists(file):
        raise HriError(f"{folder} has no app.toml, which makes a folder an app - add one")
    table = load_toml(file, "app")
    extends = table.string("extends", "")
    base = _base(table, folder, extends, (*above, folder.resolve().name)) if extends else None
    own = table.strings("networks", *([[]] if base else []))
    networks = _merged(base.networks if base else (), [_beside(table, one) for one in own])
    tasks = _added(base.tasks if base else (), table.strings("tasks", []))
    trusted = _added(base.trusted if base else (), table.strings("trusted", []))
    events = _added(base.events if base else (), table.strings("events", []))
    silent = _added(base.silent_topics if base else (), table.strings("silent_topics", []))
    about = table.string("about", "")
    on = {**(base.on if base else {}), **_reactions(table)}
    table.finish()
    return App(folder, about, networks, tasks, trusted, events, on, silent, base)


def _base(table: Table, folder: Path, extends: str, above: tuple[str, ...]) -> App:
    try:
        found = paths.find("apps", extends)
    except HriError as error:
        what, _, remedy = str(error).partition(" - ")
        raise table.error("extends", what, remedy) from error
    if found.resolve().name in above:
        what = f'"{extends}" has the name of an app that extends it'
        raise table.error("extends", what, f"give {folder.resolve()} another name")
    return _load(found, above)


def _reactions(table: Table) -> dict[str, tuple[str, ...]]:
    """`[on]`: a task, or a list of tasks, by the name of an event."""
    on = table.table("on", optional=True)
    found = {}
    for event in on.data:
        is_list = isinstance(on.data[event], list)
        found[event] = tuple(on.strings(event) if is_list else [on.string(event)])
    return found


def _merged(base: tuple[Path, ...], own: list[Path]) -> tuple[Path, ...]:
    names = {path.name for path in own}
    return (*(path for path in base if path.name not in names), *own)


def _added(base: tuple[str, ...], own: list[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys((*base, *own)))


def _beside(table: Table, name: str) -> Path:
    """A network of the app's folder, or one found by name. Raises AuthoringError."""
    folder = table.path.parent
    if paths.is_file(own := folder / name):
        return own
    try:
        return paths.find("config", name)
    except HriError as error:
        what, _, remedy = str(error).partition(" - ")
        files = sorted(path.name for path in folder.glob("*.xml"))
        raise table.error("networks", what, did_you_mean(name, files, remedy)) from error
