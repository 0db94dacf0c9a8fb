"""Exit status and one-line errors of a program. 0 for success, 1 when a check or a device failed, 2
when the command line or a file is wrong, 130 after Ctrl-C. Light to import, so that it applies
while the rest is loaded.
"""

from __future__ import annotations

import errno
import io
import logging
import os
import sys
from collections.abc import Callable
from contextlib import suppress

from hri.cli.terminal.messages import LineFormatter
from hri.cli.terminal.streams import let_go, open_missing
from hri.core import paths
from hri.core.errors import HriError
from hri.core.quoting import message_line

_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


def status_of(program: Callable[[], int]) -> int:
    """Run a program; its exit status. Bugs keep their traceback."""
    open_missing()
    _show_all_characters()
    paths.settle()
    try:
        status = program()
        sys.stdout.flush()  # Here, since errors of writing at exit cannot be caught.
        return status
    except (HriError, OSError, KeyboardInterrupt, BaseExceptionGroup) as error:
        alone = _alone(error)
        match alone:
            case HriError() as refused:
                _complain(str(refused))
                return 2
            case KeyboardInterrupt():
                return 130
            case BrokenPipeError():
                let_go(sys.stdout)
                return 0
            case OSError(filename=str() | os.PathLike() as path, strerror=reason):
                _complain(message_line(f"{path}: {reason} - check the path"))
                return 2
            case OSError(errno=number, strerror=reason) if number in _FULL:
                let_go(sys.stdout)
                _complain(f"cannot be written: {reason} - make room")
                return 2
        # Without the groups, which would bury the offending line.
        raise alone from None


def _show_all_characters() -> None:
    """Set up default logging, and escape characters that the terminal cannot show."""
    if logging.lastResort is not None:
        logging.lastResort.setFormatter(LineFormatter())
    if isinstance(sys.stdout, io.TextIOWrapper) and sys.stdout.errors == "strict":
        sys.stdout.reconfigure(errors="backslashreplace")


def _alone(error: BaseException) -> BaseException:
    """An exception without the groups that the robot loop puts around it."""
    while isinstance(error, BaseExceptionGroup) and len(error.exceptions) == 1:
        error = error.exceptions[0]
    return error


def _complain(line: str) -> None:
    """Print a line to standard error, where anyone can read it."""
    with suppress(OSError):
        print(line, file=sys.stderr)
