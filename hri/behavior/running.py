"""The networks that run on a robot: started, stopped, swapped, fed and watched while they run."""

from __future__ import annotations

import logging
from collections.abc import Callable
from functools import partial
from typing import Any

import trio

from hri.behavior.behavior import Context
from hri.behavior.network import Network
from hri.behavior.runner import Runner, Watch
from hri.core.errors import HriError, did_you_mean

log = logging.getLogger("hri.behavior")


class Networks:
    """Networks by name, each at its own rate and with its own statistics.

    Used from the robot loop; only `inject` may be called from any thread.
    """

    def __init__(self, context: Context) -> None:
        self.context = context
        self.runners: dict[str, Runner] = {}
        """What has been started and not stopped, by the name of the network."""
        self._scopes: dict[Runner, trio.CancelScope] = {}
        self._nursery: trio.Nursery | None = None

    def start(self, network: Network) -> Runner:
        """Start the behaviors of a network; it ticks as soon as, and as long as, `run` runs.

        Raises HriError when a network of that name runs, or a behavior cannot start: then none of
        them has.
        """
        if network.name in self.runners:
            raise HriError(f'a network "{network.name}" runs already - stop it, or swap it')
        runner = self._started(network)
        self.runners[network.name] = runner
        self._launch(runner)
        return runner

    def stop(self, name: str) -> None:
        """End a network. Raises HriError when none of that name runs."""
        runner = self._runner(name)
        del self.runners[name]
        self._end(runner)

    def swap(self, name: str, network: Network) -> Runner:
        """Replace a running network by another, which takes over its drives; it keeps running if
        the new one fails. The watches of the old one end with it, which is logged. Raises HriError.
        """
        old = self._runner(name)
        if network.name != name and network.name in self.runners:
            raise HriError(f'a network "{network.name}" runs already - stop it first')
        network.check()
        with old.lending_drives():
            runner = self._started(network)
        if old.is_watched:
            log.warning("%s was swapped, and those who watched it see no more", name)
        self._end(old)
        del self.runners[name]
        self.runners[network.name] = runner
        self._launch(runner)
        return runner

    def inject(self, name: str, behavior: str, input: str, value: Any) -> None:
        """Send a value to an input of a network, once, at its next tick (see `Runner.inject`)."""
        self._runner(name).inject(behavior, input, value)

    def watch(
        self, name: str, behavior: str, output: str, callback: Callable[[Any, float], object]
    ) -> Watch:
        """Call `callback(value, now)` after each tick in which an output sent something."""
        return self._runner(name).watch(behavior, output, callback)

    async def run(self) -> None:
        """Tick all networks, those that are started later too, until cancelled."""
        async with trio.open_nursery() as nursery:
            self._nursery = nursery
            try:
                for runner in self.runners.values():
                    self._launch(runner)
                await trio.sleep_forever()
            finally:
                self._nursery = None

    def close(self) -> None:
        """End all networks, the last one started first."""
        while self.runners:
            self._end(self.runners.popitem()[1])

    def _runner(self, name: str) -> Runner:
        if name not in self.runners:
            raise HriError(f'no network "{name}" runs - {did_you_mean(name, self.runners)}')
        return self.runners[name]

    def _started(self, network: Network) -> Runner:
        network.check()
        runner = Runner(network, self.context)
        runner.start()
        return runner

    def _launch(self, runner: Runner) -> None:
        if self._nursery is not None:
            # Through the clock, so that on fake time they begin one after the other.
            self.context.clock.soon(partial(self._nursery.start_soon, self._tick, runner))

    async def _tick(self, runner: Runner) -> None:
        if runner not in self.runners.values():
            return
        with trio.CancelScope() as scope:
            self._scopes[runner] = scope
            try:
                await runner.run()
            finally:
                del self._scopes[runner]

    def _end(self, runner: Runner) -> None:
        if runner in self._scopes:
            self._scopes[runner].cancel()
        runner.stop()
