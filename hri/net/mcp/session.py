"""The jobs of a robot to which an assistant has a door."""

from __future__ import annotations

import logging
import socket
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from hri.net.mcp import stdio
from hri.net.mcp.calls import Calls
from hri.net.mcp.connections import Connections
from hri.net.mcp.http import PATH, door
from hri.net.mcp.permission import Permission
from hri.net.mcp.protocol import server_of
from hri.robot import Robot
from hri.task.context import TaskContext


def address_of(listening: socket.socket) -> str:
    """Where the door over HTTP is."""
    return f"http://127.0.0.1:{listening.getsockname()[1]}{PATH}"


class StdioSession:
    """Serves the one assistant that started this program, and ends the robot with it."""

    def __init__(self, robot: Robot, permission: Permission, wire: stdio.Wire) -> None:
        self._robot, self._permission, self._wire = robot, permission, wire

    async def serve(self, context: TaskContext) -> None:
        """The job."""
        async with _calls(self._robot, context, self._permission) as calls:
            server = server_of(calls, "stdio")
            async with stdio.streams(self._wire) as (incoming, outgoing):
                await server.run(incoming, outgoing, server.create_initialization_options())
        self._robot.finish(why="the assistant has gone")


class HttpSession:
    """Serves all who show the bearer, as long as the robot lives."""

    def __init__(self, robot: Robot, permission: Permission, listening: socket.socket) -> None:
        self._robot, self._permission, self._listening = robot, permission, listening

    async def serve(self, context: TaskContext) -> None:
        """The job."""
        async with (
            _calls(self._robot, context, self._permission) as calls,
            door(server_of(calls, "http")) as app,
        ):
            await Connections(app).serve(self._listening)


@asynccontextmanager
async def _calls(
    robot: Robot, context: TaskContext, permission: Permission
) -> AsyncIterator[Calls]:
    # What strangers send is for the log of those who look for it, not for everyone's terminal.
    logging.getLogger("mcp").setLevel(logging.CRITICAL)
    calls = Calls(robot, context, permission)
    try:
        yield calls
    finally:
        calls.close()
