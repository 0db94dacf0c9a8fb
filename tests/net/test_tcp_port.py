import math
import random
import resource
import socket
import struct
import threading
import time
from contextlib import ExitStack, contextmanager, suppress

import pytest

from hri.core.errors import HriError
from hri.net.client import Client, _own_echo
from hri.net.connection import Connection
from hri.net.malleable_protocol import Item, Message, decode, encode
from hri.net.port_pool import borrow, give_back
from hri.net.server import AT_THE_DOOR, Server
from hri.net.tcp_port import MOST_WARNINGS
from tests.net.conftest import WITHIN, Taken, introduction


def message(text):
    return Message("t", (Item("text", text),))


def raw(port):
    return socket.create_connection(("127.0.0.1", port), WITHIN)


def test_messages_go_both_ways_and_a_server_sends_to_all(links):
    server, client = links
    here = server()
    there = [client(here.port), client(here.port)]
    taken = [Taken(), Taken()]
    for link, listener in zip(there, taken, strict=True):
        link.subscribe("t", listener)
    from_clients = Taken()
    here.subscribe("t", from_clients)
    assert here.wait_for_peers(2, WITHIN)
    assert all(link.wait_for_peers(1, WITHIN) for link in there)
    here.send(encode(message("to all")))
    assert [listener.wait_for(1) for listener in taken] == [[message("to all")]] * 2
    for link in there:
        link.send(encode(message("to one")))
    assert from_clients.wait_for(2) == [message("to one")] * 2


def test_tags_tell_apart_who_is_meant(links):
    server, client = links
    here = server()
    mine, others = Taken(), Taken()
    here.subscribe("mine", mine)
    here.subscribe("others", others)
    there = client(here.port)
    assert there.wait_for_peers(1, WITHIN)
    there.send(b"<unknown/>\n\n<others/>\n<mine/>\n")
    assert mine.wait_for(1) == [Message("mine", ())]
    assert others.messages == [Message("others", ())]
    here.unsubscribe("others", others)
    there.send(b"<others/>\n<mine/>\n")
    mine.wait_for(2)
    assert len(others.messages) == 1


@pytest.mark.proves("W10")
def test_a_client_connects_whenever_the_server_comes(links):
    _, client = links
    reserved = socket.create_server(("127.0.0.1", 0))
    port = reserved.getsockname()[1]
    there = client(port)
    assert there.wait_for_peers(1, WITHIN), "the reserved socket takes the first call"
    reserved.accept()[0].close()
    reserved.close()
    assert there.wait_for_peers(0, WITHIN)
    back = Server("127.0.0.1", port)
    try:
        assert there.wait_for_peers(1, WITHIN)
        taken = Taken()
        back.subscribe("t", taken)
        there.send(encode(message("again")))
        taken.wait_for(1)
    finally:
        back.close()


@pytest.mark.proves("W10")
def test_a_client_that_drops_its_server_connects_again(links):
    _, client = links
    with socket.create_server(("127.0.0.1", 0)) as listening:
        listening.settimeout(WITHIN)
        client(listening.getsockname()[1], patience=0.05)
        first = listening.accept()[0]
        first.sendall(b"<t")
        listening.accept()[0].close()
        first.close()


def test_a_socket_that_has_connected_with_itself_is_no_connection():
    with socket.socket() as alone:
        alone.bind(("127.0.0.1", 0))
        alone.connect(alone.getsockname())
        assert _own_echo(alone)
    with (
        socket.create_server(("127.0.0.1", 0)) as listening,
        raw(listening.getsockname()[1]) as peer,
    ):
        assert not _own_echo(peer)


@pytest.mark.parametrize("host", ["127.0.0.1", "no.such.host.invalid", "no..host"])
def test_a_client_without_a_server_tries_on_and_closes_at_once(host):
    lost = Client(host, 1)
    lost.send(b"<t/>\n")
    assert not lost.wait_for_peers(1, 0.15), "longer than the first pause"
    assert lost._thread.is_alive()
    lost.close()
    lost.close()
    assert not lost._thread.is_alive()


