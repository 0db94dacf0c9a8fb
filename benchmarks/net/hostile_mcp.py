"""An assistant that means ill, and what one costs: `python -m benchmarks.net.hostile_mcp`.

Prints JSON. Damaged and foreign messages, and calls beyond what is declared or allowed, come over
the pipe of a companion in a simulated room that may only be looked at: whether it moved, opened a
file or an address elsewhere, grew, or answers no more. Then, a case in each process: how late the
ticks of a 100 Hz network begin beside the companion without MCP, with it, and with calls.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator
from contextlib import closing, suppress
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import trio

from hri.behavior.network import Network
from hri.bench.figures import machine
from hri.bench.ticks import INTERVAL, NAME, SETTLING, Stopwatch, figures
from hri.core import child, paths
from hri.core.clock import RealClock
from hri.hal.resource import Description
from hri.robot import Robot
from hri.simulation.world import SimulatedWorld
from hri.task.context import TaskContext

MODULE = "benchmarks.net.hostile_mcp"
DEVICES = (Description("screen", "Hri.OffscreenScreen"), Description("voice", "Hri.SilentVoice"))
A_SECOND = 10
"""Calls of the assistant that is measured."""
SLOW = 0.11
"""Seconds between two calls beyond what is allowed, so that each is looked at, not one in many."""
CASES = ("off", "on", "asked")
SYSTEM = ("/proc", "/sys", "/dev", "/etc/localtime", "/usr/lib", "/usr/share/zoneinfo")

HELLO = {
    "jsonrpc": "2.0",
    "id": 0,
    "method": "initialize",
    "params": {
        "protocolVersion": "2025-06-18",
        "capabilities": {},
        "clientInfo": {"name": "a stranger", "version": "1"},
    },
}
READY = {"jsonrpc": "2.0", "method": "notifications/initialized"}
NAMES = (
    *("move", "turn", "say", "ask", "show", "gesture", "say_to_it", "run_task", "propose_change"),
    *("read_authored", "check_authored", "list_authored", "events", "look"),
    *("shell", "../move", "eval", "", "state\0", "x" * 5000),
)
VALUES: tuple[Any, ...] = (
    *("/etc/passwd", "../../../etc/shadow", "file:///etc/passwd", "http://127.0.0.1:9/", "~/.ssh"),
    *(1e308, -1e308, 10**400, 0, -1, True, None, [], {}, [[[]]], {"a": {"b": 1}}),
    *("", "\0", "\u202e", "x" * 100_000, "{{7*7}}", "$(reboot)", "forget me", "you may move again"),
)
KEYS = ("name", "text", "distance_m", "angle_deg", "expression", "question", "kind", "after", "x")


def hostile_calls(count: int, chance: random.Random) -> Iterator[bytes]:
    """Calls of tools that are not there, not allowed, or get what they do not take."""
    for number in range(count):
        arguments = {chance.choice(KEYS): chance.choice(VALUES) for _ in range(chance.randrange(4))}
        yield _call(number, chance.choice(NAMES), arguments)


def damaged(count: int, chance: random.Random) -> Iterator[bytes]:
    """Messages that are cut, changed, foreign, or no messages at all."""
    whole = [json.dumps(HELLO).encode(), _call(1, "state", {}), _call("x", "move", {"a": 1})]
    foreign = [
        b"GET / HTTP/1.1", b"<hri><stop/></hri>", b"null", b"[]", b"[" * 2000, b"\xff\xfe\x00",
        b'{"jsonrpc":"2.0","id":null,"method":"tools/call"}', b'{"jsonrpc":"1.0","method":"x"}',
        b'{"jsonrpc":"2.0","id":1,"result":{}}', b'{"jsonrpc":"2.0","method":"notifications/x"}',
        b'{"jsonrpc":"2.0","method":"notifications/cancelled","params":{"requestId":[1]}}',
        b'{"jsonrpc":"2.0","id":9,"method":"resources/read","params":{"uri":"file:///etc/passwd"}}',
        b'{"jsonrpc":"2.0","id":8,"method":"sampling/createMessage","params":{}}',
    ]  # fmt: skip
    for _ in range(count):
        if chance.random() < 0.5:
            yield chance.choice(foreign)
            continue
        data = bytearray(chance.choice(whole))
        for _ in range(chance.randrange(1, 6)):
            data[chance.randrange(len(data))] = chance.randrange(256)
        yield bytes(data[: chance.randrange(1, len(data) + 1)]).replace(b"\n", b" ")


def _call(id: int | str, name: str, arguments: dict[str, Any]) -> bytes:
    params = {"name": name, "arguments": arguments}
    request = {"jsonrpc": "2.0", "id": id, "method": "tools/call", "params": params}
    return json.dumps(request).encode()


# --- the assistant, in its own process ---


def assist(seconds: float) -> None:
    """Look at the state so often a second, for a while."""
    out = sys.stdout.buffer
    for line in (json.dumps(HELLO).encode(), json.dumps(READY).encode()):
        out.write(line + b"\n")
    for number in range(1, int(seconds * A_SECOND)):
        out.write(_call(number, "state", {}) + b"\n")
        out.flush()
        threading.Event().wait(1 / A_SECOND)


def attack(messages: int, calls: int) -> None:
    """Send what is damaged, then calls, then ask for the state, and wait for that answer."""
    out, chance = sys.stdout.buffer, random.Random(1)
    with suppress(BrokenPipeError):
        for line in (json.dumps(HELLO).encode(), json.dumps(READY).encode()):
            out.write(line + b"\n")
        for line in damaged(messages, chance):
            out.write(line + b"\n")
        out.flush()
        for line in hostile_calls(calls, chance):
            out.write(line + b"\n")
            out.flush()
            threading.Event().wait(SLOW)
        out.write(_call("the last", "state", {}) + b"\n")
        out.flush()
        threading.Event().wait(3600)  # until it is ended


# --- the robot ---


class Watch:
    """Notes what this process opens, connects to, and starts, once it is asked to."""

    def __init__(self, own: Path) -> None:
        allowed = (paths.house(), Path(sys.prefix), Path(sys.base_prefix), own)
        self._allowed = (*map(str, allowed), *SYSTEM)
        self.is_on = False
        self.seen: set[str] = set()
        sys.addaudithook(self._hear)

    def _hear(self, event: str, arguments: tuple[Any, ...]) -> None:
        if not self.is_on:
            return
        if event == "open" and isinstance(arguments[0], (str, bytes)):
            path = os.path.abspath(os.fsdecode(arguments[0]))
            if not path.startswith(self._allowed):
                self.seen.add(f"open {path}")
        elif event in ("os.system", "os.remove", "os.rename", "os.mkdir"):
            if not str(arguments[0]).startswith(self._allowed):
                self.seen.add(f"{event} {arguments[0]}"[:200])
        elif event in ("socket.connect", "subprocess.Popen"):
            self.seen.add(f"{event} {arguments[1]}"[:200])


def under_attack(messages: int, calls: int, own: Path) -> dict[str, Any]:
    """Be attacked, and report what that did."""
    from hri.net.mcp.permission import Permission
    from hri.net.mcp.session import StdioSession
    from hri.net.mcp.stdio import Wire

    watch = Watch(own)
    robot = Robot("companion", "simulated", devices=DEVICES, notice=lambda line: None)
    words = child.command("-m", MODULE, "attack", str(messages), str(calls))
    told, answers = os.pipe()
    report: dict[str, Any] = {}
    sizes: list[int] = []

    async def observe(context: TaskContext) -> None:
        (world,) = robot.resources.opened(SimulatedWorld)
        await context.clock.sleep(SETTLING)
        place = world.base.pose
        watch.is_on = True
        report.update(await trio.to_thread.run_sync(_until_the_last, told, sizes))
        watch.is_on = False
        pose = world.base.pose
        report["moved_m"] = round(float(np.hypot(pose.x - place.x, pose.y - place.y)), 6)
        report["elsewhere"] = sorted(watch.seen)
        report["grown_mb"] = round((sizes[-1] - sizes[len(sizes) // 3]) / 1e6, 1)
        robot.finish()

    environment = child.environment()
    with subprocess.Popen(words, stdout=subprocess.PIPE, env=environment) as attacker:
        assert attacker.stdout is not None
        wire = Wire(attacker.stdout.fileno(), answers)
        session = StdioSession(robot, Permission.READING, wire)
        with closing(robot):
            robot.live_until_over(session.serve, observe)
        attacker.kill()
    return {"messages": messages, "calls": calls, **report}


def _until_the_last(told: int, sizes: list[int]) -> dict[str, Any]:
    """What was answered until the last call was; `sizes` get the memory at each answer."""
    refused = answered = failed = 0
    process = psutil.Process()
    for line in open(told, "rb"):  # noqa: SIM115 - the process ends with it
        sizes.append(process.memory_info().rss)
        message = json.loads(line)
        if message.get("id") == "the last":
            return {
                "refused": refused, "answered": answered, "errors": failed,
                "lives": not message["result"]["isError"],
            }  # fmt: skip
        result = message.get("result", {})
        refused += bool(result.get("isError"))
        answered += bool(result) and not result.get("isError")
        failed += "error" in message
    return {"lives": False}


def lateness(case: str, seconds: float) -> dict[str, Any]:
    """How late the ticks of a 100 Hz network begin beside the companion."""
    robot = Robot(
        "companion", "simulated", clock=RealClock(), devices=DEVICES, notice=lambda _: None
    )
    stopwatch, network = Stopwatch("stopwatch"), Network(NAME, INTERVAL)
    network.add(stopwatch)
    jobs = list(robot.app.load_tasks())

    async def watch(context: TaskContext) -> None:
        await context.clock.sleep(SETTLING)
        robot.networks.start(network)
        await context.clock.sleep(seconds)
        robot.finish()

    words = child.command("-m", MODULE, "assist", str(2 * seconds + 60))
    with open(os.devnull, "wb") as nowhere, closing(robot):
        if case == "off":
            robot.live_until_over(*jobs, watch)
            return figures(stopwatch)
        from hri.net.mcp.permission import Permission
        from hri.net.mcp.session import StdioSession
        from hri.net.mcp.stdio import Wire

        quiet = child.command("-c", "import threading; threading.Event().wait()")
        assistant = words if case == "asked" else quiet
        environment = child.environment()
        with subprocess.Popen(assistant, stdout=subprocess.PIPE, env=environment) as process:
            assert process.stdout is not None
            wire = Wire(process.stdout.fileno(), nowhere.fileno())
            session = StdioSession(robot, Permission.READING, wire)
            robot.live_until_over(*jobs, session.serve, watch)
            process.kill()
    return figures(stopwatch)


def _in_a_process(*words: str, **variables: str) -> Any:
    run = subprocess.run(
        child.command("-m", MODULE, *words),
        stdout=subprocess.PIPE,
        env=child.environment(**variables),
        check=True,
    )
    return json.loads(run.stdout)


def measure(messages: int, calls: int, seconds: float) -> dict[str, Any]:
    """All of it."""
    with tempfile.TemporaryDirectory() as own:
        folders = dict.fromkeys(paths.USUAL, own)
        hostile = _in_a_process("attacked", str(messages), str(calls), own, **folders)
        late = {case: _in_a_process("late", case, str(seconds), **folders) for case in CASES}
    return {"bench": "hostile_mcp", "machine": machine(), "hostile": hostile, "lateness": late}


def main() -> None:
    """Measure all, or be one of its processes."""
    deeds: dict[str, Callable[..., object]] = {
        "attack": lambda messages, calls: attack(int(messages), int(calls)),
        "assist": lambda seconds: assist(float(seconds)),
        "attacked": lambda messages, calls, own: print(
            json.dumps(under_attack(int(messages), int(calls), Path(own)))
        ),
        "late": lambda case, seconds: print(json.dumps(lateness(case, float(seconds)))),
    }
    if sys.argv[1:] and sys.argv[1] in deeds:
        deeds[sys.argv[1]](*sys.argv[2:])
        return
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--messages", type=int, default=10_000)
    parser.add_argument("--calls", type=int, default=1_000)
    parser.add_argument("--seconds", type=float, default=30.0)
    options = parser.parse_args()
    print(json.dumps(measure(options.messages, options.calls, options.seconds), indent=2))


if __name__ == "__main__":
    main()
