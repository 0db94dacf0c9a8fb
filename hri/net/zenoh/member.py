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
from collections.abc import Callable, Sequence
from contextlib import ExitStack, suppress
from functools import partial
from typing import TYPE_CHECKING, Any

import msgspec
import trio

from hri.behavior.board import DECLARED, BoardSink, BoardSource
from hri.behavior.ports import ANY, DATATYPES
from hri.core.errors import HriError
from hri.core.latest import Latest
from hri.core.signals import Event
from hri.core.token import is_nonce, own_token
from hri.net.zenoh import values
from hri.net.zenoh.acquaintances import Acquaintances
from hri.net.zenoh.meanings import Meanings
from hri.net.zenoh.offer import LEASE, Offer
from hri.net.zenoh.remote_slot import REPEAT, SILENCE, RemoteSlot
from hri.net.zenoh.requests import Asked, Request, answer_to
from hri.net.zenoh.seal import REQUEST, Hello, Pen, Tickets, opened_request
from hri.net.zenoh.session import PATIENCE, ROBOTS, FleetSettings, check, opened
from hri.robot import Robot
from hri.robot.recording import REJECTED
from hri.task.context import TaskContext

if TYPE_CHECKING:
    import zenoh

MOST_REQUESTS = 64
"""Requests that wait for the robot's loop."""
MOST_REMOTE = 1000
"""Slots of other robots that are followed."""
TELL_EVERY = 10.0
"""Seconds between two lines in the log about the same."""
MOST_TOLD = 200
"""Subjects of such lines that are remembered."""

log = logging.getLogger("hri.net")


