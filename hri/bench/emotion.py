"""What feeling costs, and that it does not matter how often anyone looks.

All times are CPU times of one thread. In a checkout the peer in the same run is WASABI (see
`benchmarks.wasabi`), whose mood depends on the rate at which it is stepped.
"""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from hri.bench.checkout import research
from hri.bench.figures import machine, summary
from hri.bench.table import attempt
from hri.bench.workers import variables
from hri.emotion.affect import Affect
from hri.emotion.appraisal import GoalEvent
from hri.emotion.dynamics import Dynamics
from hri.emotion.emotions import NAMES, whole
from hri.emotion.files import EmotionFiles
from hri.emotion.ledger import MOST
from hri.emotion.model_spec import load_emotions
from hri.emotion.personality import Personality
from hri.emotion.stimulus import StimulusSpec

SECONDS = 60
"""How long the stream of events is that is stepped at two rates."""
RATES_HZ = (10, 1000)
CALLS = 200
"""Calls that are timed together."""
TIMES = 50
FILES = 50

STIMULI = (
    StimulusSpec("praise", "you praised me", {"joy": 0.6, "pride": 0.4}, 0.2, 60, relation=0.02),
    StimulusSpec("scold", "you scolded me", {"sadness": 0.6, "shame": 0.4, "anger": 0.3}, 0.2, 60),
    StimulusSpec("petted", "you petted me", {"love": 0.5}, 0.3, 30, satisfies={"company": 0.4}),
)
"""The files may change, what is measured may not: six emotions, from three causes."""
STREAM = ((0, "praise"), (5, "scold"), (7, "petted"), (20, "scold"), (21, "praise"))
"""Whole seconds, and the feelings then."""

_FILE = """[stimulus.number_{number}]
words = "it happened"
trigger = "something.happened"
intensity = "clip(value / 2, 0, 1)"
emotions = {{ joy = 0.5, pride = 0.2, surprise = 0.4 }}
satisfies = {{ company = 0.4 }}
relation = 0.03
person = "who"
habituation = {{ per_event = 0.4, recover_s = 30 }}

[[stimulus.number_{number}.expect]]
after_s = 10
dominant = "joy"
"""


def measure() -> dict[str, Any]:
    """Take all figures."""
    return {
        "machine": machine(),
        "microseconds": attempt(costs),
        f"reload_{FILES}_files_ms": attempt(reload_ms),
        "rates": attempt(rates),
    }


def costs() -> dict[str, Any]:
    """What each thing costs a robot that feels six emotions, for three causes.

    A state is lazy: `advance` notes the time, `read` works out what there is to see. One step of a
    robot is both together; `advance_by_cause` works out the whole ledger too. With `full_ledger` it
    has as many causes as it can keep apart.
    """
    model = Dynamics(Personality("bench"), STIMULI)
    affect = lived(model)
    busy = crowded(model)
    goal = GoalEvent("charger", 0.8, 0.9, likelihood_before=0.4)
    return {
        "emotions": len(NAMES),
        "active": len(whole(affect.outlook.charges)),
        "causes": len(model.ledger(affect)),
        "advance": _us(lambda now: model.advance(affect, now)),
        "advance_and_read": _us(lambda now: model.read(model.advance(affect, now))),
        "advance_by_cause": _us(lambda now: model.ledger(model.advance(affect, now))),
        "appraise_stimulus": _us(lambda now: model.feel(affect, "scold", 0.8, now)),
        "appraise_stimulus_by_person": _us(lambda now: model.feel(affect, "praise", 0.8, now, "A")),
        "appraise_goal": _us(lambda now: model.appraise(affect, goal, now)),
        "appraise_full_ledger": _us(lambda now: model.feel(busy, "scold", 0.8, now)),
        "why": _us(lambda now: model.why(model.advance(affect, now))),
    }


def lived(model: Dynamics) -> Affect:
    """Six emotions from three causes, a need that is stilled, a battery that runs down."""
    affect = model.rest()
    for number, stimulus in enumerate(STIMULI):
        affect = model.feel(affect, stimulus.name, 0.9, float(number))
    return model.report(affect, "energy", 0.3, float(len(STIMULI)))


def crowded(model: Dynamics) -> Affect:
    """The same by as many people as there is room for in the ledger."""
    affect = model.rest()
    for number in range(MOST + 1):
        name = STIMULI[number % len(STIMULI)].name
        affect = model.feel(affect, name, 0.9, 3 * number / MOST, f"person {number}")
    return affect


def _us(do: Callable[[float], object]) -> dict[str, float]:
    """CPU microseconds of a call that is given a time, from 1 to 20 s after the last event."""
    times = [len(STIMULI) + 1 + 19 * number / CALLS for number in range(CALLS)]
    blocks = []
    for _ in range(TIMES):
        begun = time.thread_time()
        for now in times:
            do(now)
        blocks.append((time.thread_time() - begun) / CALLS * 1e6)
    return summary(blocks, 2)


def reload_ms() -> dict[str, float]:
    """CPU milliseconds from a saved file to the model that goes on with it, all files read."""
    with tempfile.TemporaryDirectory() as name, variables(HRI_PATH=name):
        folder = Path(name) / "emotions" / "stimuli"
        folder.mkdir(parents=True)
        others = 2  # The personality and the display.
        for number in range(FILES - others):
            text = _FILE.format(number=number)
            # The built-in stimuli are in a file of this name.
            path = folder / ("companion.toml" if number == 0 else f"number_{number}.toml")
            path.write_text(text, encoding="utf-8")
        files = EmotionFiles("neutral")
        affect = files.model.dynamics().rest()
        blocks = []
        for turn in range(1, 1 + TIMES // 5):
            os.utime(path, (turn, turn))
            begun = time.thread_time()
            if not files.reload():
                raise RuntimeError("a saved file was not seen")
            files.model.dynamics().resume(affect.imprint, 0.0)
            blocks.append((time.thread_time() - begun) * 1e3)
    return summary(blocks, 1)


def rates() -> dict[str, Any]:
    """The same stream of events, stepped at two rates: how far apart the states are."""
    model = load_emotions("neutral").personality
    slow, quick = (_stepped(Dynamics(model, STIMULI), rate) for rate in RATES_HZ)
    apart = max(
        abs(one - other)
        for before, after in zip(slow, quick, strict=True)
        for one, other in zip(before, after, strict=True)
    )
    peer = research("wasabi")
    compared = peer.peaks(SECONDS) if peer else {}
    return {"hz": RATES_HZ, "largest_difference": apart, **compared}


def _stepped(model: Dynamics, rate: int) -> list[list[float]]:
    """All that is felt at each whole second of a robot whose state is worked out at each step."""
    stream, affect, seen = dict(STREAM), model.rest(), []
    for step in range(SECONDS * rate + 1):
        affect = model.settle(model.advance(affect, step / rate))
        second, rest = divmod(step, rate)
        if rest == 0:
            if second in stream:
                affect = model.feel(affect, stream[second], 1.0, step / rate)
            state = model.read(affect)
            mood = [state.valence, state.arousal, state.dominance]
            seen.append([*state.emotions.values(), *state.drives.values(), *mood])
    return seen
