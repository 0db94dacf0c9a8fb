"""The command `hri`: finds the subcommand and runs it."""

from __future__ import annotations

import argparse
import importlib
import sys
from collections.abc import Sequence

from hri import __version__
from hri.cli.terminal.exit_status import status_of
from hri.cli.terminal.messages import OptionParser
from hri.core.errors import did_you_mean
from hri.core.quoting import message_line, report
from hri.core.systems import REMEDY, is_windows, require_posix

COMMANDS = {
    "companion": ("hri.cli.companion", "start the companion (same as `run companion`)"),
    "run": ("hri.cli.run", "start an app by name or path"),
    "studio": ("hri.cli.studio", "run an app with a web page: see it think, talk to it, stop it"),
    "doctor": ("hri.cli.doctor", "test microphone, speaker, camera, screen, base and models"),
    "devices": ("hri.cli.devices", "list the devices of a configuration, and which are present"),
    "new": ("hri.cli.new", "create a driver, behavior, task, primitive, app or face"),
    "skill": ("hri.cli.skill", "list, check, create and test what an app can do beside its own"),
    "network": ("hri.cli.network", "check, show and draw behavior networks"),
    "schema": ("hri.cli.schema", "export the schemas of behaviors as XML"),
    "grammar": ("hri.cli.grammar", "check, parse with, and expand grammars"),
    "say": ("hri.cli.voice.say", "say a text, or write it to a WAV file"),
    "sounds": ("hri.cli.voice.sounds", "list, check and make sounds that are not words"),
    "idle": ("hri.cli.idle", "list, check and try what it does while nothing happens"),
    "models": ("hri.cli.models", "list and fetch models of speech and faces"),
    "voices": ("hri.cli.voice.voices", "list the voices, by language"),
    "face": ("hri.cli.face", "check, render and show faces"),
    "gesture": (
        "hri.cli.vision.gesture",
        "report nods and shakes in a video, a camera or series of poses",
    ),
    "emotion": ("hri.cli.emotion", "check and try out emotions"),
    "memory": ("hri.cli.memory", "list, show and export what the robot remembers of people"),
    "forget": ("hri.cli.forget", "erase data kept about people, or about one person"),
    "watch": (
        "hri.cli.vision.watch",
        "show the camera's view: people, ids, pose, gaze, gestures, objects, colors, motion",
    ),
    "color": ("hri.cli.color", "teach colors and find them in pictures"),
    "object": ("hri.cli.object", "teach objects and recognize them in pictures"),
    "marker": ("hri.cli.marker", "print cards with markers and find them in pictures"),
    "drive": ("hri.cli.drive", "drive a base by hand, with a live picture"),
    "fleet": ("hri.cli.fleet", "list the robots that know each other, and ask them to do things"),
    "token": ("hri.cli.token", "print the token with which other programs may move the robot"),
    "mcp": ("hri.cli.mcp", "run an app and give it to an assistant (Model Context Protocol)"),
    "bench": ("hri.cli.bench", "measure, and print JSON"),
    "soak": ("hri.cli.soak", "run a large network, or the companion, for simulated hours"),
}
"""Each command is a module with `add_arguments(parser)` and `run(options) -> exit status`."""

POSIX_ONLY = frozenset((
    "bench", "companion", "devices", "doctor", "drive", "fleet", "forget", "mcp", "memory", "run",
    "skill", "soak", "studio", "token",
))  # fmt: skip
"""Commands that Windows cannot run."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command. Returns its exit status; an HriError becomes one line."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    return status_of(lambda: _answer(words))


def _answer(words: list[str]) -> int:
    if not words or words[0] in ("-h", "--help", "help"):
        print(_overview())
        return 0
    if words[0] == "--version":
        report(f"hri {__version__}")
        return 0
    if words[0] not in COMMANDS:
        remedy = did_you_mean(words[0], COMMANDS)
        print(message_line(f'hri: unknown command "{words[0]}" - {remedy}'), file=sys.stderr)
        return 2
    return _run(words[0], words[1:])


def _run(name: str, words: Sequence[str]) -> int:
    if name in POSIX_ONLY:
        require_posix(f"hri {name}")
    module = importlib.import_module(COMMANDS[name][0])
    parser = OptionParser(prog=f"hri {name}", description=COMMANDS[name][1])
    module.add_arguments(parser)
    told = argparse.Namespace(command=["hri", name, *words])
    return int(module.run(parser.parse_args(words, told)))


def _overview() -> str:
    width = max(map(len, COMMANDS))
    lines = [f"  {name:<{width}}  {about}" for name, (_, about) in COMMANDS.items()]
    return "\n".join(
        [
            "usage: hri COMMAND [options]     (hri COMMAND --help lists the options)",
            "",
            *lines,
            "",
            "  behave NETWORK.xml runs a single behavior network.",
            *_left_out(),
        ]
    )


def _left_out() -> list[str]:
    if not is_windows():
        return []
    return ["", f"Not on Windows: {', '.join(sorted(POSIX_ONLY))} - {REMEDY}."]


if __name__ == "__main__":
    sys.exit(main())