class Member:
    """Made before the robot lives; `be_in_fleet` runs with it, as a job."""

    def __init__(self, robot: Robot, settings: FleetSettings) -> None:
        """Raises HriError where no token can be had, or the configuration cannot be read."""
        check(settings)
        self.robot, self.settings = robot, settings
        self._clock, self._token = robot.clock, own_token()
        self._pen, self._tickets = Pen(self._token), Tickets()
        self._others = Acquaintances(self._token, robot.clock, self._ask_for_values, self._complain)
        self._meanings = Meanings(partial(log.warning, "fleet: %s"))
        self._offer = Offer(robot, self._send_rows, self._complain, self._meanings)
        self._guard, self._sending = threading.Lock(), threading.Lock()
        self._remote: dict[str, RemoteSlot] = {}
        self._put: dict[str, float] = {}
        """When each slot of ours was written by another robot."""
        self._events_until = 0.0
        """Until when events are sent."""
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
            async with trio.open_nursery() as nursery:
                self._let_run_in(nursery, context)
                while True:
                    self._look_at_networks(context)
                    self._tend(self._clock.now())
                    await context.clock.sleep(REPEAT)

    def _look_at_networks(self, context: TaskContext) -> None:
        """Send the values of networks after their ticks, and note what their slots mean."""
        runners = tuple(context.networks.runners.values())
        new = [one for one in runners if self._offer.send_new not in one.after_tick]
        for runner in new:
            runner.after_tick.append(self._offer.send_new)
        if new:
            self._meanings.note(one.network for one in runners)

    def _join(self, session: zenoh.Session) -> None:
        name = self.settings.name
        if _is_there(session, name):
            raise HriError(f'a robot "{name}" is in the fleet already - choose another name')
        for key, take in (("hello", self._hello), ("do", self._request)):
            session.declare_queryable(f"hri/{name}/{key}", take)
        session.declare_subscriber(f"hri/{name}/put/**", self._take_put)
        session.declare_subscriber(f"hri/*/values/{name}", self._take)
        self._session = self._others.session = session
        self._alive = session.liveliness().declare_token(f"{ROBOTS}/{name}")

    def _let_run_in(self, nursery: trio.Nursery, context: TaskContext) -> None:
        """Let requests and pictures run beside the loop."""
        loop = trio.lowlevel.current_trio_token()

        def begin(request: Request, query: zenoh.Query) -> None:
            nursery.start_soon(self._do, context, request, query)

        self._begin = lambda *asked: loop.run_sync_soon(begin, *asked)
        self._offer.send_aside = lambda *picture: nursery.start_soon(
            self._offer.send_picture, context, *picture
        )

    def _leave(self) -> None:
        self._session = self._others.session = None
        self._begin = lambda *late: None
        self._offer.send_aside = lambda *late: None

    async def _do(self, context: TaskContext, request: Request, query: zenoh.Query) -> None:
        """Do what is asked for, and answer."""
        with self._guard:
            self._waiting -= 1
        try:
            result, kind = await self._done(context, request), "done"
        except HriError as error:
            result, kind = str(error), "refused"
        except Exception as error:  # a mistake of ours, or of a task, must not end the robot
            log.error("%s failed: %s", request.verb, error, exc_info=error)
            result, kind = f"{request.verb} failed - see its log", "refused"
        key, data = f"hri/{self.settings.name}/do", msgspec.msgpack.encode(result)
        now = self._clock.now()
        with self._sending:
            query.reply(key, data, attachment=self._pen.sealed(key, data, now, now, kind))
        query.drop()  # type: ignore[no-untyped-call]

    async def _done(self, context: TaskContext, request: Request) -> object:
        if request.verb != "want":
            return await answer_to(Asked(self.robot, context), request)
        now = self._clock.now()
        if request.arguments.get("events"):
            self._events_until = now + LEASE
        self._offer.want(request.arguments, now)
        return None

    def _tend(self, now: float) -> None:
        """Send again the values that stay, and give up slots that are silent."""
        self._offer.send_again(now)
        with self._guard:
            slots = tuple(self._remote.values())
        for slot in slots:
            if slot.fell_silent(now):
                self._tell_silence(slot.robot, f"{slot.robot}/{slot.name}")
            if slot.is_written and slot.value is not None:
                self._send_away(slot)
        for name, heard in tuple(self._put.items()):
            if now - heard > SILENCE:
                del self._put[name]
                here = self.robot.board.slot(name)
                if here.value is not None:
                    here.clear()
                    self._tell_silence(here.writer, name)
        for robot in {slot.robot for slot in slots}:
            if self._others.is_due(robot):
                self._others.greet(robot)

    def _tell_silence(self, robot: str, slot: str) -> None:
        log.warning("fleet: %s is silent - %s is empty", robot, slot)
        self.robot.events.raise_event("fleet.silent", robot=robot, slot=slot)

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

    # --- slots of others, and what is sent ---

    def _slot_of(self, address: str) -> Latest[Any]:
        robot, _, name = address.partition("/")
        if robot == self.settings.name:
            return self.robot.board.slot(name)
        with self._guard:
            if len(self._remote) >= MOST_REMOTE:
                raise HriError(f"{MOST_REMOTE} slots of other robots are followed - use fewer")
            slot = self._remote[address] = RemoteSlot(address, self._send_away)
        return slot

    def _send_away(self, slot: RemoteSlot) -> None:
        key = f"hri/{slot.robot}/put/{slot.name}/{self.settings.name}"
        try:
            meaning = self._meanings.sent(f"{slot.robot}/{slot.name}")
            row = values.row(slot.name, *slot.get(), meaning)
        except HriError as error:
            self._complain(key, str(error))
            return
        self._put_out(key, row.data, row.made, row.datatype, row.meaning)

    def _send_rows(self, reader: str, rows: Sequence[values.Row]) -> None:
        key = f"hri/{self.settings.name}/values/{reader}"
        self._put_out(key, msgspec.msgpack.encode(rows), self._clock.now(), "values")

    def _put_out(
        self, key: str, data: bytes, made: float, datatype: str, meaning: str = ""
    ) -> None:
        if (session := self._session) is None:
            return
        import zenoh

        # In the order of their numbers: one that comes before an earlier one would not count.
        with self._sending, suppress(zenoh.ZError):  # which it raises when it was closed
            now = self._clock.now()
            sealed = self._pen.sealed(key, data, now, made, datatype, meaning)
            drop = zenoh.CongestionControl.DROP
            session.put(key, data, attachment=sealed, congestion_control=drop, express=True)

    # --- in threads of Zenoh ---

    def _ask_for_values(self, robot: str, hello: Hello) -> None:
        """Ask a robot that answered for the slots of it that are read here."""
        import zenoh

        with self._guard:
            slots = [slot for slot in self._remote.values() if slot.robot == robot]
        read = [slot.name for slot in slots if not slot.is_written]
        if not read or (session := self._session) is None:
            return
        wanted = {"reader": self.settings.name, "addresses": read}
        data = msgspec.msgpack.encode(Request(hello.ticket, "want", wanted))
        key, now = f"hri/{robot}/do", self._clock.now()
        with self._sending, suppress(zenoh.ZError):
            sealed = self._pen.sealed(key, data, now, now, REQUEST)
            session.get(key, lambda reply: None, payload=data, attachment=sealed, timeout=PATIENCE)

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
                raise HriError("a request without a seal, or a long one")
            data = payload.to_bytes()
            opened_request(self._token, key, data, sealed.to_bytes())
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
        if (believed := self._others.believed(robot, sample)) is None:
            return
        try:
            for row in values.rows_of(believed.data):
                slot = self._remote.get(f"{robot}/{row.address}")
                if slot is not None and not slot.is_written:
                    slot.arrive(row.value(), believed.arrival(row.made, row.datatype))
                    self._meanings.check(f"{robot}/{row.address}", row.meaning, robot)
        except HriError as error:
            self._complain(key, str(error))

    def _take_put(self, sample: zenoh.Sample) -> None:
        """A value that another robot writes into a slot of ours."""
        key = str(sample.key_expr)
        slot, _, robot = key.removeprefix(f"hri/{self.settings.name}/put/").rpartition("/")
        if (believed := self._others.believed(robot, sample)) is None:
            return
        datatype, wanted = believed.envelope.datatype, self._datatype_wanted(slot)
        try:
            value = values.read(datatype, believed.data) if datatype else None
            if wanted is None or (value is not None and not _fits(value, wanted)):
                what = "no network reads it" if wanted is None else f"it takes a {wanted}"
                raise HriError(f"{robot} writes a {datatype} to {slot}: {what}")
        except HriError as error:
            self._complain(key, str(error))
            return
        came, here = believed.arrival(believed.envelope.made, datatype), self.robot.board.slot(slot)
        if value is None or not came.is_fresh:
            here.clear()
        else:
            self._put[slot] = came.now
            self._meanings.check(slot, believed.envelope.meaning, robot)
            here.set(value, came.now, came.spoken, robot)

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

    def _complain(self, about: str, what: str) -> None:
        """Write a line about what does not count, not more often than TELL_EVERY."""
        now = self._clock.now()
        with self._guard:
            self.complaints += 1
            if now - self._told.get(about, -TELL_EVERY) < TELL_EVERY:
                return
            if len(self._told) > MOST_TOLD:
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
