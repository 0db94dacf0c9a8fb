"""`hri grammar calibrate`: recommends a strictness for a grammar, a room and its people."""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path

from hri.cli.grammar import FILE_HELP
from hri.cli.grammar.engine import add_engine_arguments, started_engine
from hri.cli.grammar.manifest import read_manifest, spoken, usual_voices
from hri.cli.terminal.messages import Within
from hri.cli.terminal.progress_line import progress
from hri.core.errors import HriError
from hri.core.quoting import report
from hri.core.statistics import told
from hri.speech.acceptance import STRICTNESS
from hri.speech.grammar import Grammar, load_grammar
from hri.speech.grammar.matching import parse
from hri.speech.language import foreign
from hri.speech.trials import NEARLY, Attempt, RecordedClip, Score, attempt, recommended, score

EXAMPLES = """\
examples:
  hri grammar calibrate companion                       with synthetic voices
  hri grammar calibrate companion --audio manifest.tsv  with recordings: your room, your people

A manifest has a line for each recording, a tab between its columns: file, and what is said in it;
- for something that the grammar does not allow. Record both kinds where the robot will be: twenty
commands, and twenty sentences of other talk. Nothing is written: put the line that is printed last
into the network."""

STRICTNESSES = tuple(step / 20 for step in range(2, 20))
"""Strictnesses to try: 0.1 to 0.95."""
SHOWN = STRICTNESSES[::2]
FEWEST = 20
"""Sentences of each kind; with fewer, a single error changes the result."""
MOST_SPOKEN = 40
"""Sentences of the grammar that are spoken in every voice."""
FOREIGN_SHARE = 0.02
"""Default of --foreign: the accepted share of out-of-grammar speech."""

OTHER_TALK = (
    "did you see the game last night",
    "the soup needs a little more salt",
    "my sister is coming on wednesday",
    "we should paint the fence this summer",
    "he never answers his phone",
    "i left the umbrella on the train",
    "that is the third time this week",
    "the neighbors have bought a boat",
    "could somebody pass me the butter",
    "what a strange thing to say",
    "they moved to another city",
    "i have no idea where the keys are",
    "it will probably rain tomorrow",
    "she plays the piano very well",
    "remember to water the plants",
    "the meeting was longer than i thought",
    "no one told me about it",
    "this coffee is cold",
    "we could go by bicycle",
    "turn the page and read the next line",
    "i will be right back",
    "the dog wants to go out",
    "yesterday",
    "maybe later",
)
"""Sentences of everyday talk, without those that the grammar allows."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE", help=FILE_HELP)
    parser.add_argument("--audio", type=Path, metavar="MANIFEST", help="recordings to try")
    parser.add_argument(
        "--speak", action="store_true", help="synthetic voices (the default without --audio)"
    )
    parser.add_argument("--voices", nargs="+", metavar="VOICE", help="en-gb, flite:slt ...")
    parser.add_argument(
        "--sentences",
        type=Within(int, 1),
        default=MOST_SPOKEN,
        metavar="N",
        help=f"({MOST_SPOKEN})",
    )
    parser.add_argument(
        "--foreign",
        type=Within(float, 0, 1),
        default=FOREIGN_SHARE,
        metavar="SHARE",
        help=f"accepted share of other talk, 0 to 1 ({FOREIGN_SHARE})",
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    add_engine_arguments(parser)


def run(options: argparse.Namespace) -> int:
    grammar = load_grammar(options.file)
    with started_engine(options, grammar) as engine:
        heard = [attempt(clip, engine, grammar) for clip in _clips(options, grammar)]
    if not any(tried.meaning is None for tried in heard):
        raise HriError("no out-of-grammar recordings - add lines with -")
    scores = [score(heard, grammar, strictness) for strictness in STRICTNESSES]
    best = recommended(scores, options.foreign)
    if options.json:
        print(json.dumps(_as_json(scores, best), indent=2))
    else:
        _show(scores, best, heard)
    return 0


def _clips(options: argparse.Namespace, grammar: Grammar) -> Iterable[RecordedClip]:
    """The recordings of a manifest, and synthetic speech."""
    if options.audio is not None:
        rows = read_manifest(options.audio, grammar)
        yield from (row.clip() for row in progress(rows, len(rows), "hearing"))
    if options.speak or options.audio is None:
        if not options.voices and (language := foreign(grammar)):
            remedy = f"name some of {language} with --voices, or recordings with --audio"
            raise HriError(f"{grammar.path}: the usual voices speak English - {remedy}")
        voices = tuple(options.voices or usual_voices())
        other = [sentence for sentence in OTHER_TALK if parse(grammar, sentence) is None]
        sentences = [*grammar.sample(options.sentences, grammar.spoken_rules), *other]
        yield from spoken(grammar, sentences, voices)


def _show(scores: list[Score], best: Score, heard: list[Attempt]) -> None:
    foreign = scores[0].foreign
    print(f"{len(heard) - foreign} commands and {foreign} other sentences, shares in percent\n")
    print("strictness   right and accepted   taken for another   other talk accepted")
    for one in scores:
        if one.strictness in SHOWN or one is best:
            mark = "  <- recommended" if one is best else ""
            mark += "  (the default)" if one.strictness == STRICTNESS else ""
            report(
                f"      {one.strictness:4.2f}   {_percent(one.right, one.commands):>18}"
                f"   {_percent(one.wrong, one.commands):>17}"
                f"   {_percent(one.foreign_accepted, one.foreign):>19}{mark}"
            )
    print(
        f"\nrecommended: the strictest that loses at most {NEARLY:.0%} of the commands, to have a"
    )
    print("margin for talk and rooms that were not tried")
    report(f"right and accepted: {told(best.right, best.commands)}")
    report(f"other talk accepted: {told(best.foreign_accepted, best.foreign)}")
    print("(in brackets: 95 % confidence interval)")
    if _are_too_few(best):
        report(f"too few to be reliable: try {FEWEST} commands and {FEWEST} others, or more")
    print()
    print("In the network, among the parameters of Hri.Recognizer:")
    report(f'  <Parameter name="strictness" value="{best.strictness:g}"/>')


def _percent(count: int, total: int) -> str:
    return f"{100 * count / total:.1f}" if total else "-"


def _are_too_few(score: Score) -> bool:
    return min(score.commands, score.foreign) < FEWEST


def _as_json(scores: list[Score], best: Score) -> dict[str, object]:
    return {
        "recommended": best.strictness,
        "too_few": _are_too_few(best),
        "scores": [asdict(one) for one in scores],
    }
