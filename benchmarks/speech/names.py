"""First names that are said, read back by their phones, and recognized again.

    python -m benchmarks.speech.names

A name is right when what the robot would say sounds like it: a listed one as its text, or as
another text of the same phones; one that is nowhere listed but for one phone at most, for which
another of the same kind is heard (ALIKE). As the companion does it: after a "no" the name is said
again, and what both sayings are likeliest is read back, after another "no" the next best. Then ten
names each are remembered with the phones that were right, and the second saying is to be found
among them.
No number was fitted to these names, but that a second word must cost something was seen on them.
Those that are listed are among the names that the spelling and the order of phones are learned
from.
"""

from __future__ import annotations

import json
import random
import subprocess
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hri.bench.table import Row, at_least, share
from hri.core.clock import FakeClock
from hri.core.signals import HeardSlot, Prosody, Samples
from hri.hal.drivers.resampling import resample
from hri.hal.drivers.wav_file import read_wav
from hri.hal.recognizer import Segment
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.synthesizer import Synthesizer
from hri.speech import both_sayings, load_grammar, without
from hri.speech.pronunciation.lexicon import load_lexicon
from hri.speech.pronunciation.phones import Phones, distance, without_stress
from hri.speech.recognizers.ctc.decoder import CtcRecognizer
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.synthesizers.natural import NaturalVoice

GRAMMAR = Path(__file__).with_name("names.jsgf")
NAMES = Path(__file__).with_name("names.txt")
VOICES = ("heart", "slt", "en-us", "en-gb+f3")
"""slt is a voice of flite: recorded pieces of a woman."""
SAYINGS = (Prosody(), Prosody(rate=0.9, pitch=1.1))
"""How a name is said first, and again."""
SLOWER = (1.0, 1.12)
"""The same for flite, which is not told a pitch."""
ALIKE = 0.5
"""`distance` of two phones up to which one is taken for the other ("AH" and "IH")."""
READ_BACK = 3
REMEMBERED = 10
STRANGERS = 3
"""Of how many names one is said to those who remember ten others."""
CARRIER = "M AY N EY M IH Z"
QUIET = (6400, 12800)
"""Samples of silence before and after."""
LEAST_READ_BACK, LEAST_AGAIN = 0.85, 0.95


@dataclass(frozen=True, slots=True)
class Name:
    """A name and how it sounds."""

    text: str
    phones: Phones
    """With stress; none of a listed one, which a voice says as it likes."""

    def is_heard(self, text: str, phones: Phones) -> bool:
        """Whether what was heard counts as this name."""
        if not self.phones:
            return text == self.text or phones in load_lexicon().pronunciations(self.text)
        said = without_stress(self.phones)
        if len(said) != len(phones):
            return False
        other = [distance(*pair) for pair in zip(said, phones, strict=True) if pair[0] != pair[1]]
        return not other or (len(other) == 1 and other[0] <= ALIKE)


def names() -> list[Name]:
    """Those of `names.txt`."""
    lines = [line.split() for line in NAMES.read_text(encoding="utf-8").splitlines()]
    return [Name(line[0], tuple(line[1:])) for line in lines if line[0][0] not in "#["]


class Talk:
    """Voices, and ears that have the grammar."""

    def __init__(self, resources: ResourceManager) -> None:
        self._voices: dict[str, Synthesizer] = {
            "heart": NaturalVoice(Description("heart", "Hri.NaturalVoice"), resources)
        }
        for voice in ("en-us", "en-gb+f3"):
            description = Description(voice, "Hri.EspeakVoice", {"voice": voice})
            self._voices[voice] = EspeakVoice(description, resources)
        self.ears = CtcRecognizer(Description("ears", "Hri.CtcRecognizer"), resources)
        for resource in (*self._voices.values(), self.ears):
            resource.activate()
        self.ears.start(load_grammar(GRAMMAR))
        self._pieces = 0

    def said(self, voice: str, name: Name, saying: int) -> Samples:
        """The sound of "My name is ..."."""
        if voice in self._voices:
            sounds = ((name.text, name.phones),) if name.phones else ()
            manner = SAYINGS[saying]
            prosody = Prosody(rate=manner.rate, pitch=manner.pitch, sounds=sounds)
            text = f"My name is {name.text.capitalize()}."
            speech = self._voices[voice].synthesize(text, prosody)
            samples, rate = speech.samples, speech.rate
        else:
            samples, rate = _flite(voice, name, SLOWER[saying])
        return np.pad(resample(samples, rate, self.ears.rate), QUIET)

    def heard(self, samples: Samples) -> HeardSlot | None:
        """The name in it; None where it is another sentence."""
        self._pieces += 1
        segment = Segment(0.0, len(samples) / self.ears.rate, samples, number=self._pieces)
        slots = self.ears.decode(segment).slots
        return slots[0] if slots else None


