"""The robot: opens resources, builds networks, runs them with tasks, and closes it all again.

with Robot() as robot:
    robot.say("Hello.")
    if robot.ask("Shall I come closer?"):
        robot.move(0.5)
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from contextlib import ExitStack, suppress
from dataclasses import replace
from functools import cached_property, partial
from pathlib import Path
from typing import Any, Self

import trio

from hri import __version__
from hri.behavior.behavior import Behavior, Context, bridge_ports
from hri.behavior.doors import Doors
from hri.behavior.network import Network
from hri.behavior.network_check import check_together
from hri.behavior.runner import Runner
from hri.core import paths
from hri.core.clock import Clock, RealClock
from hri.core.errors import AuthoringError, HriError, first_of
from hri.core.event_bus import EventBus
from hri.core.latest import Board
from hri.core.quoting import report
from hri.core.registry import canonical
from hri.core.signals import Event
from hri.core.systems import require_posix
from hri.drive.behaviors import CommandGate
from hri.emotion.behaviors import EmotionModel
from hri.hal.choices import apply_choices, load_choices
from hri.hal.configuration import Configuration, load_configuration
from hri.hal.emergency_stop import EmergencyStop
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.robot.app import GRAMMARS, App, load_app
from hri.robot.blocking_verbs import BlockingVerbs
from hri.robot.failures import FailureTeller
from hri.robot.finding import find_object
from hri.robot.provenance import RunRecord, Setup
from hri.robot.recording import Recording
from hri.robot.skills import turned_off, why_off
from hri.robot.sources import authored
from hri.simulation.visitor import Visitor
from hri.simulation.world import SimulatedWorld
from hri.task import script
from hri.task.task_manager import TaskManager
from hri.task.task_run import Job, name_of, tell_failure
from hri.task.thread import LoopThread

__all__ = ["GRAMMARS", "App", "Job", "Robot", "find_object", "load_app"]


class Robot(BlockingVerbs):
    """Resources, networks, tasks and the loop that runs them.

    As a context manager it runs in a separate thread, and its verbs block until they are done. On a
    fake clock, time passes only inside the verbs.
    """

    def __init__(
        self,
        app: str = "companion",
        config: str = "resource-config",
        *,
        clock: Clock | None = None,
        seed: int = 0,
        devices: Sequence[Description] = (),
        parameters: dict[str, dict[str, Any]] | None = None,
        notice: Callable[[str], object] = report,
        record: Path | str | None = None,
        record_rejected: bool = False,
        doors: Doors | None = None,
    ) -> None:
        """Read and check all files; nothing is opened yet.

        `devices` replace those of the configuration with the same id. `parameters` overrides
        parameters of behaviors by their id. `notice` gets a line for each stand-in, for each
        trusted name that fits no port, and one when a recording begins. `record` is a folder for a
        recording; where it holds one, another folder beside it is taken. Words that were rejected
        are written there only with `record_rejected`. `doors` admits more from the
        network than the app and the configuration do.
        Raises HriError or AuthoringError; NotAvailable on Windows.
        """
        require_posix("a robot")
        self.clock = clock or RealClock()
        off = turned_off()
        self.app = load_app(app, off)
        self._config = paths.find("config", config)
        asked = load_configuration(self._config)
        # Also what the command line replaces is checked: a mistake must not wait for its day.
        ResourceManager(asked.devices, self.clock).check()
        if not self.clock.is_fake:  # runs that repeat know nothing of this user's devices
            present = apply_choices(asked.devices, load_choices())
            asked = replace(asked, devices=present)
        configuration = _with_devices(asked, devices)
        self.configuration = _with_seed(configuration, seed)
        self.resources = ResourceManager(
            self.configuration.devices,
            self.clock,
            notice,
            self.configuration.shapes,
            self.configuration.trusted,
        )
        self.resources.is_to_repeat |= seed != 0
        self.resources.check()
        while (error := self._assemble(parameters or {}, doors or Doors(), seed)) is not None:
            skill = self.app.skill_at(error.place.path)
            if skill is None:
                raise error
            off[skill.name] = why_off(error)
            self.app = load_app(app, off)
        for one in self.app.off:
            if one.is_broken:
                notice(f"the skill {one.name} is off: {one.why}")
        behaviors = _behaviors_of(self._authored)
        for line in self._doors.unknown(bridge_ports(behaviors.values())):
            notice(line)
        if record == "":
            raise HriError("an empty name of a folder for the recording - name one, or write None")
        self.record = None if record is None else Path(record)
        """Folder for a recording; may be set until the robot lives."""
        self.command: Sequence[str] = sys.orig_argv
        """The command line that a recording names; may be set until the robot lives."""
        self.sources: Sequence[Path] = ()
        """Files of input, such as sounds, whose contents a recording identifies; likewise."""
        self._record_rejected = record_rejected
        self._seed = seed
        self._notice = notice
        self.recording: Recording | None = None
        self.next_app: str | None = None
        """The app that runs after this one, empty for none; None where nobody would start it."""
        self.runners: list[Runner] = []
        """The app's networks as they run, or ran."""
        self.lived = 0.0
        """Seconds of the clock at which the robot ended."""
        self._finished = trio.Event()
        self._why = "closed"
        """Why it ended, or will if no one says why."""
        self._ready: Callable[[], None] = lambda: None

    def _assemble(
        self, parameters: dict[str, dict[str, Any]], doors: Doors, seed: int
    ) -> AuthoringError | None:
        """Make networks and tasks of the app, and check all; the mistake, which a skill may have.

        Raises HriError for one that has no place.
        """
        try:
            self._authored = self.app.load_networks()
            _override(self._authored, parameters)
            check_together(self._authored)
            for network in self._authored:
                network.check()
            self.events = EventBus(self.clock)
            self.board = Board()
            self._doors = doors.with_more(self.app.trusted, self.app.events)
            lent = (self.clock, self.events, self.resources, self.board, seed, self._doors)
            self.tasks = TaskManager(Context(*lent), _behaviors_of(self._authored))
            self.networks = self.tasks.networks
            self.context = self.tasks.context
            self.app.check(self.context)
            if self.app.all_skills():
                self.app.load_tasks()
        except AuthoringError as error:
            return error
        return None

    # --- the loop ---

    async def live(self, *jobs: Job) -> None:
        """Run networks and jobs (coroutine functions that take a TaskContext) until `finish()`.

        The order of starting: resources for a recording, behaviors, networks, jobs; each one
        settles before the next begins. All is closed again in reverse order, come what may.
        """
        try:
            if self.record is not None:
                self.recording = self._begun(self.record)
            self.runners = [self.networks.start(network) for network in self._authored]
            self.events.subscribe("speech.heard", self._obey_stop)
            teller = FailureTeller(self.context)
            async with trio.open_nursery() as nursery:
                self.tasks.live_in(nursery)
                nursery.start_soon(self.clock.drive)
                self.clock.soon(partial(nursery.start_soon, self.networks.run))
                if self.recording is not None:
                    # Announced last: whoever reads it can end this run like any other.
                    jobs = (self.recording.watch, *jobs, self.recording.announce)
                for job in jobs:
                    self.clock.soon(partial(nursery.start_soon, self._run, job, teller))
                self._ready()
                await self._finished.wait()
                self.lived = self.clock.now()
                if self.recording is not None:
                    self.recording.stop(self._why)
                nursery.cancel_scope.cancel()
        except BaseException as error:
            self._why = f"failed: {_cause(error)}"
            raise
        finally:
            self.close()

    async def _run(self, job: Job, teller: FailureTeller) -> None:
        """Run what the robot lives for; that it failed is said before the robot ends of it."""
        try:
            await self.tasks.run(job)
        except Exception as error:
            if isinstance(error, HriError):  # which whoever started the robot reads
                teller.tell(name_of(job))
            else:
                tell_failure(self.events, job, error)
            await teller.finish()
            raise

    def _begun(self, folder: Path) -> Recording:
        """The recording of this robot, begun. Raises HriError where it cannot be written."""
        emotion = next(
            (b for b in self.context.behaviors.values() if isinstance(b, EmotionModel)), None
        )
        setup = Setup(
            __version__,
            self._seed,
            self.app.name,
            None if emotion is None else str(emotion.personality),
            self._config.stem,
        )
        own = [file for app in self.app.line() for file in authored(app.folder)]
        sources = (*own, *self.app.networks, self._config, *self.sources)
        feelings = None if emotion is None or not emotion.memory else paths.expanded(emotion.memory)
        record = RunRecord(setup, self.clock, self.command, sources, feelings)
        return Recording(
            folder,
            setup,
            record,
            self.events,
            self.resources,
            self._notice,
            with_rejected=self._record_rejected,
        )

    def live_until_over(self, *jobs: Job) -> None:
        """`live` for code that is not async; an error of ours comes out alone, in no group."""
        try:
            with script.robot_lives():
                trio.run(partial(self.live, *jobs))
        except BaseExceptionGroup as group:
            ours = group.subgroup(HriError)
            if ours is None:
                raise
            raise first_of(ours) from group

    def _obey_stop(self, event: Event) -> None:
        """Whatever tasks run, or none: "stop" stops the base, and ends what would drive on."""
        if event.properties.get("rule") == "stop":
            self.tasks.take_away("drive")
            for behavior in self.context.behaviors.values():
                if isinstance(behavior, CommandGate):
                    behavior.halt()

    def stop_until_released(self, because: str) -> None:
        """Stop the base at once, latched, and what drives it; `because` is the reason given."""
        try:
            self.tasks.take_away("drive")
            self.events.raise_event("drive.halt", because=because)
        finally:  # whoever follows the event may fail, the base must not
            for base in self.resources.opened(EmergencyStop):
                base.stop_latched(because)

    def release(self) -> None:
        """Let the base move again."""
        for base in self.resources.opened(EmergencyStop):
            base.unlatch()

    def finish(self, *, why: str = "finished") -> None:
        """End `live`; a second call does nothing. `why` is for the record of a recording."""
        if not self._finished.is_set():
            self._why = why
        self._finished.set()

    def close(self) -> None:
        """Stop behaviors and close resources; a second call does nothing."""
        with ExitStack() as stack:  # the next one is closed also when one raises
            stack.callback(self.resources.close)
            if self.recording is not None:
                stack.callback(self.recording.stop, self._why)
            stack.callback(self.networks.close)

    # --- blocking use ---

    def __enter__(self) -> Self:
        """Start to live. Raises RuntimeError when this or another robot does already, or has."""
        if self._finished.is_set():
            raise RuntimeError("this robot has lived - make a new one")
        script.enter(self.tasks)
        script.print_what_nobody_hears(self.context)
        try:
            self.tasks.thread = LoopThread(self.clock, "robot", self._live_in_thread)
            self.tasks.thread.start()
        except BaseException:
            script.leave(self.tasks)
            raise
        return self

    def _live_in_thread(self, ready: Callable[[], None]) -> None:
        self._ready = ready
        self.live_until_over()

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        thread = self.tasks.thread
        assert thread is not None
        script.leave(self.tasks)
        why = "the script ended" if kind is None else f"the script failed: {kind.__name__}"
        with suppress(RuntimeError):  # it may have ended by itself
            thread.call(partial(self.finish, why=why))
        thread.join()
        self.tasks.thread = None
        if self.recording is not None:
            self.recording.plot()
        if kind is None and thread.failure is not None:
            raise thread.failure

    @cached_property
    def visitor(self) -> Visitor:
        """The simulated person, who does what you ask of them.

        Raises HriError where no world is simulated.
        """
        ids = self.resources.ids(SimulatedWorld)
        if not ids:
            raise HriError('nobody is simulated here - use Robot(config="simulated")')
        return Visitor(self.resources.obtain(ids[0], SimulatedWorld), self.clock)

    def run(self, job: Job, *arguments: Any) -> Any:
        """Run a coroutine function with the robot's TaskContext and wait for what it returns."""
        if self.tasks.thread is None:
            raise RuntimeError("the robot is not running - use it as `with Robot() as robot:`")
        return self.tasks.run(job, *arguments)


