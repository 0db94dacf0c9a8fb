"""How commands of `hri emotion` write what is felt."""

from __future__ import annotations

import json
from typing import Any

from hri.core.quoting import escaped
from hri.core.signals import EmotionState
from hri.emotion.affect import Affect
from hri.emotion.dynamics import Dynamics
from hri.emotion.ledger import Cause

MOST_TOLD = 4
"""Causes in a line for people; JSON has all of them."""


def text_line(time: float, dynamics: Dynamics, affect: Affect) -> str:
    """A state for people."""
    state = dynamics.read(affect)
    causes = dynamics.why(affect)[:MOST_TOLD]
    reasons = ", ".join(f"{_named(cause)} {cause.share:.0%}" for cause in causes)
    felt = f"{state.label:15} {state.intensity:.2f}  {mood_words(state)}"
    return escaped(f"{time:8.2f} s  {felt}  {reasons}".rstrip())


def _named(cause: Cause) -> str:
    return cause.name if cause.person is None else f"{cause.name} by {cause.person}"


def mood_words(state: EmotionState) -> str:
    """Pleasure, arousal and dominance."""
    return f"mood {state.valence:+.3f} {state.arousal:+.3f} {state.dominance:+.3f}"


def json_line(time: float, dynamics: Dynamics, affect: Affect, **more: bool) -> str:
    """A state for programs, and more to know about it."""
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
