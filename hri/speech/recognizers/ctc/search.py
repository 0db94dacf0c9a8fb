"""Exact search for the best sentence of a grammar, frame by frame, in numpy.

Token passing over the CTC topology: a phone lasts one frame or more, and blanks may follow it.
Every state holds two scores, of paths that end in its phone and of paths that end in a blank
after it. What came from where is kept as two bits a state and frame, so that a path is found by
walking back; where words end is kept as scores, for the sentences that were nearly as good.
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from hri.speech.recognizers.ctc.classes import BLANK
from hri.speech.recognizers.ctc.lattice import Path, Trellis, Walk
from hri.speech.recognizers.ctc.phone_graph import NOWHERE, Floats, PhoneGraph


class Search:
    """Best paths through a graph, for one piece of speech after another."""

    def __init__(self, graph: PhoneGraph) -> None:
        self.graph = graph
        size, places = graph.size, graph.places
        self._phone = np.empty(size, np.float32)
        self._blank = np.empty(size, np.float32)
        # Best way out of each state, then best way into each place.
        self._onward = np.empty(size + places, np.float32)
        self._coming = np.empty(size, np.float32)
        self._sounds = np.empty(size, np.float32)
        self._is_better = np.empty(size, np.bool_)
        self._doubled_parents = graph.parents[graph.doubled]
        self.begin()

    def begin(self, rules: Collection[str] | None = None) -> None:
        """Forget all frames. Sentences of these public rules are looked for; None is all."""
        entries = self.graph.entries.items()
        active = [entry for rule, entry in entries if rules is None or rule in rules]
        self.trellis = Trellis(self.graph, active)
        self._phone.fill(NOWHERE)
        self._blank.fill(NOWHERE)
        self._settle(0.0, b"")

    def advance(self, scores: Floats) -> None:
        """Go on by some frames: scores [frames, classes], natural logarithms."""
        graph, phone, blank = self.graph, self._phone, self._blank
        coming, onward, sounds = self._coming, self._onward, self._sounds
        states = onward[: graph.size]
        for row in np.ascontiguousarray(scores, np.float32):
            onward.take(graph.parents, out=coming, mode="clip")
            coming[graph.doubled] = blank.take(self._doubled_parents)
            np.greater(coming, phone, out=self._is_better)
            entered = np.packbits(self._is_better).tobytes()
            row.take(graph.phones, out=sounds, mode="clip")
            np.maximum(phone, coming, out=phone)
            np.add(phone, sounds, out=phone)
            np.add(states, row[BLANK], out=blank)
            self._settle(float(row[BLANK]), entered)

    def _settle(self, silence: float, entered: bytes) -> None:
        """What the scores of the phones and blanks mean for the ways out of them."""
        graph = self.graph
        states, places = self._onward[: graph.size], self._onward[graph.size :]
        np.maximum(self._phone, self._blank, out=states)
        np.greater(self._blank, self._phone, out=self._is_better)
        resting = np.packbits(self._is_better).tobytes()
        self.trellis.grow(states, silence, entered, resting)
        self.trellis.arrive(self.trellis.frames, out=places)

    def best(self) -> float:
        """Score of the best sentence that ends now; far below any other when none does."""
        return float(self._onward[self.graph.size + self.graph.final])

    def begun(self) -> Path | None:
        """The best path so far, of a sentence that need not end here; None when nothing fits.

        Its score is how much better it is than the best sentence that ends here.
        """
        states = self._onward[: self.graph.size]
        best = int(states.argmax())
        if states[best] < NOWHERE / 2:
            return None
        return Walk(self.trellis).begun(best, float(states[best]) - self.best())

    def partial(self) -> tuple[str, ...]:
        """The words that the best path so far has ended."""
        begun = self.begun() if self.trellis.frames > 0 else None
        return () if begun is None else begun.words
