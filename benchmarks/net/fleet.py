"""Values between robots of a fleet on loopback: `python -m benchmarks.net.fleet`.

Robots in two processes, for real: networks that tick at 100 Hz, the seals, Zenoh. A value is the
time at which it was made, which the other process compares with its own clock: on one machine both
are the same.
"""

from __future__ import annotations

import argparse
import json
import math
import multiprocessing
import os
import random
import signal
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, ExitStack, contextmanager, suppress
from multiprocessing.connection import Connection as Pipe
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import psutil
import zenoh

from hri.behavior.behavior import Behavior, Context
from hri.behavior.drive_command import DriveCommand
from hri.behavior.network import Network
from hri.behavior.ports import Output
from hri.bench.figures import machine
from hri.bench.table import Row, amount, at_least, at_most
from hri.bench.ticks import INTERVAL, NAME, SETTLING, Stopwatch, figures
from hri.bench.workers import variables
from hri.core.errors import HriError
from hri.core.signals import Event, Twist
from hri.hal.drive import DriveSystem
from hri.hal.resource import Description, Resource
from hri.net.zenoh.fleet import Fleet
from hri.net.zenoh.member import Member
from hri.net.zenoh.remote_slot import RemoteSlot
from hri.net.zenoh.session import QUEUE, FleetSettings, free_port, opened
from hri.robot import Robot
from hri.simulation.world import SimulatedWorld
from hri.task.context import TaskContext

PATIENCE = 60.0
SECONDS = 10.0
"""Of each measurement."""
PORTS = 100
"""Values at 100 Hz each: 10,000 a second."""
READ = 10
"""Slots of the other robot that the companion reads."""
DEVICES = (Description("screen", "Hri.OffscreenScreen"), Description("voice", "Hri.SilentVoice"))
KILLS, CUTS = 10, 50
CROWDS = ((10, True), (20, True), (40, True), (100, False))
"""Robots, and whether each has a base."""
PROCESSES = 4
MESSAGES = 100_000
SEED = 7
SPEED, STOPS = 0.3, 10
LOST = {
    "driver killed": ("driver", signal.SIGKILL),
    "driver frozen": ("driver", signal.SIGSTOP),
    "router killed": ("router", signal.SIGKILL),
}
BY_ROUTER = {
    "scouting": {"multicast": {"enabled": False}},
    "transport": {"link": {"tx": {"queue": {"size": {"data": QUEUE}}}}},
}
EMPTY = '<BehaviorNetwork name="empty" invocation_interval="1"/>'
ROOM = "[robot]\nstart = [0, 0]\n"
BARE = """
<Resources>
  <Devices>
    <DeviceBus id="world" type="Hri.SimulatedWorld">
      <Parameter name="file" value="room.toml"/>
      <Device id="drive" type="Hri.SimulatedDrive"/>
      <Device id="battery" type="Hri.SimulatedBattery"/>
      <Device id="range" type="Hri.SimulatedRangeSensor"/>
    </DeviceBus>
  </Devices>
</Resources>
"""
"""A base and sensors in a room without people, whose voices would cost more than the fleet."""


class Watch(Behavior):
    """Sends what time it is."""

    time = Output[float]("double", "seconds")

    def compute(self, now: float, dt: float) -> None:
        self.time.send(time.perf_counter())


def _living(name: str, folder: str, count: int, pipe: Pipe) -> None:
    """A process with a robot that sends values, until something comes."""
    path = Path(folder, "empty.xml")
    robot = Robot(str(path), "simulated")
    member = Member(robot, FleetSettings(name))

    async def begin(context: TaskContext) -> None:
        network = Network("clock", interval=0.01)
        network.add(Watch("watch"))
        for number in range(count):
            network.connect("watch.time", f"board.t{number}")
        context.networks.start(network)
        pipe.send(os.getpid())
        while not pipe.poll():
            await context.clock.sleep(0.05)
        robot.finish()

    robot.live_until_over(member.be_in_fleet, begin)


def _other(name: str, folder: str, count: int) -> AbstractContextManager[tuple[Pipe, int]]:
    return _process(_living, name, folder, count)


@contextmanager
def _process(target: Callable[..., None], *arguments: Any) -> Iterator[tuple[Pipe, int]]:
    """A process that sends its number when it has begun, and ends when it is sent something."""
    context = multiprocessing.get_context("spawn")
    here, there = context.Pipe()
    process = context.Process(target=target, args=(*arguments, there), daemon=True)
    process.start()
    if not here.poll(PATIENCE):
        raise HriError("the other process does not begin - run the bench again")
    yield here, here.recv()
    with suppress(OSError):  # It was killed.
        here.send(None)
    process.join(PATIENCE)


