"""What lasts, as a personality feels it: states begin and end, goals are open and decided."""

from __future__ import annotations

from collections.abc import Mapping

from hri.emotion import relations
from hri.emotion.affect import Imprint, with_charges
from hri.emotion.appraisal import GoalEvent, prospects
from hri.emotion.emotions import in_parts
from hri.emotion.fading import FORGOTTEN, Fading
from hri.emotion.held import MOST, SOON_S, Held, Level
from hri.emotion.ledger import STILL, LedgerRow, Origin, merged
from hri.emotion.stimulus import HeldSpec

RELIEF, LOSS = 1.2, 0.3
"""Of the charge of a state that ends, that of the relief, and of the sadness, at its end."""
GIVEN_UP = 8.0
"""Times the expected seconds after which a goal is not thought of any more."""
LONGEST_OPEN_S = 86400.0
"""The same for a goal that may take any time."""
LET_GO_S = 60.0
"""Seconds in which hope and fear for it fall to 1/e then."""


class States:
    """The arithmetic of states for one personality; imprints go in and come out."""

    def __init__(self, fading: Fading, gains: Mapping[str, float]) -> None:
        """`gains` are the personality's, by emotion."""
        self._fading = fading
        self._gains = gains

    def begin(
        self, imprint: Imprint, origin: Origin, spec: HeldSpec, charges: Mapping[str, float]
    ) -> Imprint:
        """A state that goes on from now on, and the charges by emotion where it goes."""
        before = imprint.held.get(origin)
        row = LedgerRow({}, STILL, imprint.time)
        if before is not None:
            row = self._fading.held(before, imprint.time)
        names = {**charges, **row.charges}
        held = Held(
            since=imprint.time,
            levels={n: Level(row.charges.get(n, 0.0), charges.get(n, 0.0)) for n in names},
            rate=1.0 / spec.rise_s,
            mood=row.mood,
            until=imprint.time + spec.for_s,
            fall_rate=1.0 / spec.fall_s,
        )
        return self._with(imprint, origin, held)

    def open(self, imprint: Imprint, origin: Origin, event: GoalEvent, peak: float) -> Imprint:
        """A goal for which hope and fear are held; `peak` is how likely it ever was before."""
        before = imprint.held.get(origin)
        now, later = (
            {name: self._gains[name] * charge for name, charge in levels.items()}
            for levels in prospects(event)
        )
        likelihood, doubts = event.likelihood_after, event.doubt_rate
        lasts = LONGEST_OPEN_S if event.expected_s is None else GIVEN_UP * event.expected_s
        held = Held(
            since=imprint.time,
            levels={name: Level(now[name], later[name]) for name in now},
            rate=doubts or 1.0 / SOON_S,
            mood=STILL if before is None else self._fading.held(before, imprint.time).mood,
            until=imprint.time + lasts,
            fall_rate=1.0 / LET_GO_S,
            likelihood=Level(likelihood, 0.0 if doubts else likelihood),
            peak=max(likelihood, peak),
        )
        return self._with(imprint, origin, held)

    def end(self, imprint: Imprint, origin: Origin) -> Imprint:
        """A state that is over; without a person, whoever it was about."""
        for other in imprint.held:
            if other == origin or (origin.person is None and other.name == origin.name):
                imprint = self._over(imprint, other)
        return imprint

    def let_go(self, imprint: Imprint, origin: Origin) -> Imprint:
        """A state of which no more than its pull on the mood is left."""
        row = self._fading.held(imprint.held[origin], imprint.time)
        pull = LedgerRow({}, row.mood, row.time)
        before = imprint.ledger.get(origin)
        return imprint._replace(
            held={other: held for other, held in imprint.held.items() if other != origin},
            ledger={**imprint.ledger, origin: pull if before is None else merged(before, pull)},
        )

    def without_faded(self, imprint: Imprint) -> Imprint:
        """Without states of which nothing is left to feel, and words that nobody needs any more."""
        for origin, held in imprint.held.items():
            if held.until <= imprint.time:
                held = self._fading.ended(held)
                imprint = imprint._replace(held={**imprint.held, origin: held})
            if held.is_over and all(
                held.at(level, imprint.time) < FORGOTTEN for level in held.levels.values()
            ):
                imprint = self.let_go(imprint, origin)
        if imprint.words:
            causes = {origin.name for origin in (*imprint.ledger, *imprint.held)}
            if not causes >= imprint.words.keys():
                kept = {name: said for name, said in imprint.words.items() if name in causes}
                imprint = imprint._replace(words=kept)
        return imprint

    def _over(self, imprint: Imprint, origin: Origin) -> Imprint:
        """A state that ends now and fades: a relief, or a small loss.

        How large it is follows from the charges that the neutral personality would have.
        """
        held = imprint.held[origin]
        if held.until <= imprint.time or held.is_over:
            return imprint
        charges = self._fading.held(held, imprint.time).charges
        ended = self._fading.ended(held._replace(until=imprint.time))
        pleased = displeased = 0.0
        for name, charge in charges.items():
            if gain := self._gains[name]:
                if relations.SIGNS[name] > 0:
                    pleased += charge / gain
                else:
                    displeased += charge / gain
        after = {
            "relief": self._gains["relief"] * RELIEF * displeased,
            "sadness": self._gains["sadness"] * LOSS * pleased,
        }
        after = {name: charge for name, charge in after.items() if charge}
        fresh = with_charges(imprint.fresh, origin, in_parts(after)) if after else imprint.fresh
        return imprint._replace(held={**imprint.held, origin: ended}, fresh=fresh)

    def _with(self, imprint: Imprint, origin: Origin, held: Held) -> Imprint:
        """With a state among those that go on, whatever was held for the same before."""
        imprint = imprint._replace(held={**imprint.held, origin: held})
        if len(imprint.held) > MOST:
            faintest = min(
                imprint.held,
                key=lambda other: sum(
                    self._fading.held(imprint.held[other], imprint.time).charges.values()
                ),
            )
            imprint = self.let_go(imprint, faintest)
        return imprint
