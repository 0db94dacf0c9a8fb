"""What is wrong with an authored file, or would be with another text in it.

A child process looks (`check`): reading may take seconds of a processor, which the robot's loop
does not have, and a text of a stranger must not take its memory. One looks at a time.
"""

from __future__ import annotations

import json
import subprocess
import threading
from collections.abc import Mapping
from dataclasses import dataclass

from hri.core import child
from hri.core.errors import HriError
from hri.net.mcp.authored import Authored
from hri.robot.app import App

CHECK = "hri.net.mcp.check"
PATIENCE = 60.0
"""Seconds that a check may take."""
NICE = 10
"""Steps by which the robot goes before, when the processor is busy."""


@dataclass(frozen=True, slots=True)
class Findings:
    """What a check has found, a line each."""

    wrong: tuple[str, ...]
    """With one of them the file cannot be used."""
    remarks: tuple[str, ...]


_one_at_a_time = threading.Lock()


def findings(app: App, file: Authored, text: str | None = None) -> Findings:
    """What is wrong with a file as it is, or as it would be with a text.

    Blocks for seconds. Raises HriError where another check goes on, or it takes too long.
    """
    if not _one_at_a_time.acquire(blocking=False):
        raise HriError("another file is being checked - ask again in a moment")
    try:
        return _asked(
            {
                "kind": file.kind,
                "name": file.name,
                "path": str(file.path.absolute()),
                "app": str(app.folder.resolve()),
                "text": text,
            }
        )
    finally:
        _one_at_a_time.release()


def _asked(request: Mapping[str, str | None]) -> Findings:
    words = ["nice", "-n", str(NICE), *child.command("-m", CHECK)]
    try:
        run = subprocess.run(
            words,
            input=json.dumps(request).encode("utf-8"),
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=child.environment(),
            timeout=PATIENCE,
            start_new_session=True,
            check=False,
        )
        answer = json.loads(run.stdout)
        return Findings(tuple(answer["wrong"]), tuple(answer["remarks"]))
    except subprocess.TimeoutExpired as error:
        raise HriError(f"not checked within {PATIENCE:g} s - make it smaller") from error
    except (OSError, ValueError, KeyError) as error:
        raise HriError("it could not be checked - make it smaller, or try `hri`'s check") from error
