"""`hri skill list`: the skills of an app, a line each."""

from __future__ import annotations

import argparse
import json

from hri.cli.skill.plugged import add_app, plugged_in, skills_of
from hri.core.quoting import report
from hri.robot.app import App
from hri.robot.skills import OffSkill


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_app(parser)
    parser.add_argument("--json", action="store_true", help="print JSON")


def run(options: argparse.Namespace) -> int:
    skills = skills_of(plugged_in(options.app))
    if options.json:
        print(json.dumps([_as_json(one) for one in skills.values()], indent=2))
        return 0
    if not skills:
        report(f"{options.app} has no skills - `hri skill new NAME` makes one")
    width = max(map(len, skills), default=0)
    for name, skill in sorted(skills.items()):
        report(f"{name:{width}}  {_state(skill)}")
    return 0


def _state(skill: App | OffSkill) -> str:
    if isinstance(skill, App):
        return f"on   {skill.about}"
    return f"off  {skill.why}"


def _as_json(skill: App | OffSkill) -> dict[str, str | bool]:
    is_on = isinstance(skill, App)
    found: dict[str, str | bool] = {"name": skill.name, "on": is_on, "folder": str(skill.folder)}
    found["about" if is_on else "why"] = skill.about if isinstance(skill, App) else skill.why
    return found
