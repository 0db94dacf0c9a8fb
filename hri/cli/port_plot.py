"""`behave --plot ID.OUTPUT`: plots the values of an output over time."""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path

from hri.behavior.runner import Runner
from hri.core.errors import HriError
from hri.core.writing import write_bytes

MOST_VALUES = 1_000_000
"""Most values to draw."""


class PortPlot:
    """Follows one output while the network runs."""

    def __init__(self, runner: Runner, port: str) -> None:
        """Raises HriError for an unknown port."""
        behavior, dot, output = port.rpartition(".")
        if not dot:
            raise HriError(f'--plot "{port}" - write a behavior and its output: gate.velocity')
        self.port = port
        self._path = Path(f"{runner.network.path.stem}-{port}.png")
        self._times: list[float] = []
        self._values: list[tuple[float, ...]] = []
        self._other = ""
        runner.watch(behavior, output, self._note)

    def _note(self, value: object, now: float) -> None:
        numbers = _numbers(value)
        if numbers is None:
            self._other = type(value).__name__
        elif len(self._times) < MOST_VALUES:
            self._times.append(now)
            self._values.append(numbers)

    def write(self) -> Path:
        """Draw it, one line per number of a value. Raises HriError without any number."""
        if not self._values:
            why = (
                f"it sent {self._other}, which is not a number"
                if self._other
                else "it sent nothing"
            )
            raise HriError(f"{self.port}: {why} - plot an output that sends numbers")
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure

        figure = Figure(figsize=(10, 4), layout="constrained")
        FigureCanvasAgg(figure)
        axes = figure.subplots()
        for row in range(max(map(len, self._values))):
            there = [
                (t, v[row]) for t, v in zip(self._times, self._values, strict=True) if row < len(v)
            ]
            axes.plot(*zip(*there, strict=True), marker=".", markersize=3, label=str(row))
        if len(axes.lines) > 1:
            axes.legend()
        axes.set_title(self.port)
        axes.set_xlabel("seconds")
        axes.grid(alpha=0.3)
        picture = io.BytesIO()
        figure.savefig(picture, dpi=100, format="png", metadata={"Software": "hri"})
        write_bytes(self._path, picture.getvalue())
        return self._path


def _numbers(value: object) -> tuple[float, ...] | None:
    """A number, or several, as floats; None for anything else."""
    if isinstance(value, (bool, int, float)):
        return (float(value),)
    if (
        isinstance(value, Sequence)
        and value
        and all(isinstance(one, (int, float)) for one in value)
    ):
        return tuple(map(float, value))
    return None
