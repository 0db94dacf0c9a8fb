"""An hour of talk that is not for the robot: how much of it is taken for a command.

Recordings of people, and two people or one composed of twelve voices, every other minute among
people who talk farther off; and its own voice, in the simulated room.
"""

from __future__ import annotations

import os
import random
import tempfile
import tomllib
from bisect import bisect_left
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
    "addressed": Turn(),
    "not addressed": Turn(is_addressed=False),
}
OWN = "its own voice"
MINUTES = {"people": 18, "dialogs": 14, "talk": 18, OWN: 10}
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
    def level(self) -> float:
        """How loud its own voice is, see `barge_in.LEVELS`."""
        return barge_in.LEVELS[self.number % len(barge_in.LEVELS)]

    @property
    def name(self) -> str:
        heard_in = f"{self.level:g} dB" if self.kind == OWN else self.condition
        return f"{self.kind} {self.number}, {heard_in}"

    def chance(self) -> random.Random:
        """The same at every run."""
        return random.Random(f"{self.kind} {self.number}")


@dataclass(frozen=True, slots=True)
class Taken:
    """Something that was taken for a command."""

    minute: Minute
    said: str
    """What was being said then."""
    text: str
    rule: str
    confidence: float

    @property
    def moves(self) -> bool:
        return self.rule in companion().marked("careful")

    def told(self) -> str:
        heard = f'"{self.text}" <{self.rule}> {self.confidence:.2f}'
        return f"{self.minute.name}: {self.said} - {heard}"


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
    if minute.kind == OWN:
        taken = list(_own_voice(minute))
        return Listened(minute, SECONDS, dict.fromkeys(TURNS, taken))
    spoken = talk(people, minute)
    clip = Clip(minute.name, spoken.sound)
    (clip,) = heard_in(minute.condition, [clip], [*people.orders, *people.read])
    by_turn = {turn: list(_taken(minute, spoken, clip, turn)) for turn in set(TURNS.values())}
    taken_by_name = {name: by_turn[turn] for name, turn in TURNS.items()}
    return Listened(minute, clip.seconds, taken_by_name)


def _taken(minute: Minute, spoken: Talk, clip: Clip, turn: Turn) -> Iterator[Taken]:
    (heard,) = hear_all([clip], turn)
    for one in heard:
        if one.is_accepted:
            said = spoken.said(one.start_s, one.end_s)
            yield Taken(minute, said, one.text, one.rule, one.confidence)


# --- who talks ---


@dataclass(frozen=True, slots=True)
class Talk:
    """A minute of one sentence after the other."""

    sound: Samples
    sentences: Sequence[str]
    ends: Sequence[float]
    """Seconds at which the pause behind each of them is over."""

    def said(self, start: float, end: float) -> str:
        """The sentences between two times in seconds."""
        first, last = (bisect_left(self.ends, time) for time in (start, end))
        return " / ".join(self.sentences[first : last + 1])


def talk(people: Recordings, minute: Minute) -> Talk:
    """A minute of talk, the same at every run."""
    chance = minute.chance()
    clips = _said(people, minute, chance)
    pieces: list[Samples] = []
    sentences: list[str] = []
    ends: list[float] = []
    while (length := sum(map(len, pieces))) < SECONDS * RATE and (clip := next(clips, None)):
        gap = np.zeros(round(chance.uniform(*GAPS) * RATE), np.int16)
        pieces += [clip.samples, gap]
        sentences.append(clip.sentence or clip.name)
        ends.append((length + len(clip.samples) + len(gap)) / RATE)
    sound = np.concatenate(pieces).astype(np.float64)
    sound += np.random.default_rng(minute.number).normal(0.0, FLOOR, len(sound))
    return Talk(np.asarray(np.round(sound), np.int16), sentences, ends)


def _said(people: Recordings, minute: Minute, chance: random.Random) -> Iterator[Clip]:
    if minute.kind == "people":
        clips = [*people.orders, *people.read]
        random.Random(0).shuffle(clips)
        rounds = MINUTES["people"] // len(CONDITIONS)
        yield from clips[minute.number // len(CONDITIONS) :: rounds]
        return
    voices = chance.sample(list(TALKERS), 2)
    levels = [chance.uniform(*LEVELS) for _ in voices]
    texts = _dialogs(chance) if minute.kind == "dialogs" else _sentences(chance)
    for turn, text in texts:
        who = turn % 2 if minute.kind == "dialogs" else 0
        sound = trimmed(TALKERS[voices[who]](text).astype(np.float64))
        samples = np.asarray(np.round(sound * 10 ** (levels[who] / 20)), np.int16)
        yield Clip(minute.name, samples, f"{voices[who]}: {text}")


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

    with tempfile.TemporaryDirectory() as folder:
        robot = barge_in.talker(Path(folder), barge_in.NATURAL, minute.level, minute.number)
        events = live_for(robot, SECONDS, tell)
    words = [event for event in events if event.name == "speech.said"]
    for event in events:
        if event.name == "speech.heard":
            heard = event.properties
            begun = [one.properties["text"] for one in words if one.time < heard["end"]]
            yield Taken(minute, begun[-1], heard["text"], heard["rule"], heard["confidence"])


def replies() -> list[str]:
    """What the companion says, and asks, where nothing is to be filled in."""
    text = (paths.find("apps", "companion") / "replies.toml").read_text(encoding="utf-8")
    told = tomllib.loads(text)
    says = [reply.get("say", []) for reply in told["reply"].values()]
    says += told["unasked"].values()
    found = [words for say in says for words in ([say] if isinstance(say, str) else say)]
    found += [question[key] for question in told["question"] for key in ("ask", "yes", "no")]
    return [words for words in found if "{" not in words]


if __name__ == "__main__":
    printed.main(__doc__, rows)