def _seen(folder: str, slots: int, seconds: float) -> tuple[list[float], float, float]:
    """Delays of the values of another robot, values a second, and how much memory grew, MB."""
    robot = Robot(str(Path(folder, "empty.xml")), "simulated")
    member = Member(robot, FleetSettings("reader"))
    delays: list[float] = []
    result: list[float] = []

    async def watch(context: TaskContext) -> None:
        first = [context.board.slot(f"writer/t{n}") for n in range(slots)]
        while any(slot.value is None for slot in first):
            await context.clock.sleep(0.05)
        delays.clear()
        begun, memory = time.perf_counter(), psutil.Process().memory_info().rss
        await context.clock.sleep(seconds)
        result.append(len(delays) / (time.perf_counter() - begun))
        result.append((psutil.Process().memory_info().rss - memory) / 1e6)
        robot.finish()

    with _on_arrival(lambda slot, value: delays.append(time.perf_counter() - value)):
        robot.live_until_over(member.be_in_fleet, watch)
    return delays, result[0], result[1]


@contextmanager
def _on_arrival(note: Callable[[RemoteSlot, Any], object]) -> Iterator[None]:
    """Call something with each value that arrives in a slot of another robot."""
    arrive = RemoteSlot.arrive

    def taken(slot: RemoteSlot, value: Any, came: Any) -> None:
        arrive(slot, value, came)
        if value is not None:
            note(slot, value)

    RemoteSlot.arrive = taken  # type: ignore[method-assign, assignment]
    try:
        yield
    finally:
        RemoteSlot.arrive = arrive  # type: ignore[method-assign]


def delays(folder: str) -> Iterator[Row]:
    """From a port on one robot to a slot on another."""
    for count in (1, PORTS):
        with _other("writer", folder, count):
            found, rate, grown = _seen(folder, count, SECONDS)
        ms = np.array(found) * 1e3
        limits = (at_most(1.0), at_most(5.0)) if count == 1 else (None, None)
        yield amount(f"{count} at 100 Hz: delay, median", float(np.median(ms)), "ms", limits[0])
        yield amount(
            f"{count} at 100 Hz: delay, p99", float(np.percentile(ms, 99)), "ms", limits[1]
        )
        limit = at_least(100.0 * count * 0.98)
        yield amount(f"{count} at 100 Hz: values", rate, "a second", limit)
        yield amount(f"{count} at 100 Hz: memory grown", grown, "MB", at_most(20.0))


def losses(folder: str) -> Iterator[Row]:
    """How long a slot keeps the value of a robot that was killed, or frozen."""
    for name, number in (("killed", signal.SIGKILL), ("frozen", signal.SIGSTOP)):
        times = [_lost(folder, number) for _ in range(KILLS)]
        yield amount(f"slot empties, robot {name}, longest", 1e3 * max(times), "ms", at_most(250.0))


def _lost(folder: str, number: signal.Signals) -> float:
    robot = Robot(str(Path(folder, "empty.xml")), "simulated")
    member = Member(robot, FleetSettings("reader"))
    found: list[float] = []
    with _other("writer", folder, 1) as (_, pid):

        async def watch(context: TaskContext) -> None:
            slot = context.board.slot("writer/t0")
            while slot.value is None:
                await context.clock.sleep(0.01)
            begun = time.perf_counter()
            os.kill(pid, number)
            while slot.value is not None:
                await context.clock.sleep(0.005)
            found.append(time.perf_counter() - begun)
            os.kill(pid, signal.SIGKILL)
            robot.finish()

        robot.live_until_over(member.be_in_fleet, watch)
    return found[0]


def steering(folder: str) -> Iterator[Row]:
    """How soon a base at 0.3 m/s is at rest whose driver is killed, freezes, or has no router."""
    for what, (who, number) in LOST.items():
        found = [_stopped(folder, who, number) for _ in range(STOPS)]
        asked, stood = (1e3 * max(times) for times in zip(*found, strict=True))
        yield amount(f"{what}: velocity 0 asked for, longest", asked, "ms", at_most(250.0))
        yield amount(f"{what}: base at rest, longest", stood, "ms", None)


