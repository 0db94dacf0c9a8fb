"""Messages that only who knows the token can have written."""

from contextlib import suppress

import pytest
from hypothesis import given, strategies as st

pytest.importorskip("msgspec", reason="the extra zenoh is not installed")

from hri.core.errors import HriError
from hri.core.token import new_nonce
from hri.net.zenoh import seal
from hri.net.zenoh.seal import Pen, Reader, Tickets, hello_of

TOKEN, OTHER = "a-token-of-32-letters-and-digits", "b-token-of-32-letters-and-digits"
KEY = "hri/anna/slot/mood"


@pytest.fixture
def pen():
    return Pen(TOKEN)


@pytest.fixture
def reader(pen):
    """One who has met Anna."""
    reader, nonce = Reader(TOKEN), new_nonce()
    reader.meet(pen.hello("anna", nonce, 5.0, "ticket"), nonce)
    return reader


def test_what_is_sealed_is_believed(pen, reader):
    found = reader.opened("anna", KEY, b"1", pen.sealed(KEY, b"1", 2.5, 0.5, "double"))
    assert (found.time, found.made, found.datatype) == (2.5, 0.5, "double")


def test_who_was_not_met_is_not_believed(pen):
    assert (
        Reader(TOKEN).opened("anna", KEY, b"1", pen.sealed(KEY, b"1", 0.0, 0.5, "double")) is None
    )


def test_a_message_counts_once(pen, reader):
    first, second = (pen.sealed(KEY, b"1", 0.0, 0.5, "double") for _ in range(2))
    reader.opened("anna", KEY, b"1", second)
    for again in (first, second):
        with pytest.raises(HriError, match="came before"):
            reader.opened("anna", KEY, b"1", again)


def test_a_robot_that_begins_again_is_met_again(pen, reader):
    old = pen.sealed(KEY, b"1", 0.0, 0.5, "double")
    later, nonce = Pen(TOKEN), new_nonce()
    assert reader.opened("anna", KEY, b"1", later.sealed(KEY, b"1", 0.0, 0.5, "double")) is None
    reader.meet(later.hello("anna", nonce, 5.0, ""), nonce)
    assert reader.opened("anna", KEY, b"1", old) is None
    assert reader.opened("anna", KEY, b"1", later.sealed(KEY, b"1", 0.0, 0.5, "double"))


@pytest.mark.parametrize(
    ("name", "nonce"), [("anna", new_nonce()), ("berta", None)], ids=["nonce", "name"]
)
def test_an_answer_to_another_question_proves_nothing(pen, name, nonce):
    asked = new_nonce()
    hello = pen.hello("anna", nonce or asked, 1.0, "")
    with pytest.raises(HriError, match="does not know the token"):
        Reader(TOKEN).meet(hello if name == "anna" else seal.Hello("berta", *list_of(hello)), asked)


def list_of(hello):
    return hello.epoch, hello.clock, hello.ticket, hello.proof


def test_another_token_proves_nothing():
    nonce = new_nonce()
    with pytest.raises(HriError, match="HRI_TOKEN"):
        Reader(TOKEN).meet(Pen(OTHER).hello("anna", nonce, 1.0, ""), nonce)


@pytest.mark.parametrize(("key", "value"), [(KEY, b"go"), ("x", b"stop")])
def test_a_seal_is_of_one_value_under_one_key(pen, reader, key, value):
    with pytest.raises(HriError, match="seal"):
        reader.opened("anna", key, value, pen.sealed(KEY, b"stop", 0.0, 0.5, "request"))


def test_a_ticket_is_good_for_one_request_and_for_a_while():
    tickets = Tickets()
    first, second = tickets.new(1.0), tickets.new(1.0)
    tickets.use(first, 2.0)
    for ticket, now in ((first, 3.0), (second, 12.0), (second, 0.5), (Tickets().new(1.0), 1.0)):
        with pytest.raises(HriError, match="not good"):
            tickets.use(ticket, now)


@given(st.text())
def test_no_other_text_is_a_ticket(text):
    with pytest.raises(HriError, match="not good"):
        Tickets().use(text, 1.0)


def test_what_is_forgotten_for_room_is_met_again(pen, reader, monkeypatch):
    monkeypatch.setattr(seal, "MOST_STREAMS", 2)
    messages = [(key, pen.sealed(key, b"", 0.0, 0.5, "double")) for key in "abc"]
    for key, message in messages:
        reader.opened("anna", key, b"", message)
    assert reader.opened("anna", "a", b"", messages[0][1]) is None
    assert "anna" not in reader.epochs


@given(st.binary(max_size=100), st.integers(0, 200), st.integers(1, 255))
def test_no_changed_message_is_believed(value, place, change):
    pen, reader, nonce = Pen(TOKEN), Reader(TOKEN), new_nonce()
    reader.meet(pen.hello("anna", nonce, 5.0, ""), nonce)
    data = bytearray(pen.sealed(KEY, value, 1.0, 0.5, "double"))
    data[place % len(data)] ^= change
    with suppress(HriError):
        assert reader.opened("anna", KEY, value, bytes(data)) is None


@given(st.binary(max_size=700))
def test_any_bytes_are_read_or_refused(data):
    for read in (seal.envelope_of, hello_of):
        with suppress(HriError):
            assert read(data).epoch is not None