def test_a_port_in_use_is_told(links):
    server, _ = links
    with pytest.raises(HriError, match="end the program that has it, or choose another tcp_port"):
        Server("127.0.0.1", server().port)
    with pytest.raises(HriError, match=r"192\.0\.2\.1:1: .* - bind to an address of this"):
        Server("192.0.2.1", 1)
    for host in ("no.such.host.invalid", "no..host"):
        with pytest.raises(HriError, match="cannot listen on no"):
            Server(host, 1)


def test_behaviors_share_a_port_and_the_last_one_closes_it():
    one = borrow(Server, "127.0.0.1", 0)
    two = borrow(Server, "127.0.0.1", one.port)
    assert one is two
    give_back(one)
    raw(one.port).close()
    give_back(two)
    with pytest.raises(OSError, match="refused"):
        raw(one.port)


def test_a_listener_that_fails_costs_nobody_a_connection(links, caplog):
    server, client = links
    here = server()

    def fail(message):
        raise ZeroDivisionError("mine")

    taken = Taken()
    here.subscribe("t", fail)
    here.subscribe("t", taken)
    there = client(here.port)
    assert there.wait_for_peers(1, WITHIN)
    there.send(b"<t/>\n<t/>\n")
    taken.wait_for(2)
    assert "<t> not taken: mine" in caplog.text


@pytest.mark.parametrize(
    ("sent", "told"),
    [
        (b"hello\n", "syntax error"),
        (b"<a>" * 30_000, "a line of more than 65536 bytes"),
        (b"<a>" * 1000 + b"\n", "<a> within a value"),
        (b'<!DOCTYPE a [<!ENTITY b "bb">]><a><b>&b;</b></a>\n', "a DOCTYPE"),
        (b"<t><b>\xff</b></t>\n", "not well-formed"),
        (b"<t", "a line not finished within 0.05 s"),
    ],
)
def test_a_peer_that_misbehaves_is_dropped_with_one_line_in_the_log(links, caplog, sent, told):
    server, _ = links
    here = server(patience=0.05)
    with raw(here.port) as peer:
        name = peer.getsockname()[1]
        peer.sendall(sent)
        with suppress(ConnectionResetError):
            assert peer.recv(1) == b""
    assert here.wait_for_peers(0, WITHIN)
    (record,) = caplog.records
    assert f"dropped 127.0.0.1:{name}" in record.message
    assert told in record.message


def test_a_peer_that_reads_too_slowly_is_dropped_and_the_others_get_all(links, caplog):
    server, client = links
    here = server(backlog=200_000)
    quick = Taken()
    there = client(here.port)
    there.subscribe("t", quick)
    with raw(here.port) as slow:
        assert here.wait_for_peers(2, WITHIN)
        count = 0
        while "dropped" not in caplog.text:
            here.send(encode(message("x" * 10_000)))
            count += 1
            quick.wait_for(count)
            assert count < 5_000
        assert "it has to read faster" in caplog.text
        assert f":{slow.getsockname()[1]}:" in caplog.text
    here.send(encode(message("last")))
    assert quick.wait_for(count + 1)[-1] == message("last")


def test_a_peer_that_sends_too_fast_is_held_back_but_loses_nothing(links):
    server, client = links
    here = server(rate=1000)
    taken = Taken()
    here.subscribe("t", taken)
    there = client(here.port)
    assert there.wait_for_peers(1, WITHIN)
    for number in range(1200):
        there.send(encode(message(str(number))))
    got = taken.wait_for(1200)
    assert [m.items[0].text for m in got] == [str(number) for number in range(1200)]


def test_those_above_the_count_are_turned_away(links, caplog):
    server, _ = links
    here = server(peers=2)
    kept = [raw(here.port), raw(here.port)]
    assert here.wait_for_peers(2, WITHIN)
    for _ in range(3):
        with raw(here.port) as refused:
            assert refused.recv(1) == b""
    assert len(caplog.records) == 1
    assert "2 peers" in caplog.text
    for peer in kept:
        peer.close()
    assert here.wait_for_peers(0, WITHIN)


def test_silent_peers_do_not_hold_all_places(links):
    """Somebody who has something to say gets in, and those who spoke lately stay."""
    server, _ = links
    here = server(peers=4, silence=0.0)
    taken = Taken()
    here.subscribe("t", taken)
    speaks, *silent = [raw(here.port) for _ in range(4)]
    assert here.wait_for_peers(4, WITHIN)
    speaks.sendall(encode(message("here")))
    taken.wait_for(1)
    for number in range(3):
        new = raw(here.port)
        new.sendall(encode(message("new")))
        taken.wait_for(2 + number)
        assert silent[number].recv(1) == b""
        silent.append(new)
    assert len(here._peers) == 4
    speaks.sendall(encode(message("still here")))
    taken.wait_for(5)
    for peer in (speaks, *silent):
        peer.close()


