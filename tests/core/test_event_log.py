"""Every event is in the log, whatever its properties are, and the log can be read."""

from pathlib import Path

import numpy as np
import pytest

from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.core.event_log import LONGEST_LINE, EventLog, read_events


@pytest.fixture
def logged(tmp_path):
    """Raises an event with a value, and another; the value as it is read."""
    bus = EventBus(FakeClock())
    log = EventLog(tmp_path / "events.jsonl", bus)

    def logged(value):
        bus.raise_event("thing.seen", value=value)
        bus.raise_event("thing.lost")
        log.close()
        seen, lost = read_events(tmp_path / "events.jsonl")
        assert (seen["event"], lost["event"]) == ("thing.seen", "thing.lost")
        return seen

    return logged


@pytest.mark.parametrize(
    ("value", "read"),
    [
        (np.float32(0.5), 0.5),
        (np.int64(3), 3),
        (np.bool_(True), True),
        ((1, np.float32("inf")), [1, None]),
        ({"a": Path("b")}, {"a": "b"}),
        ({3}, "{3}"),
        (b"\xff", "b'\\xff'"),
        (None, None),
        (True, True),
        ("\udc80 \x00 é", "\udc80 \x00 é"),
    ],
)
def test_what_json_does_not_have_is_written_as_what_is_nearest(logged, value, read):
    assert logged(value) == {"t": 0.0, "event": "thing.seen", "value": read}


@pytest.mark.parametrize("length", [LONGEST_LINE - 60, LONGEST_LINE - 48, LONGEST_LINE, 3_000_000])
def test_an_event_that_is_too_long_does_not_make_the_log_unreadable(logged, caplog, length):
    seen = logged("x" * length)
    if "value" in seen:
        assert len(seen["value"]) == length
        return
    assert seen == {"t": 0.0, "event": "thing.seen", "omitted": pytest.approx(length, abs=50)}
    assert "thing.seen of" in caplog.text
