"""What a robot sends of its slots and ports: only what someone wants, and asks for again."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from hri.behavior.board import DECLARED
from hri.behavior.ports import GENERIC
from hri.core.errors import HriError
from hri.core.signals import Frame
from hri.net.zenoh import values
from hri.net.zenoh.meanings import Meanings
from hri.net.zenoh.remote_slot import REPEAT
from hri.net.zenoh.session import is_name
from hri.robot import Robot
from hri.task.context import TaskContext

LEASE = 3.0
"""Seconds for which a value is sent to who wants it, and does not ask again."""
MOST_WANTED = 200
"""Values that are sent at a time."""


class Offer:
    """Sends values to readers; used in the robot's loop."""

    def __init__(
        self,
        robot: Robot,
        send: Callable[[str, Sequence[values.Row]], object],
        complain: Callable[[str, str], object],
        meanings: Meanings,
    ) -> None:
        """`send` gets a reader and its values; `complain` a subject and a line."""
        self._meanings = meanings
        self._robot, self._send, self._complain = robot, send, complain
        self._wanted: dict[str, dict[str, float]] = {}
        """Until when each address is sent, by who reads it."""
        self._sent: dict[tuple[str, str], tuple[float, float]] = {}
        """When each was sent last, and when the value of then was made."""
        self._under_way = set[tuple[str, str]]()
        """Pictures that are made ready, by reader and address."""
        self.send_aside: Callable[[str, str, Frame, float], object] = lambda *picture: None
        """Lets `send_picture` run beside the loop."""

    def want(self, arguments: Mapping[str, Any], now: float) -> None:
        """Send values to a reader for LEASE. Raises HriError for what cannot be wanted."""
        reader, addresses = str(arguments.get("reader", "")), arguments.get("addresses", [])
        if not isinstance(addresses, list):
            raise HriError("addresses is not a list - name slots and ports")
        if not addresses:
            return
        others = sum(len(one) for name, one in self._wanted.items() if name != reader)
        if not is_name(reader) or others + len(addresses) > MOST_WANTED:
            raise HriError(f"at most {MOST_WANTED} values are sent - ask for fewer")
        self._wanted[reader] = dict.fromkeys(map(str, addresses), now + LEASE)

    def send_new(self, now: float) -> None:
        """Send the values that are newer than those before; after each tick."""
        self._send_due(now, is_again=False)

    def send_again(self, now: float) -> None:
        """Send also the values that stay, and forget who does not ask again."""
        self._send_due(now, is_again=True)
        for reader, addresses in tuple(self._wanted.items()):
            if max(addresses.values()) < now:
                del self._wanted[reader]
                self._sent = {key: one for key, one in self._sent.items() if key[0] != reader}

    def _send_due(self, now: float, is_again: bool) -> None:
        for reader, addresses in self._wanted.items():
            due = (self._row(reader, address, now, is_again) for address in addresses)
            if rows := [row for row in due if row is not None]:
                self._send(reader, rows)

    def _row(self, reader: str, address: str, now: float, is_again: bool) -> values.Row | None:
        """A value as it is sent; None where it was sent already, or cannot travel."""
        value, made, meaning = self._value_of(address)
        sent, before = self._sent.get((reader, address), (-1.0, -1.0))
        if made == before and not (is_again and now - sent >= REPEAT):
            return None
        self._sent[reader, address] = (now, made)
        if isinstance(value, Frame):
            self.send_aside(reader, address, value, made)
            return None
        try:
            return values.row(address, value, made, meaning)
        except HriError as error:
            self._complain(address, str(error))
            return None

    async def send_picture(
        self, context: TaskContext, reader: str, address: str, frame: Frame, made: float
    ) -> None:
        """Send a picture, which is made a JPEG beside the loop; one at a time to each reader."""
        if (reader, address) in self._under_way:
            return
        self._under_way.add((reader, address))
        try:
            self._send(reader, [await context.blocking(values.row, address, frame, made)])
        except HriError as error:
            self._complain(address, str(error))
        finally:
            self._under_way.discard((reader, address))

    def _value_of(self, address: str) -> tuple[Any, float, str]:
        """The value of a slot, or the last one of a port of a network, when it was made, and what
        it means; empty for whatever.
        """
        network, _, rest = address.partition(".")
        behavior, _, output = rest.partition(".")
        runner = self._robot.networks.runners.get(network)
        if runner is not None and output:
            for one in runner.network.behaviors:
                if one.id == behavior and output in one.outputs:
                    semantic = one.outputs[output].semantic
                    meaning = semantic if semantic != GENERIC else ""
                    return one.output_port(output).value, runner.last_tick, meaning
        if address in DECLARED or address in self._robot.board:
            value, made = self._robot.board.slot(address).get()
            made = made if value is not None else -made
            return value, made, self._meanings.sent(address)
        return None, 0.0, ""
