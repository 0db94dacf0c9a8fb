"""The answer to "why are you sad?": the feeling, its degree, and its causes as one sentence."""

from __future__ import annotations

import re
from dataclasses import replace

from hri.core.signals import EmotionState
from hri.emotion.affect import Affect
from hri.emotion.dynamics import Dynamics
from hri.emotion.emotions import EMOTIONS, INDEX, NAMES
from hri.emotion.label import MOODS, OCTANTS
from hri.emotion.ledger import Cause
from hri.emotion.model_spec import EmotionModelSpec
from hri.emotion.reasons import EVEN_THOUGH, FORGIVEN_S, forgiven_words, labels_called, why_words

FAINT = 0.05
"""An emotion of less than this is not felt, when someone asks why it is."""
CLEAR = 0.25
"""From this on it is more than a little."""
PLEASANT = frozenset(name for name in NAMES if EMOTIONS[INDEX[name]].is_positive) | {
    name for (is_pleasant, *_), name in OCTANTS.items() if is_pleasant
}
"""Labels of feelings that please."""
_UNMET = re.compile(r"\b(not|yet|no)\b|n't\b")
"""In the words of an open goal, what speaks against it."""
FRESH_S = 60.0
"""Seconds for which a deed that was made good explains a mood, whatever else pulls at it."""


def explained(
    model: EmotionModelSpec,
    dynamics: Dynamics,
    affect: Affect,
    about: str = "",
    asking: str | None = None,
) -> str:
    """Why the robot feels as it does: "I am sad because you scolded me.".

    `about` is the feeling in the question, such as "sad". People with names are named, except
    `asking`, who hears "you".
    """
    state, looks = dynamics.read(affect), model.display.looks
    labels = labels_called(about, looks)
    feeling = looks[state.label].said(state.intensity)
    if not labels or state.label in labels:
        return _because(model, dynamics, affect, state.label, feeling, state, asking)
    strongest = max(labels, key=lambda label: state.emotions.get(label, 0.0))
    intensity = state.emotions.get(strongest, 0.0)
    if intensity >= FAINT:
        much = "also" if intensity >= CLEAR else "a little"
        return _because(model, dynamics, affect, strongest, f"{much} {about}", state, asking)
    because = _because(model, dynamics, affect, state.label, feeling, state, asking)
    return because if because.startswith("I was ") else f"I am not {about}. {because}"


def _because(
    model: EmotionModelSpec,
    dynamics: Dynamics,
    affect: Affect,
    label: str,
    feeling: str,
    state: EmotionState,
    asking: str | None,
) -> str:
    """One sentence about a label of which the robot is `feeling`."""
    causes, words = dynamics.why(affect, label), _words(model, dynamics, affect)
    is_pleasant = label in PLEASANT
    if forgiven := _forgiven(model, affect, label, causes, words, state, asking):
        return forgiven
    for cause in causes:
        if cause.name in model.stimuli and not cause.lasts:
            words[cause.name] = model.stimuli[cause.name].past_words(is_pleasant)
        elif cause.lasts and label == "hope" and _UNMET.search(words.get(cause.name, "")):
            words[cause.name] = f"{EVEN_THOUGH} {words[cause.name]}"
    if causes and not is_pleasant and _is_over(model, causes[0]):
        feeling = f"still {feeling.removeprefix('also ')}"
    heard = [replace(cause, person=None) if cause.person == asking else cause for cause in causes]
    return why_words(feeling, heard, words, state.drives)


def _is_over(model: EmotionModelSpec, cause: Cause) -> bool:
    """Whether it was a state that has ended."""
    spec = model.stimuli.get(cause.name)
    return spec is not None and spec.held is not None and not cause.lasts


def _words(model: EmotionModelSpec, dynamics: Dynamics, affect: Affect) -> dict[str, str]:
    """What each cause is, after "because"."""
    words = {name: spec.words for name, spec in model.stimuli.items()}
    return words | dict(dynamics.said(affect))


def _forgiven(
    model: EmotionModelSpec,
    affect: Affect,
    label: str,
    causes: tuple[Cause, ...],
    words: dict[str, str],
    state: EmotionState,
    asking: str | None,
) -> str:
    """How someone made up for the deed behind it, a short while ago; empty if nobody did."""
    last = affect.imprint.soothed
    if last is None or affect.time - last.time > FORGIVEN_S:
        return ""
    is_fresh = label in MOODS and affect.time - last.time < FRESH_S
    if not is_fresh and (not causes or causes[0].name not in (last.deed, last.amends)):
        return ""
    felt = model.display.looks[last.emotion].words
    return forgiven_words(last, words, felt, state.emotions.get(last.emotion, 0.0), asking)
