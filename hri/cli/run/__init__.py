"""`hri run APP`: opens the devices, runs the app, reports events, writes a recording."""

from __future__ import annotations

import argparse
import logging
import math
import sys
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from hri.cli.door_options import add_door_options, doors_of
from hri.cli.fleet_options import add_fleet_options, settings_of
from hri.cli.run.browser import forget_page
from hri.cli.run.changes import announce_changes
from hri.cli.run.narrator import Narrator
from hri.cli.run.repeating import repeated
from hri.cli.run.studio_options import add_studio_options, show_address, studio_of
from hri.cli.terminal.ending import Ending
from hri.cli.terminal.messages import LineFormatter, Within
from hri.cli.terminal.streams import unfailing_output
from hri.conversation.memory_keeper import PEOPLE_FILE
from hri.core.clock import FakeClock, RealClock
from hri.core.errors import HriError, NotAvailable
from hri.core.quoting import message_line
from hri.core.realtime import become_realtime
from hri.drive.behaviors import CommandGate
from hri.emotion.persistence import memory_file
from hri.emotion.personality import load_personality
from hri.face.model import load_face
from hri.hal.awaited import WAITING
from hri.hal.camera import Camera
from hri.hal.drivers.video_file import check_video
from hri.hal.drivers.wav_file import load_sound
from hri.hal.microphone import Microphone
from hri.hal.resource import Description, Resource
from hri.robot import Job, Robot
from hri.robot.app import load_app
from hri.robot.verbs import is_quiet
from hri.simulation.visit_script import Visit, load_visit
from hri.simulation.world import SimulatedWorld
from hri.speech.behaviors import Voice
from hri.speech.recognizers.typed import TypedRecognizer
from hri.task.context import TaskContext

if TYPE_CHECKING:
    from hri.net.zenoh.member import Member

