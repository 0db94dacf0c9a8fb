"""Answers to a yes/no question, typed and spoken, and other sentences said instead of one."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from benchmarks.speech import ears, printed
from benchmarks.speech.conditions import heard_in
from benchmarks.speech.ears import companion, typed
from benchmarks.speech.texts import blocks
from benchmarks.speech.voices import spoken
from hri.bench.speech.listening import Heard
from hri.bench.speech.samples import Recordings
from hri.bench.table import Limit, Row, at_least, at_most, share
from hri.core.errors import NotAvailable
from hri.speech.turn import Turn

KEPT_ASIDE = "answers.txt"
"""Sentences that whoever writes grammars/answers.jsgf has not seen."""
LEARNED = "answers_learned.txt"
"""Sentences that it was written from: their rows have no limit."""
OTHER = "other"
"""Heading of what is not an answer."""
CONDITIONS = ("clean", "12 dB")
LEAST = 0.95
"""Share of the answers that must be understood."""
TOLD = 4
"""Different things that a row says a sentence was taken for."""
QUESTION = Turn(is_question_open=True)


@dataclass(frozen=True, slots=True)
class Try:
    """One sentence, said once."""

    kind: str
    sentence: str
    voice: str
    heard: Sequence[Heard]

    @property
    def answer(self) -> str:
        """The answer that it was taken for: the first that was heard; empty for none."""
        answers = companion().marked("answer")
        taken = [one.rule for one in self.heard if one.is_accepted and one.rule in answers]
        return taken[0] if taken else ""


def rows(people: Recordings | None, step: int = 1) -> Iterator[Row]:
    """Of both files: typed, then spoken by eight voices in each condition. Raises NotAvailable
    without flite or recordings.
    """
    yield from _rows(KEPT_ASIDE, people, step)
    for row in _rows(LEARNED, people, step):
        yield {key: value for key, value in row.items() if key not in ("limit", "side", "passed")}


def _rows(file: str, people: Recordings | None, step: int) -> Iterator[Row]:
    of = ", learned from" if file == LEARNED else ""
    kinds = {sentence: kind for kind, sentence in list(blocks(file))[::step]}
    lines = [Try(kind, text, "typed", [typed(text, QUESTION)]) for text, kind in kinds.items()]
    yield from _counted(f"typed{of}", lines)
    if people is None:
        raise NotAvailable("no recordings of people - name their folder with --recordings")
    said = list(spoken(list(kinds)))
    for condition in CONDITIONS:
        clips = list(heard_in(condition, said, [*people.orders, *people.read]))
        outcomes = ears.heard(clips, QUESTION, f"answers, {condition}")
        tries = [
            Try(kinds[one.clip.sentence], one.clip.sentence, one.clip.voice, one.heard)
            for one in outcomes
        ]
        yield from _counted(f"spoken, {condition}{of}", tries)


def _counted(how: str, tries: Sequence[Try]) -> Iterator[Row]:
    answers = [one for one in tries if one.kind != OTHER]
    others = [one for one in tries if one.kind == OTHER]

    def row(
        what: str, of: Sequence[Try], counts: Callable[[Try], bool], limit: Limit | None
    ) -> Row:
        return share(f"{what}, {how}", sum(map(counts, of)), len(of), limit)

    yield row(
        "answers understood", answers, lambda one: one.answer == one.kind, at_least(LEAST)
    ) | {"clips": _sentences([one for one in answers if one.answer != one.kind])}
    for kind in dict.fromkeys(one.kind for one in answers):
        yield row(
            f"of these {kind}",
            [one for one in answers if one.kind == kind],
            lambda one: one.answer == one.kind,
            None,
        )
    yield row(
        "taken for another answer", answers, lambda one: one.answer not in ("", one.kind), None
    )
    yield row(
        "other sentences taken for an answer", others, lambda one: bool(one.answer), at_most(0)
    ) | {"clips": _sentences([one for one in others if one.answer])}


def _sentences(tries: Sequence[Try]) -> list[str]:
    """For people: each sentence once, how often it failed, and what it was taken for."""
    made: dict[str, Counter[str]] = {}
    for one in tries:
        taken = "; ".join(f'"{heard.text}" {_verdict(heard)}' for heard in one.heard) or "nothing"
        made.setdefault(f"{one.kind}: {one.sentence}", Counter())[taken] += 1
    return [
        f"{sentence} - {found.total()}: "
        + ", ".join(f"{count} {taken}" for taken, count in found.most_common(TOLD))
        for sentence, found in made.items()
    ]


def _verdict(heard: Heard) -> str:
    return f"<{heard.rule}>" if heard.is_accepted else heard.reason


if __name__ == "__main__":
    printed.main(__doc__, rows)
