"""`hri drive`: drive a base by hand, with a live picture of its pose and sensors. `hri drive replay
RUN` draws a recorded run.
"""

from __future__ import annotations

import argparse
from dataclasses import replace

from hri.cli.drive import replay
from hri.cli.drive.teleop import Teleop
from hri.cli.drive.terminal_view import TerminalView, own_terminal
from hri.cli.drive.view import View
from hri.cli.drive.window_view import WindowView
from hri.cli.probe import KINDS, ask_ports
from hri.cli.terminal.ending import Ending
from hri.core import paths
from hri.core.clock import Clock, RealClock
from hri.core.errors import HriError
from hri.drive.supervisor.base_bus import SIMULATED, BaseBus
from hri.hal.configuration import load_configuration
from hri.hal.drive import Odometry
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.screen import Screen

NAMES = {type.rpartition(".")[2].lower(): type for type in KINDS}
"""Values of `--base`."""
EMULATED = "Hri.Create2"
"""The base that is emulated by default."""
ODOMETRY, WINDOW = "drive_by_hand_odometry", "drive_by_hand_window"
RADIUS = 0.72
"""Radius of a round body in the picture, per meter between the wheels; that of the Create 2."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    about = "serial port of the base, such as /dev/ttyUSB0; or the word replay, to draw a RUN"
    add("port", nargs="?", default="", help=about)
    add(
        "--simulated", action="store_true", help="an emulated base in the simulated world, released"
    )
    add("--base", choices=sorted(NAMES), help="kind of the base (default: detect it at the port)")
    add("--window", action="store_true", help="also open a window, which takes keys too")
    add("--config", metavar="FILE", help="use the base of a configuration, with its networks")
    replay.add_arguments(parser)


def run(options: argparse.Namespace) -> int:
    """Drive until someone quits, or draw a run. Exit status 0."""
    if options.port == replay.NAME:
        return replay.run(options)
    keyboard, screen = own_terminal()
    ending = Ending()
    print("Looking for the base...", flush=True)
    with ending.kept_for_later(), opened(options, RealClock()) as resources:
        bus = base_of(resources, options)
        odometry = resources.obtain(ODOMETRY, Odometry)
        title = f"{bus.protocol.title} at {bus.description.text('port')}"
        windows = [_window(resources, bus, title)] if options.window else []
        with TerminalView(keyboard, screen, title) as view:
            teleop = Teleop(bus, odometry, [view, *windows])
            teleop.run(resources.clock, lambda: ending.is_asked)
    return 0


def base_of(resources: ResourceManager, options: argparse.Namespace) -> BaseBus:
    """The base, open; an emulated one is released, since it cannot hurt anyone."""
    bus = resources.obtain(resources.ids(BaseBus)[0], BaseBus)
    if options.simulated:
        bus.unlatch()
    return bus


def _window(resources: ResourceManager, bus: BaseBus, title: str) -> View:
    """A window beside the terminal. Raises NotAvailable without a display."""
    parameters = {"title": title, "height": "720", "key_repeat": "0.1"}
    resources.declare(Description(WINDOW, "Hri.Screen", parameters))
    track = bus.protocol.described(bus.description).track
    return WindowView(resources.obtain(WINDOW, Screen), title, RADIUS * track)


def opened(options: argparse.Namespace, clock: Clock) -> ResourceManager:
    """The devices; their first base is driven. Raises HriError if they have none."""
    port = SIMULATED if options.simulated else options.port
    if options.config:
        resources = _configured(options.config, port, clock)
    else:
        base = Description("base", _kind(options.base, port), {"port": port})
        resources = ResourceManager([base], clock)
    resources.declare(Description(ODOMETRY, "Hri.BaseOdometry", bus=resources.ids(BaseBus)[0]))
    resources.check()
    return resources


def _kind(name: str | None, port: str) -> str:
    """The device type of the base at a port, detected unless it was named."""
    if not port:
        raise HriError("no base is named - give its port, or --simulated (hri devices --probe)")
    if name:
        return NAMES[name]
    if port == SIMULATED:
        return EMULATED
    (answer,) = ask_ports([port])
    if not answer.type:
        raise HriError(f"{port}: {answer.says}")
    return answer.type


def _configured(config: str, port: str, clock: Clock) -> ResourceManager:
    """The devices of a configuration, whose first base is at that port, where one is given."""
    path = paths.find("config", config)
    configuration = load_configuration(path)
    devices, shapes = configuration.devices, configuration.shapes
    resources = ResourceManager(devices, clock, shapes=shapes)
    bases = resources.ids(BaseBus)
    if not bases:
        raise HriError(f"{path}: no base in it - add a bus such as {EMULATED}")
    if not port:
        return resources
    moved = (
        replace(device, parameters={**device.parameters, "port": port})
        if device.id == bases[0]
        else device
        for device in devices
    )
    return ResourceManager(tuple(moved), clock, shapes=shapes)