def _cause(error: BaseException) -> str:
    """The first exception of a group, in words."""
    while isinstance(error, BaseExceptionGroup):
        error = error.exceptions[0]
    return f"{type(error).__name__}: {error}" if str(error) else type(error).__name__


def _with_devices(configuration: Configuration, devices: Sequence[Description]) -> Configuration:
    chosen = {device.id: device for device in devices}
    kept = [chosen.pop(device.id, device) for device in configuration.devices]
    return replace(configuration, devices=(*kept, *chosen.values()))


def _with_seed(configuration: Configuration, seed: int) -> Configuration:
    """Give simulated worlds the seed, unless the file says one."""
    devices = tuple(
        replace(device, parameters={"seed": str(seed), **device.parameters})
        if canonical(device.type) == "Hri.SimulatedWorld"
        else device
        for device in configuration.devices
    )
    return replace(configuration, devices=devices)


def _override(networks: list[Network], parameters: dict[str, dict[str, Any]]) -> None:
    """Set parameters of behaviors by id, in whatever network they are. Raises HriError."""
    for network in networks:
        for behavior in network.behaviors:
            for name, value in parameters.get(behavior.id, {}).items():
                behavior.set_parameter(name, value)


def _behaviors_of(networks: list[Network]) -> dict[str, Behavior]:
    """By `network.id`."""
    return {f"{n.name}.{behavior.id}": behavior for n in networks for behavior in n.behaviors}
