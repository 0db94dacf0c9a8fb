"""Dialogues that a page shows, played to a robot that hears what is typed.

    ```dialogue
    you: roll two dice
    robot: I rolled * and *.
    ```

A `*` stands for any words.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Literal

from hri.core.errors import AuthoringError, Place
from hri.core.reading import read_text
from hri.core.signals import Event
from hri.hal.resource import Description
from hri.robot import Robot
from hri.speech.recognizers.typed import TypedRecognizer
from hri.task.context import TaskContext

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

Who = Literal["you", "robot"]
Line = tuple[Who, str]
_BLOCK = re.compile(r"^```dialogue\n(.*?)^```", re.DOTALL | re.MULTILINE)
_LINE = re.compile(r"(you|robot): (.+)")
_FILE = re.compile(
    r"^`(\w+)/([\w.]+)`[^\n]*\n(?:[^`\n][^\n]*\n|\n)*```\w*\n(.*?)^```", re.DOTALL | re.MULTILINE
)


@dataclass(frozen=True)
class Dialogue:
    """What is said, and where that is written."""

    place: Place
    lines: tuple[Line, ...]

    def mistake(self, happened: Sequence[Line]) -> str:
        """The first line that went otherwise, in words; empty if all went as shown."""
        for number, (who, text) in enumerate(self.lines):
            said = happened[number] if number < len(happened) else None
            if said is None or said[0] != who or not fnmatchcase(said[1], _pattern(text)):
                instead = "nothing more" if said is None else f'"{said[1]}" from {said[0]}'
                return f'line {number + 1}, "{text}" from {who}: {instead} instead'
        return ""


def _pattern(text: str) -> str:
    """For fnmatch, in which only * has a meaning."""
    return text.replace("[", "[[]").replace("?", "[?]")


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
        lines.append(("you" if said[1] == "you" else "robot", said[2]))
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
    """The lines that were said when a robot of the devices TYPED heard those of the people.

    Each line is typed a second after the robot has said what stands before it.
    """
    keyboard = robot.resources.obtain("recognizer", TypedRecognizer)
    happened: list[Line] = []

    async def talk(context: TaskContext) -> None:
        with context.queue("speech.finished") as queue:
            for who, text in dialogue.lines:
                if who == "you":
                    await context.clock.sleep(AFTER)
                    keyboard.type_line(text, context.clock.now())
                    happened.append((who, text))
                    continue
                event: Event | None = None
                with context.clock.move_on_after(PATIENCE):
                    event = await queue.get()
                if event is None:
                    break
                happened.append((who, str(event.properties["text"])))
        robot.finish()

    robot.live_until_over(*robot.app.load_tasks(), talk)
    return happened
