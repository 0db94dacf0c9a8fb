"""The networks that run, as the page starts, pauses, and ends them."""

from __future__ import annotations

from contextlib import suppress
from functools import lru_cache
from pathlib import Path

import trio

from hri.behavior.breakpoint import Breakpoint
from hri.behavior.network import Network
from hri.behavior.network_check import check_together
from hri.behavior.network_file import load_network, read_network
from hri.behavior.runner import Runner
from hri.behavior.running import Networks
from hri.core.errors import HriError
from hri.studio.topics import RunningNetwork
from hri.task.context import TaskContext


class RunningNetworks:
    """Used in the robot's loop."""

    def __init__(self, networks: Networks, is_alone: bool = False) -> None:
        """`is_alone`: a network is the whole app, which no task relies on."""
        self._networks, self._is_alone = networks, is_alone
        self._own: set[Runner] = set()
        """What the page has started."""
        self._breakpoints: dict[Runner, Breakpoint] = {}
        self._starting = trio.Lock()

    async def start(self, context: TaskContext, path: str, text: str = "") -> None:
        """Run a file, or a text as if that file had it; replaces the network of that name.

        A network that is the whole app is replaced, too. The robot's loop goes on while the file is
        read. Raises HriError; what ran then goes on.
        """
        file = Path(path)
        if file.suffix != ".xml":
            raise HriError(f'"{path[:200]}" is not a network - name an .xml file')
        async with self._starting:
            self._start(await context.blocking(_loaded, file, text))

    def _start(self, network: Network) -> None:
        old = self._networks.runners.get(network.name)
        if old is not None and not self._is_replaceable(old):
            what = f'the app runs a network "{network.name}" already'
            raise HriError(f"{what} - give yours another name")
        others = [one.network for one in self._networks.runners.values() if one is not old]
        check_together([*others, network])
        if old is None:
            self._own.add(self._networks.start(network))
            return
        runner = self._networks.swap(network.name, network)
        self._own = (self._own - {old}) | {runner}
        if (point := self._breakpoints.pop(old, None)) is not None:
            with suppress(HriError):  # the new network may have no such port
                self._breakpoints[runner] = Breakpoint(runner, point.port, point.condition.text)

    def _is_replaceable(self, runner: Runner) -> bool:
        return self._is_alone or runner in self._own

    def stop(self, name: str) -> None:
        """End a network that the page has started. Raises HriError."""
        runner = self._runner(name)
        if not self._is_replaceable(runner):
            raise HriError(f'"{name}" belongs to the app - pause it, or end the app')
        self._networks.stop(name)
        self._own.discard(runner)
        self._breakpoints.pop(runner, None)

    def has_breakpoint(self, runner: Runner) -> bool:
        """Whether it may pause by itself."""
        return runner in self._breakpoints

    def pause(self, name: str, on: bool) -> None:
        """Let a network pause, or go on. Raises HriError."""
        runner = self._runner(name)
        if on:
            runner.pause()
        else:
            runner.resume()

    def tick(self, name: str) -> None:
        """A single tick of a paused network. Raises HriError."""
        self._runner(name).step()

    def break_at(self, name: str, port: str, condition: str = "") -> None:
        """Pause when a condition holds; an empty one ends the breakpoint. Raises HriError."""
        runner = self._runner(name)
        new = Breakpoint(runner, port, condition) if condition else None
        if old := self._breakpoints.pop(runner, None):
            old.cancel()
        if new is not None:
            self._breakpoints[runner] = new

    def _runner(self, name: str) -> Runner:
        try:
            return self._networks.runners[name]
        except KeyError:
            raise HriError(f'no network "{name}" runs - start it') from None

    def listed(self) -> list[RunningNetwork]:
        """All networks that run."""
        return [self._row(runner) for runner in self._networks.runners.values()]

    def _row(self, runner: Runner) -> RunningNetwork:
        point = self._breakpoints.get(runner)
        return {
            "name": runner.network.name,
            "path": _resolved(runner.network.path),
            "interval": runner.network.interval,
            "is_paused": runner.is_paused,
            "is_own": self._is_replaceable(runner),
            "ticks": runner.statistics.ticks,
            "missed": runner.statistics.missed,
            "breakpoint": {"port": point.port, "condition": point.condition.text}
            if point is not None
            else None,
            "hit": runner.paused_by,
        }


def _loaded(file: Path, text: str) -> Network:
    """A network that can be started. Raises HriError."""
    network = read_network(text, file) if text else load_network(file)
    network.check()
    return network


@lru_cache(maxsize=256)
def _resolved(path: Path) -> str:
    # Looked at several times a second: asking the file system each time costs the robot's loop.
    return str(path.resolve())
