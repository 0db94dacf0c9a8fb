"""`hri emotion watch`: shows what a running robot feels, from what it keeps in its memory file.

Between two events all follows in closed form, so the file is as good as a look into the robot; of
one that has ended it tells what it would feel by now.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from hri.cli.emotion.output import json_line, mood_words
from hri.core.clock import Clock, RealClock
from hri.core.errors import HriError
from hri.emotion.affect import Affect
from hri.emotion.dynamics import Dynamics
from hri.emotion.files import EmotionFiles
from hri.emotion.model import EmotionModelSpec
from hri.emotion.persistence import Memory, memory_file, recall
from hri.emotion.reasons import why_words


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--personality", metavar="NAME", help="another one than the robot's own")
    add("--every", type=_seconds, default=1.0, metavar="S", help="seconds between two looks")
    add("--once", action="store_true", help="look once, and end")
    add("--json", action="store_true", help="print one JSON object a line")


def run(options: argparse.Namespace) -> int:
    """Until Ctrl-C."""
    personality = options.personality or kept(memory_file()).personality
    files, clock = EmotionFiles(personality), RealClock()
    dynamics = files.model.dynamics()
    try:
        while True:
            if _is_new(files):
                dynamics = files.model.dynamics()
            affect = remembered(dynamics, memory_file(), clock)
            if options.json:
                line = json_line(clock.wall().timestamp(), dynamics, affect)
                print(line, flush=True)
            else:
                _show(
                    f"{clock.wall():%H:%M:%S}  {_told(files.model, dynamics, affect)}", options.once
                )
            if options.once:
                return 0
            clock.advance(options.every)
    except KeyboardInterrupt:
        print()
        return 0


def _is_new(files: EmotionFiles) -> bool:
    """Whether the robot has read its files anew; as it does, a wrong one is told once."""
    try:
        return files.reload()
    except HriError as error:
        print(f"\n{error}", file=sys.stderr)
        return False


def kept(path: Path) -> Memory:
    """What the robot that keeps this file has written. Raises HriError when there is none."""
    memory = recall(path)
    if memory is None:
        remedy = "run an app without --fast, --demo and --seed"
        raise HriError(f"{path}: no robot keeps here what it feels - {remedy}")
    return memory


def remembered(dynamics: Dynamics, path: Path, clock: Clock) -> Affect:
    """What the robot that keeps this file feels now. Raises HriError when there is none."""
    memory, now = kept(path), clock.now()
    return dynamics.resume(memory.awakened(now, clock.wall().timestamp()), now)


def _told(model: EmotionModelSpec, dynamics: Dynamics, affect: Affect) -> str:
    state = dynamics.read(affect)
    words = {name: spec.words for name, spec in model.stimuli.items()}
    why = why_words(model.words(state.label), dynamics.why(affect), words, state.drives)
    drives = " ".join(f"{name} {level:.2f}" for name, level in state.drives.items())
    return f"{state.label} {state.intensity:.2f}  {mood_words(state)}  {drives}  {why}"


def _show(line: str, once: bool) -> None:
    """On a terminal each look is written over the last one."""
    if sys.stdout.isatty() and not once:
        sys.stdout.write(f"\r\x1b[K{line}")
        sys.stdout.flush()
    else:
        print(line, flush=True)


def _seconds(text: str) -> float:
    value = float(text)
    if not 0.05 <= value <= 3600:
        raise argparse.ArgumentTypeError(f"{text} - write seconds from 0.05 to 3600")
    return value
