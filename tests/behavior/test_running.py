import threading

import pytest
import trio

from hri.behavior.behavior import Behavior
from hri.behavior.network import Network
from hri.behavior.ports import Input, Output
from hri.behavior.running import Networks
from hri.core.errors import HriError
from hri.testing import context as lend


class Count(Behavior):
    """Counts its ticks."""

    ticks = Output[float]("double", "how many so far")
    is_running = False

    def start(self, context):
        self.done, self.is_running = 0, True

    def compute(self, now, dt):
        self.done += 1
        self.ticks.send(float(self.done))

    def stop(self):
        self.is_running = False


class Log(Behavior):
    """Keeps what arrives at each tick."""

    input = Input[float]("double", "numbers")

    def start(self, context):
        self.all, self.first = [], []

    def compute(self, now, dt):
        self.all.append(self.input.values)
        self.first.append(self.input.value)


class Broken(Behavior):
    """Cannot start."""

    def start(self, context):
        raise HriError("no such device - plug it in")


class Stubborn(Count):
    """Cannot stop."""

    def stop(self):
        raise OSError("stuck")


def network_of(name, interval, *behaviors):
    network = Network(name, interval)
    for behavior in behaviors:
        network.add(behavior)
    return network


def counting(name="net", interval=0.1):
    return network_of(name, interval, Count("count"))


def logging_network():
    network = network_of("net", 0.1, Count("count"), Log("log"))
    network.connect("count.ticks", "log.input")
    return network


def live(context, script):
    """Run networks while a coroutine function works with them; the networks."""
    networks = Networks(context)

    async def main():
        async with trio.open_nursery() as nursery:
            nursery.start_soon(context.clock.drive)
            nursery.start_soon(networks.run)
            await script(networks, context.clock)
            nursery.cancel_scope.cancel()

    trio.run(main)
    return networks


@pytest.mark.proves("B06")
def test_networks_of_two_rates_run_at_once_each_with_its_statistics():
    context = lend()

    async def script(networks, clock):
        fast = networks.start(counting("fast", 0.1))
        slow = networks.start(counting("slow", 0.25))
        await clock.sleep(0.99)
        assert fast.statistics.ticks == 10
        assert slow.statistics.ticks == 4
        timing = fast.statistics.behaviors["count"]
        assert timing.count == 10
        assert 0 < timing.mean <= timing.longest
        assert fast.statistics.lateness.longest == 0

    live(context, script)


@pytest.mark.proves("T24")
def test_networks_start_stop_and_swap_while_others_run():
    context = lend()

    async def script(networks, clock):
        first, other = counting("first"), counting("other")
        networks.start(first)
        networks.start(other)
        await clock.sleep(0.45)
        networks.stop("first")
        assert not first["count"].is_running
        second = counting("other", 0.05)
        networks.swap("other", second)
        assert not other["count"].is_running
        await clock.sleep(1.01)
        assert first["count"].done == other["count"].done == 5
        assert second["count"].done == 21
        assert list(networks.runners) == ["other"]

    live(context, script).close()


def test_a_network_that_cannot_start_leaves_the_old_one_running():
    context = lend()

    async def script(networks, clock):
        old, helper = counting(), Count("helper")
        networks.start(old)
        with pytest.raises(HriError, match="plug it in"):
            networks.swap("net", network_of("net", 0.1, helper, Broken("broken")))
        assert not helper.is_running
        await clock.sleep(0.95)
        assert old["count"].done == 10

    live(context, script)


def test_names_are_unique_and_unknown_ones_get_a_hint():
    networks = Networks(lend())
    networks.start(counting("moving"))
    with pytest.raises(HriError, match="runs already"):
        networks.start(counting("moving"))
    with pytest.raises(HriError, match='did you mean "moving"'):
        networks.stop("movin")
    with pytest.raises(HriError, match='did you mean "count"'):
        networks.inject("moving", "coutn", "x", 1)
    with pytest.raises(HriError, match='did you mean "ticks"'):
        networks.watch("moving", "count", "tick", print)


def test_one_that_cannot_stop_keeps_no_other_from_stopping(caplog):
    networks = Networks(lend())
    network = network_of("net", 0.1, Count("a"), Stubborn("b"), Count("c"))
    networks.start(network)
    networks.close()
    assert not network["a"].is_running
    assert not network["c"].is_running
    assert "net.b did not stop: stuck" in caplog.text


@pytest.mark.proves("T24", "B11")
def test_an_injected_value_arrives_once_as_one_more_link():
    context = lend()

    async def script(networks, clock):
        network = logging_network()
        networks.start(network)
        await clock.sleep(0.05)
        networks.inject("net", "log", "input", 41)
        networks.inject("net", "log", "input", 42.0)
        await clock.sleep(0.2)
        assert network["log"].all == [[1.0], [41.0, 42.0, 2.0], [3.0]]
        assert network["log"].first == [1.0, 41.0, 3.0]

    live(context, script)


def test_an_injected_value_of_another_type_is_refused():
    networks = Networks(lend())
    networks.start(logging_network())
    with pytest.raises(HriError, match=r"log.input: 'x' is of type str - send a double"):
        networks.inject("net", "log", "input", "x")
    with pytest.raises(HriError, match="send a double"):
        networks.inject("net", "log", "input", True)


def test_values_may_be_injected_from_other_threads():
    context = lend()
    network = network_of("net", 0.1, Log("log"))
    runner = Networks(context).start(network)

    def send(offset):
        for number in range(200):
            runner.inject("log", "input", float(offset + number))

    threads = [threading.Thread(target=send, args=(1000 * k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads):
        runner.tick(0.0)
    runner.tick(0.0)
    arrived = [value for values in network["log"].all for value in values]
    assert sorted(arrived) == sorted(float(1000 * k + n) for k in range(4) for n in range(200))


@pytest.mark.proves("T24")
def test_a_watch_sees_what_is_sent_until_it_is_cancelled():
    context = lend()

    async def script(networks, clock):
        seen = []
        networks.start(counting())
        watch = networks.watch("net", "count", "ticks", lambda *seen_at: seen.append(seen_at))
        await clock.sleep(0.25)
        watch.cancel()
        watch.cancel()
        await clock.sleep(0.2)
        assert seen == [(1.0, 0.0), (2.0, 0.1), (3.0, 0.2)]

    live(context, script)


def test_a_watch_may_stop_its_own_network_and_may_fail(caplog):
    context = lend()

    async def script(networks, clock):
        network = counting()
        networks.start(network)
        networks.watch("net", "count", "ticks", lambda value, now: 1 / 0)
        networks.watch(
            "net", "count", "ticks", lambda value, now: networks.stop("net") if value == 3 else None
        )
        await clock.sleep(1)
        assert network["count"].done == 3
        assert not network["count"].is_running

    live(context, script)
    assert "division by zero" in caplog.text


def test_a_behavior_may_stop_its_own_network_which_ends_with_the_tick():
    class Quitter(Behavior):
        """Ends it all at once."""

        def compute(self, now, dt):
            self.networks.stop("net")

    context = lend()

    async def script(networks, clock):
        network = network_of("net", 0.1, Quitter("quitter"), Count("count"))
        network["quitter"].networks = networks
        networks.start(network)
        await clock.sleep(1)
        assert network["count"].done == 1
        assert not network["count"].is_running

    live(context, script)