def _driving(settings: FleetSettings, folder: str, pipe: Pipe) -> None:
    """A process with a robot that steers another one."""
    robot = Robot(str(Path(folder, "empty.xml")), "simulated")
    member = Member(robot, settings)

    async def drive(context: TaskContext) -> None:
        wish = context.board.slot("wheels/wish")
        pipe.send(os.getpid())
        while not pipe.poll():
            wish.set(Twist(SPEED), context.clock.now())
            await context.clock.sleep(0.05)
        robot.finish()

    robot.live_until_over(member.be_in_fleet, drive)


def _routing(endpoint: str, pipe: Pipe) -> None:
    """A process with a router."""
    own = {"mode": "router", "listen": {"endpoints": [endpoint]}, **BY_ROUTER}
    session = zenoh.open(zenoh.Config.from_json5(json.dumps(own)))
    pipe.send(os.getpid())
    pipe.recv()
    session.close()  # type: ignore[no-untyped-call]


def _client(folder: str) -> tuple[Path, str]:
    """How programs join the fleet by a router, and where that listens."""
    file, endpoint = Path(folder, "client.json5"), f"tcp/127.0.0.1:{free_port()}"
    client = {"mode": "client", "connect": {"endpoints": [endpoint]}, **BY_ROUTER}
    file.write_text(json.dumps(client))
    return file, endpoint


def _stopped(folder: str, who: str, number: signal.Signals) -> tuple[float, float]:
    """Seconds until a velocity of 0 is asked for, and until the base is at rest, and says why."""
    file, endpoint = _client(folder)
    with ExitStack() as stack:
        _, router = stack.enter_context(_process(_routing, endpoint))
        robot = Robot(str(Path(folder, "empty.xml")), str(Path(folder, "bare.xml")))
        member = Member(robot, FleetSettings("wheels", allows_remote=True, file=file))
        driving = FleetSettings("driver", allows_remote=True, file=file)
        _, driver = stack.enter_context(_process(_driving, driving, folder))
        found: list[float] = []

        async def watch(context: TaskContext) -> None:
            base = context.resources.obtain("world", SimulatedWorld).base
            network = Network("wheels", interval=0.02)
            network.add(DriveCommand("wheels"))
            network.connect("board.wish", "wheels.velocity")
            network.sort()
            context.networks.start(network)
            silent: list[Event] = []
            context.events.subscribe("fleet.silent", silent.append)
            while base.velocity.linear < SPEED:
                await context.clock.sleep(0.002)
            begun = time.perf_counter()
            os.kill({"router": router, "driver": driver}[who], number)
            while base.goal != Twist():
                await context.clock.sleep(0.002)
            found.append(time.perf_counter() - begun)
            while base.velocity != Twist():
                await context.clock.sleep(0.002)
            found.append(time.perf_counter() - begun)
            while not silent:
                await context.clock.sleep(0.01)
            for pid in (driver, router):
                os.kill(pid, signal.SIGKILL)
            robot.finish()

        robot.live_until_over(member.be_in_fleet, watch)
    return found[0], found[1]


def cuts(folder: str) -> Iterator[Row]:
    """A robot that freezes and thaws: when its value is gone and back, and how old one is."""
    robot = Robot(str(Path(folder, "empty.xml")), "simulated")
    member = Member(robot, FleetSettings("reader"))
    gone, back, ages = list[float](), list[float](), list[float]()
    with _other("writer", folder, 1) as (_, pid):

        async def until(context: TaskContext, is_there: bool) -> float:
            slot, begun = context.board.slot("writer/t0"), time.perf_counter()
            assert isinstance(slot, RemoteSlot)
            while ((value := slot.value) is not None) != is_there:
                await context.clock.sleep(0.002)
            if value is not None:
                ages.append(time.perf_counter() - value - slot.age)
            return time.perf_counter() - begun

        async def watch(context: TaskContext) -> None:
            await until(context, is_there=True)
            for _ in range(CUTS):
                os.kill(pid, signal.SIGSTOP)
                gone.append(await until(context, is_there=False))
                await context.clock.sleep(0.5)
                os.kill(pid, signal.SIGCONT)
                back.append(await until(context, is_there=True))
            robot.finish()

        robot.live_until_over(member.be_in_fleet, watch)
    yield amount(f"{CUTS} cuts: value gone, longest", 1e3 * max(gone), "ms", at_most(500.0))
    yield amount(f"{CUTS} cuts: value back, longest", 1e3 * max(back), "ms", at_most(2000.0))
    yield amount(f"{CUTS} cuts: older than it says, most", 1e3 * max(ages), "ms", at_most(50.0))


