"""The behavior whose ports a schema defines: inputs are sent over TCP, received values become
outputs. `docs/bridge.md` describes the protocol.
"""

from __future__ import annotations

import logging
import os
from typing import Any

from hri.behavior.behavior import Behavior, Context
from hri.behavior.effects import ANYTHING, NOTHING
from hri.behavior.ports import Input, Output, Param
from hri.core.errors import HriError
from hri.core.origin import BRIDGE, caused_by
from hri.core.quoting import quoted
from hri.net import control, values
from hri.net.client import Client
from hri.net.door import Door
from hri.net.inbox import Inbox
from hri.net.loopback import is_loopback
from hri.net.malleable_protocol import LONGEST, Item, Message, Sender, checked_name, split
from hri.net.port_pool import borrow, give_back
from hri.net.receipts import Receipts
from hri.net.server import Server
from hri.net.tcp_port import TcpPort

log = logging.getLogger("hri.net")

LOOPBACK = "127.0.0.1"
BIND = "HRI_BIND"
"""The environment variable for where servers listen."""


class MalleableBehavior(Behavior):
    """Sends its inputs over TCP, and on its outputs what arrives for them; ports by schema."""

    category = "net"
    is_relay = True
    takes_any_ports = True
    tcp_host = Param("", "the server to connect with; empty: be the server")
    tcp_port = Param(25000, "the port; 0: a free one, for servers", minimum=0, maximum=65535)
    tag_name = Param("malleable", "behaviors with the same tag talk with each other")
    bind = Param("", "where a server listens; empty: what HRI_BIND says, else 127.0.0.1")
    keep_quotes = Param(
        True, "leave the quotes that strings of other behaviors come in, as in 2003"
    )
    separator = Param(
        "space",
        "between the numbers of an array that is sent; all are read",
        among=tuple(values.SEPARATORS),
    )

    @property
    def bridge_ports(self) -> tuple[tuple[str, str], ...]:
        return tuple((self.tag_name, name) for name in self.outputs)

    def check(self) -> None:
        """Raises HriError for a datatype or a name that cannot travel."""
        if checked_name(self.tag_name) == control.TAG:
            raise HriError(
                f'{self.id}: the tag "{control.TAG}" is the bridge\'s own - take another'
            )
        # Not by name alone: an input and an output may share one.
        ports: list[Input[Any] | Output[Any]] = [*self.inputs.values(), *self.outputs.values()]
        for port in ports:
            name = port.name
            checked_name(name)
            if port.datatype not in values.FORMS:
                travels = ", ".join(values.FORMS)
                what = f"{self.id}.{name} is {port.datatype}, which does not travel over TCP"
                raise HriError(f"{what} - use one of {travels}")

    def start(self, context: Context) -> None:
        self._inputs = [
            (name, self.input_port(name), p.datatype) for name, p in self.inputs.items()
        ]
        self._told: set[str] = set()
        self._clock = context.clock
        self._inbox = Inbox({name: port.datatype for name, port in self.outputs.items()})
        self._events = context.events
        self._receipts = Receipts(self.tag_name, context.events)
        # The other end may be a robot, to which this program proves the token.
        self.may_do = ANYTHING if self.tcp_host else NOTHING
        self._door = Door(self, self.tag_name, context)
        self._door.prepare()
        self._is_told_to_stop = False
        self._link = self._opened(context.doors.allows_remote)
        self._link.subscribe(self.tag_name, self._receive)
        self._link.subscribe(control.TAG, self._obey)

    def _opened(self, allows_remote: bool) -> TcpPort:
        """Raises HriError when it would let other machines in and nobody has allowed it."""
        port = int(self.tcp_port)
        if self.tcp_host:
            proves_token = allows_remote or is_loopback(self.tcp_host)
            return borrow(Client, self.tcp_host, port, proves_token=proves_token)
        host = self.bind or os.environ.get(BIND) or LOOPBACK
        if not allows_remote and not is_loopback(host):
            where = "bind" if self.bind else BIND
            what = f"{where} {quoted(host)} lets other machines in"
            raise HriError(f"{what} - start it with --allow-remote, or bind to {LOOPBACK}")
        return borrow(Server, host, port)

    @property
    def port_in_use(self) -> int:
        """The TCP port, from `start` on."""
        return self._link.port

    def compute(self, now: float, dt: float) -> None:
        items = [
            Item(name, values.write(datatype, value, self.separator))
            for name, port, datatype in self._inputs
            for value in port.values
            if values.can_travel(value)
        ]
        if items:
            self._send(items)
        self._door.look()
        if self._is_told_to_stop:
            self._is_told_to_stop = False
            with caused_by(BRIDGE):
                self._events.raise_event("drive.halt", because="I was told to over the network")
        taken = self._inbox.take(self._door.admits)
        self._receipts.take({name: value for name, (value, _) in taken.items()}, dt)
        for name, (value, spoken) in taken.items():
            is_bare = self.keep_quotes or not isinstance(value, str)
            self.output_port(name).send(value if is_bare else values.unquoted(value), spoken)

    def stop(self) -> None:
        self._link.unsubscribe(self.tag_name, self._receive)
        self._link.unsubscribe(control.TAG, self._obey)
        give_back(self._link)

    def _send(self, items: list[Item]) -> None:
        lines, too_long = split(Message(self.tag_name, tuple(items)))
        for line in lines:
            self._link.send(line)
        for item in too_long:
            if item.port not in self._told:
                self._told.add(item.port)
                what = "%s.%s: a value of %d characters is not sent - keep it within %d bytes"
                log.warning(what, self.id, item.port, len(item.text), LONGEST)

    def _receive(self, message: Message) -> None:
        """Keep what has arrived, in the thread of the port."""
        sender = message.sender or Sender()
        sender.spoken = self._clock.now()
        self._inbox.put(*self._door.admitted(message.items, sender), sender=sender)

    def _obey(self, message: Message) -> None:
        """Stop at the next tick, whoever on this machine says so."""
        self._is_told_to_stop = True
