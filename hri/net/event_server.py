"""The event server: events of other programs are raised here, and the names of local events are
sent to them.

What comes is text in the query form, `Examples.PhotoEvent.Shoot?count=5&delay=1`. Who sends it
proves the token, since a task may do anything when it hears an event. Names that begin with a
capital may come, and those that `events` of app.toml allows; no event passes for one of the robot's
own. The task ends when an event comes that has "End" in its name.
"""

from __future__ import annotations

import logging

from hri.core.errors import HriError
from hri.core.event_bus import check_from_outside
from hri.core.quoting import escaped
from hri.core.signals import Event
from hri.net.receipts import RECEIVED
from hri.net.values import unquoted
from hri.task.context import TaskContext
from hri.task.events import parse_query, write_event
from hri.task.primitive import Primitive, primitive
from hri.task.task_run import TaskStatus

log = logging.getLogger("hri.net")


@primitive("Examples.EventServer")
class EventServer(Primitive):
    """Carry events to and from other programs over TCP, until one comes with End in its name."""

    def __init__(self, context: TaskContext) -> None:
        super().__init__(context)
        self._raising = ""

    def start(self) -> None:
        self._subscription = self.context.events.subscribe("*", self._tell)
        self.on_value("server", "event", self._raise)

    def finish(self) -> None:
        self._subscription.cancel()

    def _tell(self, event: Event) -> None:
        # Those who sent an event know of it, and that they did.
        if event.name not in (self._raising, RECEIVED):
            self.inject("server", "event_id", event.name)

    def _raise(self, text: str, now: float) -> None:
        text = unquoted(text)
        print(f"Received event string: {escaped(text)}")
        try:
            event = self._allowed(parse_query(text))
        except HriError as error:
            log.warning("%s", error)
            return
        print(f"Raising event: {escaped(write_event(event))}")
        self._raising = event.name
        try:
            self.context.events.raise_from_outside(event)
        finally:
            self._raising = ""
        if "End" in event.name:
            self.set_status(TaskStatus.SUCCESS)

    def _allowed(self, event: Event) -> Event:
        """Raises HriError for an event that may not come from outside."""
        check_from_outside(event)
        if not self.context.networks.context.doors.takes(event.name):
            remedy = "name it in events of app.toml, or begin it with a capital"
            raise HriError(f'"{event.name}" may not come from outside - {remedy}')
        return event
