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

from hri.studio.event_memory import MOST_OTHERS
from hri.studio.link import (
    FACE,
    LARGEST,
    TEXT,
    VALUE,
    LinkError,
    RobotEnd,
    Unpacker,
    finite,
    packed,
    packed_json,
)
from hri.studio.request_queue import MOST_OF_A_KIND, MOST_REQUESTS, STOP


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
    """The next messages: JSON, a topic and its value, or kind and content."""
    unpacker, found = Unpacker(), []
    while len(found) < count:
        data = server.recv(65_536)
        assert data
        for kind, content in unpacker.feed(data):
            if kind == VALUE:
                topic, value = content.decode().split("\n", 1)
                found.append({"topic": topic, "value": json.loads(value)})
            else:
                found.append(json.loads(content) if kind == TEXT else (kind, content))
    return found


def test_the_server_sees_at_once_that_the_link_is_closed(link, server):
    assert link.reader.is_alive(), "it waits for what the server sends"
    link.close()
    assert server.recv(1) == b""


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


def test_every_server_gets_the_last_events_and_no_flood_pushes_out_what_was_said(link):
    said = {"event": "speech.said", "t": 0, "text": "hello"}
    link.add_event(said)
    for number in range(3 * MOST_OTHERS):
        link.add_event({"event": "x", "t": number})
        for _ in range(3):
            link.add_event({"event": "odometry", "t": number})
    for _ in range(2):
        ours, theirs = socket.socketpair()
        theirs.settimeout(10)
        link.attach(ours)
        found = [one["event"] for one in received(theirs, 1 + MOST_OTHERS)]
        assert found[0] == said
        assert [one["t"] for one in found[1:]] == list(range(2 * MOST_OTHERS, 3 * MOST_OTHERS))
        link.detach()
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


def asked(server, number, command):
    server.sendall(packed_json({"number": number, "command": command, "with": {}}))


@pytest.mark.parametrize("is_first", [True, False])
def test_no_flood_pushes_out_a_stop(link, server, is_first):
    if is_first:
        asked(server, 7, STOP)
    for number in range(2 * MOST_REQUESTS):
        asked(server, 1000 + number, f"command{number % 50}")
    if not is_first:
        asked(server, 7, STOP)
    server.shutdown(socket.SHUT_WR)
    link.reader.join(10)
    assert link.requests.take_stop() == [7]
    assert link.requests.take_stop() is None


def test_a_request_that_finds_no_room_is_refused_with_what_to_do(link, server):
    count = 3 * MOST_OF_A_KIND
    for number in range(count):
        asked(server, number, "redeem")
    asked(server, count, "say")
    refused = received(server, count - MOST_OF_A_KIND)
    assert [one["answer"] for one in refused] == list(range(MOST_OF_A_KIND, count))
    why = "20 redeem requests wait for the robot already - ask again when it goes on"
    assert {one["error"] for one in refused} == {why}
    server.shutdown(socket.SHUT_WR)
    link.reader.join(10)
    waiting = [link.requests.take().command for _ in range(MOST_OF_A_KIND + 1)]
    assert waiting == MOST_OF_A_KIND * ["redeem"] + ["say"]
    assert link.requests.take() is None


def test_a_release_that_waited_does_not_undo_a_later_stop(link, server):
    for number, command in enumerate(["release", STOP, STOP, "release"]):
        asked(server, number, command)
    (refused,) = received(server, 1)
    assert refused["answer"] == 0
    assert refused["error"] == "a stop came after it - release the robot again"
    server.shutdown(socket.SHUT_WR)
    link.reader.join(10)
    assert link.requests.take_stop() == [1, 2]
    assert link.requests.take().number == 3


def test_whoever_waits_for_a_stop_hears_of_each_and_of_one_that_waits(link, server):
    heard = []
    link.requests.call_on_stop(lambda: heard.append("a"))
    asked(server, 1, STOP)
    asked(server, 2, STOP)
    server.shutdown(socket.SHUT_WR)
    link.reader.join(10)
    link.requests.call_on_stop(lambda: heard.append("b"))
    assert heard == ["a", "a", "b"]


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
