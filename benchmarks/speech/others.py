"""An hour of talk that is not for the robot: how much of it is taken for a command.

Recordings of people, and two people or one composed of twelve voices, every other minute among
people who talk farther off; and its own voice, in the simulated room.
"""

from __future__ import annotations

import os
import random
import tempfile
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from benchmarks.progress import progress
from benchmarks.speech import accuracy, barge_in, printed
from benchmarks.speech.conditions import heard_in
from benchmarks.speech.ears import companion, hear_all
from benchmarks.speech.levels import trimmed
from benchmarks.speech.texts import blocks, lines
from benchmarks.speech.voices import TALKERS
from hri.bench.speech.flite_voices import RATE
from hri.bench.speech.listening import ONE_CORE
from hri.bench.speech.samples import Clip, Recordings
from hri.bench.table import Row, amount, at_most
from hri.bench.workers import variables, worker_pool
from hri.core import paths
from hri.core.errors import NotAvailable
from hri.core.signals import Samples
from hri.speech.behaviors import Voice
from hri.speech.turn import Turn
from hri.task.context import TaskContext
from hri.testing import live_for

TURNS: Mapping[str, Turn] = {
    "by who may mean it": Turn(),
    "by who does not mean it": Turn(),  # Turn(is_addressed=False), once a turn says it
}
MINUTES = {"people": 18, "dialogs": 14, "talk": 18, "its own voice": 10}
"""How many minutes there are of each kind of talk."""
CONDITIONS = ("clean", "12 dB")
SECONDS = 60.0
GAPS = (0.15, 1.2)
"""Seconds between sentences: some follow each other without a pause, others after one."""
LEVELS = (-18.0, 0.0)
"""How loud someone talks, dB against who speaks to the robot."""
FLOOR = 3.0
"""Level of the quiet room, of 32767."""


@dataclass(frozen=True, slots=True)
class Minute:
    """A minute of one kind of talk."""

    kind: str
    number: int

    @property
    def condition(self) -> str:
        return CONDITIONS[self.number % len(CONDITIONS)]

    @property
    def name(self) -> str:
        return f"{self.kind} {self.number}, {self.condition}"

    def chance(self) -> random.Random:
        """The same at every run."""
        return random.Random(f"{self.kind} {self.number}")


@dataclass(frozen=True, slots=True)
class Taken:
    """Something that was taken for a command."""

    minute: Minute
    text: str
    rule: str
    confidence: float

    @property
    def moves(self) -> bool:
        return self.rule in companion().marked("careful")

    def told(self) -> str:
        return f'{self.minute.name}: "{self.text}" <{self.rule}> {self.confidence:.2f}'


@dataclass(frozen=True, slots=True)
class Listened:
    """What became of a minute."""

    minute: Minute
    seconds: float
    taken: Mapping[str, Sequence[Taken]]
    """By the names of `TURNS`."""


def rows(people: Recordings | None, step: int = 1) -> Iterator[Row]:
    """By whose turn it is; every `step`th minute.

    Raises NotAvailable without flite or recordings.
    """
    if people is None:
        raise NotAvailable("no recordings of people - name their folder with --recordings")
    minutes = [Minute(kind, n) for kind, count in MINUTES.items() for n in range(0, count, step)]
    with variables(**ONE_CORE), worker_pool(os.cpu_count() or 1) as pool:
        done = pool.map(partial(listened, people), minutes)
        all_of = list(progress(done, len(minutes), "others' talk, minutes"))
    hours = sum(one.seconds for one in all_of) / 3600.0
    for name in TURNS:
        taken = [one for listened in all_of for one in listened.taken[name]]
        yield amount(
            f"others' talk taken for a command, {name}", len(taken) / hours, "an hour", None,
            count=len(taken), minutes=round(60 * hours, 1), clips=[one.told() for one in taken],
        )  # fmt: skip
        for kind in MINUTES:
            count = sum(one.minute.kind == kind for one in taken)
            yield amount(f"of these of {kind}", count, f"in {_minutes(all_of, kind):.1f} min", None)
        moving = [one for one in taken if one.moves]
        yield amount(
            f"of these that move, {name}", len(moving) / hours, "an hour", at_most(0),
            count=len(moving), clips=[one.told() for one in moving],
        )  # fmt: skip


def _minutes(all_of: Sequence[Listened], kind: str) -> float:
    return sum(one.seconds for one in all_of if one.minute.kind == kind) / 60.0


