"""`hri grammar confuse`: finds sentences that sound alike but differ in meaning."""

from __future__ import annotations

import argparse
import json
import sys

from hri.cli.grammar import FILE_HELP
from hri.cli.grammar.engine import add_engine_arguments, add_strictness, started_engine
from hri.cli.grammar.expand import in_words
from hri.cli.grammar.manifest import spoken, usual_voices
from hri.cli.terminal.messages import Within
from hri.cli.terminal.progress_line import waiting
from hri.core.quoting import report
from hri.core.statistics import told
from hri.speech.grammar import Grammar, load_grammar
from hri.speech.grammar.expansion import count_ways
from hri.speech.grammar.lint.confusion import FARTHEST, SoundAlike, sound_alikes
from hri.speech.grammar.lint.expectations import meaning_of
from hri.speech.grammar.matching import Parse, parse
from hri.speech.language import complaint, foreign
from hri.speech.pronunciation.lexicon import load_lexicon
from hri.speech.trials import Attempt, attempt, confusions, score

EXAMPLES = """\
examples:
  hri grammar confuse companion                  pairs that are near by their phones
  hri grammar confuse companion --speak          speak sentences in several voices, hear them again
  hri grammar confuse my.jsgf --speak --sentences 300 --voices en-us en-gb flite:slt

The distance is 0 for the same sound and 1 for nothing in common; below 0.1 expect confusions in
noise. What to do: say one of the two in other or in more words, or mark the rule @careful."""

MOST_COMPARED = 3000
"""Default of --sentences, compared by their phones."""
MOST_SPOKEN = 60
"""Default of --sentences with --speak, in every voice."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE", help=FILE_HELP)
    parser.add_argument(
        "-n", type=Within(int, 1), default=25, metavar="N", help="number of pairs to show (25)"
    )
    parser.add_argument(
        "--sentences",
        type=Within(int, 1),
        metavar="N",
        help=f"number of sentences to compare ({MOST_COMPARED}; with --speak {MOST_SPOKEN})",
    )
    parser.add_argument(
        "--farthest",
        type=Within(float, 0, 1),
        default=FARTHEST,
        metavar="D",
        help=f"distance ({FARTHEST})",
    )
    parser.add_argument("--speak", action="store_true", help="speak and recognize the sentences")
    parser.add_argument("--voices", nargs="+", metavar="VOICE", help="en-gb, flite:slt ...")
    add_strictness(parser)
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    add_engine_arguments(parser)


def run(options: argparse.Namespace) -> int:
    grammar = load_grammar(options.file)
    if language := foreign(grammar):
        print(f"{grammar.path}: {' - '.join(complaint(grammar, language))}", file=sys.stderr)
    most = options.sentences or (MOST_SPOKEN if options.speak else MOST_COMPARED)
    sentences = grammar.sample(most, grammar.spoken_rules)
    if options.speak:
        return _by_ear(options, grammar, sentences)
    with waiting("comparing"):
        readings = [
            found
            for text in sentences
            if (found := parse(grammar, text, grammar.spoken_rules)) is not None
        ]
        pairs = sound_alikes(readings, load_lexicon(), options.farthest)
    if options.json:
        told_pairs = [_pair_as_json(pair) for pair in pairs[: options.n]]
        print(json.dumps({"compared": len(readings), "pairs": told_pairs}, indent=2))
        return 0
    for pair in pairs[: options.n]:
        for line in _pair(pair).split("\n"):
            report(line)
    report(_compared(grammar, len(readings), len(pairs), options.farthest))
    return 0


def _pair(pair: SoundAlike) -> str:
    one, other = (words or "(nothing)" for words in pair.difference)
    return (
        f"{pair.distance:.2f}  {one}  ~  {other}\n"
        f'      "{pair.first.text}" {_meaning(pair.first)}\n'
        f'      "{pair.second.text}" {_meaning(pair.second)}'
    )


def _meaning(reading: Parse) -> str:
    return f"=> {meaning_of(reading)}"


def _compared(grammar: Grammar, compared: int, pairs: int, farthest: float) -> str:
    ways = count_ways(grammar)
    drawn = "" if ways <= compared else f", drawn from {in_words(ways)}"
    found = f"{pairs} {'pair' if pairs == 1 else 'pairs'} no farther apart than {farthest:g}"
    return f"{grammar.path}: {found} among {compared} sentences{drawn}"


def _pair_as_json(pair: SoundAlike) -> dict[str, object]:
    return {
        "distance": round(pair.distance, 4),
        "difference": list(pair.difference),
        "sentences": [
            {"text": reading.text, "rule": reading.rule, "tags": dict(reading.tags)}
            for reading in (pair.first, pair.second)
        ],
    }


def _by_ear(options: argparse.Namespace, grammar: Grammar, sentences: list[str]) -> int:
    voices = tuple(options.voices or usual_voices())
    with started_engine(options, grammar) as engine:
        clips = spoken(grammar, sentences, voices)
        heard = [attempt(clip, engine, grammar) for clip in clips]
    confused = confusions(heard, grammar, options.strictness)
    missed = _missed(heard, grammar, options.strictness)
    counts = score(heard, grammar, options.strictness)
    if options.json:
        print(
            json.dumps(
                {
                    "voices": list(voices),
                    "spoken": counts.commands,
                    "right": counts.right,
                    "confusions": [
                        {"said": said, "taken_for": taken, "times": times}
                        for (said, taken), times in confused.most_common()
                    ],
                    "missed": [{"said": said, "times": times} for said, times in missed],
                },
                indent=2,
            )
        )
        return 0
    for (said, taken), times in confused.most_common(options.n):
        report(f'{times} of {len(voices)} voices: "{said}" was taken for "{taken}"')
    for said, times in missed[: options.n]:
        report(f'{times} of {len(voices)} voices: "{said}" was not accepted')
    tried = f"{len(sentences)} sentences in {len(voices)} voices"
    right = told(counts.right, counts.commands)
    report(f"{grammar.path}: {tried}, right and accepted {right}")
    return 0


def _missed(heard: list[Attempt], grammar: Grammar, strictness: float) -> list[tuple[str, int]]:
    """Rejected sentences, and in how many voices; the worst first."""
    counts: dict[str, int] = {}
    for tried in heard:
        if not tried.accepted(grammar, strictness):
            counts[tried.said] = counts.get(tried.said, 0) + 1
    return sorted(counts.items(), key=lambda item: -item[1])