SENSES = ("microphone", "camera", "screen", "speaker")
UNSEEN = "no screen: --studio shows the face in a browser, --record DIR keeps a film of the run"
CALM_SECONDS = 2.0
"""Seconds of calm before a run from files ends."""
LONGEST_TASK = 600.0
"""Seconds to wait for running tasks after the end of input."""
BEGIN_AGAIN = 5.0
"""Seconds until a service begins again for which something was missing."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("app", nargs="?", default="", help="name of an app in apps/, or a path")
    add_options(parser)


def add_options(parser: argparse.ArgumentParser) -> None:
    """The options of every app."""
    parser.set_defaults(command=sys.orig_argv)
    add = parser.add_argument
    add("--config", default="resource-config", metavar="FILE", help="the devices (%(default)s)")
    add("--audio", type=Path, metavar="FILE", help="hear this sound file instead of a microphone")
    add("--camera", metavar="FILE|none", help="see this video or image, or nothing")
    add(
        "--record",
        type=Path,
        metavar="DIR",
        help="write events, video, sound, plot in there",
    )
    about = "run again what was recorded there; with --fast it gives the same, byte for byte"
    add("--repeat", type=Path, metavar="DIR", help=about)
    add("--record-rejected", action="store_true", help="also write rejected words there")
    add("--keep", action="store_true", help="start from saved feelings, and save them")
    add("--headless", action="store_true", help="draw the face without a window")
    add("--duration", type=Within(float, 0.001), metavar="S", help="end after this many seconds")
    add("--seed", type=int, default=None, metavar="N", help="random seed")
    add("--realtime", action="store_true", help="run with real-time priority, where allowed")
    add("--fast", action="store_true", help="fake time, as fast as the machine can")
    add("--personality", default="neutral", metavar="NAME", help="from emotions/personalities")
    add("--face", default="robot", metavar="NAME", help="from faces/")
    add("--captions", action="store_true", help="show captions below the face")
    add(
        "--service",
        action="store_true",
        help="for systemd: wait for devices that are missing, and live until asked to end",
    )
    add("--demo", action="store_true", help="a simulated person visits for two minutes")
    add("--studio", action="store_true", help="serve a page on which to see and steer the robot")
    add_studio_options(parser)
    add("--fleet", metavar="NAME", help="join the fleet of robots under this name")
    add_fleet_options(parser)
    add_door_options(parser)


Beside = Callable[[Robot], Sequence[Job]]
"""Gives more jobs, of someone who is there instead of a visitor."""


def _nobody(robot: Robot) -> Sequence[Job]:
    return ()


def run(options: argparse.Namespace, beside: Beside = _nobody) -> int:
    """Check all files, then run until the end. Output that cannot be written does not stop the
    robot. `beside` gives jobs that run as well.
    """
    if not (options.app or options.repeat):
        raise HriError("no app - name one, such as companion")
    ending = Ending()
    with unfailing_output(), ending.kept_for_later():
        if options.repeat is None:
            if options.service:
                return _serve(options, ending)
            return _run(options, ending, beside=beside)
        with repeated(options, add_options, print) as recorded:
            return _run(recorded, ending)


def _serve(options: argparse.Namespace, ending: Ending) -> int:
    """Run, and begin again while something is missing without which nothing can run."""
    told: set[str] = set()

    def tell_once(line: str) -> None:
        if line not in told or not line.endswith(WAITING):
            told.add(line)
            print(line, flush=True)

    while not ending.is_asked:
        try:
            return _run(options, ending, tell_once)
        except NotAvailable as error:
            tell_once(f"{error}{WAITING}")
            ending.pause(BEGIN_AGAIN)
    return 0


def _run(
    options: argparse.Namespace,
    ending: Ending,
    notice: Callable[[str], object] = print,
    beside: Beside = _nobody,
) -> int:
    """Run the app, and those that the fleet asks for instead; after one that cannot run, the one
    before it again.
    """
    before = options.app
    while True:
        try:
            app = _live(options, ending, notice, beside)
        except HriError as error:
            if options.app == before:
                raise
            print(message_line(str(error)), file=sys.stderr)
            options.app = before
            continue
        if not app:
            return 0
        before, options.app = options.app, app


def _live(
    options: argparse.Namespace,
    ending: Ending,
    notice: Callable[[str], object],
    beside: Beside,
) -> str | None:
    """Let a robot run the app; the next one that it is to run."""
    # Missed ticks are summed up at the end; only failures are logged at once.
    handler = logging.StreamHandler()
    handler.setFormatter(LineFormatter("%(levelname)s - %(message)s"))
    handler.setLevel(logging.ERROR)  # the studio shows more
    logging.basicConfig(level=logging.ERROR, handlers=[handler])
    check_files(options)
    robot = Robot(
        options.app,
        options.config,
        clock=FakeClock() if options.fast else RealClock(),
        seed=options.seed or 0,
        devices=replaced_devices(options),
        parameters={
            "emotion": {
                "personality": options.personality,
                "memory": memory_of(options),
                "memory_after_yes": "" if is_to_repeat(options) else str(memory_file()),
            },
            "display": {"personality": options.personality},
            "face": {"face": options.face},
            "renderer": {"face": options.face, "captions": options.captions},
        },
        notice=notice,
        record=options.record,
        record_rejected=options.record_rejected,
        doors=doors_of(options),
    )
    robot.resources.is_to_repeat |= is_to_repeat(options)
    if hasattr(options, "memory"):  # a run that is repeated knows nobody
        robot.board.slot(PEOPLE_FILE).set("", robot.clock.now())
    robot.resources.waits_for_devices = options.service
    robot.command, robot.sources = options.command, inputs(options)
    tasks = robot.app.load_tasks()
    studio = studio_of(robot, options) if options.studio else None
    member = _member(robot, options)
    robot.next_app = "" if member is not None and options.record is None else None
    narrator = Narrator(robot)
    mention_kept(options, narrator)
    hosted = beside(robot)
    session = Session(robot, options, narrator, ending, has_visitors=not hosted)
    try:
        is_unseen = "screen" in open_senses(robot)
        if is_unseen and not (options.headless or options.fast or options.studio or options.record):
            narrator.tell(UNSEEN)
        if studio is not None:
            studio.start()
            show_address(studio, options, narrator.tell)
        more = (*(studio.jobs() if studio else ()), *hosted)
        more += (member.be_in_fleet,) if member is not None else ()
        robot.live_until_over(*tasks, *session.jobs(), *more)
    finally:
        if studio is not None:
            studio.close()
            forget_page(studio.port)
        robot.close()
    if robot.recording is not None:
        robot.recording.plot()
    narrator.summary()
    return robot.next_app


def _member(robot: Robot, options: argparse.Namespace) -> Member | None:
    """The robot's end of the fleet, where it joins one."""
    if not options.fleet:
        return None
    from hri.net.zenoh.member import Member

    return Member(robot, settings_of(options, options.fleet))


