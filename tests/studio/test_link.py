"""The link keeps the newest, forgets the old, and never waits for the server."""

import json
import math
import socket
import struct
import threading

import cv2
import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.studio.link import (
    FACE,
    LARGEST,
    MOST_EVENTS,
    MOST_REQUESTS,
    STOP,
    TEXT,
    LinkError,
    RobotEnd,
    Unpacker,
    finite,
    packed,
    packed_json,
)


@pytest.fixture
def link():
    made = RobotEnd()
    yield made
    made.close()


@pytest.fixture
def server(link):
    ours, theirs = socket.socketpair()
    theirs.settimeout(10)
    link.attach(ours)
    yield theirs
    theirs.close()


def received(server, count):
    """The next messages, JSON or kind and content."""
    unpacker, found = Unpacker(), []
    while len(found) < count:
        data = server.recv(65_536)
        assert data
        for kind, content in unpacker.feed(data):
            found.append(json.loads(content) if kind == TEXT else (kind, content))
    return found


@given(st.lists(st.tuples(st.sampled_from((1, 2, 3)), st.binary(max_size=200))), st.integers(1, 50))
def test_messages_survive_however_the_stream_is_cut(messages, size):
    stream = b"".join(packed(kind, content) for kind, content in messages)
    unpacker = Unpacker()
    cut = [stream[first : first + size] for first in range(0, len(stream), size)]
    assert [message for part in cut for message in unpacker.feed(part)] == messages


def test_a_message_that_is_too_long_is_refused_before_it_fills_the_memory():
    with pytest.raises(LinkError, match="a message of 4000001 bytes"):
        list(Unpacker().feed(struct.pack(">BI", 1, LARGEST + 1)))


VALUES = st.recursive(
    st.floats() | st.text() | st.none() | st.booleans(),
    lambda parts: st.lists(parts) | st.dictionaries(st.text(), parts),
)


@given(VALUES)
def test_everything_can_be_written_as_json(value):
    kind, content = next(Unpacker().feed(packed_json(value)))
    assert (kind, json.loads(content)) == (TEXT, json.loads(json.dumps(finite(value))))


def test_numbers_that_json_does_not_have_are_null():
    assert finite({"a": [math.inf, (math.nan, 1.5)], 2: None}) == {
        "a": [None, [None, 1.5]],
        "2": None,
    }


def test_a_server_that_comes_later_gets_the_newest_of_each_topic(link):
    for number in range(100):
        link.put("base", number)
    link.put("about", "x")
    ours, theirs = socket.socketpair()
    theirs.settimeout(10)
    link.attach(ours)
    assert received(theirs, 2) == [{"topic": "base", "value": 99}, {"topic": "about", "value": "x"}]
    theirs.close()


def test_what_does_not_change_is_sent_once(link, server):
    for _ in range(3):
        link.put("base", 1)
    link.put("end", 1)
    assert [one["topic"] for one in received(server, 2)] == ["base", "end"]


def test_what_is_costly_to_write_is_written_by_the_thread_that_sends_it(link, server):
    writers = []

    def written():
        writers.append(threading.current_thread().name)
        return '{"counting": 1}'

    link.put_later("ports", written)
    assert received(server, 1) == [{"topic": "ports", "value": {"counting": 1}}]
    assert writers == ["studio link"]


def test_without_a_server_old_events_are_forgotten(link):
    for number in range(3 * MOST_EVENTS):
        link.add_event({"event": "x", "t": number})
    ours, theirs = socket.socketpair()
    theirs.settimeout(10)
    link.attach(ours)
    found = received(theirs, MOST_EVENTS)
    assert [one["event"]["t"] for one in found] == list(range(2 * MOST_EVENTS, 3 * MOST_EVENTS))
    theirs.close()


def test_a_server_that_never_reads_does_not_hold_up_the_robot(link, server):
    image = np.random.default_rng(1).integers(0, 255, (480, 640, 3)).astype(np.uint8)
    for number in range(2000):
        link.put("base", number)
        link.put_picture("face", image, number)
    found = received(server, 1)
    assert found[0]["topic"] == "base"


def test_pictures_come_as_jpeg_with_their_time(link, server):
    image = np.full((48, 64, 3), (200, 30, 30), np.uint8)
    link.put_picture("face", image, 12.5)
    ((kind, content),) = received(server, 1)
    assert kind == FACE
    assert struct.unpack(">d", content[:8]) == (12.5,)
    shown = cv2.imdecode(np.frombuffer(content[8:], np.uint8), cv2.IMREAD_COLOR)[..., ::-1]
    assert shown.shape == image.shape
    assert np.abs(shown.astype(int) - image).max() < 12


def test_a_stop_goes_before_all_other_requests_and_is_never_forgotten(link, server):
    for number in range(2 * MOST_REQUESTS):
        server.sendall(packed_json({"number": number, "command": "say", "with": {}}))
    server.sendall(packed_json({"number": 7, "command": STOP, "with": {}}))
    server.sendall(packed_json({"wanted": ["face"]}))
    server.shutdown(socket.SHUT_WR)
    link.reader.join(10)
    assert link.requests[0].command == STOP
    assert len(link.requests) == MOST_REQUESTS


@pytest.mark.parametrize(
    "junk", [b"\x01\x00\x00\x00\x02[]", b"\x01\x00\x00\x00\x01{", b"\xff" * 50]
)
def test_junk_on_the_link_ends_the_reading_and_nothing_else(link, server, junk):
    server.sendall(junk)
    server.shutdown(socket.SHUT_WR)
    link.reader.join(10)
    assert not link.reader.is_alive()
    link.put("base", 1)
    assert received(server, 1) == [{"topic": "base", "value": 1}]
