"""Facial expressions of everyone who is seen, in a network."""

from __future__ import annotations

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output, Param
from hri.core import paths
from hri.core.signals import People
from hri.vision.expressions.expression_patterns import FILE, load_expression_patterns
from hri.vision.expressions.expression_recognizer import FacialExpression, PeopleExpressions
from hri.vision.gestures.gesture_file import FACIAL_EXPRESSION, chosen

ALL = "all"


class FacialExpressions(Behavior):
    """Recognizes smiles, brows and blinks, and reports them: how faces look, not what people feel.

    `person.expressed` says that one shows, `person.relaxed` that one that lasts is over, each with
    the `person`, the `expression` (its row of the file of patterns), and the `seconds` since it
    began. A blink is reported once, by `person.expressed`. Needs the face mesh.
    """

    category = "vision"

    expressions = Param(ALL, "which ones, with spaces between; all of the file for all")
    patterns = Param(FILE, "the file that says what counts as which expression")

    people = Input[People]("people", "everyone who is seen")
    shown = Output[str]("string", "what the one attended to shows now; empty at rest")

    def start(self, context: Context) -> None:
        self._events = context.events
        known = load_expression_patterns(paths.find("config", self.patterns))
        names = known if self.expressions.strip() == ALL else self.expressions.split()
        rows = {row.name: row for row in chosen(known, names, FACIAL_EXPRESSION)}
        self._brief = {row.name for row in rows.values() if row.is_brief}
        self._recognizer = PeopleExpressions(rows.values())

    def compute(self, now: float, dt: float) -> None:
        if (people := self.people.value) is not None:
            for one in self._recognizer.update(people):
                self._tell(one)
            self.shown.send(" ".join(self._recognizer.shown_by(people.attended)))

    def _tell(self, one: FacialExpression) -> None:
        is_over = one.is_over and one.kind not in self._brief
        self._events.raise_event(
            "person.relaxed" if is_over else "person.expressed",
            person=one.person,
            expression=one.kind,
            seconds=round(one.seconds, 3),
        )
