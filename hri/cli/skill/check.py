"""`hri skill check`: mistakes of skills, and sentences that meet those of other commands."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

from hri.cli.skill.plugged import add_names, chosen, skills_of, with_named
from hri.cli.terminal.progress_line import waiting
from hri.conversation import forms
from hri.core.clock import FakeClock
from hri.core.quoting import report
from hri.robot import Robot
from hri.robot.skills import OffSkill
from hri.speech.behaviors import Listener
from hri.speech.grammar import Grammar, Parse, load_grammar, parse
from hri.speech.grammar.lint import linter
from hri.speech.grammar.lint.ambiguity import follow_others
from hri.speech.grammar.lint.confusion import SoundAlike, sound_alikes
from hri.speech.pronunciation.lexicon import load_lexicon
from hri.testing.dialogues import TYPED

OWN, OTHERS = 40, 2
"""Sentences that are compared of each command of a skill, and of each other command."""
MOST_TOLD = 10
"""Pairs that sound alike, of each skill."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_names(parser)


def run(options: argparse.Namespace) -> int:
    with with_named(options.app, options.names) as name:
        with waiting("reading the app and its skills"):
            # All files are read and compared with each other; nothing is opened.
            robot = Robot(
                name, "simulated", clock=FakeClock(), devices=TYPED, notice=lambda line: None
            )
        grammar = robot.context.behavior(Listener).read_grammar()
        skills = skills_of(robot.app)
        is_wrong = False
        for one in chosen(robot.app, options.names):
            skill = skills[one]
            if isinstance(skill, OffSkill):
                report(f"{one}: {skill.why}")
                is_wrong = is_wrong or skill.is_broken
            else:
                is_wrong |= _has_mistaken_answers(one, skill.folder)
                is_wrong |= _has_conflict(one, skill.folder, grammar)
    return int(is_wrong)


def _has_mistaken_answers(name: str, folder: Path) -> bool:
    """Say what is wrong with the grammars of a skill's forms."""
    file = folder / forms.FILE
    found = forms.load_forms([file]).values() if file.exists() else ()
    findings = [
        one
        for path in sorted({form.grammar for form in found})
        for one in linter.check(load_grammar(path))
        if one.severity in ("error", "warning")
    ]
    for one in findings:
        report(f"{name}: {one}")
    return any(one.severity == "error" for one in findings)


def _has_conflict(name: str, folder: Path, grammar: Grammar) -> bool:
    """Compare the commands of a skill with all others, and say what meets."""
    own = [rule for rule in grammar.public_rules if _is_in(folder, grammar, rule)]
    if not own:
        report(f"{name}: fine; it has no commands")
        return False
    with waiting(f"comparing the commands of {name}"):
        taken = list(_taken(grammar, own))
        alike = _alike(grammar, own)
    for sentence, rule, other in taken:
        report(f'{name}: "{sentence}" counts as {other}, not as <{rule}> - say it another way')
    for pair in alike[:MOST_TOLD]:
        first, second = pair.first, pair.second
        report(
            f'{name}: "{first.text}" <{first.rule}> sounds like "{second.text}" <{second.rule}>'
            f" (distance {pair.distance:.2f}) - where one is taken for the other, use other words"
        )
    if not taken:
        count = "1 command" if len(own) == 1 else f"{len(own)} commands"
        sounding = (
            "1 sentence that sounds" if len(alike) == 1 else f"{len(alike)} sentences that sound"
        )
        report(f"{name}: fine; {count}, {sounding} like others")
    return bool(taken)


def _is_in(folder: Path, grammar: Grammar, rule: str) -> bool:
    return grammar.rules[rule].path.resolve().is_relative_to(folder.resolve())


def _taken(grammar: Grammar, own: list[str]) -> Iterator[tuple[str, str, str]]:
    """A sentence of each command that counts as something else, that command, and what it is."""
    for rule in own:
        for sentence in grammar.sample(OWN, [rule]):
            found = parse(grammar, sentence)
            if found is None:
                yield sentence, rule, "nothing, as it means two things"
                break
            if found.rule != rule and not follow_others(grammar, {rule, found.rule}):
                yield sentence, rule, f"<{found.rule}>"
                break


def _alike(grammar: Grammar, own: list[str]) -> list[SoundAlike]:
    """Pairs of a sentence of these commands and one of others that sound alike."""
    spoken = [rule for rule in grammar.spoken_rules if rule not in own]
    texts = [
        *(text for rule in own for text in grammar.sample(OWN, [rule])),
        *(text for rule in spoken for text in grammar.sample(OTHERS, [rule])),
    ]
    readings: list[Parse] = [
        found for text in texts if (found := parse(grammar, text, grammar.spoken_rules)) is not None
    ]
    pairs = sound_alikes(readings, load_lexicon())
    return [one for one in pairs if (one.first.rule in own) != (one.second.rule in own)]
