"""Fits the confidence of the default engine: `python fit.py --recordings FOLDER`.

Sentences of the grammars in `calibration/` are spoken by synthetic voices, laid over babble or a
kitchen, cut and decoded as the engine does it, each by its own grammar and by others. What its own
grammar decodes right speaks for a sentence; whatever a grammar makes of sentences that it does not
have, of `calibration/foreign.txt` and of babble alone speaks against, and so does what its own
grammar takes for another sentence. Every second of the recorded orders stands against all grammars,
too. Prints the constants for `confidence.py`, and how well a fit without a fifth of the grammars
and voices separates the two there.

Kept out, since figures are taken from them: the voices slt and awb, the other half of the orders,
and the grammars of `hri bench speech`.
"""

from __future__ import annotations

import argparse
import random
import zlib
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

import numpy as np
import soxr
from numpy.typing import NDArray

from benchmarks.speech.babble import babble
from benchmarks.speech.kitchen import kitchen
from benchmarks.speech.levels import above
from benchmarks.speech.manners import MANNERS
from hri.bench.speech import flite_voices, samples
from hri.bench.speech.flite_voices import RATE
from hri.core.signals import Samples
from hri.speech.endpoint import Endpointer
from hri.speech.grammar import load_grammar
from hri.speech.grammar.expansion import random_sentence
from hri.speech.grammar.matching import parse
from hri.speech.pronunciation.lexicon import load_lexicon
from hri.speech.recognizers.ctc.confidence import Fit, fit_of, scores_of, shares
from hri.speech.recognizers.ctc.conformer import load_network
from hri.speech.recognizers.ctc.loudness import noise_of, sounding
from hri.speech.recognizers.ctc.phone_graph import compile
from hri.speech.recognizers.ctc.ranking import ranked
from hri.speech.recognizers.ctc.rival_words import Rivals
from hri.speech.recognizers.ctc.search import Search
from hri.speech.recognizers.ctc.word_habits import Habits
from hri.speech.recognizers.voice_activity import voice_detector
from hri.speech.synthesizers.espeak_library import Mark, Setting, load_espeak

Floats = NDArray[np.float64]

HERE = Path(__file__).parent / "calibration"
RATIOS = (None, 15.0, 12.0, 9.0, 6.0)
"""Decibels above the babble; None is without."""
SENTENCES = 36
"""Of each grammar."""
VOICES_EACH = 4
SPOKEN = ("plain", "fast", "far")
"""Manners in which the natural voice speaks."""
OTHER_GRAMMARS = 2
"""That decode a sentence beside its own."""
BABBLES, BABBLE_S = 40, 4.0
MOST_FOREIGN = {None: 0.005, 12.0: 0.015}
"""Share of the foreign pieces that may be accepted, by ratio."""
FOLDS = 5
STEPS = 30


def main() -> None:
    """Make the pieces, fit, and tell."""
    parser = argparse.ArgumentParser(description="Fits the confidence of the default engine.")
    parser.add_argument("--recordings", type=Path, required=True, help="see `hri bench speech`")
    parser.add_argument("--weights", default="", help="of another network than that of `hri`")
    options = parser.parse_args()
    orders = orders_of(options.recordings)
    said = [
        *sentences(),
        *(Said(clip, "", "", "people") for clip in orders),
        *talk(talkers_of(options.recordings)),
    ]
    chance = random.Random(1)
    names = [names_for(clip, chance) for clip in said]
    with ProcessPoolExecutor() as pool:
        work = partial(pieces_of, options.weights, options.recordings)
        pieces = [piece for found in pool.map(work, said, names, chunksize=8) for piece in found]
    tell(pieces)


@dataclass(frozen=True, eq=False)
class Said:
    """A clip with a sentence; `grammar` is the name of its grammar, "" when it belongs to none."""

    samples: Samples
    sentence: str
    grammar: str
    voice: str


@dataclass(frozen=True)
class Piece:
    """What a grammar made of a piece of speech, and whether that was said."""

    fit: Fit
    doubt: float
    """How likely the engine holds sentences of another meaning, 0 to 1."""
    is_right: bool
    is_foreign: bool
    ratio: float | None
    noise: float
    """As the engine measures it, 0 to 1."""
    fold: int


class Decoder:
    """A grammar and the search through it."""

    def __init__(self, path: Path) -> None:
        self.grammar = load_grammar(path)
        self.search = Search(compile(self.grammar.graph(), Habits(load_lexicon())))

    def meaning(self, sentence: str) -> object:
        """What a sentence means; None for one that the grammar does not have."""
        found = parse(self.grammar, sentence)
        return None if found is None else (found.rule, found.tags)


