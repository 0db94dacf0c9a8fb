"""The sounds that the figures are taken on, each with what was said in it."""

from __future__ import annotations

import csv
import json
import random
import wave
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from hri.bench.speech import flite_voices
from hri.bench.speech.flite_voices import RATE
from hri.core.errors import HriError
from hri.core.signals import Samples

DATA = Path(__file__).parent
ROBOT = DATA / "robot.jsgf"
ORDERS = DATA / "orders.jsgf"


@dataclass(frozen=True, eq=False)
class Clip:
    """One sound, mono, 16 kHz."""

    name: str
    samples: Samples
    sentence: str = ""
    """What was said, where that is known."""
    slots: Mapping[str, str] = field(default_factory=dict)
    """What an order asks for."""
    voice: str = ""

    @property
    def seconds(self) -> float:
        return len(self.samples) / RATE


@dataclass(frozen=True)
class Recordings:
    """Recordings of people; see `read_recordings`."""

    orders: tuple[Clip, ...]
    read: tuple[Clip, ...]
    """Lines of a novel."""


def commands() -> list[str]:
    """The sentences of `commands.tsv`."""
    return [row["sentence"] for row in _rows(DATA / "commands.tsv")]


def spoken(sentences: Sequence[str], voices: Sequence[str] = flite_voices.VOICES) -> list[Clip]:
    """Each sentence in each voice."""
    return [
        Clip(f"{voice}/{sentence}", flite_voices.say(sentence, voice), sentence, voice=voice)
        for sentence in sentences
        for voice in voices
    ]


def read_recordings(folder: Path) -> Recordings:
    """The recordings that `manifest.tsv` of the folder lists.

    Its column `transcript` holds the words, or "SLOTS " and a JSON object.
    Raises HriError when a file is missing or of another kind than mono, 16 bit, 16 kHz.
    """
    orders, read = [], []
    for row in _rows(folder / "manifest.tsv"):
        name, said = row["file"], row["transcript"]
        if said.startswith("SLOTS "):
            slots = json.loads(said.removeprefix("SLOTS "))
            orders.append(Clip(name, flite_voices.read_wav(folder / name), slots=slots))
        elif "librivox" in row["source"]:
            read.append(Clip(name, flite_voices.read_wav(folder / name), said))
    return Recordings(tuple(orders), tuple(read))


def write_wav(path: Path, clip: Clip) -> None:
    """Write a clip: mono, 16 bit, 16 kHz."""
    with wave.open(str(path), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(RATE)
        file.writeframes(clip.samples.tobytes())


_BEGINNINGS = ("b", "br", "c", "d", "f", "g", "h", "j", "k", "l", "m", "n", "p", "r", "s", "t", "v")
_MIDDLES = ("a", "e", "i", "o", "ar", "en", "or", "il", "an", "ay")
_ENDINGS = ("ba", "den", "ford", "ger", "kin", "la", "ley", "man", "na", "rick", "son", "ton")


def names(count: int) -> list[str]:
    """Different names of two made words, always the same ones."""
    chance = random.Random(0)
    found: dict[str, None] = {}
    while len(found) < count:
        found[" ".join(_name(chance) for _ in range(2))] = None
    return list(found)


def _name(chance: random.Random) -> str:
    return "".join(chance.choice(parts) for parts in (_BEGINNINGS, _MIDDLES, _ENDINGS))


def _rows(path: Path) -> list[dict[str, Any]]:
    try:
        with path.open(encoding="utf-8", newline="") as lines:
            return list(csv.DictReader(lines, delimiter="\t"))
    except OSError as error:
        raise HriError(f"{path}: {error.strerror} - check the folder") from error
