"""Plays conversations to the simulated companion, and sums up what readers make of them."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from time import perf_counter

from benchmarks.conversation import figures, judging, transcript, visits
from benchmarks.conversation.playing import play_all
from benchmarks.conversation.talks import SETS, load_talks
from benchmarks.progress import progress
from hri.core.errors import HriError

PLAYED = Path("build/conversation")
"""Where transcripts are written unless told otherwise."""


def main() -> None:
    """Raises SystemExit."""
    options = _parser().parse_args()
    command: Callable[[argparse.Namespace], None] = options.command
    try:
        command(options)
    except HriError as error:
        raise SystemExit(str(error)) from error


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.conversation", description=__doc__)
    commands = parser.add_subparsers(required=True)
    play = commands.add_parser("play", help="play each talk to a fresh robot")
    play.add_argument("set", nargs="?", default="open", choices=SETS)
    play.add_argument("--writer", default="", metavar="NAME", help="only the talks of this writer")
    play.set_defaults(command=_play)
    visit = commands.add_parser("visits", help="play visits to a robot that remembers")
    visit.add_argument("--count", type=int, default=20, metavar="N", help="how many; 20")
    visit.set_defaults(command=_visits)
    for written in (play, visit):
        written.add_argument("--out", type=Path, metavar="FILE", help="the transcript to write")
    judge = commands.add_parser("judge", help="sum up the verdicts of one or two readers")
    judge.add_argument("transcripts", nargs="+", type=Path, metavar="TRANSCRIPT")
    what = judge.add_mutually_exclusive_group(required=True)
    what.add_argument("--for-readers", action="store_true", help="print the form to fill in")
    what.add_argument("--by", nargs="+", type=Path, metavar="FILE", help="filled-in forms, 1 or 2")
    judge.set_defaults(command=_judge)
    return parser


def _play(options: argparse.Namespace) -> None:
    begun = perf_counter()
    lines = play_all(load_talks(options.set, writer=options.writer))
    _write(lines, options.out or PLAYED / f"{options.set}.jsonl")
    is_toy = options.set == "toy"
    print(*figures.table(lines, intents=is_toy), sep="\n")
    if is_toy:
        whole, some, total = figures.intents_understood(lines)
        print(f"intents understood: {whole} of {total} in all sentences, {some} in at least one")
    else:
        print(figures.told_again(lines))
    print(f"seconds: {perf_counter() - begun:.0f}")


def _visits(options: argparse.Namespace) -> None:
    begun = perf_counter()
    drawn = visits.drawn(load_talks("open"), options.count)
    played = progress(visits.lived(drawn), len(drawn), "visits")
    lines = [line for visit in played for line in visit]
    _write(lines, options.out or PLAYED / "visits.jsonl")
    print(*figures.table(lines), sep="\n")
    print(figures.told_again(lines))
    print(f"seconds: {perf_counter() - begun:.0f}")


def _write(lines: list[transcript.Line], file: Path) -> None:
    transcript.write(lines, file)
    print(f"transcript: {file}")


def _judge(options: argparse.Namespace) -> None:
    lines = transcript.read_all(options.transcripts)
    if options.for_readers:
        print(*transcript.for_readers(lines), sep="\n")
        return
    if len(options.by) > 2:
        raise HriError(f"{len(options.by)} files of verdicts - name one or two")
    readers = [judging.read_verdicts(file, lines) for file in options.by]
    print(*judging.report(lines, readers), sep="\n")


if __name__ == "__main__":
    main()