def open_senses(robot: Robot) -> set[str]:
    """Open the most important devices; the ids of those replaced by stand-ins."""
    if robot.app.is_network:  # it opens what it needs
        return set()
    present = [id for id in SENSES if id in robot.resources.descriptions]
    for id in present:
        robot.resources.obtain(id, Resource)
    return {id for id in present if robot.resources.stand_in_of(id) is not None}


def check_files(options: argparse.Namespace) -> None:
    """Refuse bad files and conflicting options before anything starts. Raises HriError."""
    if options.demo and options.keep:
        what = "--demo --keep: the visitor of a demo is simulated, and is not kept among people"
        raise HriError(f"{what} - leave out one of the two")
    if options.service and (options.demo or options.fast):
        with_it = "--demo" if options.demo else "--fast"
        what = f"--service {with_it}: a service meets real people in real time"
        raise HriError(f"{what} - leave out one of the two")
    if options.fleet and options.fast:
        raise HriError("--fleet --fast: a fleet lives in real time - leave out one of the two")
    load_app(options.app)
    if options.audio is not None:
        load_sound(options.audio)
    if options.camera not in (None, "none"):
        check_video(Path(options.camera))
    load_face(options.face)
    load_personality(options.personality)


def inputs(options: argparse.Namespace) -> list[Path]:
    """The files that are heard and seen."""
    named = (options.audio, options.camera if options.camera != "none" else None)
    return [Path(name) for name in named if name is not None]


def memory_of(options: argparse.Namespace) -> str:
    """The file of saved feelings, or those of the run that is repeated; None unless requested."""
    return getattr(options, "memory", str(memory_file())) if options.keep else ""


def mention_kept(options: argparse.Namespace, narrator: Narrator) -> None:
    """Report in one line that saved feelings exist which this run does not use."""
    path = memory_file()
    if path.exists() and not options.keep and not is_to_repeat(options):
        remedy = "--keep starts from them, `hri forget` erases them"
        narrator.tell(f"{path}: feelings of earlier runs are saved there - {remedy}")


def is_to_repeat(options: argparse.Namespace) -> bool:
    """Whether the run should be repeatable on any machine."""
    return bool(options.fast or options.demo or options.seed is not None)


def replaced_devices(options: argparse.Namespace) -> list[Description]:
    """The devices that the command line substitutes for configured ones."""
    devices = []
    if options.audio is not None:
        file = {"file": str(options.audio)}
        devices.append(Description("microphone", "Hri.WavMicrophone", file))
    if options.demo:
        devices.append(_on_world("microphone", "Hri.SimulatedMicrophone"))
        devices.append(_on_world("camera", "Hri.SimulatedCamera"))
    if options.camera == "none":
        devices.append(Description("camera", "Hri.BlankCamera"))
    elif options.camera is not None:
        file = {"file": options.camera}
        devices.append(Description("camera", "Hri.VideoFileCamera", file))
    if options.headless:
        devices.append(Description("screen", "Hri.OffscreenScreen"))
    return devices


def _on_world(id: str, type: str) -> Description:
    return Description(id, type, bus="world")


