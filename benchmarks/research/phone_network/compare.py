"""Compares networks on the same pieces: `python compare.py FILE... --recordings FOLDER --draws 2`.

Of each weight file ("tree" is the one that comes with `hri`): how many commands and people's orders
are decoded right, in which no threshold has a part; how many are accepted right and wrong; and how
many sentences from outside of the grammar are accepted. These are the sounds of `hri bench speech`,
in other draws of the noise, with 95 % intervals.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

from benchmarks.speech.accuracy import GRAMMARS, Kind, sounds
from benchmarks.speech.conditions import CONDITIONS
from hri.bench.speech import samples
from hri.bench.speech.listening import Heard
from hri.bench.speech.samples import Clip
from hri.bench.speech.scoring import Outcome
from hri.core.clock import FakeClock
from hri.core.signals import Utterance
from hri.core.statistics import wilson
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.acceptance import judge
from hri.speech.grammar import Grammar, load_grammar
from hri.speech.grammar.matching import parse
from hri.speech.recognizers.ctc.decoder import CtcRecognizer

BATCH = 20
FIRST_DRAW = 101
"""Of the noise; the figures of the bench have other draws."""
KINDS: tuple[Kind, ...] = ("commands", "orders", "outside")


@dataclass(frozen=True, slots=True)
class Tally:
    """What was made of some clips."""

    clips: int = 0
    decoded: int = 0
    """Right, whether it was accepted or not."""
    accepted: int = 0
    """Accepted and right."""
    mistaken: int = 0
    """Accepted and wrong."""

    def __add__(self, other: Tally) -> Tally:
        return Tally(
            self.clips + other.clips,
            self.decoded + other.decoded,
            self.accepted + other.accepted,
            self.mistaken + other.mistaken,
        )


@cache
def ears(weights: str, kind: Kind) -> tuple[CtcRecognizer, Grammar]:
    """A recognizer with a grammar."""
    parameters = {} if weights == "tree" else {"weights": weights}
    resources = ResourceManager((), FakeClock())
    recognizer = CtcRecognizer(Description("ears", "Hri.Ctc", parameters), resources)
    grammar = load_grammar(GRAMMARS[kind])
    recognizer.activate()
    recognizer.start(grammar)
    return recognizer, grammar


def heard(clip: Clip, recognizer: CtcRecognizer, grammar: Grammar) -> list[Heard]:
    """What `hri grammar listen --wav` makes of a clip."""
    pieces = [*recognizer.listen(clip.samples, clip.seconds), *recognizer.flush()]
    found = []
    for piece in pieces:
        result = judge(grammar, piece, recognizer.decode(piece))
        is_accepted = isinstance(result, Utterance)
        rule, tags = (result.rule, result.tags) if is_accepted else ("", {})
        reason = "" if is_accepted else result.reason
        found.append(Heard(is_accepted, result.text, rule, tags, result.confidence, reason, 0.0))
    return found


def tally(weights: str, kind: Kind, clips: Sequence[Clip]) -> Tally:
    """What a network makes of clips."""
    recognizer, grammar = ears(weights, kind)
    total = Tally()
    for clip in clips:
        outcome = Outcome(clip, heard(clip, recognizer, grammar))
        total += Tally(1, is_decoded(outcome, grammar), outcome.is_right, outcome.is_mistaken)
    return total


def is_decoded(outcome: Outcome, grammar: Grammar) -> bool:
    """Whether the best sentence of a piece is what was said."""
    for piece in outcome.heard:
        if (found := parse(grammar, piece.text)) is not None:
            alone = Heard(True, piece.text, found.rule, found.tags, 1.0, "", 0.0)
            if Outcome(outcome.clip, [alone]).is_right:
                return True
    return False


def main() -> None:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+")
    parser.add_argument("--recordings", type=Path, required=True, help="see `hri bench speech`")
    parser.add_argument("--draws", type=int, default=1)
    parser.add_argument("--step", type=int, default=1, help="take every STEP-th clip")
    parser.add_argument("--kinds", nargs="+", default=KINDS, choices=KINDS)
    parser.add_argument("--conditions", nargs="+", default=list(CONDITIONS))
    args = parser.parse_args()
    people = samples.read_recordings(args.recordings)
    with ProcessPoolExecutor() as pool:
        for kind in args.kinds:
            for condition in args.conditions:
                count = args.draws if condition != "clean" else 1
                draws = range(FIRST_DRAW, FIRST_DRAW + count)
                said = [c for d in draws for c in sounds(people, kind, condition, args.step, d)]
                batches = [said[begin : begin + BATCH] for begin in range(0, len(said), BATCH)]
                for file in args.files:
                    parts = pool.map(partial(tally, file, kind), batches)
                    print(f"{kind:9} {condition:20} {told(sum(parts, Tally()), file)}", flush=True)


def told(total: Tally, file: str) -> str:
    """For people, in percent."""
    shares = []
    for what, count in (
        ("decoded", total.decoded),
        ("accepted", total.accepted),
        ("wrong", total.mistaken),
    ):
        low, high = wilson(count, total.clips)
        rate = 100 * count / total.clips
        shares.append(f"{what} {rate:5.1f} ({100 * low:.0f}-{100 * high:.0f})")
    return f"of {total.clips}: " + ", ".join(shares) + f"  {Path(file).stem}"


if __name__ == "__main__":
    main()
