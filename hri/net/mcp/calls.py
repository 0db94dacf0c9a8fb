"""How a call is carried out: admitted, limited, marked as from outside, and ended with its client.

It runs as a task of the robot, so that claims, priorities, the safe base and "stop" are to it as to
all others.
"""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from hri.core.errors import HriError, did_you_mean
from hri.core.origin import MCP, caused_by
from hri.core.quoting import quoted
from hri.hal.pending import Interrupted
from hri.net.mcp.arguments import checked
from hri.net.mcp.permission import Kind, Permission, flag_for
from hri.net.mcp.rate import Rate
from hri.net.mcp.recent_events import RecentEvents
from hri.net.mcp.tools import TOOLS, Asked, Tool
from hri.robot import Robot
from hri.task.context import TaskContext
from hri.task.task_run import TaskStatus

MOST_CALLS = 8
"""Calls that are carried out at once; `stop` is always taken."""
BURST, A_SECOND = 40.0, 10.0
"""Calls that may come at once after a pause, and then each second."""
LONGEST_CLIENT = 40
"""Letters of what a client calls itself."""

log = logging.getLogger("hri.net")


class Refused(HriError):
    """A call that is not carried out, whatever it asks for."""


@dataclass(frozen=True, slots=True)
class Caller:
    """Who calls."""

    session: str
    """By which door it came: "stdio" or "http"."""
    client: str
    """What it calls itself, which proves nothing."""


class Calls:
    """The calls of all assistants of one robot, in its loop."""

    def __init__(self, robot: Robot, context: TaskContext, permission: Permission) -> None:
        self._robot, self._context = robot, context
        self._recent = RecentEvents(context)
        self._rate, self._stops = Rate(BURST, A_SECOND), Rate(BURST, A_SECOND)
        self._under_way = 0
        self.permission = permission

    @property
    def robot(self) -> Robot:
        """The robot that is asked."""
        return self._robot

    @property
    def tools(self) -> dict[str, Tool]:
        """Those that may be used."""
        return {name: one for name, one in TOOLS.items() if self.permission.allows(one.kind)}

    def close(self) -> None:
        """Listen to the robot no more."""
        self._recent.stop()

    def require_calm(self) -> None:
        """Count a request. Raises Refused when too many come."""
        if not self._rate.take(self._context.clock.now()):
            raise Refused(f"too many calls - {A_SECOND:g} a second are taken")

    async def call(self, name: str, given: Mapping[str, Any], caller: Caller) -> Any:
        """Carry out a call; what it gives. Raises HriError for all that goes wrong.

        A call that is cancelled, as its client has gone, ends with all that it began.
        """
        tool = self._admitted(name, caller)
        arguments = checked(name, tool.arguments, given)
        if tool.kind is Kind.STOPS:
            with caused_by(MCP):
                return await tool.do(Asked(self._robot, self._context, self._recent))
        if self._under_way >= MOST_CALLS:
            raise Refused(f"{MOST_CALLS} calls are under way - wait for one of them")
        self._under_way += 1
        try:
            return await self._carried_out(name, tool, arguments)
        finally:
            self._under_way -= 1

    def _admitted(self, name: str, caller: Caller) -> Tool:
        """The tool, if it may be used now. Raises HriError."""
        is_stop = name in TOOLS and TOOLS[name].kind is Kind.STOPS
        if not is_stop:
            self.require_calm()
        if name not in TOOLS:
            raise HriError(f'no tool "{quoted(name)}" - {did_you_mean(name[:60], self.tools)}')
        tool = TOOLS[name]
        if not self.permission.allows(tool.kind):
            self._tell("mcp.refused", name, caller)
            what = f"{name} is not allowed: this robot may only be looked at and stopped"
            if self.permission is not Permission.READING:
                what = f"{name} is not allowed: this robot may not be moved"
            raise Refused(f"{what} - a person starts `hri mcp` with {flag_for(tool.kind)}")
        # A stop is always carried out; that it came is told as often as anything else.
        if not is_stop or self._stops.take(self._context.clock.now()):
            self._tell("mcp.called", name, caller)
        return tool

    def _tell(self, event: str, tool: str, caller: Caller) -> None:
        log.info("%s: %s by %s over %s", event, tool, caller.client, caller.session)
        with caused_by(MCP):
            self._context.events.raise_event(
                event, tool=tool, session=caller.session, client=caller.client, by=MCP
            )

    async def _carried_out(self, name: str, tool: Tool, arguments: Mapping[str, Any]) -> Any:
        """Run it as a task. Raises HriError when it fails, is interrupted, or takes too long."""
        found: list[Any] = []
        failed: list[HriError] = []

        async def assistant(context: TaskContext) -> None:
            asked = Asked(self._robot, context, self._recent)
            try:
                with caused_by(MCP):
                    found.append(await tool.do(asked, **arguments))
            except Interrupted:
                raise
            except HriError as error:
                failed.append(error)
            except Exception as error:  # a mistake of ours must not end the robot
                log.error("%s failed: %s", name, error, exc_info=error)
                failed.append(HriError(f"{name} failed - the robot goes on; see its log"))

        task = self._context.manager.install(assistant)
        try:
            with self._context.clock.move_on_after(tool.longest) as scope:
                await task.wait()
            if scope.cancelled_caught:
                raise HriError(f"{name} was ended after {tool.longest:g} s")
        finally:
            task.cancel()
        if failed:
            raise failed[0]
        if not found:
            raise HriError(f"{name} was interrupted{_because(task.status, task.error)}")
        return found[0]


def _because(status: TaskStatus, error: Exception | None) -> str:
    if status is TaskStatus.CANCELLED and error is None:
        return ": someone stopped the robot"
    return f": {error}" if error is not None else ""
