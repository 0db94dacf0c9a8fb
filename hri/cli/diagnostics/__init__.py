"""Shared by the diagnostic commands: options, help as in 2003, and opening devices."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from typing import TypeVar

from hri.cli.terminal.exit_status import status_of
from hri.cli.terminal.messages import OptionParser
from hri.core import paths
from hri.core.clock import Clock, FakeClock, RealClock
from hri.core.errors import NotAvailable
from hri.core.quoting import report
from hri.hal.choices import apply_choices, load_choices
from hri.hal.configuration import Configuration, load_configuration
from hri.hal.resource import Resource
from hri.hal.resource_manager import ResourceManager

R = TypeVar("R", bound=Resource)


def parser(name: str, help: str) -> argparse.ArgumentParser:
    """A parser with the options of every diagnostic; `help` begins with its usage line."""
    usage = help.splitlines()[0].removeprefix("Usage: ")
    made = OptionParser(prog=name, usage=usage, add_help=False)
    made.add_argument("--help", "-h", action="store_true")
    made.add_argument("--config", default="resource-config")
    made.add_argument("--fast", action="store_true")
    return made


def run(
    parser: argparse.ArgumentParser,
    help: str,
    test: Callable[[argparse.Namespace], int],
    arguments: Sequence[str] | None,
) -> int:
    """Run a diagnostic; its exit status, 2 when an option or a file is wrong."""
    options = parser.parse_args(arguments)
    if options.help:
        print(help, end="")
        return 0
    return status_of(lambda: test(options))


@contextmanager
def resources_of(options: argparse.Namespace) -> Iterator[ResourceManager]:
    """The devices that the options name, closed again at the end.

    In real time they come without their stand-ins, which would hide that a device is missing.
    """
    clock: Clock = FakeClock() if options.fast else RealClock()
    configuration = load_configuration(paths.find("config", options.config))
    if not options.fast:
        configuration = without_stand_ins(configuration)
    resources = ResourceManager(configuration.devices, clock, shapes=configuration.shapes)
    resources.check()
    try:
        yield resources
    finally:
        resources.close()


def without_stand_ins(configuration: Configuration) -> Configuration:
    """The configuration with the user's choices, without stand-ins."""
    return replace(
        configuration,
        devices=tuple(
            replace(device, parameters={**device.parameters, "stand_in": ""})
            for device in apply_choices(configuration.devices, load_choices())
        ),
    )


def obtained(
    resources: ResourceManager, ids: Sequence[str], interface: type[R]
) -> tuple[list[R], int]:
    """The devices that can be opened, and the number of those that cannot, each reported in a line.
    A stand-in for several devices counts once.
    """
    opened: list[R] = []
    missing = 0
    for id in ids:
        try:
            device = resources.obtain(id, interface)
        except NotAvailable as error:
            report(f"Initializing...{error}", file=sys.stderr)
            missing += 1
        else:
            if device not in opened:
                opened.append(device)
    return opened, missing
