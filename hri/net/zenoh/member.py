"""A robot's end of the fleet: its values, its events, and requests from who proves the token.

Keys, all below `hri/`:

    robots/NAME              alive as long as the robot (a liveliness token)
    NAME/hello               asked with a nonce: an answer to believe it by, and a ticket
    NAME/do                  asked with a request: its result
    NAME/values/READER       values of slots and ports, while a robot wants them
    NAME/put/SLOT/ROBOT      values that another robot writes into a slot
    NAME/event/EVENT         events, while someone wants them
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack, suppress
from typing import TYPE_CHECKING, Any

import msgspec
import trio

from hri.behavior.board import DECLARED, BoardSink, BoardSource
from hri.behavior.ports import ANY, DATATYPES
from hri.core.errors import HriError
from hri.core.latest import Latest
from hri.core.signals import Event, Frame
from hri.core.token import is_nonce, new_nonce, own_token
from hri.net.zenoh import values
from hri.net.zenoh.clocks import OtherClock, RoundTrip
from hri.net.zenoh.remote_slot import REPEAT, SILENCE, Arrival, RemoteSlot
from hri.net.zenoh.requests import Asked, Request, answer_to
from hri.net.zenoh.seal import Envelope, Pen, Reader, Tickets, envelope_of, hello_of, require_seal
from hri.net.zenoh.session import PATIENCE, ROBOTS, FleetSettings, check, is_name, opened
from hri.robot import Robot
from hri.robot.recording import REJECTED
from hri.task.context import TaskContext

if TYPE_CHECKING:
    import zenoh

LEASE = 3.0
"""Seconds for which a value is sent to who wants it, and does not ask again."""
RENEW = 1.0
"""Seconds after which it is asked for again, and clocks are compared."""
MOST_WANTED = 200
"""Values that are sent at a time."""
MOST_REQUESTS = 64
"""Requests that wait for the robot's loop."""
MOST_REMOTE = 1000
"""Slots of other robots that are followed."""
TELL_EVERY = 10.0
"""Seconds between two lines in the log about messages of one robot that do not count."""

log = logging.getLogger("hri.net")


