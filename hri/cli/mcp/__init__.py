"""`hri mcp [APP]`: runs an app to which an assistant has a door; `hri mcp token`: its bearer."""

from __future__ import annotations

import argparse
import sys
from contextlib import closing

from hri.cli import run as run_app
from hri.cli.mcp import token
from hri.cli.terminal.messages import Within
from hri.cli.terminal.streams import open_missing
from hri.core.errors import HriError, NotAvailable
from hri.core.quoting import report
from hri.net.mcp.permission import FLAGS, Permission

TOKEN = "token"
"""Instead of an app."""
PORT = 8312
"""Where the door over HTTP is, unless told otherwise: beside the studio's."""
PACKAGES = ("mcp", "mcp_types")
NOT_MEANT = ("fast", "repeat", "demo", "service")
"""Options of `hri run` with which no assistant can be there."""
EXAMPLES = """\
examples:
  hri mcp                          over standard input and output: an assistant starts it so
  hri mcp --allow-speaking         it may also speak, show something, and propose drafts
  hri mcp --allow-moving --http    over HTTP on this machine; it may also drive
  hri mcp token                    print the bearer for --http; --new, --revoke

docs/assistants.md shows how an assistant is configured."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.epilog = EXAMPLES
    add = parser.add_argument
    about = "name of an app in apps/, or a path (%(default)s); `token` for the bearer"
    add("app", nargs="?", default="companion", help=about)
    about = "serve over HTTP on this machine (port %(const)s); 0 takes any free port"
    port = Within(int, 0, 65535)
    add("--http", nargs="?", type=port, const=PORT, default=None, metavar="PORT", help=about)
    about = "let it speak, ask, show, gesture, and propose drafts"
    add(FLAGS[Permission.SPEAKING], action="store_true", help=about)
    about = "let it also drive, run tasks, and type to the robot"
    add(FLAGS[Permission.MOVING], action="store_true", help=about)
    token.add_arguments(parser)
    run_app.add_options(parser)


def run(options: argparse.Namespace) -> int:
    """Run the app until its end, or that of the assistant; or see to the bearer."""
    if options.app == TOKEN:
        return token.run(options)
    token.refuse(options)
    for name in NOT_MEANT:
        if getattr(options, name):
            raise HriError(f"--{name}: an assistant is there in real time - leave it out")
    try:
        import mcp  # noqa: F401 - the first of all that needs it
    except ModuleNotFoundError as error:
        if error.name not in PACKAGES:
            raise
        remedy = "pip install 'hri[mcp]' installs it"
        raise NotAvailable(f"the package mcp is missing - {remedy}") from error
    serve = _over_stdio if options.http is None else _over_http
    return serve(options, _permission(options))


def _permission(options: argparse.Namespace) -> Permission:
    if options.allow_moving:
        return Permission.MOVING
    return Permission.SPEAKING if options.allow_speaking else Permission.READING


def _over_stdio(options: argparse.Namespace, permission: Permission) -> int:
    from hri.net.mcp import stdio
    from hri.net.mcp.session import StdioSession

    open_missing()
    with stdio.taken() as wire:
        return run_app.run(options, lambda robot: [StdioSession(robot, permission, wire).serve])


def _over_http(options: argparse.Namespace, permission: Permission) -> int:
    from hri.net.mcp.bearer import BEARER
    from hri.net.mcp.connections import listening
    from hri.net.mcp.session import HttpSession, address_of

    with closing(listening(options.http)) as port:
        report(f"mcp       {address_of(port)}", flush=True)
        if BEARER.load() is None:
            report("no bearer yet, so nobody may come - hri mcp token makes one", file=sys.stderr)
        return run_app.run(options, lambda robot: [HttpSession(robot, permission, port).serve])
