"""What its skills cost the companion in hearing: `python -m benchmarks.speech.with_skills`.

Two voices that nothing was learned from say its commands, and other sentences between them; every
second one among people who talk farther off. The same minutes are heard once with the commands of
all its skills, and once without any.
"""

from __future__ import annotations

import argparse
import random
from collections.abc import Iterator, Sequence
from pathlib import Path

from benchmarks.speech import accuracy
from benchmarks.speech.conditions import heard_in
from benchmarks.speech.ears import companion, heard, with_skills
from benchmarks.speech.texts import blocks, lines
from benchmarks.speech.voices import NEW, spoken
from hri.bench.speech.samples import Clip, read_recordings
from hri.bench.speech.scoring import Outcome
from hri.conversation.examples import sayings
from hri.speech.grammar import Grammar, parse
from hri.speech.turn import Turn

MINUTES = 40.0
MOST_WORSE = 0.02
"""By which fewer may be understood, or more wrongly taken."""
CONDITIONS = ("clean", "12 dB")
SEED = 7


def clips(people: Path) -> list[Clip]:
    """The minutes, in an order drawn by chance; only commands have a sentence."""
    known = companion()
    spoken_rules = {*known.spoken_rules}
    commands = [texts[0] for rule, texts in sayings(known).items() if rule in spoken_rules]
    others = [text for kind, text in blocks("phrases.txt") if kind in ("others", "near")]
    others = [*lines("no_motion.txt"), *accuracy.outside(), *others]
    others = [text for text in others if parse(with_skills(), text) is None]
    said = [*spoken(commands, NEW), *map(_unnamed, spoken(others, NEW))]
    random.Random(SEED).shuffle(said)
    recordings = read_recordings(people)
    background = [*recordings.orders, *recordings.read]
    return [
        clip
        for number, condition in enumerate(CONDITIONS)
        for clip in heard_in(condition, list(_first(said, MINUTES))[number::2], background)
    ]


def _unnamed(clip: Clip) -> Clip:
    return Clip(clip.name, clip.samples, "", voice=clip.voice)


def _first(said: Sequence[Clip], minutes: float) -> Iterator[Clip]:
    """As many of these as fill that time."""
    seconds = 0.0
    for clip in said:
        if seconds >= 60.0 * minutes:
            return
        seconds += clip.seconds
        yield clip


def main() -> None:
    """Raises SystemExit with 1 when the skills cost more than they may."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.speech.with_skills", description=__doc__
    )
    parser.add_argument("recordings", type=Path, help="recordings of people, as for hri bench")
    said = clips(parser.parse_args().recordings)
    minutes = sum(clip.seconds for clip in said) / 60.0
    ears = {"without skills": companion, "with skills": with_skills}
    outcomes = {name: heard(said, Turn(), name, grammar) for name, grammar in ears.items()}
    commands = sum(bool(clip.sentence) for clip in said)
    print(f"{minutes:.1f} minutes, {commands} commands, {len(said) - commands} other sentences")
    shares = {name: _shares(made, ears[name]()) for name, made in outcomes.items()}
    for name, (understood, taken) in shares.items():
        print(f"{name}: understood {understood:.1%}, wrongly taken {taken:.1%}")
    for one, other in zip(outcomes["without skills"], outcomes["with skills"], strict=True):
        if _is_right(one, companion()) and not _is_right(other, with_skills()):
            print(f"lost with skills: {other.told()}")
    (before, wrong_before), (after, wrong_after) = shares.values()
    raise SystemExit(before - after > MOST_WORSE or wrong_after - wrong_before > MOST_WORSE)


def _is_right(one: Outcome, grammar: Grammar) -> bool:
    return one.means_the_same(grammar) if one.clip.sentence else not one.accepted


def _shares(made: Sequence[Outcome], grammar: Grammar) -> tuple[float, float]:
    """Of the commands those that were understood; of all clips those that were wrongly taken."""
    commands = [one for one in made if one.clip.sentence]
    right = [one for one in commands if _is_right(one, grammar)]
    wrong = [one for one in made if one.accepted and not _is_right(one, grammar)]
    return len(right) / len(commands), len(wrong) / len(made)


if __name__ == "__main__":
    main()
