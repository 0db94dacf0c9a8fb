"""Runs a command without a network, with an empty home folder, and reports what it tried.

`unshare` leaves it only the loopback network, and hides the sockets of the system's services, which
could look up names for it. `strace` lists its system calls, and those of its children.
"""

from __future__ import annotations

import ipaddress
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from hri.core.errors import NotAvailable

PROGRAMS = {"strace": "strace", "unshare": "util-linux", "mount": "mount", "ip": "iproute2"}
"""Each with its Debian package."""
SETUP = 'ip link set lo up && mount -t tmpfs none /run && exec "$@"'
CALLS = "connect,bind,sendto,sendmsg,sendmmsg,openat,?open,?creat"
"""A question mark is for what some processors lack."""
OWN = tuple(f"{folder}/hri" for folder in (".cache", ".config", ".local/share", ".local/state"))
CACHES = (".cache/fontconfig", ".cache/matplotlib", ".config/matplotlib")
"""Of the home folder, where others may keep what they make again."""
SYSTEM = ("/dev/", "/proc/", "/sys/")
COMPILED = re.compile(r"/__pycache__/.*\.pyc")
"""Python's, beside any module."""
NAME_SERVICE = 53
STOPPED = 124
"""The status of `timeout` for a command that it stopped."""
KILLED = 137
"""The status of a command that did not end when it was asked to, or whose children did not."""
PATIENCE = 20.0
"""Seconds that a command may take to end."""

_SENT = re.compile(
    r"(?P<call>connect|bind|sendto|sendmsg|sendmmsg)\(.*?sa_family=(?P<family>AF_\w+)"
    r'(?:.*?htons\((?P<port>\d+)\).*?(?:inet_addr\(|AF_INET6, )"(?P<host>[^"]+)")?'
)
_CREATED = re.compile(r"(?:creat\(|open(?:at)?\(.*O_CREAT).* = \d+<(?P<path>/[^>]*)>")


@dataclass(frozen=True, slots=True)
class Tried:
    """What a command did."""

    status: int
    """Its exit status, STOPPED if it went on until it was stopped, or KILLED."""
    output: str
    sent: tuple[str, ...]
    """System calls with an address outside of this machine, or that look up a name."""
    written: tuple[str, ...]
    """Files that are neither in our folders nor in the current or the temporary one."""
    left: tuple[str, ...]
    """Files in the temporary folder."""


def require_sandbox() -> None:
    """Raise NotAvailable where a program is missing, or the system does not permit it."""
    missing = [package for name, package in PROGRAMS.items() if shutil.which(name) is None]
    if missing:
        raise NotAvailable(f"no {', '.join(missing)} - apt install {' '.join(missing)}")
    with tempfile.TemporaryDirectory() as folder:
        tried = run(["true"], Path(folder), 10)
    if tried.status != 0:
        raise NotAvailable(f"not permitted: {tried.output.strip()[:200]} - run it as root")


def run(command: Sequence[str], folder: Path, seconds: float) -> Tried:
    """Run a command in the sandbox, and press Ctrl-C after some seconds.

    In the folder are its `home`, its temporary files, and `here`, the current folder; a second
    command finds there what the first one left.
    """
    home, here, temporary, log = (folder / name for name in ("home", "here", "temporary", "log"))
    for made in (home, here, temporary, log):
        made.mkdir(exist_ok=True)
    programs = f"{Path(sys.executable).parent}:/usr/sbin:/usr/bin:/sbin:/bin"
    environment = {"PATH": programs, "HOME": str(home), "TMPDIR": str(temporary)}
    trace = ["strace", "-ff", "--seccomp-bpf", "-qq", "-y", "-e", "signal=none", "-e"]
    trace += [f"trace={CALLS}", "-o", str(log / "calls")]
    stop = ["timeout", "--signal=INT", f"--kill-after={PATIENCE}", str(seconds)]
    whole = [*_unshared(), "sh", "-c", SETUP, "sh", *trace, *stop, *command]
    status, output = _ran(whole, here, environment, seconds + 2 * PATIENCE)
    lines = [line for file in sorted(log.iterdir()) for line in _lines(file)]
    shutil.rmtree(log)
    written = {place for line in lines if (place := created(line))} | _files(home)
    return Tried(
        status,
        output.decode("utf-8", "replace"),
        tuple(sorted({call for line in lines if (call := sent(line))})),
        tuple(sorted(place for place in written if not _is_allowed(place, folder))),
        tuple(sorted(_files(temporary))),
    )


def _ran(
    command: Sequence[str], folder: Path, environment: dict[str, str], timeout: float
) -> tuple[int, bytes]:
    """The exit status and the output of a command."""
    try:
        done = subprocess.run(
            command,
            env=environment,
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            timeout=timeout,
            check=False,
        )
    except subprocess.TimeoutExpired as late:
        return KILLED, late.output or b""
    return done.returncode, done.stdout


def _unshared() -> list[str]:
    """The command line that separates a program, which ends with all of its children."""
    own = ["--net", "--mount", "--pid", "--fork", "--kill-child", "--mount-proc"]
    return ["unshare", *([] if os.geteuid() == 0 else ["--map-root-user"]), *own]


def _lines(file: Path) -> Iterator[str]:
    with file.open(encoding="utf-8", errors="replace") as lines:
        yield from lines


def _files(folder: Path) -> set[str]:
    return {str(path) for path in folder.rglob("*") if not path.is_dir()}


def sent(line: str) -> str:
    """The address of a system call, if it is outside of this machine, or of a name service."""
    found = _SENT.match(line)
    if found is None or found["family"] in ("AF_UNIX", "AF_NETLINK", "AF_UNSPEC"):
        return ""
    if found["host"] is None:
        return f"{found['call']} {found['family']}"
    is_here = ipaddress.ip_address(found["host"]).is_loopback
    if is_here and int(found["port"]) != NAME_SERVICE:
        return ""
    return f"{found['call']} {found['host']} port {found['port']}"


def created(line: str) -> str:
    """The file that a system call opened, and created if it was not there."""
    found = _CREATED.match(line)
    return found["path"].removesuffix(" (deleted)") if found else ""


def _is_allowed(place: str, folder: Path) -> bool:
    own = (f"home/{name}" for name in (*OWN, *CACHES))
    allowed = tuple(f"{folder / name}/" for name in (*own, "here", "temporary"))
    return place.startswith((*SYSTEM, *allowed)) or COMPILED.search(place) is not None
