"""`hri network check|show|draw|format FILE|APP`: checks, shows and draws networks."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

from hri.behavior.behavior import Behavior
from hri.behavior.board import DECLARED, BoardSink, BoardSource
from hri.behavior.catalog import type_of
from hri.behavior.network import Network
from hri.behavior.network_check import check_together, slot_table
from hri.behavior.network_file import load_network
from hri.behavior.network_layout import lay_out, stacked
from hri.behavior.network_svg import to_svg
from hri.behavior.writer import save_network, write_network
from hri.cli.terminal.progress_line import waiting
from hri.core import paths
from hri.core.errors import HriError
from hri.core.quoting import escaped, message_line
from hri.core.writing import write_text
from hri.robot.app import load_app


def add_arguments(parser: argparse.ArgumentParser) -> None:
    commands = parser.add_subparsers(dest="action", required=True)
    for name, (_, about) in ACTIONS.items():
        command = commands.add_parser(name, help=about, description=about)
        what = "a network, or an app with its networks: a path, or a name in the search folders"
        command.add_argument("network", metavar="FILE|APP", help=what)
        if name == "draw":
            command.add_argument("--out", type=Path, metavar="FILE", help="*.svg or *.png")


def run(options: argparse.Namespace) -> int:
    action, _ = ACTIONS[options.action]
    with waiting("reading the network"):
        networks = _loaded(options.network)
        return action(networks, options)


def _loaded(name: str) -> list[Network]:
    """The network of that name or path; else the networks of the app. Raises HriError."""
    if (Path(name) / "app.toml").is_file():
        return _of_app(name)
    try:
        found = paths.find("config", name)
    except HriError as error:
        try:
            paths.find("apps", name)
        except HriError:
            raise error from None
        return _of_app(name)
    return [load_network(found)]


def _of_app(name: str) -> list[Network]:
    networks = load_app(name).load_networks()
    check_together(networks)
    return networks


def check(networks: list[Network], options: argparse.Namespace) -> int:
    """Exit status 1 when there are warnings; errors are raised."""
    return max([_check(network) for network in networks], default=0)


def _check(network: Network) -> int:
    network.check()
    warnings = [*map(str, network.warnings), *(end.what for end in network.loose_ends())]
    for warning in warnings:
        print(message_line(f"warning: {warning}"))
    counts = f"{len(network.authored)} behaviors, {len(network.links)} links"
    print(f"{network.path}: {counts}, {_counted(warnings)}")
    return 1 if warnings else 0


def _counted(warnings: list[str]) -> str:
    return {0: "ok", 1: "1 warning"}.get(len(warnings), f"{len(warnings)} warnings")


def show(networks: list[Network], options: argparse.Namespace) -> int:
    """The running order, with parameters, links, and users of the board."""
    for network in networks:
        _show(network)
    _show_board(networks)
    return 0


def _show(network: Network) -> None:
    rate = f"every {network.interval:g} s ({1 / network.interval:.4g} Hz)"
    print(f"{network.name}, {rate}; each cycle, in this order:")
    width = max((len(behavior.id) for behavior in network.authored), default=0)
    for number, behavior in enumerate(network.authored, start=1):
        mark = "  (sensor)" if behavior.is_sensor else ""
        print(f"{number:4}  {behavior.id:<{width}}  {type_of(behavior)}{mark}")
        for name, declared in behavior.parameters.items():
            value = getattr(behavior, name)
            if value != declared.default:
                print(f"      {'':<{width}}    {name} = {escaped(declared.text(value))}")
    print("links:")
    for link in network.links:
        print(f"      {link}  ({link.datatype})")


def _show_board(networks: list[Network]) -> None:
    """Each slot: its type, who writes it, and who reads it."""
    writers, readers, datatypes = slot_table(networks)
    if datatypes:
        print("slots of the board:")
    for slot, datatype in sorted(datatypes.items()):
        about = f"  {DECLARED[slot].about}" if slot in DECLARED else ""
        print(f"      {slot}  ({datatype}){about}")
        for what, users in (("written by", writers), ("read by", readers)):
            if slot in users or slot not in DECLARED:
                print(f"          {what} {', '.join(users.get(slot, ['none of these networks']))}")


def draw(networks: list[Network], options: argparse.Namespace) -> int:
    """Write a picture; the file name decides the format."""
    out = options.out or Path(f"{Path(options.network).stem}.svg")
    layout = stacked([lay_out(network, _second_line) for network in networks])
    if out.suffix == ".svg":
        write_text(out, to_svg(layout))
    elif out.suffix == ".png":
        from hri.cli.network.picture import write_png

        write_png(layout, out)
    else:
        raise HriError(f'a picture "{out}" - name it *.svg or *.png')
    print(out)
    return 0


def _second_line(behavior: Behavior) -> str:
    """The line below the id in a picture."""
    return "slots" if isinstance(behavior, BoardSource | BoardSink) else type_of(behavior)


def format(networks: list[Network], options: argparse.Namespace) -> int:
    """Rewrite the file in canonical form."""
    for network in networks:
        _format(network)
    return 0


def _format(network: Network) -> None:
    before = network.path.read_text(encoding="utf-8", errors="replace")
    if before == write_network(network):
        print(f"{network.path}: canonical")
        return
    save_network(network, network.path)
    print(f"{network.path}: rewritten")


ACTIONS: dict[str, tuple[Callable[[list[Network], argparse.Namespace], int], str]] = {
    "check": (check, "report errors and warnings; exit 1 on warnings"),
    "show": (show, "print order, rate, parameters, links, and users of the board"),
    "draw": (draw, "draw the network, as SVG or PNG"),
    "format": (format, "rewrite the file in canonical form"),
}
