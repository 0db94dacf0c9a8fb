"""`hri emotion`: check, list and try out the files in `emotions/`."""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

from hri.core import paths
from hri.core.errors import AuthoringError, HriError, Place, did_you_mean, read_text
from hri.core.signals import EmotionState, Stimulus
from hri.core.toml import load_toml
from hri.emotion import personality, stimulus
from hri.emotion.display import load_display
from hri.emotion.dynamics import Affect, Dynamics
from hri.emotion.emotions import EMOTIONS, NAMES
from hri.emotion.model import load_emotions

Timeline = list[tuple[float, Stimulus]]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    commands = parser.add_subparsers(dest="emotion_command", metavar="COMMAND", required=True)
    check = commands.add_parser("check", help="load all emotion files and report what is wrong")
    check.set_defaults(emotion_run=_check)
    listing = commands.add_parser("list", help="show personalities, stimuli and emotions")
    listing.set_defaults(emotion_run=_list)
    simulate = commands.add_parser("simulate", help="play stimuli and print what is felt")
    simulate.set_defaults(emotion_run=_simulate)
    simulate.add_argument("--personality", default="neutral", metavar="NAME")
    events_help = "lines with spaces: seconds stimulus intensity (0 to 1; 1 when left out)"
    simulate.add_argument("--events", required=True, type=Path, metavar="FILE", help=events_help)
    at_help = "print the state at these times (seconds) too"
    simulate.add_argument("--at", type=_times, default=[], metavar="T1,T2,...", help=at_help)
    simulate.add_argument("--json", action="store_true", help="print one JSON object a line")


def run(options: argparse.Namespace) -> int:
    status: int = options.emotion_run(options)
    return status


def _check(options: argparse.Namespace) -> int:
    """Try all files, so that one that is wrong does not hide the next."""
    loaders: dict[str, Callable[[], object]] = {
        stimulus.FOLDER: stimulus.load_stimuli,
        "emotions/display.toml": load_display,
    }
    for name in _personalities():
        loaders[f"{personality.FOLDER}/{name}"] = partial(personality.load_personality, name)
    problems = [error for load in loaders.values() if (error := _error_of(load))]
    for error in problems:
        print(error)
    if problems:
        return 2
    for warning in _unreachable():
        print(f"warning: {warning}")
    print(f"{', '.join(loaders)}: fine")
    return 0


def _error_of(load: Callable[[], object]) -> HriError | None:
    try:
        load()
    except HriError as error:
        return error
    return None


def _unreachable() -> Iterator[str]:
    """Emotions that nothing causes."""
    stimuli = stimulus.load_stimuli().values()
    for emotion in NAMES:
        if not any(spec.emotions.get(emotion) for spec in stimuli):
            yield f"no stimulus causes {emotion} - add it to one in {stimulus.FOLDER}"


def _personalities() -> list[str]:
    files = (Path(name) for name in paths.names(personality.FOLDER))
    return [file.stem for file in files if file.suffix == ".toml"]


def _list(options: argparse.Namespace) -> int:
    print("personalities")
    for name in _personalities():
        table = load_toml(personality.personality_path(name), "personality")
        print(f"  {name:18} {table.string('description', '')}")
    print("stimuli")
    for spec in stimulus.load_stimuli().values():
        felt = ", ".join(f"{name} {weight:g}" for name, weight in spec.emotions.items())
        print(f"  {spec.name:18} {felt}")
    print("emotions")
    for emotion in EMOTIONS:
        axes = f"{emotion.pleasure:+.2f} {emotion.arousal:+.2f} {emotion.dominance:+.2f}"
        print(f"  {emotion.name:18} pleasure, arousal, dominance {axes}, {emotion.tau_s:g} s")
    return 0


def _simulate(options: argparse.Namespace) -> int:
    dynamics = load_emotions(options.personality).dynamics()
    timeline = _read_timeline(options.events, dynamics.names)
    write = _write_json if options.json else _write_line
    for affect in _play(dynamics, timeline, options.at):
        write(affect.time, dynamics.read(affect), dynamics.why(affect))
    return 0


def _play(dynamics: Dynamics, timeline: Timeline, times: list[float]) -> Iterator[Affect]:
    """The state after each event and at each time asked for, in order of time."""
    steps: list[tuple[float, Stimulus | None]] = [*timeline, *((time, None) for time in times)]
    steps.sort(key=lambda step: step[0])
    affect = dynamics.rest(min((time for time, _ in steps), default=0.0))
    for time, felt in steps:
        affect = dynamics.advance(affect, time)
        if felt is not None:
            affect = dynamics.feel(affect, felt.name, felt.intensity, time)
        yield affect


def _write_line(time: float, state: EmotionState, why: list[tuple[str, float]]) -> None:
    mood = f"{state.valence:+.3f} {state.arousal:+.3f} {state.dominance:+.3f}"
    reasons = ", ".join(f"{cause} {share:.0%}" for cause, share in why)
    print(f"{time:8.2f} s  {state.label:10} {state.intensity:.2f}  mood {mood}  {reasons}".rstrip())


def _write_json(time: float, state: EmotionState, why: list[tuple[str, float]]) -> None:
    line: dict[str, Any] = {
        "t": time,
        "label": state.label,
        "pleasure": state.valence,
        "arousal": state.arousal,
        "dominance": state.dominance,
        "emotions": dict(state.emotions),
        "why": [{"cause": cause, "share": share} for cause, share in why],
    }
    print(json.dumps(line))


def _read_timeline(path: Path, known: tuple[str, ...]) -> Timeline:
    """The events of a file; empty lines and what follows `#` are skipped."""
    timeline: Timeline = []
    for number, line in enumerate(read_text(path, "event file").splitlines(), start=1):
        words = line.partition("#")[0].split()
        if words:
            timeline.append(_read_event(words, Place(path, number), known))
    return timeline


def _read_event(words: list[str], place: Place, known: tuple[str, ...]) -> tuple[float, Stimulus]:
    if len(words) not in (2, 3):
        remedy = "write: seconds stimulus intensity, such as: 1.5 praise 0.8"
        raise AuthoringError(place, f"{len(words)} words", remedy)
    time, name, intensity = _number(words[0]), words[1], _number([*words, "1"][2])
    if time is None or time < 0:
        raise AuthoringError(place, f'"{words[0]}" is no time', "write seconds, such as 1.5")
    if name not in known:
        raise AuthoringError(place, f'no stimulus "{name}"', did_you_mean(name, known))
    if intensity is None or not 0 <= intensity <= 1:
        raise AuthoringError(place, f'"{words[2]}" is no intensity', "write a number from 0 to 1")
    return time, Stimulus(name, intensity)


def _number(text: str) -> float | None:
    """A finite number, None when it is anything else."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def _times(text: str) -> list[float]:
    values = [_number(part) for part in text.split(",")]
    times = [value for value in values if value is not None and value >= 0]
    if len(times) < len(values):
        raise argparse.ArgumentTypeError(f'"{text}" - write seconds with commas, such as 0,10,60')
    return times
