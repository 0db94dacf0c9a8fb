"""`hri grammar confuse`: finds sentences that sound alike but differ in meaning, and words and
sentences from outside that would be taken for some of the grammar.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

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
from hri.speech.grammar.lint.outside_sentences import (
    FARTHEST_OUTSIDE,
    Taken,
    outside,
    read_sentences,
    taken_for,
)
from hri.speech.grammar.lint.outside_words import Beside, beside, value_lists
from hri.speech.grammar.matching import Parse, parse
from hri.speech.grammar.tags import spell_tags
from hri.speech.language import complaint, foreign, is_other_language
from hri.speech.pronunciation.lexicon import load_lexicon
from hri.speech.trials import Attempt, attempt, confusions, score

EXAMPLES = """\
examples:
  hri grammar confuse companion                  pairs that are near by their phones
  hri grammar confuse companion --speak          speak sentences in several voices, hear them again
  hri grammar confuse my.jsgf --speak --sentences 300 --voices en-us en-gb flite:slt
  hri grammar confuse my.jsgf --outside what_else.txt   which of these sentences are taken, for what

First come pairs of sentences, then common words beside the lists: nobody listed "soup", which is
heard as "soap". The distance is 0 for the same sound and 1 for nothing in common; below 0.1 expect
confusions in noise. What to do: say one of the two in other or in more words, list the word that
people may say, too, or mark the rule @careful.

--outside takes a sentence a line and shows those that the grammar does not allow and that sound
like one that it does, with the words that differ and the values that these would set. A blank line
and one that begins with # say nothing."""

MOST_COMPARED = 3000
"""Default of --sentences, compared by their phones."""
MOST_BESIDE = 4
"""Common words that are shown beside one of a list."""
MOST_SPOKEN = 60
"""Default of --sentences with --speak, in every voice."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE", help=FILE_HELP)
    parser.add_argument(
        "-n",
        type=Within(int, 1),
        default=25,
        metavar="N",
        help="number of pairs to show, of words and of sentences (25)",
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
        metavar="D",
        help=f"distance ({FARTHEST}; with --outside {FARTHEST_OUTSIDE})",
    )
    modes = parser.add_mutually_exclusive_group()
    modes.add_argument(
        "--outside",
        type=Path,
        metavar="SENTENCES",
        help="a file of sentences that mean none of the commands: show which are taken",
    )
    modes.add_argument("--speak", action="store_true", help="speak and recognize the sentences")
    parser.add_argument("--voices", nargs="+", metavar="VOICE", help="en-gb, flite:slt ...")
    add_strictness(parser)
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    add_engine_arguments(parser)


def run(options: argparse.Namespace) -> int:
    grammar = load_grammar(options.file)
    if language := foreign(grammar):
        print(f"{grammar.path}: {' - '.join(complaint(grammar, language))}", file=sys.stderr)
    if options.outside is not None:
        return _from_outside(options, grammar)
    most = options.sentences or (MOST_SPOKEN if options.speak else MOST_COMPARED)
    sentences = grammar.sample(most, grammar.spoken_rules)
    if options.speak:
        return _by_ear(options, grammar, sentences)
    farthest = FARTHEST if options.farthest is None else options.farthest
    with waiting("comparing"):
        readings = [
            found
            for text in sentences
            if (found := parse(grammar, text, grammar.spoken_rules)) is not None
        ]
        lexicon = load_lexicon()
        pairs = sound_alikes(readings, lexicon, farthest)
        words = sorted(
            () if is_other_language(grammar) else beside(value_lists(grammar), lexicon, farthest),
            key=lambda near: near.outside[0][1],
        )
    if options.json:
        result = {
            "compared": len(readings),
            "pairs": [_pair_as_json(pair) for pair in pairs[: options.n]],
            "beside": [_beside_as_json(near) for near in words[: options.n]],
        }
        print(json.dumps(result, indent=2))
        return 0
    for pair in pairs[: options.n]:
        for line in _pair(pair).split("\n"):
            report(line)
    if words:
        report("words beside the lists")
    for near in words[: options.n]:
        report(_beside(near))
    report(_compared(grammar, len(readings), len(pairs), farthest))
    if words:
        report(f"{grammar.path}: {len(words)} words of lists have a common word as near")
    return 0


def _beside(near: Beside) -> str:
    others = ", ".join(f'"{word}"' for word, _ in near.outside[:MOST_BESIDE])
    entry = "" if near.word == near.entry.text else f' in "{near.entry.text}"'
    value = spell_tags({near.tag: near.entry.value})
    return f"{near.outside[0][1]:.2f}  {others}  ~  {near.word}{entry} <{near.rule.key}> {value}"


def _beside_as_json(near: Beside) -> dict[str, object]:
    return {
        "rule": near.rule.key,
        "tags": {near.tag: near.entry.value},
        "entry": near.entry.text,
        "word": near.word,
        "outside": [
            {"word": word, "distance": round(distance, 4)} for word, distance in near.outside
        ],
    }


def _from_outside(options: argparse.Namespace, grammar: Grammar) -> int:
    farthest = FARTHEST_OUTSIDE if options.farthest is None else options.farthest
    said = read_sentences(options.outside)
    with waiting("comparing"):
        strange = outside(grammar, said)
        taken = taken_for(grammar, strange, load_lexicon(), farthest)
    if options.json:
        found = {"outside": len(strange), "taken": [_taken_as_json(each) for each in taken]}
        print(json.dumps(found, indent=2))
        return 0
    for each in taken[: options.n]:
        said_words, heard_words = (words or "(nothing)" for words in each.difference)
        sets = f", which sets {spell_tags(each.sets)}" if each.sets else ""
        report(f"{each.distance:.2f}  {said_words}  ~  {heard_words}{sets}")
        report(f'      "{each.said}"')
        report(f'      "{each.reading.text}" {_meaning(each.reading)}')
    near = f"no farther from one of the grammar than {farthest:g}"
    report(f"{grammar.path}: {len(taken)} of {len(strange)} outside sentences are {near}")
    return 0


def _taken_as_json(taken: Taken) -> dict[str, object]:
    reading = taken.reading
    return {
        "distance": round(taken.distance, 4),
        "text": taken.said,
        "difference": list(taken.difference),
        "taken_for": {"text": reading.text, "rule": reading.rule, "tags": dict(reading.tags)},
        "sets": taken.sets,
    }


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
