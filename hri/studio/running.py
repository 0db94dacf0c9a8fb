"""The networks that run, as the page starts, pauses, and watches them."""

from __future__ import annotations

from pathlib import Path

from hri.behavior.breakpoint import Breakpoint
from hri.behavior.network_check import check_together
from hri.behavior.network_file import load_network, read_network
from hri.behavior.runner import Runner
from hri.behavior.running import Networks
from hri.core.errors import HriError
from hri.studio.link import NETWORK, THUMBNAIL, RobotEnd
from hri.studio.port_values import PortSampler
from hri.studio.topics import PortValues, RunningNetwork
from hri.task.context import TaskContext

LOOK_EVERY = 0.05
"""Seconds between two looks at values; pictures are taken every sixth time."""
PICTURES_EVERY = 6


class RunningNetworks:
    """Used in the robot's loop."""

    def __init__(self, networks: Networks, link: RobotEnd, is_alone: bool = False) -> None:
        """`is_alone`: a network is the whole app, which no task relies on."""
        self._networks, self._link, self._is_alone = networks, link, is_alone
        self._own: set[Runner] = set()
        """What the page has started."""
        self._breakpoints: dict[Runner, Breakpoint] = {}
        self._samplers: dict[Runner, PortSampler] = {}

    def start(self, path: str, text: str = "") -> None:
        """Run a file, or a text as if that file had it; replaces what the page ran of that name.

        A network that is the whole app is replaced, too. Raises HriError; what ran then goes on.
        """
        file = Path(path)
        if file.suffix != ".xml":
            raise HriError(f'"{path[:200]}" is not a network - name an .xml file')
        network = read_network(text, file) if text else load_network(file)
        old = self._networks.runners.get(network.name)
        if old is not None and not self._is_replaceable(old):
            what = f'the app runs a network "{network.name}" already'
            raise HriError(f"{what} - give yours another name")
        others = [one.network for one in self._networks.runners.values() if one is not old]
        check_together([*others, network])
        running = self._networks
        runner = running.swap(network.name, network) if old else running.start(network)
        self._own = (self._own - {old}) | {runner}

    def _is_replaceable(self, runner: Runner) -> bool:
        return self._is_alone or runner in self._own

    def stop(self, name: str) -> None:
        """End a network that the page has started. Raises HriError."""
        runner = self._runner(name)
        if not self._is_replaceable(runner):
            raise HriError(f'"{name}" belongs to the app - pause it, or end the app')
        self._networks.stop(name)
        self._own.discard(runner)

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
            "path": str(runner.network.path.resolve()),
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

    async def watch(self, context: TaskContext) -> None:
        """Give the page the values that it wants, as long as the robot lives."""
        looks = 0
        while True:
            await context.clock.sleep(LOOK_EVERY)
            values = self._sampled()
            self._link.put("ports", values)
            if looks % PICTURES_EVERY == 0:
                self._link.put("thumbnails", self._thumbnails())
            looks += 1

    def _sampled(self) -> dict[str, PortValues]:
        runners = self._networks.runners
        wanted = {name: runners[name] for name in self._link.wanted_of(NETWORK) if name in runners}
        for runner in self._samplers.keys() - set(wanted.values()):
            self._samplers.pop(runner).close()
        found: dict[str, PortValues] = {}
        for name, runner in wanted.items():
            if runner not in self._samplers:
                self._samplers[runner] = PortSampler(runner)
            if (values := self._samplers[runner].look()) is not None:
                found[name] = values
        for gone in self._breakpoints.keys() - set(runners.values()):
            del self._breakpoints[gone]
        return found

    def _thumbnails(self) -> dict[str, str]:
        found: dict[str, str] = {}
        for wanted in self._link.wanted_of(THUMBNAIL):
            name, _, port = wanted.partition("/")
            runner = self._networks.runners.get(name)
            sampler = self._samplers.get(runner) if runner is not None else None
            picture = sampler.thumbnail(port) if sampler is not None else None
            if picture is not None:
                found[wanted] = picture
        return found
