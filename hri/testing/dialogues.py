"""Dialogues that a page shows, played to a robot that hears what is typed.

    ```dialogue
    you: roll two dice
    robot: I rolled * and *.
    wait: 3 minutes
    robot: Your tea is ready.
    ```

A `*` stands for any words. What the robot says by itself during a wait does not count.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Literal

from hri.core.errors import AuthoringError, Place
from hri.core.reading import read_text
from hri.hal.resource import Description
from hri.robot import Robot
from hri.speech.recognizers.typed import TypedRecognizer
from hri.task.context import TaskContext
from hri.task.queue import EventQueue

TYPED = (
    Description("screen", "Hri.BlankScreen"),
    Description("recognizer", "Hri.Typed"),
    Description("camera", "Hri.BlankCamera"),
    Description("microphone", "Hri.MemoryMicrophone"),
)
"""Devices of a robot that hears what is typed, and sees nothing."""
AFTER = 1.0
"""Seconds from the end of what the robot says to the next line."""
PATIENCE = 20.0
"""Seconds without a word after which nothing more is waited for."""
LONGEST_WAIT = 3600.0
"""Seconds of one wait, which take a machine some minutes."""
UNITS = {"second": 1.0, "minute": 60.0, "hour": 3600.0}

Who = Literal["you", "robot", "wait"]
Line = tuple[Who, str]
_BLOCK = re.compile(r"^```dialogue\n(.*?)^```", re.DOTALL | re.MULTILINE)
_WHO: Mapping[str, Who] = {"you": "you", "robot": "robot", "wait": "wait"}
_LINE = re.compile(r"(you|robot|wait): (.+)")
_WAIT = re.compile(rf"(\d+(?:\.\d+)?) ({'|'.join(UNITS)})s?")
_FILE = re.compile(
    r"^`(\w+)/([\w.]+)`[^\n]*\n(?:[^`\n][^\n]*\n|\n)*```\w*\n(.*?)^```", re.DOTALL | re.MULTILINE
)


@dataclass(frozen=True)
class Dialogue:
    """What is said, and where that is written."""

    place: Place
    lines: tuple[Line, ...]

    def mistake(self, happened: Sequence[Line]) -> str:
        """The first line that went otherwise, with its place; empty if all went as shown."""
        rest = iter(happened)
        for number, (who, text) in enumerate(self.lines, start=self.place.line):
            if who == "wait":
                continue
            said = next(rest, None)
            if said is None or said[0] != who or not _is_as_shown(said[1], text):
                instead = "nothing more" if said is None else f'"{said[1]}" from {said[0]}'
                return f'{Place(self.place.path, number)}: "{text}" from {who}: {instead} instead'
        return ""


def _is_as_shown(said: str, text: str) -> bool:
    """Whether words are those of a page, in which only * has a meaning."""
    return fnmatchcase(said, text.replace("[", "[[]").replace("?", "[?]"))


def _seconds(wait: str) -> float | None:
    """How long it is; None for what is not a time, or too long a one."""
    found = _WAIT.fullmatch(wait)
    seconds = math.inf if found is None else float(found[1]) * UNITS[found[2]]
    return seconds if seconds <= LONGEST_WAIT else None


def read_dialogues(page: Path) -> list[Dialogue]:
    """The dialogues of a page, in order.

    Raises AuthoringError for a line of one that nobody says, HriError for a page that cannot be
    read.
    """
    text = read_text(page, "page")
    return [_dialogue(page, text, block) for block in _BLOCK.finditer(text)]


def _dialogue(page: Path, text: str, block: re.Match[str]) -> Dialogue:
    first = text.count("\n", 0, block.start(1)) + 1
    lines: list[Line] = []
    for number, line in enumerate(block[1].splitlines(), start=first):
        said = _LINE.fullmatch(line)
        if said is None:
            what = f'nobody says the line "{line[:60]}" of a dialogue'
            raise AuthoringError(Place(page, number), what, 'begin it with "you: " or "robot: "')
        if said[1] == "wait" and _seconds(said[2]) is None:
            what = f'"{said[2][:60]}" is not a time up to an hour'
            raise AuthoringError(Place(page, number), what, 'write "wait: 3 minutes"')
        lines.append((_WHO[said[1]], said[2]))
    return Dialogue(Place(page, first), tuple(lines))


def write_shown_files(page: Path, folder: Path) -> None:
    """Write what a page shows below the names of files, such as `fortune/skill.toml`.

    Raises HriError for a page that cannot be read.
    """
    for name, file, text in _FILE.findall(read_text(page, "page")):
        place = folder / name
        place.mkdir(parents=True, exist_ok=True)
        (place / file).write_text(text, encoding="utf-8")


def played(robot: Robot, dialogue: Dialogue) -> list[Line]:
    """The lines that were said when a robot of the devices TYPED heard those of the people, up to
    the first that is not as shown.

    Each line is typed a second after the robot has said what stands before it. After a wait, the
    robot may say other things by itself before the next line.
    """
    keyboard = robot.resources.obtain("recognizer", TypedRecognizer)
    happened: list[Line] = []

    async def talk(context: TaskContext) -> None:
        with context.queue("speech.finished") as queue:
            has_waited = False
            for who, text in dialogue.lines:
                if who == "wait":
                    await context.clock.sleep(_seconds(text) or 0.0)
                elif who == "you":
                    await context.clock.sleep(AFTER)
                    keyboard.type_line(text, context.clock.now())
                    happened.append((who, text))
                else:
                    said = await _heard(context, queue, text if has_waited else "*")
                    if said is not None:
                        happened.append((who, said))
                    if said is None or not _is_as_shown(said, text):
                        break  # the rest would be about something else
                has_waited = who == "wait"
        robot.finish()

    robot.live_until_over(*robot.app.load_tasks(), talk)
    return happened


async def _heard(context: TaskContext, queue: EventQueue, shown: str) -> str | None:
    """The next words of the robot that are as shown; else its last ones, None for silence."""
    said: str | None = None
    with context.clock.move_on_after(PATIENCE):
        while said is None or not _is_as_shown(said, shown):
            said = str((await queue.get()).properties["text"])
    return said
