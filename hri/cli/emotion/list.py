"""`hri emotion list`: personalities, stimuli and emotions."""

from __future__ import annotations

import argparse
from pathlib import Path

from hri.core import paths
from hri.core.quoting import escaped, report
from hri.core.toml import load_toml
from hri.emotion import personality
from hri.emotion.display import load_display
from hri.emotion.emotions import EMOTIONS
from hri.emotion.stimulus import StimulusSpec, load_stimuli


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """No options."""


def run(options: argparse.Namespace) -> int:
    print("personalities")
    for name in personality_names():
        table = load_toml(personality.personality_path(name), "personality")
        report(f"  {name:18} {escaped(table.string('description', ''))}")
    print("stimuli")
    for spec in load_stimuli().values():
        report(f"  {spec.name:18} {_effects(spec)}")
    print("display rules")
    for name, rules in load_display().rules.items():
        report(f"  {name:18} for {', '.join(rules)}")
    print("emotions")
    for emotion in EMOTIONS:
        axes = f"{emotion.pleasure:+.2f} {emotion.arousal:+.2f} {emotion.dominance:+.2f}"
        report(f"  {emotion.name:18} pleasure, arousal, dominance {axes}, {emotion.tau_s:g} s")
    return 0


def personality_names() -> list[str]:
    """All personalities over the search folders, sorted."""
    files = (Path(name) for name in paths.names(personality.FOLDER))
    return [file.stem for file in files if file.suffix == ".toml"]


def _effects(spec: StimulusSpec) -> str:
    felt = ", ".join(f"{name} {weight:g}" for name, weight in spec.emotions.items())
    stilled = ", ".join(f"{name} {share:g}" for name, share in spec.satisfies.items())
    parts = [
        felt,
        f"stills {stilled}" if stilled else "",
        f"on {spec.trigger}" * bool(spec.trigger),
    ]
    return "; ".join(part for part in parts if part)
