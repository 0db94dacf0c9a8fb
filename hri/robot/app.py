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
    skills/NAME/   its skills (`hri.robot.skills`)
"""

from __future__ import annotations

import inspect
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path
from types import MappingProxyType, ModuleType
from typing import Self

from hri.behavior.network import Network
from hri.behavior.network_file import load_network
from hri.core import paths
from hri.core.errors import AuthoringError, HriError, Place, did_you_mean
from hri.core.python_file import load_module
from hri.core.toml import Table, load_toml
from hri.robot.event_tasks import start_on
from hri.robot.skills import OffSkill, read_skills
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
APP, SKILL = "app.toml", "skill.toml"
"""What lists the parts of an app, and of a skill."""
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
    quiet_hours: tuple[int, int] | None = None
    """The hours of the day at which it begins and ends to say nothing by itself; None for the
    usual ones."""
    base: Self | None = None
    """The app that it extends; what that one has is in the fields above, too."""
    skills: tuple[Self, ...] = ()
    """Those that are plugged into it; their networks, ports and events are in the fields above."""
    off: tuple[OffSkill, ...] = ()
    """Skills of its line that are not plugged in."""
    is_skill: bool = False
    replaces: tuple[str, ...] = ()
    """Commands of small talk for which a skill has better ones."""

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

    @property
    def file(self) -> Path:
        """Where its parts are listed."""
        return self.folder / (SKILL if self.is_skill else APP)

    def line(self) -> Iterator[App]:
        """The app and its skills, the one that it extends and the skills of that, and so on."""
        app: App | None = self
        while app is not None:
            yield app
            yield from app.skills
            app = app.base

    def skill_at(self, path: Path) -> App | None:
        """The skill that a file is of."""
        place = path.resolve()
        inside = (one for one in self.all_skills() if place.is_relative_to(one.folder.resolve()))
        return next(inside, None)

    def all_skills(self) -> tuple[App, ...]:
        """Those of its line, in the order in which they are plugged in."""
        return tuple(app for app in self.line() if app.is_skill)

    def files(self, name: str) -> list[Path]:
        """The files of that name of all apps in its line, its own last."""
        found = [app.folder / name for app in self.line() if paths.is_file(app.folder / name)]
        return found[::-1]

    def grammar(self) -> Path | None:
        """Its own grammar, or that of the nearest app in its line that has one."""
        own = (app for app in self.line() if not app.is_skill)
        return next(filter(None, map(_grammar_of, own)), None)

    def grammars_of_skills(self) -> list[Path]:
        """What its skills understand."""
        return list(filter(None, map(_grammar_of, self.all_skills())))

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
                behavior.set_parameter("skills", "\n".join(map(str, self.grammars_of_skills())))
                behavior.set_parameter("silent_rules", " ".join(sorted(self.replaced_rules)))
        self._refuse_unknown_topics(networks)
        self._refuse_to_replace_commands(networks)
        return networks

    @property
    def replaced_rules(self) -> frozenset[str]:
        """What its skills have better commands for."""
        return frozenset(rule for skill in self.all_skills() for rule in skill.replaces)

    def _refuse_to_replace_commands(self, networks: list[Network]) -> None:
        """No skill takes "stop" away: only what is about a topic of small talk may be replaced."""
        listeners = [
            one for part in networks for one in part.behaviors if isinstance(one, Listener)
        ]
        if not self.replaced_rules or not listeners:
            return
        grammar = load_grammar(listeners[0].grammar)
        for skill in self.all_skills():
            for rule in skill.replaces:
                if rule in grammar.public_rules and not grammar.rules[rule].topics:
                    what = f"<{rule}> is a command, not small talk"
                    raise load_toml(skill.file).error("replaces", what, "name one with @topic")

    def _refuse_unknown_topics(self, networks: list[Network]) -> None:
        if not self.silent_topics:
            return
        behaviors = (one for network in networks for one in network.behaviors)
        names = [one.grammar for one in behaviors if isinstance(one, Listener)]
        known = {topic for name in names for topic in load_grammar(name).topics}
        for app in self.line():
            table = load_toml(app.file)
            for topic in table.strings("silent_topics", []):
                if topic not in known:
                    what = f'no rule of the grammar has the topic "{topic}"'
                    raise table.error("silent_topics", what, did_you_mean(topic, known))

    def load_tasks(self) -> list[Job]:
        """What runs from the start: the tasks, and what starts others `[on]` events.

        Raises AuthoringError for a name that no `tasks.py` has, or a task that needs arguments.
        """
        return [job for part in (self, *self.all_skills()) for job in self._jobs_of(part)]

    def _jobs_of(self, part: App) -> Iterator[Job]:
        """What the app, or one of its skills, lists."""
        for name in part.tasks:
            yield self._without_arguments(name, part)
        for pattern, names in part.on.items():
            yield partial(start_on, pattern, self._on_event(pattern, names, part))

    def task(self, name: str, part: App | None = None) -> Job:
        """A task by name: of its `tasks.py`, of those of the apps it extends, or "Hri.Speak".

        For a skill, its `part`, a task of that one comes first. Raises HriError for one that is not
        there.
        """
        if "." in name:
            return find_task(name)
        modules = self._modules(part)
        # A task comes before what a module only imports.
        modules.sort(key=lambda module: name not in _tasks_of(module))
        for module in modules:
            if hasattr(module, name):
                job: Job = getattr(module, name)
                return job
        where = (part or self).folder / "tasks.py"
        raise HriError(f'no task "{name}" in {where} - {did_you_mean(name, self.task_names(part))}')

    def _modules(self, part: App | None) -> list[ModuleType]:
        """Every `tasks.py` that a part may name tasks of: its own first, and of no other skill."""
        own = [] if part is None else [part]
        others = [app for app in self.line() if app not in own and not app.is_skill]
        return [app.module for app in (*own, *others) if app.module is not None]

    def task_type(self, name: str, part: App | None = None) -> TaskType:
        """The task as one that takes its arguments by name. Raises HriError as `task` does."""
        job = self.task(name, part)
        return job if isinstance(job, TaskType) else TaskType(name, job)

    def task_names(self, part: App | None = None) -> list[str]:
        """The tasks in its `tasks.py` and in those of the apps it extends, sorted."""
        return sorted({name for module in self._modules(part) for name in _tasks_of(module)})

    def has_plain_function(self, name: str, part: App | None = None) -> bool:
        """Whether a `tasks.py` of its line has a function of that name that is not a task."""
        return any(
            inspect.isfunction(found := getattr(module, name, None))
            and not _is_task(found)
            and found.__module__ == module.__name__
            for module in self._modules(part)
        )

    def _without_arguments(self, name: str, part: App) -> Job:
        try:
            job = self.task(name, part)
        except HriError as error:
            what, _, remedy = str(error).rpartition(" - ")
            raise AuthoringError(self._place_of_task(name, part), what, remedy) from error
        try:
            self.task_type(name, part).bound()
        except HriError as error:
            what = str(error).partition(" - ")[0]
            remedy = "call it from a task of tasks.py"
            raise AuthoringError(self._place_of_task(name, part), what, remedy) from error
        return job

    def _on_event(self, pattern: str, names: tuple[str, ...], part: App) -> tuple[TaskType, ...]:
        """What an event starts. Raises AuthoringError for a task that it may lack something for."""
        try:
            jobs = tuple(self.task_type(name, part) for name in names)
        except HriError as error:
            what, _, remedy = str(error).rpartition(" - ")
            raise AuthoringError(self._place_of_event(pattern, part), what, remedy) from error
        for job in jobs:
            for name, parameter in job.parameters.items():
                if parameter.default is inspect.Parameter.empty and name != "event":
                    what = f'[on] "{pattern}": {job.id} needs {name}, which an event may lack'
                    remedy = f"give {name} a default value"
                    raise AuthoringError(self._place_of_event(pattern, part), what, remedy)
        return jobs

    @staticmethod
    def _place_of_event(pattern: str, part: App) -> Place:
        """Where `[on]` of a part, or else of an app that it extends, names an event."""
        tables = (load_toml(app.file) for app in part.line() if app is part or not app.is_skill)
        reactions = (table.table("on", optional=True) for table in tables)
        return next(on.place(pattern) for on in reactions if pattern in on)

    @staticmethod
    def _place_of_task(name: str, part: App) -> Place:
        """Where `tasks` of a part, or else of an app that it extends, names a task."""
        tables = (load_toml(app.file) for app in part.line() if app is part or not app.is_skill)
        return next(table.place("tasks") for table in tables if name in table.strings("tasks", []))

    def check(self, context: TaskContext) -> None:
        """Let the apps read their own files, with `check(context)` of the tasks that have one."""
        now = context.clock.now()
        context.board.slot(SLOT).set(self, now)
        context.board.slot(FOLDERS).set(tuple(app.folder for app in self.line()), now)
        if self.tasks or self.on or self.skills:
            for app in self.line():
                if app.module is not None and hasattr(app.module, "check"):
                    app.module.check(context)

    @cached_property
    def module(self) -> ModuleType | None:
        """`tasks.py`, in a separate package so that it can import its neighbors. None if a skill,
        or an app that extends another, does not have it.
        """
        may_lack = self.base or self.is_network or self.is_skill
        if may_lack and not paths.is_file(self.folder / "tasks.py"):
            return None
        package = f"hri_{'skill' if self.is_skill else 'app'}_{self.folder.resolve().name}"
        beside = self.folder / "__init__.py"
        if not may_lack or paths.is_file(beside):
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


def load_app(name: str, off: Mapping[str, str] = MappingProxyType({})) -> App:
    """Read an app by name or path, and those it extends; the file of a network is an app of it.

    Skills that are `off`, by name and why, are not plugged in, nor those that cannot be read.
    Raises HriError or AuthoringError.
    """
    if name.endswith(NETWORK):
        path = paths.find("config", name)
        return App(path, f"the network {path.name}", (path,), ())
    return _load(paths.find("apps", name), (), off)


def _load(folder: Path, above: tuple[str, ...], off: Mapping[str, str]) -> App:
    file = folder / APP
    if folder.is_dir() and not paths.exists(file):
        raise HriError(f"{folder} has no app.toml, which makes a folder an app - add one")
    table = load_toml(file, "app")
    extends = table.string("extends", "")
    base = _base(table, folder, extends, (*above, folder.resolve().name), off) if extends else None
    own = table.strings("networks", *([[]] if base else []))
    app = _parts(table, folder, base, own)
    app = replace(app, quiet_hours=_quiet_hours(table, app.quiet_hours))
    skills = read_skills(table, folder, off, partial(_skill, app))
    table.finish()
    found = _with_skills(app, skills.on)
    return replace(found, off=(*(base.off if base else ()), *skills.off))


def _parts(table: Table, folder: Path, base: App | None, networks: list[str]) -> App:
    """An app or a skill with the things that its lists name, and with those of its base."""
    below = base or App(folder, "", (), ())
    return App(
        folder,
        table.string("about", ""),
        _merged(below.networks, [_beside(table, one) for one in networks]),
        _added(below.tasks, table.strings("tasks", [])),
        _added(below.trusted, table.strings("trusted", [])),
        _added(below.events, table.strings("events", [])),
        {**below.on, **_reactions(table)},
        _added(below.silent_topics, table.strings("silent_topics", [])),
        below.quiet_hours,
        base,
    )


def _skill(app: App, folder: Path) -> App:
    """Read a skill. Raises HriError or AuthoringError."""
    table = load_toml(folder / SKILL, "skill")
    parts = _parts(table, folder, None, table.strings("networks", []))
    skill = replace(parts, is_skill=True, replaces=tuple(table.strings("replaces", [])))
    table.finish()
    _ = skill.module  # Python that fails must not wait for its first use.
    if skill.name in [one.name for one in app.line()]:
        raise HriError(f'{folder}: "{skill.name}" is the name of an app - rename the folder')
    return skill


def _with_skills(app: App, skills: Sequence[App]) -> App:
    """An app with the networks of its skills, and with what they let in from outside."""
    together = app
    for skill in skills:
        together = replace(
            together,
            networks=_merged(together.networks, skill.networks),
            trusted=_added(together.trusted, skill.trusted),
            events=_added(together.events, skill.events),
        )
    return replace(together, skills=tuple(skills))


def _base(
    table: Table, folder: Path, extends: str, above: tuple[str, ...], off: Mapping[str, str]
) -> App:
    try:
        found = paths.find("apps", extends)
    except HriError as error:
        what, _, remedy = str(error).partition(" - ")
        raise table.error("extends", what, remedy) from error
    if found.resolve().name in above:
        what = f'"{extends}" has the name of an app that extends it'
        raise table.error("extends", what, f"give {folder.resolve()} another name")
    return _load(found, above, off)


def _reactions(table: Table) -> dict[str, tuple[str, ...]]:
    """`[on]`: a task, or a list of tasks, by the name of an event."""
    on = table.table("on", optional=True)
    found = {}
    for event in on.data:
        is_list = isinstance(on.data[event], list)
        found[event] = tuple(on.strings(event) if is_list else [on.string(event)])
    return found


def _quiet_hours(table: Table, usual: tuple[int, int] | None) -> tuple[int, int] | None:
    """`[hours] quiet = [22, 6]`: two hours of the day, which are the same for none."""
    if "hours" not in table:
        return usual
    hours = table.table("hours")
    found = hours.numbers("quiet", count=2)
    hours.finish()
    if not all(hour in range(24) for hour in found):
        remedy = "write when they begin and end, such as [22, 6], or [0, 0] for none"
        raise hours.error("quiet", "quiet is not two hours from 0 to 23", remedy)
    begins, ends = map(int, found)
    return begins, ends


def _grammar_of(app: App) -> Path | None:
    """The grammar in the folder of an app or of a skill."""
    return next(filter(paths.is_file, (app.folder / name for name in GRAMMARS)), None)


def _merged(base: tuple[Path, ...], own: Sequence[Path]) -> tuple[Path, ...]:
    names = {path.name for path in own}
    return (*(path for path in base if path.name not in names), *own)


def _added(base: tuple[str, ...], own: Sequence[str]) -> tuple[str, ...]:
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
