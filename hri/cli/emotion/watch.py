"""`hri emotion watch`: shows the feelings of a running robot, from its memory file. Between two
events the state follows in closed form, so the file is as good as the robot itself; for a robot
that has ended it shows what it would feel by now.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from hri.cli.emotion.output import json_line, mood_words
from hri.cli.terminal.messages import Within
from hri.core.clock import RealClock
from hri.core.errors import HriError
from hri.core.quoting import escaped, report
from hri.emotion.affect import Affect
from hri.emotion.dynamics import Dynamics
from hri.emotion.explanation import explained
from hri.emotion.files import EmotionFiles
from hri.emotion.model_spec import EmotionModelSpec
from hri.emotion.persistence import Memory, memory_file, recall
from hri.emotion.reasons import age_words


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--personality", metavar="NAME", help="show it with another personality")
    add(
        "--every",
        type=Within(float, 0.05, 3600),
        default=1.0,
        metavar="S",
        help="seconds between updates",
    )
    add("--once", action="store_true", help="print once, and end")
    add("--json", action="store_true", help="print one JSON object per line")


def run(options: argparse.Namespace) -> int:
    """Until Ctrl-C."""
    watch = _Watch(options, memory_file(), RealClock())
    try:
        watch.look()
        while not options.once:
            watch.clock.advance(options.every)
            watch.look()
    except KeyboardInterrupt:
        print()
    return 0


class _Watch:
    """One robot, by its memory file; each error in its files is reported once."""

    def __init__(self, options: argparse.Namespace, path: Path, clock: RealClock) -> None:
        """Raises HriError when no robot keeps this file."""
        self.clock = clock
        self._options = options
        self._path = path
        kept(path)
        self._personality = ""
        self._files: EmotionFiles | None = None
        self._told = ""

    def look(self) -> None:
        """Print its feelings, or why they are unknown. Raises HriError with `--once`. Like the
        robot, it continues with the last good files when they are broken.
        """
        try:
            memory = kept(self._path)
            self._show(self._model_of(memory), memory)
        except HriError as error:
            if self._options.once:
                raise
            self._tell(error)

    def _model_of(self, memory: Memory) -> EmotionModelSpec:
        """The emotion files of the robot that wrote this memory."""
        personality = self._options.personality or memory.personality
        if self._files is None or personality != self._personality:
            self._files, self._personality = EmotionFiles(personality), personality
        try:
            self._files.reload()
        except HriError as error:
            self._tell(error)
        return self._files.model

    def _tell(self, error: HriError) -> None:
        if str(error) != self._told:
            self._told = str(error)
            print(f"\n{error}", file=sys.stderr)

    def _show(self, model: EmotionModelSpec, memory: Memory) -> None:
        now, wall = self.clock.now(), self.clock.wall().timestamp()
        dynamics, is_running = model.dynamics(), memory.is_running(wall)
        affect = dynamics.resume(memory.awakened(now, wall), now)
        if self._options.json:
            print(json_line(wall, dynamics, affect, running=is_running), flush=True)
            return
        line = f"{self.clock.wall():%H:%M:%S}  {_told(model, dynamics, affect)}"
        if not is_running:
            line += f"  (it ended {age_words(wall - memory.wall) or 'just now'})"
        if sys.stdout.isatty() and not self._options.once:
            # On a terminal each update overwrites the last one.
            print(f"\r\x1b[K{escaped(line)}", end="", flush=True)
        else:
            report(line, flush=True)


def kept(path: Path) -> Memory:
    """The memory in this file. Raises HriError when there is none."""
    memory = recall(path)
    if memory is None:
        raise HriError(f"{path}: no robot saves its feelings here - run an app with --keep")
    return memory


def _told(model: EmotionModelSpec, dynamics: Dynamics, affect: Affect) -> str:
    state = dynamics.read(affect)
    why = explained(model, dynamics, affect)
    drives = " ".join(f"{name} {level:.2f}" for name, level in state.drives.items())
    return escaped(f"{state.label} {state.intensity:.2f}  {mood_words(state)}  {drives}  {why}")
