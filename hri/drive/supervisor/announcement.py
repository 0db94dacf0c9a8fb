"""What people should know of a base, as events and in the log."""

from __future__ import annotations

import logging

from hri.core.event_bus import EventBus
from hri.drive.supervisor.base_bus import BaseBus, Watcher
from hri.drive.supervisor.cause import Cause
from hri.drive.supervisor.link import State

log = logging.getLogger("hri.drive")


def announce(bus: BaseBus, events: EventBus) -> Watcher:
    """Raise an event, and write a line to the log, for each thing that people should know.

    It goes on until the watcher that it returns is given to `unwatch`, or the bus is closed.

    `drive.stopped` (reason, words) unless someone asked it to stop, `drive.refused` (words) for a
    command that made no sense, `drive.faulty` (words) for a sensor that cannot be believed.
    """
    told, faulty = 0, frozenset[str]()

    def tell(state: State) -> None:
        nonlocal told, faulty
        for news in state.news:
            if news.number > told:
                told = news.number
                _tell(news.cause)
        for words in sorted(frozenset(state.faults) - faulty):
            log.warning("%s: %s", bus.id, words)
            events.raise_event("drive.faulty", words=words)
        faulty = frozenset(state.faults)

    def _tell(cause: Cause) -> None:
        if cause.name == "refused":
            log.warning("%s: refused: %s", bus.id, cause.because)
            events.raise_event("drive.refused", words=cause.because)
        elif cause.name != "done":
            log.info("%s: %s", bus.id, cause.words)
            events.raise_event("drive.stopped", reason=cause.name, words=cause.words)

    bus.watch(tell)
    return tell
