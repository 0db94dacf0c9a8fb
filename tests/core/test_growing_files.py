import os

import pytest
from hypothesis import given, settings, strategies as st

from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError, HriError
from hri.core.event_bus import EventBus
from hri.core.event_log import EventLog, read_events
from hri.core.growing_files import GrowingFile
from tests.disk import full_disk


@given(records=st.lists(st.binary(max_size=50), max_size=20), room=st.integers(0, 400))
@settings(max_examples=50, deadline=None)
def test_a_file_on_a_full_disk_ends_with_its_last_whole_record(tmp_path_factory, records, room):
    path = tmp_path_factory.mktemp("disk") / "log"
    with full_disk(after=room):
        file = GrowingFile(path)
        kept = [record for record in records if file.append(record)]
        file.close()
    assert kept == records[: len(kept)]
    assert path.read_bytes() == b"".join(kept)
    assert len(kept) == len(records) or sum(map(len, records[: len(kept) + 1])) > room


def test_a_full_disk_is_said_once_in_one_line(tmp_path, caplog):
    with full_disk(after=10):
        file = GrowingFile(tmp_path / "log")
        for _ in range(5):
            file.append(b"seven..")
    assert caplog.messages == [f"{tmp_path}/log ends here: File too large - make room on the disk"]
    assert file.has_ended


def test_two_programs_do_not_write_into_one_file(tmp_path):
    first = GrowingFile(tmp_path / "log")
    first.append(b"first")
    with pytest.raises(HriError, match="another program is writing it - choose another place"):
        GrowingFile(tmp_path / "log")
    first.close()
    assert (tmp_path / "log").read_bytes() == b"first"
    GrowingFile(tmp_path / "log").close()
    assert (tmp_path / "log").read_bytes() == b""


def test_what_cannot_be_opened_is_refused_in_one_line(tmp_path):
    for path in (tmp_path, tmp_path / "none" / "log", tmp_path / ("x" * 300)):
        with pytest.raises(HriError, match="cannot be written: "):
            GrowingFile(path)


def log_of(path, count, room=10**9):
    bus = EventBus(FakeClock())
    log = EventLog(path, bus)
    with full_disk(after=room):
        for number in range(count):
            bus.raise_event("speech.said", text=f"sentence {number}")
    log.close()


def test_the_log_of_a_full_disk_is_readable_to_its_last_whole_line(tmp_path):
    path = tmp_path / "events.jsonl"
    log_of(path, 20, room=500)
    events = read_events(path)
    assert [event["text"] for event in events] == [f"sentence {n}" for n in range(len(events))]
    assert 3 < len(events) < 20
    assert path.read_bytes().endswith(b"}\n")


def test_a_log_that_was_cut_off_within_a_letter_is_read_to_its_last_whole_line(tmp_path):
    path = tmp_path / "events.jsonl"
    whole = '{"t": 0.1, "event": "a", "x": "\u00e9"}\n'.encode()
    path.write_bytes(whole + whole[: whole.index(b"\xc3") + 1])
    assert len(read_events(path)) == 1
    path.write_bytes(whole + b"\xff\n" + whole)
    with pytest.raises(AuthoringError, match=":2:1: not UTF-8 text - delete this"):
        read_events(path)


@given(cut=st.integers(0, 600))
@settings(max_examples=30, deadline=None)
def test_a_log_that_was_cut_off_anywhere_is_read_to_its_last_whole_line(tmp_path_factory, cut):
    path = tmp_path_factory.mktemp("cut") / "events.jsonl"
    log_of(path, 10)
    os.truncate(path, min(cut, path.stat().st_size))
    whole = path.read_bytes().count(b"\n")
    assert whole <= len(read_events(path)) <= whole + 1