class Counter(Behavior):
    """Counts its ticks."""

    count = Output[float]("double", "ticks")

    def start(self, context: Context) -> None:
        self._count = 0

    def compute(self, now: float, dt: float) -> None:
        self._count += 1
        self.count.send(float(self._count))


def _living_crowd(
    names: Sequence[str], folder: str, file: Path, has_base: bool, pipe: Pipe
) -> None:
    """A process with several robots, a thread each: a simulated base, sensors, and a counter."""
    ended = threading.Event()

    def live(name: str) -> None:
        robot = Robot(str(Path(folder, "empty.xml")), str(Path(folder, "bare.xml")))
        member = Member(robot, FleetSettings(name, allows_remote=True, file=file))

        async def begin(context: TaskContext) -> None:
            if has_base:
                context.resources.obtain("drive", DriveSystem)
                for sensor in ("range", "battery"):
                    context.resources.obtain(sensor, Resource)
            network = Network("clock", interval=0.1)
            network.add(Counter("counter"))
            network.connect("counter.count", "board.count")
            context.networks.start(network)
            while not ended.is_set():
                await context.clock.sleep(0.2)
            robot.finish()

        robot.live_until_over(member.be_in_fleet, begin)

    threads = [threading.Thread(target=live, args=(name,)) for name in names]
    for thread in threads:
        thread.start()
    pipe.send(os.getpid())
    pipe.recv()
    ended.set()
    for thread in threads:
        thread.join()


def crowd(folder: str) -> Iterator[Row]:
    """Robots of several processes, each with a base, sensors and a network of 10 Hz; one reads all
    of their counters. A router is in the middle.
    """
    for count, has_base in CROWDS:
        yield from _crowd(folder, count, has_base)


def _crowd(folder: str, count: int, has_base: bool) -> Iterator[Row]:
    names = [f"robot{number}" for number in range(count)]
    file, endpoint = _client(folder)
    counts: dict[str, set[float]] = {name: set() for name in names}
    used: list[float] = []
    with ExitStack() as stack:
        _, router = stack.enter_context(_process(_routing, endpoint))
        shares = (names[number::PROCESSES] for number in range(PROCESSES))
        crowds = [_process(_living_crowd, share, folder, file, has_base) for share in shares]
        pids = [stack.enter_context(one)[1] for one in crowds]
        robot = Robot(str(Path(folder, "empty.xml")), "simulated")
        member = Member(robot, FleetSettings("reader", allows_remote=True, file=file))

        async def watch(context: TaskContext) -> None:
            slots = {name: context.board.slot(f"{name}/count") for name in names}
            end = context.clock.now() + PATIENCE
            while any(slot.value is None for slot in slots.values()) and context.clock.now() < end:
                await context.clock.sleep(0.1)
            before, routed, begun = _used(pids), _used([router]), time.perf_counter()
            for came in counts.values():
                came.clear()
            await context.clock.sleep(SECONDS)
            seconds = time.perf_counter() - begun
            used.extend([(_used(pids) - before) / seconds, (_used([router]) - routed) / seconds])
            robot.finish()

        with _on_arrival(lambda slot, value: counts[slot.robot].add(value)):
            robot.live_until_over(member.be_in_fleet, watch)
        memory = sum(psutil.Process(pid).memory_info().rss for pid in pids)
    lost = sum(max(one) - min(one) + 1 - len(one) if one else math.inf for one in counts.values())
    who = f"{count} robots {'with a base' if has_base else 'without one'}"
    yield amount(f"{who}: values lost in {SECONDS:.0f} s", lost, "values", at_most(0))
    yield amount(f"{who}: processor of each", 100 * used[0] / count, "% of a core", None)
    yield amount(f"{who}: router, for each", 100 * used[1] / count, "% of a core", None)
    yield amount(f"{who}: memory of each", memory / count / 1e6, "MB", None)


def _used(pids: Sequence[int]) -> float:
    times = (psutil.Process(pid).cpu_times() for pid in pids)
    return float(sum(one.user + one.system for one in times))


