"""What moves the emotions, read from `emotions/stimuli/*.toml`: praise, a bump, being ignored."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from hri.core import paths
from hri.core.errors import HriError
from hri.core.toml import Table, load_toml
from hri.emotion.emotions import NAMES, emotions_in

FOLDER = "emotions/stimuli"
TEMPERAMENT = "temperament"
"""The name under which a personality's baseline appears among the causes."""
_STRONGEST = 0.95


@dataclass(frozen=True, slots=True)
class StimulusSpec:
    """A kind of thing that can happen to the robot."""

    name: str
    words: str
    """What happened, as the robot says it after "because": "you praised me"."""
    emotions: Mapping[str, float]
    """Intensity that each emotion reaches when this comes in full strength out of a calm."""
    habituates: float = 0.0
    """Share of its effect that is lost with each time, 0 to 1."""
    recover_s: float = 60.0
    """Seconds in which that loss falls to 1/e."""

    def charges(self) -> list[float]:
        """Charge it adds to each emotion in full strength, in the order of the table."""
        return [-math.log1p(-self.emotions.get(name, 0.0)) for name in NAMES]


def stimulus_paths() -> Iterator[Path]:
    """All stimulus files; of two of the same name, that of the first search folder."""
    for name in paths.names(FOLDER):
        if name.endswith(".toml"):
            yield paths.find(FOLDER, Path(name).stem)


def load_stimuli() -> dict[str, StimulusSpec]:
    """All stimuli by name. Raises HriError when there is none, AuthoringError with the place."""
    stimuli: dict[str, StimulusSpec] = {}
    for path in stimulus_paths():
        table = load_toml(path, "stimulus file")
        for name, entry in table.tables("stimulus"):
            if name in stimuli or name == TEMPERAMENT:
                raise entry.error(None, f'"{name}" is taken already', "choose another name")
            stimuli[name] = _stimulus(name, entry)
        table.finish()
    if not stimuli:
        raise HriError(f"no stimulus in {FOLDER} - add a file such as companion.toml there")
    return stimuli


def _stimulus(name: str, table: Table) -> StimulusSpec:
    emotions = table.table("emotions")
    emotions_in(emotions)
    habituation = table.table("habituation", optional=True)
    stimulus = StimulusSpec(
        name=name,
        words=table.string("words"),
        emotions=emotions.weights(maximum=_STRONGEST),
        habituates=habituation.number("per_event", 0.0, minimum=0, maximum=1),
        recover_s=habituation.number("recover_s", 60.0, minimum=1, maximum=86400),
    )
    habituation.finish()
    table.finish()
    return stimulus
