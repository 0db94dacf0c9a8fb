"""`hri network check|show|draw|format|diff FILE|APP`: looks at networks, and compares them."""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path

from hri.behavior.board import DECLARED
from hri.behavior.catalog import type_of
from hri.behavior.network import Network
from hri.behavior.network_check import check_together, slot_table
from hri.behavior.network_difference import (
    HEADING,
    NetworkDifference,
    compare,
    drawn_together,
    kind_of,
)
from hri.behavior.network_file import load_network
from hri.behavior.network_layout import Layout, lay_out, stacked, titled
from hri.behavior.network_svg import to_svg
from hri.behavior.network_writer import save_network, write_network
from hri.cli.terminal.progress_line import waiting
from hri.core import paths
from hri.core.errors import HriError
from hri.core.quoting import escaped, message_line, report
from hri.core.writing import write_text
from hri.robot.app import load_app


def add_arguments(parser: argparse.ArgumentParser) -> None:
    commands = parser.add_subparsers(dest="action", required=True)
    for name, (_, about) in ACTIONS.items():
        command = commands.add_parser(name, help=about, description=about)
        what = "a network, or an app with its networks: a path, or a name in the search folders"
        command.add_argument("network", metavar="FILE|APP", help=what)
        if name == "diff":
            command.add_argument("other", metavar="FILE|APP", help="what it became")
            command.add_argument("--json", action="store_true", help="print them as JSON")
        if name in ("draw", "diff"):
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
    report(f"{network.path}: {counts}, {_counted(warnings)}")
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
    report(f"{network.name}, {rate}; each cycle, in this order:")
    width = max((len(behavior.id) for behavior in network.authored), default=0)
    for number, behavior in enumerate(network.authored, start=1):
        mark = "  (sensor)" if behavior.is_sensor else ""
        report(f"{number:4}  {behavior.id:<{width}}  {type_of(behavior)}{mark}")
        for name, declared in behavior.parameters.items():
            value = getattr(behavior, name)
            if value != declared.default:
                report(f"      {'':<{width}}    {name} = {escaped(declared.text(value))}")
    print("links:")
    for link in network.links:
        report(f"      {link}  ({link.datatype})")


def _show_board(networks: list[Network]) -> None:
    """Each slot: its type, who writes it, and who reads it."""
    writers, readers, datatypes = slot_table(networks)
    if datatypes:
        print("slots of the board:")
    for slot, datatype in sorted(datatypes.items()):
        about = f"  {DECLARED[slot].about}" if slot in DECLARED else ""
        report(f"      {slot}  ({datatype}){about}")
        for what, users in (("written by", writers), ("read by", readers)):
            if slot in users or slot not in DECLARED:
                report(f"          {what} {', '.join(users.get(slot, ['none of these networks']))}")


def draw(networks: list[Network], options: argparse.Namespace) -> int:
    """Write a picture; the file name decides the format."""
    out = options.out or Path(f"{Path(options.network).stem}.svg")
    _write_picture(stacked([lay_out(network, kind_of) for network in networks]), out)
    return 0


def _write_picture(layout: Layout, out: Path) -> None:
    """The file name decides the format. Raises HriError."""
    if out.suffix == ".svg":
        write_text(out, to_svg(layout))
    elif out.suffix == ".png":
        from hri.cli.network.picture import write_png

        write_png(layout, out)
    else:
        raise HriError(f'a picture "{out}" - name it *.svg or *.png')
    report(str(out))


def diff(networks: list[Network], options: argparse.Namespace) -> int:
    """What differs from another network or app, also as a picture; exit status 1 when any does."""
    others = _loaded(options.other)
    pairs = _paired(networks, others)
    differences = [compare(old, new) for old, new in pairs]
    if options.json:
        print(json.dumps([asdict(one) for one in differences], indent=2))
    else:
        for (old, new), difference in zip(pairs, differences, strict=True):
            _print_difference(old, new, difference)
    if options.out is not None:
        drawn = [drawn_together(*pair, one) for pair, one in zip(pairs, differences, strict=True)]
        for layout in drawn:
            name, x, y = layout.headings[0]
            layout.headings = [(f"{name} ({HEADING})", x, y)]
        _write_picture(titled(drawn), options.out)
    return int(any(not one.is_empty for one in differences))


def _paired(old: list[Network], new: list[Network]) -> list[tuple[Network, Network]]:
    """The networks of two apps by their names; two networks whatever they are called."""
    if len(old) == len(new) == 1:
        return [(old[0], new[0])]
    before, after = ({one.name: one for one in side} for side in (old, new))
    names = dict.fromkeys((*before, *after))
    return [(before.get(name) or Network(name), after.get(name) or Network(name)) for name in names]


def _print_difference(old: Network, new: Network, difference: NetworkDifference) -> None:
    lines = difference.lines()
    if lines:
        for line in (f"--- {old.path}", f"+++ {new.path}", *lines):
            report(line)
        return
    is_equal = write_network(old) == write_network(new)
    same = "the same" if is_equal else "the same but for order, layout, and comments"
    report(f"{new.path}: {same}")


def format(networks: list[Network], options: argparse.Namespace) -> int:
    """Rewrite the file in canonical form."""
    for network in networks:
        _format(network)
    return 0


def _format(network: Network) -> None:
    before = network.path.read_text(encoding="utf-8", errors="replace")
    if before == write_network(network):
        report(f"{network.path}: canonical")
        return
    save_network(network, network.path)
    report(f"{network.path}: rewritten")


ACTIONS: dict[str, tuple[Callable[[list[Network], argparse.Namespace], int], str]] = {
    "check": (check, "report errors and warnings; exit 1 on warnings"),
    "show": (show, "print order, rate, parameters, links, and users of the board"),
    "draw": (draw, "draw the network, as SVG or PNG"),
    "diff": (diff, "compare two networks, also as a picture; exit 1 when they differ"),
    "format": (format, "rewrite the file in canonical form"),
}
