"""Events that an author lets the robot raise, such as `pizza.ordered`."""

from __future__ import annotations

import re

from hri.core.event_bus import OWN_SUBJECTS
from hri.core.toml import Table

_EVENT = re.compile(r"[A-Za-z]\w*(\.\w+)+")


def read_event(entry: Table) -> str:
    """The name behind `event`; empty without one.

    Raises AuthoringError for a name that is invalid, or kept for what the robot itself senses.
    """
    event = entry.string("event", "")
    if event and not _EVENT.fullmatch(event):
        remedy = 'write a subject and what happened, such as "timer.set"'
        raise entry.error("event", f'"{event}" does not name an event', remedy)
    if event.partition(".")[0] in OWN_SUBJECTS:
        remedy = "choose another first word"
        raise entry.error("event", f'"{event}" is kept for what the robot itself senses', remedy)
    return event