@cache
def decoders() -> dict[str, Decoder]:
    """The grammars of `calibration/` by name."""
    return {path.stem: Decoder(path) for path in sorted(HERE.glob("*.jsgf"))}


@cache
def orders_of(recordings: Path) -> list[Samples]:
    """Every second of the recorded orders."""
    return [clip.samples for clip in samples.read_recordings(recordings).orders[::2]]


@cache
def talkers_of(recordings: Path) -> list[Samples]:
    """People whose talk lies under the sentences."""
    read = samples.read_recordings(recordings).read
    return [*orders_of(recordings), *(clip.samples for clip in read)]


network_of = cache(load_network)


@cache
def rivals() -> Rivals:
    """What else could have been said."""
    return Rivals(Habits(load_lexicon()))


def names_for(clip: Said, chance: random.Random) -> list[str]:
    """The grammars that decode a clip: its own, and some others."""
    others = [name for name in decoders() if name != clip.grammar]
    return [*filter(None, [clip.grammar]), *chance.sample(others, OTHER_GRAMMARS)]


def sentences() -> Iterator[Said]:
    """Sentences of all grammars and of none, each in a few voices."""
    chance = random.Random(0)
    texts = [
        (name, text)
        for name, decoder in decoders().items()
        for text in {random_sentence(decoder.grammar, chance): None for _ in range(SENTENCES)}
    ]
    foreign = (HERE / "foreign.txt").read_text(encoding="utf-8").splitlines()
    voices = dict(speakers())
    for name, text in [*texts, *(("", line) for line in foreign)]:
        for voice in chance.sample(sorted(voices), VOICES_EACH):
            quiet = round(flite_voices.LEAD * RATE), round(flite_voices.TAIL * RATE)
            yield Said(np.pad(voices[voice](text), quiet), text, name, voice)


def talk(talkers: Sequence[Samples]) -> Iterator[Said]:
    """Babble with nobody in front of it, softly and loud."""
    for seed in range(BABBLES):
        chance = np.random.default_rng(seed)
        sound = babble(talkers, round(BABBLE_S * RATE), chance)
        sound *= 10 ** chance.uniform(2.0, 3.3) / np.std(sound)
        yield Said(np.clip(sound, -32768, 32767).astype(np.int16), "", "", f"babble {seed}")


def speakers() -> Iterator[tuple[str, Callable[[str], Samples]]]:
    """Voices by name; some of them once more as larger and smaller people."""
    for voice, rate, pitch in (("en-us", 165, 50), ("en-us+f3", 160, 60), ("en-gb", 150, 45)):
        yield voice, partial(_espeak, setting=Setting(voice=voice, rate=rate, pitch=pitch))
    for voice in ("rms", "kal16"):
        for size in (1.0, 1.08, 0.93):
            yield f"{voice} {size:g}", partial(_flite, voice=voice, size=size)
    for manner in SPOKEN:
        yield manner, MANNERS[manner]


def _espeak(text: str, setting: Setting) -> Samples:
    blocks: list[bytes] = []

    def take(sound: bytes, marks: Sequence[Mark]) -> bool:
        blocks.append(sound)
        return True

    library = load_espeak()
    library.speak(text, setting, take)
    return _resampled(np.frombuffer(b"".join(blocks), np.int16), library.rate)


def _flite(text: str, voice: str, size: float) -> Samples:
    return _resampled(flite_voices.say(text, voice), RATE * size)


def _resampled(samples: Samples, rate: float) -> Samples:
    sound = soxr.resample(samples.astype(np.float32), rate, RATE)
    return np.clip(sound, -32768, 32767).astype(np.int16)


def pieces_of(weights: str, recordings: Path, clip: Said, names: list[str]) -> list[Piece]:
    """A clip in every noise, decoded by some grammars."""
    found = []
    for ratio in RATIOS:
        for piece in cut(noisy(clip, talkers_of(recordings), ratio)):
            scores = scores_of(network_of(weights).posteriors(piece[sounding(piece)]))
            for name in names:
                if (decoded := _decoded(clip, name, scores)) is not None:
                    fold = _fold(name, clip.voice)
                    found.append(Piece(*decoded, ratio, noise_of(piece), fold))
    return found