def _flite(voice: str, name: Name, slower: float) -> tuple[Samples, int]:
    """Raises OSError without the program."""
    phones = ["ax" if one == "AH0" else one.rstrip("012").lower() for one in name.phones]
    text = ["-t", f"My name is {name.text.capitalize()}."]
    if phones:
        text = ["-p", " ".join(("pau", *CARRIER.lower().split(), *phones, "pau"))]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "said.wav"
        manner = ["--setf", f"duration_stretch={slower}"]
        command = ["flite", "-voice", voice, *manner, *text, "-o", str(path)]
        subprocess.run(command, check=True, capture_output=True)
        return read_wav(path)


def rows(step: int = 1) -> Iterator[Row]:
    """Of every name, or every `step`-th: read back, and recognized again; in the clean."""
    with ResourceManager((), FakeClock()) as resources:
        talk = Talk(resources)
        chosen = names()[::step]
        read: dict[str, list[tuple[bool, bool]]] = defaultdict(list)
        again = found = mistaken = strangers = 0
        for voice in VOICES:
            kept: list[tuple[Name, HeardSlot, Samples]] = []
            for name in chosen:
                again_said = talk.said(voice, name, 1)
                slot = talk.heard(talk.said(voice, name, 0))
                tries = _read_back(slot, talk.heard(again_said))
                right = [name.is_heard(one.text, one.phones) for one in tries]
                kind = "nowhere listed" if name.phones else "listed"
                read[f"{kind}, {voice}"].append((any(right[:1]), any(right)))
                if not any(right[:1]):
                    heard = [f"{one.text} {'.'.join(one.phones)}" for one in tries]
                    print(voice, name.text, *name.phones, "|", *heard, file=sys.stderr)
                if slot is not None:
                    kept.append((name, _confirmed(name, tries), again_said))
            random.Random(5).shuffle(kept)
            groups = [kept[at : at + REMEMBERED] for at in range(0, len(kept), REMEMBERED)]
            for number, group in enumerate(groups):
                talk.ears.know("name", {slot.text: slot.phones for _, slot, _ in group})
                for name, slot, samples in group:
                    now = talk.heard(samples)
                    again += 1
                    found += now is not None and now.text == slot.text
                    if now is None or now.text != slot.text:
                        print("again", voice, name.text, slot.text, now, file=sys.stderr)
                for name, slot, samples in groups[(number + 1) % len(groups)][::STRANGERS]:
                    now = talk.heard(samples)
                    strangers += 1
                    known = {other.text for _, other, _ in group} - {slot.text, name.text}
                    mistaken += now is not None and now.text in known
            talk.ears.know("name", {})
    for what, ways in read.items():
        yield share(f"{what}, at once", sum(one for one, _ in ways), len(ways), None)
        yield share(f"{what}, after the read-back", sum(two for _, two in ways), len(ways), None)
    every = [one for ways in read.values() for one in ways]
    yield share("right at once", sum(one for one, _ in every), len(every), None)
    limit = at_least(LEAST_READ_BACK)
    yield share("right after the read-back", sum(two for _, two in every), len(every), limit)
    yield share("recognized among ten", found, again, at_least(LEAST_AGAIN))
    yield share("another name taken for one of ten", mistaken, strangers, None)


def _read_back(first: HeardSlot | None, again: HeardSlot | None) -> list[HeardSlot]:
    """What the robot says: what it heard, then of both sayings what it has not said."""
    if first is None:
        return []
    tries, rest = [first], without(both_sayings(first, again or first), [first])
    while rest is not None and len(tries) < READ_BACK:
        tries.append(rest)
        rest = without(rest, tries)
    return tries


def _confirmed(name: Name, tries: Sequence[HeardSlot]) -> HeardSlot:
    """What is remembered: what was right, else what was heard first."""
    right = (one for one in tries if name.is_heard(one.text, one.phones))
    return next(right, tries[0])


if __name__ == "__main__":
    for row in rows(int(sys.argv[1]) if len(sys.argv) > 1 else 1):
        print(json.dumps(row))