def hostile(folder: str) -> Iterator[Row]:
    """Messages that are damaged, foreign, or came before, to each key of a robot."""
    chance = random.Random(SEED)
    with _other("writer", folder, 1) as (_, pid), opened(FleetSettings()) as session:
        robots = Fleet(session)
        while "writer" not in robots.names():
            pass
        heard: list[tuple[str, bytes, bytes]] = []

        def hear(sample: zenoh.Sample) -> None:
            if len(heard) < 100 and sample.attachment is not None:
                payload, sealed = sample.payload.to_bytes(), sample.attachment.to_bytes()
                heard.append((str(sample.key_expr), payload, sealed))

        session.declare_subscriber("hri/writer/values/**", hear)
        before, memory = robots.ask("writer", "state", {}), psutil.Process(pid).memory_info().rss
        for number in range(MESSAGES):
            key, payload, sealed = _bad(chance, heard)
            if number % 10:
                block = zenoh.CongestionControl.BLOCK  # so that each arrives
                session.put(key, payload, attachment=sealed, congestion_control=block)
            else:
                asked = chance.choice(("hello", "do"))
                session.get(
                    f"hri/writer/{asked}", lambda reply: None, payload=payload, attachment=sealed
                )
        after = robots.ask("writer", "state", {})
        grown = (psutil.Process(pid).memory_info().rss - memory) / 1e6
        is_same = {**after, "seconds": 0} == {**before, "seconds": 0}
    yield amount(f"{MESSAGES} hostile messages: memory grown", grown, "MB", at_most(30.0))
    yield amount("it answers, and is as before", float(is_same), "", at_least(1.0))


def _bad(
    chance: random.Random, heard: Sequence[tuple[str, bytes, bytes]]
) -> tuple[str, bytes, bytes]:
    """A message that must not count: its key, payload and envelope."""
    kind = chance.randrange(3)
    if kind == 0 or not heard:
        key = f"hri/writer/put/{chance.choice(('drive.command', 'people', 'x', 'a/b'))}/anna"
        return key, chance.randbytes(chance.randrange(200)), chance.randbytes(chance.randrange(120))
    key, payload, sealed = chance.choice(heard)
    if kind == 1:  # as it was, to another key
        return f"hri/writer/put/drive.command/{chance.choice(('writer', 'anna'))}", payload, sealed
    damaged = bytearray(sealed)
    damaged[chance.randrange(len(damaged))] ^= 1 << chance.randrange(8)
    return key, payload, bytes(damaged)


def loop(folder: str) -> Iterator[Row]:
    """How late ticks of 100 Hz begin beside the companion, without a fleet and in one."""
    found = {name: _lateness(folder, name == "in a fleet") for name in ("alone", "in a fleet")}
    for name, late in found.items():
        yield amount(f"companion {name}: lateness of ticks, p99", late, "ms", None)
    yield amount("in a fleet / alone", found["in a fleet"] / found["alone"], "", at_most(2.0))


def _lateness(folder: str, is_in_fleet: bool) -> float:
    robot = Robot("companion", "simulated", devices=DEVICES)
    member = Member(robot, FleetSettings("reader")) if is_in_fleet else None
    stopwatch, network = Stopwatch("stopwatch"), Network(NAME, INTERVAL)
    network.add(stopwatch)

    async def watch(context: TaskContext) -> None:
        for number in range(READ):
            context.board.slot(f"writer/t{number}")
        await context.clock.sleep(SETTLING)
        context.networks.start(network)
        await context.clock.sleep(SECONDS)
        robot.finish()

    with _other("writer", folder, READ):
        jobs = [member.be_in_fleet] if member is not None else []
        robot.live_until_over(*robot.app.load_tasks(), *jobs, watch)
    return float(figures(stopwatch)["lateness_ms"]["p99"])


PARTS = {
    "delays": delays,
    "losses": losses,
    "steering": steering,
    "cuts": cuts,
    "crowd": crowd,
    "hostile": hostile,
    "loop": loop,
}


def main() -> None:
    """Print a row for each figure, and the machine."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", choices=PARTS, help="one part alone")
    options = parser.parse_args()
    with TemporaryDirectory() as folder, variables(XDG_STATE_HOME=folder):
        for name, text in {"empty.xml": EMPTY, "bare.xml": BARE, "room.toml": ROOM}.items():
            Path(folder, name).write_text(text)
        for name, part in PARTS.items():
            for row in part(folder) if options.only in (None, name) else ():
                print(json.dumps(row), flush=True)
    print(json.dumps({"machine": machine()}))


if __name__ == "__main__":
    main()
