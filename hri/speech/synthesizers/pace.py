"""Whether this machine makes a voice as fast as it is heard; what was too slow is remembered."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

from hri.core import paths
from hri.core.errors import HriError
from hri.core.privacy import folder_for
from hri.core.toml import load_toml
from hri.core.writing import PRIVATE, write_text

TRIED = 60.0
"""Seconds of sound after which a voice is judged."""
SLOW = 0.5
"""Seconds for a second of sound: with more, the pause before an answer is as long as half of it."""


@dataclass(slots=True)
class Pace:
    """What making a voice has taken so far."""

    took: float = 0.0
    """Seconds."""
    sound: float = 0.0
    """Seconds of sound that were made in them."""

    def add(self, took: float, sound: float) -> None:
        """Count another part."""
        self.took += took
        self.sound += sound

    @property
    def is_slow(self) -> bool:
        """Whether enough was made to know that it is too slow."""
        return self.sound >= TRIED and self.took > SLOW * self.sound


def slow_file() -> Path:
    """Where the voices are kept that were too slow."""
    return paths.state_folder() / "slow-voices.toml"


def slow_voices() -> dict[str, float]:
    """Seconds that a second of sound took, by voice; empty where nothing can be read."""
    try:
        table = load_toml(slow_file(), "list of slow voices")
        return {voice: table.number(voice) for voice in table.keys()}  # noqa: SIM118 - no dict
    except HriError:
        return {}


def remember_slow(voice: str, pace: Pace) -> None:
    """Keep that a voice is too slow here. Raises HriError where it cannot be written."""
    found = {**slow_voices(), voice: round(pace.took / pace.sound, 2)}
    lines = [f"{json.dumps(name)} = {factor}" for name, factor in found.items()]
    folder_for(slow_file())
    head = "# Seconds for a second of sound; delete this file to try these voices again.\n"
    write_text(slow_file(), head + "\n".join(lines) + "\n", PRIVATE)