class Session:
    """One run of an app: its visitor, its narration, its end."""

    def __init__(
        self,
        robot: Robot,
        options: argparse.Namespace,
        narrator: Narrator,
        ending: Ending,
        has_visitors: bool = True,
    ) -> None:
        """`has_visitors`: where there is no microphone, a simulated person may visit."""
        self.robot = robot
        self._has_visitors = has_visitors
        self.ending = ending
        self.options = options
        self.narrator = narrator
        visits = robot.app.files("demo.toml")
        if options.demo and not visits:
            raise HriError(f"{robot.app.folder}: this app has no demo.toml - run it without --demo")
        # Read before anything starts: it is also played when there is no microphone.
        self._authored = load_visit(visits[-1]) if visits else None
        self.visit: Visit | None = None

    def jobs(self) -> list[Job]:
        """The tasks that run beside the app's own."""
        jobs: list[Job] = [self.prepare, self.end_when_over, self.watch_window, self.watch_signals]
        if self.options.realtime:
            jobs.append(self.run_ahead)
        if self.robot.clock.is_fake:
            return jobs
        saved = partial(
            announce_changes, self.robot.app, self.narrator.tell, bool(self.options.studio)
        )
        return [*jobs, self.narrator.greet, saved]

    async def run_ahead(self, context: TaskContext) -> None:
        """Ask for real-time priority; networks and devices have started by now."""
        if refusal := become_realtime():
            self.narrator.tell(refusal)

    async def prepare(self, context: TaskContext) -> None:
        """Let the visitor in, or keep the simulated room empty for real people."""
        if self.options.audio is not None or self.options.service:
            return
        resources = self.robot.resources
        is_deaf = self._has_visitors and resources.stand_in_of("microphone") is not None
        if self._authored is not None and (self.options.demo or is_deaf):
            world = resources.obtain("world", SimulatedWorld)
            if not world.people and not self.options.demo:
                self.narrator.tell("no microphone, and the simulated room is empty")
                return
            if is_deaf and not self.options.fast:
                self.narrator.tell("no microphone: a simulated person visits for two minutes")
            self.visit = self._authored
            self.visit.start(world, context.clock, context.events)
        elif resources.stand_in_of("camera") is not None:
            for person in resources.obtain("world", SimulatedWorld).people:
                person.starts_present = False

    async def end_when_over(self, context: TaskContext) -> None:
        """End after the duration, after the visit, or at the end of the input files; a service only
        after the duration. Then tasks started by commands or events, such as a timer, may finish.
        """
        clock = context.clock
        end, why = self._end_time()
        calm_since = spent_since = clock.now()
        while clock.now() < end:
            await clock.sleep(min(0.1, end - clock.now()))
            if self.options.service or not self._is_spent():
                calm_since = spent_since = clock.now()
                continue
            waits = bool(context.manager.installed) and clock.now() - spent_since < LONGEST_TASK
            if waits or not self._is_calm(context):
                calm_since = clock.now()
            elif clock.now() - calm_since >= CALM_SECONDS:
                why = "the input ended"
                break
        self.robot.finish(why=why)

    def _end_time(self) -> tuple[float, str]:
        """When it ends, in seconds of the clock, and why."""
        if self.options.duration is not None:
            return float(self.options.duration), "the duration was over"
        if self.visit is not None:
            return self.visit.duration, "the visit was over"
        return math.inf, ""

    def _is_spent(self) -> bool:
        """Whether the input is files or typed lines, and has ended."""
        spent = []
        typed = self.robot.resources.ids(TypedRecognizer)
        if typed:
            spent.append(self.robot.resources.obtain(typed[0], TypedRecognizer).has_ended)
        if self.options.audio is not None:
            spent.append(self.robot.resources.obtain("microphone", Microphone).has_ended)
        if self.options.camera not in (None, "none"):
            spent.append(self.robot.resources.obtain("camera", Camera).has_ended)
        return bool(spent) and all(spent)

    @staticmethod
    def _is_calm(context: TaskContext) -> bool:
        voice, gate = context.find_behavior(Voice), context.find_behavior(CommandGate)
        is_at_rest = (voice is None or voice.is_idle) and (gate is None or not gate.is_moving)
        return is_at_rest and is_quiet(context.behaviors)

    async def watch_window(self, context: TaskContext) -> None:
        """End when the window is closed."""
        await context.wait_for("window.closed")
        self.robot.finish(why="the window was closed")

    async def watch_signals(self, context: TaskContext) -> None:
        """End cleanly on Ctrl-C, or when the system or the terminal asks."""
        await self.ending.wait(partial(self.robot.finish, why="asked to end by a signal"))