def _decoded(
    clip: Said, name: str, scores: NDArray[np.float32]
) -> tuple[Fit, float, bool, bool] | None:
    """How it fits, its doubt, whether it is right and foreign; None for what says nothing."""
    decoder = decoders()[name]
    decoder.search.begin()
    decoder.search.advance(scores)
    candidates = ranked(decoder.search, scores, rivals())
    meaning = decoder.meaning(clip.sentence)
    if not candidates or (meaning is not None and name != clip.grammar):
        return None
    meanings = [decoder.meaning(" ".join(one.path.words)) for one in candidates]
    chances = shares([one.score for one in candidates])
    doubt = sum(
        chance for chance, other in zip(chances, meanings, strict=True) if other != meanings[0]
    )
    best = candidates[0].path
    fit = fit_of(best, rivals().score(scores, best.words), scores, decoder.search.graph.phones)
    return fit, float(doubt), meaning is not None and meanings[0] == meaning, meaning is None


def _fold(grammar: str, voice: str) -> int:
    return zlib.crc32(f"{grammar} {voice}".encode()) % FOLDS


def noisy(clip: Said, talkers: Sequence[Samples], ratio: float | None) -> Samples:
    """The clip among people who talk, or in a kitchen; the same at every run."""
    if ratio is None:
        return clip.samples
    others = [talker for talker in talkers if not np.array_equal(talker, clip.samples)]
    seed = zlib.crc32(f"{clip.sentence} {clip.voice} {len(clip.samples)} {ratio:g}".encode())
    make = (babble, kitchen)[seed % 2]
    return above(clip.samples, make(others, len(clip.samples), np.random.default_rng(seed)), ratio)


def cut(samples: Samples) -> list[Samples]:
    """The pieces of speech in a sound."""
    endpointer = Endpointer(RATE, voice_detector)
    segments = [*endpointer.listen(samples, len(samples) / RATE), *endpointer.flush()]
    return [segment.samples for segment in segments if segment.samples is not None]


def tell(pieces: Sequence[Piece]) -> None:
    """Fit, and print the constants and how well they do on what they were not fitted on."""
    given = np.array([numbers(piece) for piece in pieces])
    is_right = np.array([piece.is_right for piece in pieces])
    is_foreign = np.array([piece.is_foreign for piece in pieces])
    folds = np.array([piece.fold for piece in pieces])
    ratios = np.array([piece.ratio or np.inf for piece in pieces])
    doubts = np.array([piece.doubt for piece in pieces])
    odds = np.zeros(len(pieces))
    for fold in range(FOLDS):
        weights = fitted(given[folds != fold], is_right[folds != fold])
        odds[folds == fold] = given[folds == fold] @ weights
    points = odds - needed(doubts)
    least = {
        ratio: float(np.quantile(points[is_foreign & (ratios == (ratio or np.inf))], 1.0 - share))
        for ratio, share in MOST_FOREIGN.items()
    }
    print(f"{len(pieces)} pieces, {is_right.sum()} right")
    halves = np.split(fitted(given, is_right), 2)
    for name, (first, *rest), below in zip(
        ("IN_QUIET", "IN_NOISE"), halves, least.values(), strict=True
    ):
        told = ", ".join(f"{weight:.2f}" for weight in (first - below, *rest))
        print(f"{name} = ({told})  # {below:.2f} below the fit")
    for ratio in np.unique(ratios):
        bound = least[None] if np.isinf(ratio) else least[12.0]
        here = (ratios == ratio) & (points >= bound)
        shares_of = {
            "right": (here & is_right).sum() / (is_right & (ratios == ratio)).sum(),
            "foreign": (here & is_foreign).sum() / (is_foreign & (ratios == ratio)).sum(),
            "wrong": (here & ~is_right & ~is_foreign).sum() / max((here & ~is_foreign).sum(), 1),
        }
        told = ", ".join(f"{name} {share:.4f}" for name, share in shares_of.items())
        print(f"{ratio:g} dB, accepted: {told}")


def numbers(piece: Piece) -> tuple[float, ...]:
    """What is weighed: all of it in quiet, and all of it again in noise."""
    fit, noise = np.array(piece.fit.numbers), piece.noise
    return (*(fit * (1.0 - noise)), *(fit * noise))


def needed(doubts: Floats) -> Floats:
    """Log odds from which the confidence, after the doubt, is 0.5 or more."""
    chances = np.minimum(0.5 / np.maximum(1.0 - doubts, 1e-9), 1.0 - 1e-9)
    return np.asarray(np.log(chances / (1.0 - chances)))


def fitted(given: Floats, is_right: NDArray[np.bool_]) -> Floats:
    """Weights of a logistic regression on [pieces, numbers], by Newton's method."""
    weights = np.zeros(given.shape[1])
    for _ in range(STEPS):
        chances = 1.0 / (1.0 + np.exp(-given @ weights))
        slope = given.T @ (chances - is_right)
        bend = (given * (chances * (1.0 - chances))[:, None]).T @ given
        weights = weights - np.linalg.solve(bend, slope)
    return weights


if __name__ == "__main__":
    main()
