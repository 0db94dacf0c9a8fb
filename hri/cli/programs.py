"""The console scripts; while one is still loading, Ctrl-C ends it quietly."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Sequence

from hri.cli.terminal.exit_status import status_of


def _program(name: str) -> Callable[..., int]:
    def main(arguments: Sequence[str] | None = None) -> int:
        return status_of(lambda: int(importlib.import_module(f"hri.cli.{name}").main(arguments)))

    return main


behave = _program("behave")
test_camera = _program("diagnostics.camera")
test_drive_system = _program("diagnostics.drive_system")
test_range_sensor = _program("diagnostics.range_sensor")
