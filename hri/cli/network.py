"""`hri network check|show|draw|format FILE`: what authors need to know of a behavior network."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

from hri.behavior.catalog import type_of
from hri.behavior.drawing import to_svg
from hri.behavior.layout import lay_out
from hri.behavior.network import Network, load_network
from hri.behavior.writer import save_network, write_network
from hri.cli.progress import waiting
from hri.core.errors import HriError
from hri.core.quoting import escaped, message_line
from hri.core.writing import write_text


def add_arguments(parser: argparse.ArgumentParser) -> None:
    commands = parser.add_subparsers(dest="action", required=True)
    for name, (_, about) in ACTIONS.items():
        command = commands.add_parser(name, help=about, description=about)
        command.add_argument("network", metavar="FILE", help="path, or name over the folders")
        if name == "draw":
            command.add_argument("--out", type=Path, metavar="FILE", help="*.svg or *.png")


def run(options: argparse.Namespace) -> int:
    action, _ = ACTIONS[options.action]
    with waiting("reading the network"):
        return action(load_network(options.network), options)


def check(network: Network, options: argparse.Namespace) -> int:
    """Exit status 1 when there is something to warn of; what is wrong raises an error."""
    network.check()
    warnings = [*network.warnings, *network.loose_ends()]
    for warning in warnings:
        print(message_line(f"warning: {warning}"))
    counts = f"{len(network.behaviors)} behaviors, {len(network.links)} links"
    print(f"{network.path}: {counts}, {_counted(warnings)}")
    return 1 if warnings else 0


def _counted(warnings: list[str]) -> str:
    return {0: "ok", 1: "1 warning"}.get(len(warnings), f"{len(warnings)} warnings")


def show(network: Network, options: argparse.Namespace) -> int:
    """The order in which all runs, with parameters, and the links."""
    rate = f"every {network.interval:g} s ({1 / network.interval:.4g} Hz)"
    print(f"{network.name}, {rate}; each cycle, in this order:")
    width = max((len(behavior.id) for behavior in network.behaviors), default=0)
    for number, behavior in enumerate(network.behaviors, start=1):
        mark = "  (sensor)" if behavior.is_sensor else ""
        print(f"{number:4}  {behavior.id:<{width}}  {type_of(behavior)}{mark}")
        for name, declared in behavior.parameters.items():
            value = getattr(behavior, name)
            if value != declared.default:
                print(f"      {'':<{width}}    {name} = {escaped(declared.text(value))}")
    print("links:")
    for link in network.links:
        print(f"      {link}  ({link.datatype})")
    return 0


def draw(network: Network, options: argparse.Namespace) -> int:
    """Write a picture; its name decides which kind."""
    out = options.out or Path(f"{network.path.stem}.svg")
    type_names = {behavior.id: type_of(behavior) for behavior in network.behaviors}
    layout = lay_out(network, type_names)
    if out.suffix == ".svg":
        write_text(out, to_svg(layout, type_names))
    elif out.suffix == ".png":
        from hri.cli.network_picture import write_png

        write_png(layout, type_names, out)
    else:
        raise HriError(f'a picture "{out}" - name it *.svg or *.png')
    print(out)
    return 0


def format(network: Network, options: argparse.Namespace) -> int:
    """Rewrite the file in canonical form."""
    before = network.path.read_text(encoding="utf-8", errors="replace")
    if before == write_network(network):
        print(f"{network.path}: is canonical")
        return 0
    save_network(network, network.path)
    print(f"{network.path}: rewritten")
    return 0


ACTIONS: dict[str, tuple[Callable[[Network, argparse.Namespace], int], str]] = {
    "check": (check, "report what is wrong, or looks wrong; exit 1 on warnings"),
    "show": (show, "print order, rate, parameters and links"),
    "draw": (draw, "draw the network, as SVG or PNG"),
    "format": (format, "rewrite the file in canonical form"),
}
