"""How often a command is taken for one that was not said, and whether the right slot is in doubt.

    python -m benchmarks.speech.slots --set cafe --condition clean

hears sentences in and outside of a grammar, said by three voices (see `slot_clips`), and with
`--set orders` the orders of people; one JSON row for each figure. `--dump DIR` keeps what was
heard; `--replay DIR` judges that again, which takes a fraction of the time. Ends with status 1
where a limit is missed.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any, Literal

from benchmarks.speech.slot_clips import (
    GRAMMARS,
    LEVELS,
    SPEAKERS,
    Saying,
    grammar,
    is_near,
    meaning,
    sayings,
)
from benchmarks.speech.slot_dump import Dump, Listened, dumped, file_name
from benchmarks.speech.voices import VOICES
from hri.bench.speech import recordings_beside
from hri.bench.speech.flite_voices import RATE
from hri.bench.speech.samples import Clip, Recordings, read_recordings
from hri.bench.table import Limit, Row, at_least, at_most, share
from hri.core.clock import FakeClock
from hri.core.signals import Rejection, Utterance
from hri.hal.recognizer import Hypothesis, Segment
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.acceptance import STRICTNESS
from hri.speech.grammar.matching import parse
from hri.speech.grammar.words import listed
from hri.speech.hearing import hear
from hri.speech.recognizers.automatic import AutomaticRecognizer
from hri.speech.understanding import Heard, understand

TOLD = 400
"""Clips that a row names."""

WRONG = "accepted with a wrong meaning"
LIMITS: Mapping[str, Limit] = {
    f"house, outside, clean: {WRONG}": at_most(0.08),
    "house, inside, clean: right": at_least(0.95),
    # Half of what was accepted wrongly before slots were judged, and what was right then.
    "orders, 12 dB: wrong": at_most(0.0235),
    "orders, 6 dB: wrong": at_most(0.0535),
    "orders, clean: right after one question": at_least(0.98),
    "orders, 12 dB: right after one question": at_least(0.887),
    "orders, 6 dB: right after one question": at_least(0.667),
}
"""By what is measured."""

Verdict = Literal["right", "wrong", "asked", "rejected"]


class Listener(AutomaticRecognizer):
    """The default engine, which remembers the pieces that it decoded."""

    def _open(self) -> None:
        super()._open()
        self.decoded: list[tuple[Segment, Hypothesis]] = []

    def decode(self, segment: Segment, rules: Collection[str] | None = None) -> Hypothesis:
        hypothesis = super().decode(segment, rules)
        self.decoded.append((segment, hypothesis))
        return hypothesis


@cache
def _engine(set_: str) -> Listener:
    engine = Listener(Description("recognizer", "Hri.Recognizer"), ResourceManager((), FakeClock()))
    engine.activate()
    engine.start(grammar(set_))
    return engine


def heard_of(saying: Saying) -> Listened:
    """What the default engine makes of a clip, and of an order that is said again."""
    pieces, heard = _hear(saying.set, saying.clip)
    again, heard_again = _hear(saying.set, saying.other) if saying.other else ([], [])
    return Listened(saying, pieces, heard, again, heard_again)


def _hear(set_: str, clip: Clip) -> tuple[list[Segment], list[Heard]]:
    engine = _engine(set_)
    engine.decoded.clear()
    heard = list(hear(clip.samples, RATE, engine, grammar(set_)))
    return [_piece_of(one, engine.decoded) for one in heard], heard


def _piece_of(heard: Heard, decoded: Sequence[tuple[Segment, Hypothesis]]) -> Segment:
    """The piece of speech that something was heard in: the last one with these words."""
    fitting = [segment for segment, found in decoded if listed(found.text) == heard.text]
    return fitting[-1] if fitting else decoded[-1][0]


def judged_again(one: Listened) -> Listened:
    """The same pieces of speech as the present code hears them."""
    saying = one.saying
    heard, again = (
        [
            understand(_engine(saying.set), grammar(saying.set), piece, STRICTNESS, None)
            for piece in pieces
        ]
        for pieces in (one.pieces, one.again)
    )
    return Listened(saying, one.pieces, heard, one.again, again)


# --- what became of a clip ---


def verdict(one: Listened) -> Verdict:
    """What became of it: `asked` where a slot, or one of two commands, is asked for."""
    accepted = [heard for heard in one.heard if isinstance(heard, Utterance)]
    if accepted:
        is_right = len(accepted) == 1 and one.saying.is_meant(accepted[0].rule, accepted[0].tags)
        return "right" if is_right else "wrong"
    return "asked" if _asked(one) is not None else "rejected"


def _asked(one: Listened) -> Rejection | None:
    """The clearest piece that is asked about: beside the sentence, noise may sound like another."""
    rejected = (heard for heard in one.heard if isinstance(heard, Rejection))
    asked = [heard for heard in rejected if heard.unsure or heard.choices]
    return max(asked, key=lambda heard: heard.confidence, default=None)


def names_the_slot(one: Listened) -> bool:
    """Whether what is asked for was heard wrong: a value that was not said."""
    asked = _asked(one)
    return asked is not None and bool(set(asked.unsure) & _wrong_slots(one.saying, asked.text))


def _wrong_slots(saying: Saying, text: str) -> set[str]:
    """Of the nearest sentence the tags that were not meant; outside, whose words were not said."""
    found = parse(grammar(saying.set), text)
    if found is None:
        return set()
    if saying.kind == "outside":
        said = set(saying.clip.sentence.split())
        return {name for name, value in found.tags.items() if set(str(value).split()) - said}
    wanted = saying.meant or {}
    tags = wanted.get("tags", wanted)
    return {name for name, value in found.tags.items() if tags.get(name) != value}


def is_right_when_asked(one: Listened) -> bool:
    """Whether it is right at once, or after its unsure slots were said again."""
    if (now := verdict(one)) != "asked":
        return now == "right"
    asked = _asked(one)
    assert asked is not None
    answered = _tags_again(one, _doubted(one.saying.set, asked))
    tags = dict(asked.sure) | {name: answered[name] for name in asked.unsure if name in answered}
    return bool(asked.unsure) and meaning(one.saying.set, "", tags) == one.saying.meant


def _tags_again(one: Listened, doubted: Mapping[str, Any]) -> dict[str, Any]:
    """What was understood of the order that was said again, as far as it is sure or the same."""
    heard = max(one.heard_again, key=lambda heard: heard.confidence, default=None)
    if heard is None:
        return {}
    if isinstance(heard, Utterance):
        return dict(heard.tags)
    again = _doubted(one.saying.set, heard)
    same = {name: value for name, value in again.items() if doubted.get(name) == value}
    return {**same, **heard.sure}


def _doubted(set_: str, heard: Rejection) -> dict[str, Any]:
    """The values that were heard and are not sure."""
    found = parse(grammar(set_), heard.text)
    tags = {} if found is None else found.tags
    return {name: tags[name] for name in heard.unsure if name in tags}


# --- the rows ---


def rows(set_: str, level: str, listened: Iterable[Listened]) -> Iterator[Row]:
    """The figures of a set at a level of noise, of near sentences also by themselves."""
    by_kind: dict[str, list[Listened]] = {}
    for one in listened:
        by_kind.setdefault(one.saying.kind, []).append(one)
    for kind, clips in by_kind.items():
        what = set_ if kind == "orders" else f"{set_}, {kind}"
        yield from _rows_of(what, level, kind, clips)
        if kind == "outside":
            near = [one for one in clips if is_near(set_, one.saying.clip.sentence)]
            yield from _rows_of(f"{set_}, near", level, kind, near)


def _rows_of(what: str, level: str, kind: str, clips: Sequence[Listened]) -> Iterator[Row]:
    if not clips:
        return

    def counted(name: str, hits: Sequence[Listened]) -> Row:
        told = [_told(one) for one in hits[:TOLD]]
        # Of people's orders the noise, since each is of someone else.
        by = Counter(one.saying.clip.voice or one.saying.condition for one in hits)
        measured = f"{what}, {level}: {name}"
        row = share(measured, len(hits), len(clips), LIMITS.get(measured))
        return row | {"by": dict(sorted(by.items())), "clips": told}

    by_verdict: dict[Verdict, list[Listened]] = {}
    for one in clips:
        by_verdict.setdefault(verdict(one), []).append(one)
    right, wrong = by_verdict.get("right", []), by_verdict.get("wrong", [])
    asked, rejected = by_verdict.get("asked", []), by_verdict.get("rejected", [])
    is_outside = kind == "outside"
    yield counted("accepted, with the same meaning" if is_outside else "right", right)
    yield counted(WRONG if is_outside else "wrong", wrong)
    named = [one for one in asked if names_the_slot(one)]
    yield counted("asked about, the slot named that was not heard right", named)
    yield counted("asked about otherwise", [one for one in asked if one not in named])
    yield counted("rejected", rejected)
    if kind == "orders":
        yield counted("right after one question", [o for o in clips if is_right_when_asked(o)])


def _told(one: Listened) -> str:
    heard = "; ".join(map(_told_of, one.heard)) or "nothing"
    name = one.saying.clip.name + (f" {one.saying.condition}" if one.saying.set == "orders" else "")
    return f"{name} -> {heard}"


def _told_of(heard: Heard) -> str:
    if isinstance(heard, Utterance):
        return f'"{heard.text}" {heard.confidence:.2f}'
    unsure = f", unsure {' '.join(heard.unsure)}" if heard.unsure else ""
    return f'"{heard.text}" {heard.confidence:.2f} {heard.reason}{unsure}'


def _listened(
    set_: str, level: str, people: Recordings | None, options: argparse.Namespace
) -> Iterator[Listened]:
    if options.replay:
        for one in dumped(options.replay, set_, level):
            if not options.voices or one.saying.clip.voice in ("", *options.voices):
                yield judged_again(one)
        return
    dump = Dump(options.dump, file_name(set_, level)) if options.dump else None
    voices = options.voices or SPEAKERS
    for saying in sayings(set_, level, people, options.cache, voices, options.step, options.draw):
        one = heard_of(saying)
        if dump is not None:
            dump.add(one)
        yield one
    if dump is not None:
        dump.write()


def main() -> None:
    """Print the rows. Raises SystemExit."""
    parser = argparse.ArgumentParser(description=__doc__)
    add = parser.add_argument
    add("--set", choices=(*GRAMMARS, "all"), default="all")
    add("--condition", choices=("clean", "12", "6", "all"), default="all", help="level of noise")
    add("--voices", nargs="+", choices=VOICES, default=(), metavar="VOICE", help="default: three")
    add("--recordings", type=Path, default=recordings_beside(), metavar="DIR")
    add("--step", type=int, default=1, metavar="N", help="take every N-th sentence only")
    add("--draw", type=int, default=0, metavar="N", help="other noise")
    add("--cache", type=Path, metavar="DIR", help="keep the sound of the voices there")
    add("--dump", type=Path, metavar="DIR", help="keep what was heard there")
    add("--replay", type=Path, metavar="DIR", help="judge again what was kept there")
    add("--brief", action="store_true", help="do not name the clips")
    options = parser.parse_args()
    people = read_recordings(options.recordings) if options.recordings else None
    status = 0
    for level in LEVELS:
        if options.condition not in ("all", level.removesuffix(" dB")):
            continue
        for set_ in GRAMMARS if options.set == "all" else (options.set,):
            print(f"{set_}, {level}", file=sys.stderr)
            for row in rows(set_, level, _listened(set_, level, people, options)):
                if options.brief:
                    row.pop("clips")
                print(json.dumps(row), flush=True)
                status |= not row.get("passed", True)
    raise SystemExit(status)


if __name__ == "__main__":
    main()