def test_of_silent_peers_the_one_that_showed_the_token_goes_last(links, monkeypatch):
    monkeypatch.setenv("HRI_TOKEN", "known-to-somebody")
    server, _ = links
    here = server(peers=2, silence=0.0)
    known, stranger = raw(here.port), raw(here.port)
    heard = Taken()
    here.subscribe("hri", heard)
    known.sendall(introduction("known-to-somebody") + b"<hri><stop/></hri>\n")
    heard.wait_for(1)
    assert here.wait_for_peers(2, WITHIN)
    taken = Taken()
    here.subscribe("t", taken)
    stranger.sendall(encode(message("later than the other")))
    taken.wait_for(1)
    with raw(here.port):
        assert stranger.recv(1) == b""
    for peer in (known, stranger):
        peer.close()


def test_chatty_strangers_do_not_keep_out_who_shows_the_token(links, monkeypatch):
    """They say something all the time, so none of them ever gives way to a stranger."""
    monkeypatch.setenv("HRI_TOKEN", "known-to-somebody")
    server, _ = links
    here = server(peers=4, silence=math.inf)
    strangers = [raw(here.port) for _ in range(4)]
    assert here.wait_for_peers(4, WITHIN)
    with raw(here.port) as turned_away:
        assert turned_away.recv(1) == b""
    heard = Taken()
    here.subscribe("t", heard)
    with raw(here.port) as known:
        known.sendall(introduction("known-to-somebody"))
        assert strangers[0].recv(1) == b"", "the one that was heard longest ago"
        known.sendall(encode(message("here")))
        heard.wait_for(1)
        assert here.wait_for_peers(4, WITHIN)
        assert heard.messages[0].sender.is_authorized
    for peer in strangers:
        peer.close()


def test_at_the_door_the_token_may_be_proven(links, monkeypatch):
    monkeypatch.setenv("HRI_TOKEN", "known-to-someone")
    server, _ = links
    here = server(peers=1, silence=math.inf, introduction=WITHIN)
    heard = Taken()
    here.subscribe("t", heard)
    with raw(here.port) as stranger, Connection(port=here.port, timeout=WITHIN) as known:
        assert stranger.recv(1) == b""
        known.send(encode(message("here")).decode().strip())
        assert heard.wait_for(1)[0].sender.is_authorized


def test_at_the_door_a_stranger_may_stop_the_robot(links):
    server, _ = links
    here = server(peers=1, silence=math.inf)
    heard = Taken()
    here.subscribe("hri", heard)
    with raw(here.port), raw(here.port) as other:
        other.sendall(b"<hri><stop/></hri>\n")
        heard.wait_for(1)


def test_a_crowd_at_the_door_is_turned_away(links):
    server, _ = links
    here = server(peers=1, silence=math.inf, introduction=WITHIN)
    with ExitStack() as opened:
        for _ in range(1 + AT_THE_DOOR):
            opened.enter_context(raw(here.port))
        assert here.wait_for_peers(1 + AT_THE_DOOR, WITHIN)
        assert opened.enter_context(raw(here.port)).recv(1) == b""


def test_more_after_the_end_of_a_message_costs_a_line_and_not_the_connection(links, caplog):
    server, _ = links
    here = server()
    taken = Taken()
    here.subscribe("t", taken)
    with raw(here.port) as peer:
        two = encode(message("one")).strip() + encode(message("two"))
        peer.sendall(two + encode(message("three")))
        assert taken.wait_for(1) == [message("three")]
        (told,) = decode(peer.recv(1000)).items
    assert told.port == "refused"
    assert "more after </t> - write each message on a separate line" in told.text
    (record,) = caplog.records
    assert "skipped a line of 127.0.0.1" in record.message


