"""Two people get to know the robot for 20 minutes, and come back the next day.

    python -m benchmarks.conversation.two_days

Prints both days, what the robot knows of each of them at the end, and each mistake that it made;
the exit status is 1 where there is one. It takes some minutes.
"""

from __future__ import annotations

import argparse
import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from datetime import timedelta
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.conversation.playing import DEVICES, play
from benchmarks.conversation.talks import Talk, Turn, joined, load_talks, read_talks
from benchmarks.conversation.transcript import Line
from benchmarks.conversation.visits import LaterClock
from hri.bench.workers import variables
from hri.conversation import PEOPLE_FILE, KnownPerson, MemoryKeeper
from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.robot import Robot

TALKS = Path(__file__).with_name("two_days.toml")
CHAT = "{chat}"
"""A turn in whose place people chat."""
TURNS = 14
"""Of one chat."""
APART = timedelta(days=1, hours=2)
SEED = 4
FACTS: Mapping[str, tuple[str, ...]] = {
    "Anna": ("jazz", "Eva", "May 3"),
    "Ben": ("gardening", "Rex"),
}
"""What each of them told."""
ALL = "what do you know about me"
NOT_CHAT = ("name", "call", "forget", "remember", "quiet", "sleep", "shut", "bye", "night", "like")
"""Words that end a talk, or say something of who talks."""


def lived(file: Path) -> Iterator[list[Line]]:
    """Play both days to a robot that keeps its memory of people in a file."""
    with TemporaryDirectory() as folder, variables(XDG_STATE_HOME=folder):
        for number, day in enumerate(days()):
            robot = Robot(
                "companion",
                "simulated",
                clock=LaterClock(number * APART),
                seed=number + 1,
                devices=DEVICES,
            )
            robot.board.slot(PEOPLE_FILE).set(str(file), 0.0)
            yield play(day, robot)


def days() -> list[Talk]:
    """What is said on each day."""
    chance, chats = random.Random(SEED), joined(load_talks("open"))
    meant = [one for one in chats if not any(word in one.say for word in NOT_CHAT)]
    return [
        replace(talk, turns=tuple(_with_chats(talk.turns, meant, chance)))
        for talk in read_talks(TALKS, "two days")
    ]


def _with_chats(
    turns: Sequence[Turn], chats: Sequence[Turn], chance: random.Random
) -> Iterator[Turn]:
    for turn in turns:
        if turn.say == CHAT:
            yield from chance.sample(chats, TURNS)
        else:
            yield turn


def mistakes(lines: Sequence[Line]) -> Iterator[str]:
    """Where it confused the two, did not know one, or left out a fact of theirs."""
    who, greeted = "", set[str]()
    for line in lines:
        said = " ".join(words.text for words in line.said)
        who = next((name for name in FACTS if line.say == f"my name is {name.lower()}"), who)
        others = {fact for name, facts in FACTS.items() if name != who for fact in facts}
        for fact in others:
            if who and fact in said:
                yield f'{who} heard of "{fact}"'
        if line.say == ALL:
            for fact in FACTS[who]:
                if fact not in said:
                    yield f'of {who} it did not know "{fact}"'
        if "haven't seen you" in said:
            greeted.add(who)
            if f"{who}!" not in said or not any(fact in said for fact in FACTS[who]):
                yield f"{who} was greeted without their name or a fact: {said}"
    if lines[0].situation == "the next day" and greeted != {*FACTS}:
        yield f"only {sorted(greeted)} were greeted"


def known(file: Path) -> tuple[KnownPerson, ...]:
    """Everyone in a file of people."""
    clock = FakeClock()
    keeper = MemoryKeeper(file, {}, clock, EventBus(clock))
    try:
        return keeper.memory.people
    finally:
        keeper.close()


def main() -> None:
    """Play, and print. Raises SystemExit."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    with TemporaryDirectory() as folder:
        file = Path(folder) / "people.db"
        found: list[str] = []
        for lines in lived(file):
            found += mistakes(lines)
            print(f"--- {lines[0].situation}")
            for line in lines:
                print(f"{line.time:7.1f}  {line.say}")
                for words in line.said:
                    print(f"{'':9}    {words.told()}")
        for person in known(file):
            facts = ", ".join(f"{fact.relation} {fact.value}" for fact in person.facts)
            print(f"{person.name}: {person.meetings} meetings, {facts}")
    print("\n".join(found) or "no mistakes")
    raise SystemExit(bool(found))


if __name__ == "__main__":
    main()
