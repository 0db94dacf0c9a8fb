"""A robot with a studio: the server beside it, its address, and what the page asks."""

from __future__ import annotations

import json
import logging
import secrets
import socket
import subprocess
import threading
from collections.abc import Awaitable, Iterator
from contextlib import contextmanager, suppress

import trio

from hri.core import child
from hri.core.errors import HriError
from hri.robot import Job, Robot
from hri.studio.access import Codes
from hri.studio.actions import Asked, obey
from hri.studio.commands import HEAR
from hri.studio.devices import devices_of
from hri.studio.link import RobotEnd
from hri.studio.live import Live
from hri.studio.network_watch import NetworkWatch
from hri.studio.port import SERVER, listening
from hri.studio.request_queue import STOP, Request
from hri.studio.running import RunningNetworks
from hri.task.context import TaskContext

PORT = 8311
"""Where the page is, unless told otherwise."""
LOOK_EVERY = 0.02
"""Seconds between two looks at what the page asks."""
AGAIN_AFTER = 0.2
"""Seconds until a server that has ended is started again."""
PATIENCE = 3.0
"""Seconds that a server has to end."""
CODE = "code"
"""The request for another code."""

log = logging.getLogger("hri.studio")


class StudioSession:
    """Made before the robot lives; `jobs` run with it, `close` ends the server."""

    def __init__(self, robot: Robot, port: int = PORT, allows_remote: bool = False) -> None:
        """Listens at once. Raises HriError where it cannot."""
        self._robot = robot
        self._socket = listening(port, allows_remote)
        self.port: int = self._socket.getsockname()[1]
        secret = secrets.token_urlsafe(32)
        self._codes = Codes(secret)
        self._link = RobotEnd()
        self._networks = RunningNetworks(robot.networks, robot.app.is_network)
        self._watch = NetworkWatch(robot.networks, self._link, self._networks.has_breakpoint)
        self._live = Live(robot, self._link, self._networks)
        self._is_closed = threading.Event()
        self._config = {
            "port": self.port,
            "secret": secret,
            "allows_remote": allows_remote,
            "networks": [str(path.resolve()) for path in robot.app.networks],
            "devices": devices_of(robot.resources),
        }
        self._child: subprocess.Popen[bytes] | None = None
        self._keeper = threading.Thread(target=self._keep_server, name="studio", daemon=True)

    def start(self) -> None:
        """Start the server, and let the page have face and log; before the robot lives."""
        self._live.join()
        self._keeper.start()

    @property
    def server(self) -> int:
        """The process of the server that runs, or ran last; 0 before the first."""
        return self._child.pid if self._child is not None else 0

    def address(self) -> str:
        """The page, with another code that works once."""
        return f"http://127.0.0.1:{self.port}/?code={self._codes.new()}"

    def jobs(self) -> list[Job]:
        """The tasks that run beside the robot's own."""
        return [self._stop_when_asked, self._live.watch, self._watch.watch, self._obey]

    async def _stop_when_asked(self, context: TaskContext) -> None:
        """Stop the robot as soon as its loop goes on: a loop that was held up has many timers that
        are due, for which a stop does not wait.
        """
        asked = Asked(self._robot, context, self._networks)
        token = trio.lowlevel.current_trio_token()
        wanted = trio.Event()

        def wake() -> None:
            with suppress(trio.RunFinishedError):
                token.run_sync_soon(lambda: wanted.set(), idempotent=True)

        while True:
            self._link.requests.call_on_stop(wake)
            await wanted.wait()
            wanted = trio.Event()
            self._stop(asked)

    def _stop(self, asked: Asked) -> None:
        """Stop the robot if someone asked for it."""
        if (numbers := self._link.requests.take_stop()) is not None:
            with self._refusing(STOP, *numbers):
                obey(asked, STOP, {})
                for number in numbers:
                    self._link.answer(number)

    async def _obey(self, context: TaskContext) -> None:
        """Do what the page asks, in the robot's loop."""
        asked = Asked(self._robot, context, self._networks)
        async with trio.open_nursery() as nursery:
            while True:
                while (request := self._link.requests.take()) is not None:
                    self._stop(asked)  # what was asked for since the one before
                    with self._refusing(request.command, request.number):
                        if (takes_a_while := self._begun(asked, request)) is not None:
                            nursery.start_soon(self._finish, request, takes_a_while)
                await context.clock.sleep(LOOK_EVERY)

    def _begun(self, asked: Asked, request: Request) -> Awaitable[object] | None:
        """What to await before the answer; None where it is done and answered."""
        result: object = None
        if request.command == HEAR:
            self._live.typed.add(str(request.arguments.get("text", "")))
        if request.command == CODE:
            result = self.address()
        elif request.command == "redeem":
            result = self._codes.redeem(str(request.arguments.get("code", "")))
        elif (doing := obey(asked, request.command, request.arguments)) is not None:
            return doing
        self._link.answer(request.number, result=result)
        return None

    async def _finish(self, request: Request, doing: Awaitable[object]) -> None:
        with self._refusing(request.command, request.number):
            self._link.answer(request.number, result=await doing)

    @contextmanager
    def _refusing(self, command: str, *numbers: int) -> Iterator[None]:
        """Whatever goes wrong is an answer; a mistake of ours must not end the robot's loop."""
        try:
            yield
        except HriError as error:
            failed = str(error)
        except Exception as error:
            log.error("%s failed: %s", command, error, exc_info=error)
            failed = f"{command} failed: {error!r} - the robot goes on; see its log"
        else:
            return
        for number in numbers:
            self._link.answer(number, error=failed)

    def _keep_server(self) -> None:
        """Start the server, and again when it has ended. The port stays ours meanwhile: a page that
        comes back waits instead of being refused.
        """
        while not self._is_closed.is_set():
            ours, theirs = socket.socketpair()
            fds = (self._socket.fileno(), theirs.fileno())
            words = child.command("-m", SERVER, *map(str, fds))
            try:
                self._child = subprocess.Popen(
                    words,
                    stdin=subprocess.PIPE,
                    pass_fds=fds,
                    env=child.environment(),
                    start_new_session=True,  # Ctrl-C is for the robot, which ends the server
                )
            except OSError as error:
                log.error("the studio cannot start: %s", error)
                return
            theirs.close()
            self._give(self._child)
            self._link.attach(ours)
            self._child.wait()
            self._link.detach()
            if not self._is_closed.wait(AGAIN_AFTER):
                log.error("the studio's server has ended - it starts again")

    def _give(self, server: subprocess.Popen[bytes]) -> None:
        """The settings, which no other user can read there."""
        assert server.stdin is not None
        try:
            server.stdin.write(json.dumps(self._config).encode())
            server.stdin.close()
        except OSError:  # it has ended already, and is started again
            log.debug("the studio's server ended before it began")

    def close(self) -> None:
        """End the server; a second call does nothing."""
        self._is_closed.set()
        self._live.leave()
        self._link.close()
        if self._child is not None:
            try:
                self._child.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                self._child.kill()
        self._socket.close()
