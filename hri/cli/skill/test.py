"""`hri skill test`: plays the dialogues of a skill's page, and reports the lines that differ."""

from __future__ import annotations

import argparse
from pathlib import Path

from hri.cli.skill.plugged import add_names, chosen, plugged_in, skills_of, with_named
from hri.cli.terminal.progress_line import waiting
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.quoting import report
from hri.robot import Robot
from hri.robot.skills import OffSkill
from hri.testing.dialogues import TYPED, Dialogue, played, read_dialogues

PAGE = "README.md"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_names(parser)


def run(options: argparse.Namespace) -> int:
    failed = 0
    with with_named(options.app, options.names) as name:
        app = plugged_in(name)
        for skill in chosen(app, options.names):
            failed += not _passes(name, skill, skills_of(app)[skill].folder)
    return int(failed > 0)


def _passes(app: str, name: str, folder: Path) -> bool:
    """Play the dialogues of a skill, and say how they went."""
    try:
        dialogues = read_dialogues(folder / PAGE)
        found = [mistake for one in dialogues if (mistake := _mistake(app, name, one))]
    except HriError as error:
        report(f"{name}: {error}")
        return False
    for mistake in found:
        report(f"{name}: {mistake}")
    if not found:
        report(f"{name}: {_counted(len(dialogues))} as shown")
    return not found


def _counted(number: int) -> str:
    return "1 dialogue" if number == 1 else f"{number} dialogues"


def _mistake(app: str, name: str, dialogue: Dialogue) -> str:
    with waiting(f"playing {dialogue.place}"):
        robot = Robot(app, "simulated", clock=FakeClock(), devices=TYPED, notice=lambda line: None)
        for one in robot.app.off:
            if one.name == name:
                raise HriError(_why_off(one))
        return dialogue.mistake(played(robot, dialogue))


def _why_off(skill: OffSkill) -> str:
    return skill.why if skill.is_broken else f"it is off - `hri skill on {skill.name}` turns it on"