def test_peers_that_come_again_and_again_do_not_fill_the_log(links, caplog):
    server, _ = links
    here = server()
    for _ in range(MOST_WARNINGS + 50):
        with raw(here.port) as peer:
            peer.sendall(b"no message\n")
            with suppress(ConnectionResetError):
                assert peer.recv(1) == b""
    assert len(caplog.records) == MOST_WARNINGS


def misbehave(port, kind, seed):
    """One peer that does harm, in whatever way is its own, until it is dropped or done."""
    dice = random.Random(seed)
    with suppress(OSError), raw(port) as peer:
        peer.settimeout(0.2)
        if kind == "half-open":
            linger = struct.pack("ii", 1, 0)
            peer.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, linger)
            peer.sendall(b"<t><text")
            return
        for _ in range(dice.randrange(1, 40)):
            peer.sendall(HARM[kind](dice))


HARM = {
    "garbage": lambda dice: dice.randbytes(dice.randrange(1, 5000)),
    "endless line": lambda dice: b"x" * 50_000,
    "deep": lambda dice: b"<a>" * 5_000 + b"\n",
    "bomb": lambda dice: b'<!DOCTYPE t [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;">]><t>&b;</t>\n',
    "slow": lambda dice: b"<",
    "flood": lambda dice: b"<other><text>1</text></other>\n" * 2_000,
    "blank": lambda dice: b"\n" * 60_000,
    "half-open": None,
}


def test_a_hundred_peers_that_misbehave_disturb_nobody(links):
    server, client = links
    here = server(peers=128, patience=0.5)
    taken = Taken()
    here.subscribe("t", taken)
    good = client(here.port)
    heard = Taken()
    good.subscribe("t", heard)
    assert here.wait_for_peers(1, WITHIN)
    assert good.wait_for_peers(1, WITHIN)
    kinds = sorted(HARM)
    bad = [
        threading.Thread(target=misbehave, args=(here.port, kinds[k % len(kinds)], k))
        for k in range(100)
    ]
    for thread in bad:
        thread.start()
    for number in range(500):
        good.send(encode(message(str(number))))
        taken.wait_for(number + 1)
        here.send(encode(message(str(number))))
    for thread in bad:
        thread.join(WITHIN)
        assert not thread.is_alive()
    texts = [str(number) for number in range(500)]
    assert [m.items[0].text for m in taken.messages] == texts
    assert [m.items[0].text for m in heard.wait_for(500)] == texts
    assert here.wait_for_peers(1, WITHIN)


@pytest.fixture
def without_files():
    """While its body runs, this process can open no file and no socket."""

    @contextmanager
    def limited():
        soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
        resource.setrlimit(resource.RLIMIT_NOFILE, (0, hard))
        try:
            yield
        finally:
            resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard))

    return limited


def test_a_client_that_gets_no_socket_tries_on(links, without_files):
    _, client = links
    with socket.create_server(("127.0.0.1", 0)) as listening:
        there = client(listening.getsockname()[1])
        first = listening.accept()[0]
        assert there.wait_for_peers(1, WITHIN)
        with without_files():
            first.close()
            assert there.wait_for_peers(0, WITHIN)
            assert not there.wait_for_peers(1, 0.4), "longer than the first pause"
        assert there.wait_for_peers(1, WITHIN)


def test_a_server_without_a_file_left_rests_and_takes_those_who_waited(
    links, without_files, caplog
):
    server, _ = links
    here = server()
    waiting = [socket.socket() for _ in range(3)]
    with without_files():
        for peer in waiting:
            peer.connect(("127.0.0.1", here.port))
        before = time.process_time()
        assert not here.wait_for_peers(3, 0.5)
        assert time.process_time() - before < 0.25
    assert here.wait_for_peers(3, WITHIN)
    assert [r.message for r in caplog.records] == [
        f"{here.address}: cannot let anyone in: Too many open files"
    ]
    for peer in waiting:
        peer.close()


class Clumsy(Server):
    """Makes a mistake of its own."""

    is_new = True

    def _tend(self, now):
        if self.is_new:
            self.is_new = False
            raise ZeroDivisionError("clumsy")
        return super()._tend(now)


def test_a_mistake_of_ours_does_not_end_the_thread(caplog):
    here = Clumsy("127.0.0.1", 0)
    with raw(here.port):
        assert here.wait_for_peers(1, WITHIN)
    here.close()
    assert "clumsy" in caplog.text
