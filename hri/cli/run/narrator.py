"""Prints a line for each event: things heard, said, seen, and felt."""

from __future__ import annotations

import sys
from collections import Counter
from typing import TextIO

from hri.cli.terminal.streams import let_go
from hri.core.origin import KEYBOARD
from hri.core.quoting import message_line, report
from hri.core.signals import Event
from hri.face.behaviors import FaceRenderer
from hri.robot import Robot
from hri.speech.behaviors import Listener
from hri.task.context import TaskContext

LINES = {
    "speech.heard": "heard     {text}",
    "speech.rejected": "ignored   {text} ({why})",
    "speech.said": "said      {text}",
    "emotion.changed": "feels     {label}",
    "emotion.moved": "moves     out of {emotion}",
    "grammar.changed": "reloaded the grammar",
    "grammar.refused": "refused   {error}",
    "replies.changed": "reloaded replies.toml",
    "replies.refused": "refused   {error}",
    "emotions.reloaded": "reloaded the emotion files",
    "memory.begun": "saves its feelings from now on, in {file}",
    "memory.forgotten": "forgot, as requested",
    "head.nodded": "saw       a nod",
    "head.shaken": "saw       a shake of the head",
    "person.seen": "saw       a person",
    "person.lost": "lost      the person",
    "camera.switched": "camera    on: {on}",
    "camera.lost": "camera    lost",
    "camera.found": "camera    back",
    "vision.failed": "eyes      {reason}",
    "fleet.asked": "asked     {verb}",
    "fleet.silent": "lost      {robot} of the fleet: {slot} is empty",
    "mcp.called": "asked     {tool}",
    "mcp.refused": "refused   {tool}",
    "mcp.proposed": "drafted   {draft}",
    "drive.stopped": "stopped   ({reason})",
    "drive.refused": "refused   {words}",
    "drive.faulty": "faulty    {words}",
    "bumper.pressed": "bumped",
    "button.pressed": "pressed   {button}",
    "battery.lowered": "battery   low",
    "microphone.muted": "muted     {muted}",
}


HARMFUL = 0.05
"""Share of a network's ticks, once it is ready, that must have been missed to be told. With fewer,
every output is one interval late now and then, which is less than what devices and people vary by:
a face of 25 pictures a second drops one a second, and the base stops by its own watchdog.
"""


class Narrator:
    """Listens to a robot's events and prints them."""

    def __init__(self, robot: Robot, out: TextIO | None = None) -> None:
        self.robot = robot
        self.out = out or sys.stdout
        self._counts: Counter[str] = Counter()
        self._label = ""
        self._pose: tuple[float, float] | None = None
        self._first_frame: float | None = None
        self._at_start: dict[str, tuple[int, Counter[str]]] = {}
        """Of each network, the ticks and the missed ones by the time that it was ready."""
        self._is_unread = False
        behaviors = robot.context.behaviors.values()
        self._listener = next((b for b in behaviors if isinstance(b, Listener)), None)
        self._renderer = next((b for b in behaviors if isinstance(b, FaceRenderer)), None)
        robot.events.subscribe("*", self._hear)

    def tell(self, text: str) -> None:
        """Print a line; when the reader is gone (`... | head`), the robot ends."""
        if self._is_unread:
            return
        try:
            report(text, self.out, flush=True)
        except BrokenPipeError:
            self._is_unread = True
            let_go(self.out)  # Python's flush at exit must not complain either
            self.robot.finish(why="nobody reads its output")

    async def greet(self, context: TaskContext) -> None:
        """Once the face is visible, print how to talk to the robot and how to end it."""
        while self._renderer is not None and not self._renderer.frames:
            await context.clock.sleep(0.02)
        self._first_frame = context.clock.now()
        # While models load, ticks are missed that nobody waits for.
        for runner in self.robot.runners:
            statistics = runner.statistics
            self._at_start[runner.network.name] = statistics.ticks, statistics.causes.copy()
        is_new = not self._counts["speech.heard"] and self._takes_greetings()
        hint = "say hello, or ask what you can say - " if is_new else ""
        self.tell(f"ready: {hint}Ctrl-C ends it")

    def _takes_greetings(self) -> bool:
        """Whether its grammar has the sentences of the hint; another app's may not."""
        if self._listener is None:
            return False
        rules = {key.rpartition(".")[2] for key in self._listener.loaded_grammar.public_rules}
        return {"greet", "help"} <= rules

    def _hear(self, event: Event) -> None:
        self._counts[event.name] += 1
        if event.name == "odometry":
            self._pose = (event.properties["x_cm"] / 100, event.properties["y_cm"] / 100)
            return
        if event.name == "grammar.changed" and not event.properties["reloaded"]:
            return
        if event.name == "emotion.changed":
            if event.properties["label"] == self._label:
                return
            self._label = event.properties["label"]
        template = LINES.get(event.name)
        if template is None:
            return
        text = template.format_map(_Known(event.properties, why=_why(event), error=_error(event)))
        if event.origin not in ("", KEYBOARD):  # who types knows
            text = f"{text} ({event.origin})"
        # Unknown without odometry in a network.
        where = "" if self._pose is None else "x {:5.2f} m  y {:5.2f} m".format(*self._pose)
        line = f"{event.time:7.1f} s  {text:<58}  {self._label:<12} {where}".rstrip()
        self.tell(message_line(line))

    def summary(self) -> None:
        """Summary of the visit, and the place of its recording."""
        counts = self._counts
        seen = counts["head.nodded"] + counts["head.shaken"]
        self.tell("")
        self.tell(
            f"{self.robot.lived:.0f} s: heard {counts['speech.heard']},"
            f" said {counts['speech.said']}, head gestures {seen},"
            f" ignored {counts['speech.rejected']}"
        )
        if self._first_frame is not None:
            lived = self.robot.lived - self._first_frame
            frames = self._renderer.frames if self._renderer is not None else 0
            self.tell(f"{frames / max(lived, 0.1):.1f} frames a second")
        for runner in self.robot.runners:
            ticks, causes = self._at_start.get(runner.network.name, (0, Counter()))
            statistics = runner.statistics
            if line := late(
                runner.network.name, statistics.ticks - ticks, statistics.causes - causes
            ):
                self.tell(line)
        if self.robot.recording is not None:
            files = "events.jsonl, face.mp4, robot.wav, timeline.png, feelings.svg, recording.json"
            self.tell(f"recorded in {self.robot.recording.where}: {files}")


def _error(event: Event) -> str:
    """The first mistake that an event reports, and how many there are beside it."""
    first, *others = str(event.properties.get("error", "")).splitlines() or [""]
    return f"{first} (and {len(others)} more)" if others else first


def _why(event: Event) -> str:
    """The reason an event gives, with its detail where it has one."""
    reasons = (event.properties.get(name) for name in ("reason", "detail"))
    return ": ".join(str(reason) for reason in reasons if reason)


def late(network: str, ticks: int, causes: Counter[str]) -> str:
    """A line for a network that missed enough ticks to be noticed; "" for others.

    `causes` are the missed ones, by what was late (`Statistics.causes`).
    """
    missed = causes.total()
    if not missed or missed < HARMFUL * (ticks + missed):
        return ""
    what, count = causes.most_common(1)[0]
    told = f"{network} ran late: {missed} of {ticks + missed} ticks missed"
    if what:
        remedy = f"make {what} faster, or raise the invocation_interval of {network}"
        return f"{told}, {count} of them because of {what} - {remedy}"
    return f"{told}, most because this machine is busy - end other programs"


class _Known(dict[str, object]):
    def __missing__(self, key: str) -> str:
        return ""
