"""Makes a Windows of this process, as far as Python sees it: run in a child process, first of all.

What other packages need is imported before, since they are installed for this system. The names of
commands follow on the command line; what a command says comes as JSON, one a line.
"""

import asyncio
import contextlib
import importlib
import importlib.abc
import io
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import unittest.mock
from pathlib import Path

import cv2
import numpy as np
import PIL.Image
import trio

PRELOADED = asyncio, cv2, np, PIL.Image, trio, subprocess, tempfile, unittest.mock
MODULES = frozenset((
    "crypt", "curses", "fcntl", "grp", "posix", "pty", "pwd", "readline", "resource", "spwd",
    "syslog", "termios", "tty",
))  # fmt: skip
SYSTEM = (
    "O_CLOEXEC", "O_DIRECTORY", "O_NOFOLLOW", "O_NONBLOCK", "PRIO_PROCESS", "SCHED_FIFO",
    "SCHED_RESET_ON_FORK", "WNOHANG", "chown", "fchmod", "fchown", "fork", "getegid", "geteuid",
    "getgid", "getloadavg", "getpgid", "getpgrp", "getpriority", "getuid", "killpg", "lchown",
    "mkfifo", "nice", "openpty", "pidfd_open", "pread", "pwrite", "register_at_fork",
    "sched_getaffinity", "sched_getscheduler", "sched_param", "sched_setscheduler",
    "setpriority", "setsid", "statvfs", "sync", "uname",
)  # fmt: skip
SIGNALS = (
    "SIGALRM", "SIGCHLD", "SIGCONT", "SIGHUP", "SIGKILL", "SIGPIPE", "SIGQUIT", "SIGSTOP",
    "SIGTSTP", "SIGUSR1", "SIGUSR2", "SIGWINCH", "pidfd_send_signal", "pthread_sigmask",
)  # fmt: skip
PARTS = (
    "hri", "hri/core", "hri/face", "hri/speech/grammar", "hri/cli/face", "hri/cli/grammar",
    "hri/cli/terminal", "hri/emotion", "hri/testing",
)  # fmt: skip
"""Packages, of which all modules can be imported, and the front doors."""


class Hidden(importlib.abc.MetaPathFinder):
    """Nobody finds the modules that only POSIX has."""

    def find_spec(self, name, path=None, target=None):
        if name in MODULES:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)


def become_windows():
    for name in MODULES - {"posix"}:
        sys.modules.pop(name, None)
    sys.meta_path.insert(0, Hidden())
    for module, names in ((os, SYSTEM), (signal, SIGNALS), (socket, ("AF_UNIX",))):
        for name in names:
            if hasattr(module, name):
                delattr(module, name)
    sys.platform = "win32"


def modules(house):
    """The names of all modules of PARTS; of the first one only its own."""
    for part in PARTS:
        folder = house / part
        for file in folder.glob("*.py") if part == "hri" else folder.rglob("*.py"):
            words = file.relative_to(house).with_suffix("").parts
            yield ".".join(words[:-1] if words[-1] == "__init__" else words)


def told(words):
    """The status of a command, and what it says."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            status = importlib.import_module("hri.cli.main").main(words)
        except SystemExit as end:
            status = end.code
    return {"status": status, "out": out.getvalue(), "err": err.getvalue()}


def robot():
    """What the class says that cannot be."""
    try:
        importlib.import_module("hri").Robot()
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    return ""


if __name__ == "__main__":
    become_windows()
    house = Path(__file__).parents[2]
    for name in sorted(modules(house)):
        if name != "hri.pytest_plugin":
            importlib.import_module(name)
    print(json.dumps(robot()))
    for line in sys.stdin:
        print(json.dumps(told(json.loads(line))), flush=True)
