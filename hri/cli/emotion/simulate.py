"""`hri emotion simulate`: plays a timeline and prints the feelings; memory files are not
changed.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from pathlib import Path

from hri.cli.emotion.output import json_line, text_line
from hri.cli.emotion.stimulus_timeline import Happening, read_timeline, seconds
from hri.core.signals import Stimulus
from hri.emotion.affect import Affect
from hri.emotion.appraisal import appraise
from hri.emotion.dynamics import Dynamics
from hri.emotion.model_spec import load_emotions

MOST_DRAWN = 5000
"""Most states in a plot; a longer timeline skips some."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--personality", default="neutral", metavar="NAME", help="from emotions/personalities")
    events_help = "lines: seconds stimulus intensity (0 to 1; 1 when left out) person; or TOML"
    add("--events", required=True, type=Path, metavar="FILE", help=events_help)
    at_help = "print the state at these times (seconds) too"
    add("--at", type=_times, default=[], metavar="T1,T2,...", help=at_help)
    add("--json", action="store_true", help="print one JSON object per line")
    add("--plot", type=Path, metavar="PNG", help="draw mood, emotions and drives over time")


def run(options: argparse.Namespace) -> int:
    model = load_emotions(options.personality)
    dynamics = model.dynamics()
    timeline = read_timeline(options.events, tuple(model.stimuli))
    line = json_line if options.json else text_line
    every = 1 + (len(timeline) + len(options.at)) // MOST_DRAWN
    drawn: list[Affect] = []
    for number, affect in enumerate(play(dynamics, timeline, options.at)):
        print(line(affect.time, dynamics, affect))
        if options.plot is not None and number % every == 0:
            drawn.append(affect)
    if options.plot is not None:
        from hri.cli.emotion.plot import plot_affects

        named = [(event.time, _name_of(event)) for event in timeline]
        plot_affects(dynamics, drawn, named, options.plot)
    return 0


def play(
    dynamics: Dynamics, timeline: Sequence[Happening], times: Sequence[float]
) -> Iterator[Affect]:
    """The state after each event and at each time asked for, in order of time."""
    steps: list[tuple[float, Happening | None]] = [(event.time, event) for event in timeline]
    steps += [(time, None) for time in times]
    steps.sort(key=lambda step: step[0])
    affect = dynamics.rest(min((time for time, _ in steps), default=0.0))
    for time, event in steps:
        affect = dynamics.advance(affect, time) if event is None else _felt(dynamics, affect, event)
        yield affect


def _felt(dynamics: Dynamics, affect: Affect, event: Happening) -> Affect:
    what = event.what
    if isinstance(what, Stimulus):
        return dynamics.feel(affect, what.name, what.intensity, event.time, event.person)
    return dynamics.appraise(affect, what, event.time)


def _name_of(event: Happening) -> str:
    what = event.what
    return what.name if isinstance(what, Stimulus) else appraise(what).cause


def _times(text: str) -> list[float]:
    times = [seconds(part) for part in text.split(",")]
    found = [time for time in times if time is not None]
    if len(found) < len(times):
        raise argparse.ArgumentTypeError(f'"{text}" - write seconds with commas, such as 0,10,60')
    return found