class Member:
    """Made before the robot lives; `be_in_fleet` runs with it, as a job."""

    def __init__(self, robot: Robot, settings: FleetSettings) -> None:
        """Raises HriError where no token can be had, or the configuration cannot be read."""
        check(settings)
        self.robot, self.settings = robot, settings
        self._clock = robot.clock
        token = own_token()
        self._token, self._pen, self._reader = token, Pen(token), Reader(token)
        self._tickets = Tickets()
        self._guard, self._sending = threading.RLock(), threading.Lock()
        self._remote: dict[str, RemoteSlot] = {}
        self._clocks: dict[str, OtherClock] = {}
        self._asked: dict[str, float] = {}
        """When each robot was asked for a hello."""
        self._wanted: dict[str, dict[str, float]] = {}
        """Until when each address is sent, by who reads it."""
        self._sent: dict[tuple[str, str], tuple[float, float]] = {}
        """When each was sent last, and when what was sent was made."""
        self._under_way = set[tuple[str, str]]()
        """Pictures that are made ready, by reader and address."""
        self._send_aside: Callable[[str, str, Frame, float], object] = lambda *picture: None
        self._events_until = 0.0
        """Until when events are sent."""
        self._put: dict[str, float] = {}
        """When each slot of ours was written by another robot."""
        self._waiting = 0
        """Requests that were taken, and not begun."""
        self._told: dict[str, float] = {}
        self.complaints = 0
        """Messages that did not count."""
        self._begin: Callable[[Request, zenoh.Query], object] = lambda *asked: None
        """Begins a request in the robot's loop; called by any thread."""
        self._session: zenoh.Session | None = None
        robot.board.remote = self._slot_of

    # --- in the robot's loop ---

    async def be_in_fleet(self, context: TaskContext) -> None:
        """Be in the fleet as long as the robot lives. Raises HriError where it cannot join."""
        with ExitStack() as stack:
            session = await context.blocking(stack.enter_context, opened(self.settings))
            await context.blocking(self._join, session)
            stack.callback(self._leave)
            stack.callback(context.events.subscribe("*", self._tell).cancel)
            loop = trio.lowlevel.current_trio_token()
            async with trio.open_nursery() as nursery:

                def begin(request: Request, query: zenoh.Query) -> None:
                    nursery.start_soon(self._do, context, request, query)

                self._begin = lambda *asked: loop.run_sync_soon(begin, *asked)
                self._send_aside = lambda *picture: nursery.start_soon(
                    self._send_picture, context, *picture
                )
                while True:
                    for runner in context.networks.runners.values():
                        if self._send_new not in runner.after_tick:
                            runner.after_tick.append(self._send_new)
                    self._tend(self._clock.now())
                    await context.clock.sleep(REPEAT)

    def _join(self, session: zenoh.Session) -> None:
        name = self.settings.name
        if _is_there(session, name):
            raise HriError(f'a robot "{name}" is in the fleet already - choose another name')
        for key, take in (("hello", self._hello), ("do", self._request)):
            session.declare_queryable(f"hri/{name}/{key}", take)
        session.declare_subscriber(f"hri/{name}/put/**", self._take_put)
        session.declare_subscriber(f"hri/*/values/{name}", self._take)
        self._session = session
        self._alive = session.liveliness().declare_token(f"{ROBOTS}/{name}")

    def _leave(self) -> None:
        self._session = None
        self._begin = lambda *asked: None
        self._send_aside = lambda *picture: None

    async def _do(self, context: TaskContext, request: Request, query: zenoh.Query) -> None:
        """Do what is asked for, and answer."""
        self._waiting -= 1
        key = f"hri/{self.settings.name}/do"
        try:
            if request.verb == "want":
                self._want(request.arguments)
                result: object = None
            else:
                result = await answer_to(Asked(self.robot, context), request)
            data, kind = msgspec.msgpack.encode(result), "done"
        except HriError as error:
            data, kind = msgspec.msgpack.encode(str(error)), "refused"
        except Exception as error:  # a mistake of ours, or of a task, must not end the robot
            log.error("%s failed: %s", request.verb, error, exc_info=error)
            data, kind = msgspec.msgpack.encode(f"{request.verb} failed - see its log"), "refused"
        now = self._clock.now()
        with self._sending:
            sealed = self._pen.sealed(key, data, now, now, kind)
            query.reply(key, data, attachment=sealed)
        query.drop()  # type: ignore[no-untyped-call]

    def _want(self, arguments: Mapping[str, Any]) -> None:
        """Send values, or events, for a while."""
        until = self._clock.now() + LEASE
        if arguments.get("events"):
            self._events_until = until
        reader, addresses = str(arguments.get("reader", "")), arguments.get("addresses", [])
        if not addresses:
            return
        if not isinstance(addresses, list):
            raise HriError("addresses is not a list - name slots and ports")
        others = sum(len(one) for name, one in self._wanted.items() if name != reader)
        if not is_name(reader) or others + len(addresses) > MOST_WANTED:
            raise HriError(f"at most {MOST_WANTED} values are sent - ask for fewer")
        self._wanted[reader] = dict.fromkeys(map(str, addresses), until)

    def _tend(self, now: float) -> None:
        """Send again the values that stay, and give up slots that are silent."""
        self._send(now, is_again=True)
        with self._guard:
            slots = tuple(self._remote.values())
        for slot in slots:
            slot.look(now)
            if slot.is_written and slot.value is not None:
                self._send_away(slot)
        for name, heard in tuple(self._put.items()):
            if now - heard > SILENCE:
                del self._put[name]
                self.robot.board.slot(name).clear()
        for robot in {slot.robot for slot in slots}:
            if now - self._asked.get(robot, -RENEW) >= RENEW:
                self._greet(robot, [s for s in slots if s.robot == robot])

    def _send_new(self, now: float) -> None:
        """After a tick: send what is wanted and changed."""
        if self._wanted:
            self._send(now, is_again=False)

    def _send(self, now: float, is_again: bool) -> None:
        for reader, addresses in tuple(self._wanted.items()):
            rows = [
                row
                for address in addresses
                if (row := self._row(reader, address, now, is_again)) is not None
            ]
            if rows:
                self._send_rows(reader, rows, now)
            if max(addresses.values()) < now:
                del self._wanted[reader]
                self._sent = {key: one for key, one in self._sent.items() if key[0] != reader}

    def _row(self, reader: str, address: str, now: float, is_again: bool) -> values.Row | None:
        """A value as it is sent; None where it was sent already, or cannot travel."""
        value, made = self._value_of(address)
        sent, before = self._sent.get((reader, address), (-1.0, -1.0))
        if made == before and not (is_again and now - sent >= REPEAT):
            return None
        self._sent[reader, address] = (now, made)
        if isinstance(value, Frame):
            self._send_aside(reader, address, value, made)
            return None
        try:
            return values.row(address, value, made)
        except HriError as error:
            self._complain(address, str(error))
            return None

    def _send_rows(self, reader: str, rows: Sequence[values.Row], now: float) -> None:
        data = msgspec.msgpack.encode(rows)
        self._put_out(f"hri/{self.settings.name}/values/{reader}", data, now, "values")

    async def _send_picture(
        self, context: TaskContext, reader: str, address: str, frame: Frame, made: float
    ) -> None:
        """Send a picture, which is made a JPEG beside the loop; one at a time to each reader."""
        if (reader, address) in self._under_way:
            return
        self._under_way.add((reader, address))
        try:
            row = await context.blocking(values.row, address, frame, made)
            self._send_rows(reader, [row], self._clock.now())
        except HriError as error:
            self._complain(address, str(error))
        finally:
            self._under_way.discard((reader, address))

    def _value_of(self, address: str) -> tuple[Any, float]:
        """The value of a slot, or the last one of a port of a network, and when it was made."""
        network, _, rest = address.partition(".")
        behavior, _, output = rest.partition(".")
        runner = self.robot.networks.runners.get(network)
        if runner is not None and output:
            for one in runner.network.behaviors:
                if one.id == behavior and output in one.outputs:
                    return one.output_port(output).value, runner.last_tick
        if address in self._slots_in_use():
            value, made = self.robot.board.slot(address).get()
            return value, made if value is not None else -made
        return None, 0.0

    def _slots_in_use(self) -> set[str]:
        return {*DECLARED, *self.robot.board}

    def _tell(self, event: Event) -> None:
        """Send an event that someone wants, as a recording has it."""
        if event.time <= self._events_until:
            withheld = REJECTED.get(event.name, ())
            told = {key: "" if key in withheld else one for key, one in event.properties.items()}
            own = {"t": round(event.time, 4), "event": event.name}
            own |= {"origin": event.origin} if event.origin else {}
            try:
                data = msgspec.json.encode({**own, **told, **own}, enc_hook=str)
            except (TypeError, ValueError, RecursionError):
                return
            key = f"hri/{self.settings.name}/event/{event.name}"
            self._put_out(key, data, event.time, "event")

    # --- remote slots ---

    def _slot_of(self, address: str) -> Latest[Any]:
        robot = address.partition("/")[0]
        if robot == self.settings.name:
            return self.robot.board.slot(address.partition("/")[2])
        with self._guard:
            if len(self._remote) >= MOST_REMOTE:
                raise HriError(f"{MOST_REMOTE} slots of other robots are followed - use fewer")
            slot = self._remote[address] = RemoteSlot(address, self._send_away)
        return slot

    def _send_away(self, slot: RemoteSlot) -> None:
        key = f"hri/{slot.robot}/put/{slot.name}/{self.settings.name}"
        try:
            row = values.row(slot.name, *slot.get())
        except HriError as error:
            self._complain(key, str(error))
            return
        self._put_out(key, row.data, row.made, row.datatype)

    def _put_out(self, key: str, data: bytes, made: float, datatype: str) -> None:
        if (session := self._session) is None:
            return
        import zenoh

        # In the order of their numbers: one that comes before an earlier one would not count.
        with self._sending, suppress(zenoh.ZError):  # which it raises when it was closed
            sealed = self._pen.sealed(key, data, self._clock.now(), made, datatype)
            session.put(
                key,
                data,
                attachment=sealed,
                congestion_control=zenoh.CongestionControl.DROP,
                express=True,
            )

    def _greet(self, robot: str, slots: list[RemoteSlot]) -> None:
        """Meet another robot again, and ask it for values."""
        import zenoh

        session = self._session
        if session is None:
            return
        asked, nonce = self._clock.now(), new_nonce()
        self._asked[robot] = asked
        read = [slot.name for slot in slots if not slot.is_written]

        def met(reply: zenoh.Reply) -> None:
            answered = self._clock.now()
            if (ok := reply.ok) is None:
                return
            try:
                hello = hello_of(ok.payload.to_bytes())
                if hello.name != robot:
                    return
                with self._guard:
                    is_another = self._reader.epochs.get(robot) != hello.epoch
                    self._reader.meet(hello, nonce)
                    if is_another:  # It began again, and so did its clock.
                        self._clocks[robot] = OtherClock()
                    clock = self._clocks[robot]
                clock.take(RoundTrip(asked, answered, hello.clock))
            except HriError as error:
                self._complain(robot, str(error))
                return
            if read:
                request = Request(
                    hello.ticket, "want", {"reader": self.settings.name, "addresses": read}
                )
                self._ask(session, robot, request)

        with suppress(zenoh.ZError):  # It was closed meanwhile.
            session.get(f"hri/{robot}/hello", met, payload=nonce, timeout=PATIENCE)

    def _ask(self, session: zenoh.Session, robot: str, request: Request) -> None:
        import zenoh

        key, data = f"hri/{robot}/do", msgspec.msgpack.encode(request)
        now = self._clock.now()
        with self._sending, suppress(zenoh.ZError):
            sealed = self._pen.sealed(key, data, now, now, "request")
            session.get(key, lambda reply: None, payload=data, attachment=sealed, timeout=PATIENCE)

    # --- in threads of Zenoh ---

    def _hello(self, query: zenoh.Query) -> None:
        payload = query.payload
        data = payload.to_bytes() if payload is not None and len(payload) <= 64 else b""
        nonce = data.decode("ascii", "replace")
        if is_nonce(nonce):
            now = self._clock.now()
            hello = self._pen.hello(self.settings.name, nonce, now, self._tickets.new(now))
            query.reply(f"hri/{self.settings.name}/hello", msgspec.msgpack.encode(hello))
        query.drop()  # type: ignore[no-untyped-call]

    def _request(self, query: zenoh.Query) -> None:
        key = f"hri/{self.settings.name}/do"
        try:
            payload, sealed = query.payload, query.attachment
            if payload is None or sealed is None or len(payload) > values.LONGEST:
                raise HriError("a request without a seal")
            data = payload.to_bytes()
            require_seal(self._token, key, data, envelope_of(sealed.to_bytes()))
            request = msgspec.msgpack.decode(data, type=Request)
            with self._guard:
                self._tickets.use(request.ticket, self._clock.now())
                if self._waiting >= MOST_REQUESTS:
                    raise HriError("too many requests wait - try again")
                self._waiting += 1
            self._begin(request, query)
        except (HriError, ValueError, RecursionError) as error:
            self._complain("request", str(error))
            query.drop()  # type: ignore[no-untyped-call]

    def _take(self, sample: zenoh.Sample) -> None:
        """Values that this robot wants of another one."""
        key = str(sample.key_expr)
        robot = key.split("/")[1]
        if (believed := self._believed(robot, key, sample)) is None:
            return
        envelope, clock, now = believed
        try:
            for row in values.rows_of(sample.payload.to_bytes()):
                slot = self._remote.get(f"{robot}/{row.address}")
                if slot is not None and not slot.is_written:
                    made, sent = clock.ours(row.made), clock.ours(envelope.time)
                    slot.arrive(row.value(), Arrival(row.datatype, made, sent, now))
        except HriError as error:
            self._complain(key, str(error))

    def _take_put(self, sample: zenoh.Sample) -> None:
        """A value that another robot writes into a slot of ours."""
        key = str(sample.key_expr)
        slot, _, robot = key.removeprefix(f"hri/{self.settings.name}/put/").rpartition("/")
        if (believed := self._believed(robot, key, sample)) is None:
            return
        envelope, clock, now = believed
        wanted = self._datatype_wanted(slot)
        try:
            row = values.Row(slot, envelope.made, envelope.datatype, sample.payload.to_bytes())
            value = row.value()
            if wanted is None or (value is not None and not _fits(value, wanted)):
                what = "no network reads it" if wanted is None else f"it takes a {wanted}"
                raise HriError(f"{robot} writes a {row.datatype} to {slot}: {what}")
        except HriError as error:
            self._complain(key, str(error))
            return
        came = Arrival(row.datatype, clock.ours(row.made), clock.ours(envelope.time), now)
        here = self.robot.board.slot(slot)
        if value is None or not came.is_fresh:
            here.clear()
        else:
            self._put[slot] = now
            here.set(value, now, came.spoken, robot)

    def _datatype_wanted(self, slot: str) -> str | None:
        """What a slot of ours takes; None where nothing reads it, or a network here writes it."""
        found = DECLARED[slot].datatype if slot in DECLARED else None
        for runner in tuple(self.robot.networks.runners.values()):
            for one in runner.network.behaviors:
                if isinstance(one, BoardSink) and slot in one.inputs:
                    return None
                if isinstance(one, BoardSource) and slot in one.outputs:
                    found = one.outputs[slot].datatype
        return found

    def _believed(
        self, robot: str, key: str, sample: zenoh.Sample
    ) -> tuple[Envelope, OtherClock, float] | None:
        """What a message says of itself, the clock of its sender, and now; None for one that does
        not count. Who is not known is met.
        """
        now = self._clock.now()
        try:
            if sample.attachment is None or len(sample.payload) > values.LONGEST:
                raise HriError(f"{key}: a value without a seal, or a long one")
            data, sealed = sample.payload.to_bytes(), sample.attachment.to_bytes()
            with self._guard:
                envelope = self._reader.opened(robot, key, data, sealed)
                clock = self._clocks.get(robot)
                if envelope is not None and clock is not None:
                    return envelope, clock, now
                if now - self._asked.get(robot, -RENEW) < RENEW or len(self._asked) > MOST_REMOTE:
                    return None
            self._greet(robot, [one for one in self._remote.values() if one.robot == robot])
        except HriError as error:
            self._complain(key, str(error))
        return None

    def _complain(self, about: str, what: str) -> None:
        """Write a line about what does not count, not more often than TELL_EVERY."""
        now = self._clock.now()
        with self._guard:
            self.complaints += 1
            if now - self._told.get(about, -TELL_EVERY) < TELL_EVERY:
                return
            if len(self._told) > MOST_WANTED:
                self._told.clear()
            self._told[about] = now
        log.warning("fleet: %s", what)


def _fits(value: Any, datatype: str) -> bool:
    return datatype == ANY or isinstance(value, DATATYPES[datatype])


def _is_there(session: zenoh.Session, name: str) -> bool:
    return any(
        reply.ok is not None
        for reply in session.liveliness().get(f"{ROBOTS}/{name}", timeout=PATIENCE)
    )
