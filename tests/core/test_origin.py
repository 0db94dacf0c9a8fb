"""Who caused an event is with it, in the bus and in a recording."""

import json

from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.core.event_log import EventLog
from hri.core.origin import BRIDGE, KEYBOARD, STUDIO, caused_by, origin
from hri.core.signals import Event


def test_what_is_raised_while_a_request_is_carried_out_has_its_origin():
    bus = EventBus(FakeClock())
    bus.subscribe("drive.halt", lambda event: bus.raise_event("drive.stopped"))
    heard = []
    bus.subscribe("*", heard.append)
    with caused_by(STUDIO):
        bus.raise_event("drive.halt")
        with caused_by(""):
            bus.raise_event("speech.said")
    with caused_by(KEYBOARD):
        bus.raise_event("microphone.muted")
    bus.raise_from_outside(Event("Examples.Door", properties={}))
    bus.raise_event("odometry")
    found = [(event.name, event.origin) for event in heard]
    assert found == [
        ("drive.stopped", STUDIO),
        ("drive.halt", STUDIO),
        ("speech.said", ""),
        ("microphone.muted", KEYBOARD),
        ("Examples.Door", BRIDGE),
        ("odometry", ""),
    ]
    assert origin() == ""


def test_a_recording_has_the_origin_and_no_word_of_it_for_the_robots_own(tmp_path):
    bus = EventBus(FakeClock())
    log = EventLog(tmp_path / "events.jsonl", bus)
    with caused_by(STUDIO):
        bus.raise_event("speech.said", text="Hello.", origin="me")
    bus.raise_from_outside(Event("Door", properties={}))
    bus.raise_event("speech.said", text="Hello.")
    log.close()
    said = {"t": 0.0, "event": "speech.said", "text": "Hello."}
    lines = (tmp_path / "events.jsonl").read_text().splitlines()
    assert [json.loads(line) for line in lines] == [
        {**said, "origin": "studio"},
        {"t": 0.0, "event": "Door", "outside": True, "origin": "bridge"},
        said,
    ]