def listened(people: Recordings, minute: Minute) -> Listened:
    """One minute, in this process."""
    if minute.kind == "its own voice":
        taken = list(_own_voice(minute))
        return Listened(minute, SECONDS, dict.fromkeys(TURNS, taken))
    clip = Clip(minute.name, talk(people, minute))
    (clip,) = heard_in(minute.condition, [clip], [*people.orders, *people.read])
    by_turn = {turn: list(_taken(minute, clip, turn)) for turn in set(TURNS.values())}
    taken_by_name = {name: by_turn[turn] for name, turn in TURNS.items()}
    return Listened(minute, clip.seconds, taken_by_name)


def _taken(minute: Minute, clip: Clip, turn: Turn) -> Iterator[Taken]:
    (heard,) = hear_all([clip], turn)
    for one in heard:
        if one.is_accepted:
            yield Taken(minute, one.text, one.rule, one.confidence)


# --- who talks ---


def talk(people: Recordings, minute: Minute) -> Samples:
    """A minute of one sentence after the other."""
    chance = minute.chance()
    noise = np.random.default_rng(minute.number)
    sentences = _said(people, minute, chance)
    pieces: list[Samples] = []
    while (
        sum(map(len, pieces)) < SECONDS * RATE and (sentence := next(sentences, None)) is not None
    ):
        gap = round(chance.uniform(*GAPS) * RATE)
        pieces += [sentence, np.zeros(gap, np.int16)]
    sound = np.concatenate(pieces).astype(np.float64)
    return np.asarray(np.round(sound + noise.normal(0.0, FLOOR, len(sound))), np.int16)


def _said(people: Recordings, minute: Minute, chance: random.Random) -> Iterator[Samples]:
    if minute.kind == "people":
        clips = [*people.orders, *people.read]
        random.Random(0).shuffle(clips)
        rounds = MINUTES["people"] // len(CONDITIONS)
        yield from (clip.samples for clip in clips[minute.number // len(CONDITIONS) :: rounds])
        return
    voices = chance.sample(list(TALKERS), 2)
    levels = [chance.uniform(*LEVELS) for _ in voices]
    texts = _dialogs(chance) if minute.kind == "dialogs" else _sentences(chance)
    for turn, text in texts:
        who = turn % 2 if minute.kind == "dialogs" else 0
        sound = trimmed(TALKERS[voices[who]](text).astype(np.float64))
        yield np.asarray(np.round(sound * 10 ** (levels[who] / 20)), np.int16)


def _dialogs(chance: random.Random) -> Iterator[tuple[int, str]]:
    """Dialogs in an order drawn by chance, with whose turn it is."""
    by_name: dict[str, list[str]] = {}
    for name, text in blocks("dialogs.txt"):
        by_name.setdefault(name, []).append(text)
    for name in chance.sample(list(by_name), len(by_name)):
        yield from enumerate(by_name[name])


def _sentences(chance: random.Random) -> Iterator[tuple[int, str]]:
    """Sentences that hold no command."""
    others = [text for kind, text in blocks("phrases.txt") if kind in ("others", "near")]
    texts = [*lines("no_motion.txt"), *accuracy.outside(), *others]
    yield from enumerate(chance.sample(texts, len(texts)))


def _own_voice(minute: Minute) -> Iterator[Taken]:
    """It says what it replies, one after the other, and hears itself."""
    said = minute.chance().sample(replies(), len(replies()))

    async def tell(context: TaskContext) -> None:
        voice = context.behavior(Voice)
        for text in said:
            voice.say(text)

    level = barge_in.LEVELS[minute.number % len(barge_in.LEVELS)]
    with tempfile.TemporaryDirectory() as folder:
        robot = barge_in.talker(Path(folder), barge_in.NATURAL, level, minute.number)
        events = live_for(robot, SECONDS, tell)
    for event in events:
        if event.name == "speech.heard":
            heard = event.properties
            yield Taken(minute, heard["text"], heard["rule"], heard["confidence"])


def replies() -> list[str]:
    """What the companion says, and asks, where nothing is to be filled in."""
    text = (paths.find("apps", "companion") / "replies.toml").read_text(encoding="utf-8")
    told = tomllib.loads(text)
    says = [reply.get("say", []) for reply in told["reply"].values()]
    found = [words for say in says for words in ([say] if isinstance(say, str) else say)]
    found += told["unasked"].values()
    found += [question[key] for question in told["question"] for key in ("ask", "yes", "no")]
    return [words for words in found if "{" not in words]


if __name__ == "__main__":
    printed.main(__doc__, rows)
