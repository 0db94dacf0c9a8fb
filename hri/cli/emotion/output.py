"""Output of feelings by the commands of `hri emotion`."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from typing import Any

from hri.core.quoting import escaped
from hri.core.signals import EmotionState
from hri.emotion.affect import Affect
from hri.emotion.dynamics import Dynamics
from hri.emotion.ledger import Cause

MOST_TOLD = 4
"""Most causes in a text line; JSON has all of them."""


def text_line(time: float, dynamics: Dynamics, affect: Affect) -> str:
    """A state as text."""
    state = dynamics.read(affect)
    reasons = ", ".join(f"{name} {percent}%" for name, percent in _percents(dynamics.why(affect)))
    felt = f"{state.label:15} {state.intensity:.2f}  {mood_words(state)}"
    return escaped(f"{time:8.2f} s  {felt}  {reasons}".rstrip())


def _percents(causes: Sequence[Cause]) -> list[tuple[str, int]]:
    """The largest causes and the others as one, with whole percents that add up to 100."""
    told = [(_named(cause), 100 * cause.share) for cause in causes[:MOST_TOLD]]
    if rest := sum(100 * cause.share for cause in causes[MOST_TOLD:]):
        told.append(("others", rest))
    # Causes that lost most by rounding down share the remaining percents.
    cut = sorted(told, key=lambda one: math.floor(one[1]) - one[1])
    raised = {name for name, _ in cut[: round(sum(share % 1 for _, share in told))]}
    return [(name, math.floor(share) + (name in raised)) for name, share in told]


def _named(cause: Cause) -> str:
    return cause.name if cause.person is None else f"{cause.name} by {cause.person}"


def mood_words(state: EmotionState) -> str:
    """Pleasure, arousal and dominance."""
    return f"mood {state.valence:+.3f} {state.arousal:+.3f} {state.dominance:+.3f}"


def json_line(time: float, dynamics: Dynamics, affect: Affect, **more: bool) -> str:
    """A state as JSON, with more detail."""
    state = dynamics.read(affect)
    line: dict[str, Any] = {
        "t": time,
        "label": state.label,
        "pleasure": state.valence,
        "arousal": state.arousal,
        "dominance": state.dominance,
        "emotions": dict(state.emotions),
        "drives": dict(state.drives),
        "why": [
            {
                "cause": cause.name,
                "share": cause.share,
                "age_s": cause.age_s,
                "person": cause.person,
            }
            for cause in dynamics.why(affect)
        ],
        **more,
    }
    return json.dumps(line)
