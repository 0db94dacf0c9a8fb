import math

import pytest
from hypothesis import given, strategies as st

from hri.net.inbox import KEPT, KEPT_CHARACTERS, Inbox
from hri.net.malleable_protocol import Item, ProtocolError, Sender


def inbox():
    return Inbox({"text": "string", "number": "double"})


def ticks(filled, count, port="text"):
    return [filled.take().get(port, (None, None))[0] for _ in range(count)]


@pytest.mark.proves("W08")
def test_a_counted_value_is_sent_in_as_many_ticks():
    filled = inbox()
    filled.put(Item("text", "once", 1), sender=Sender())
    filled.put(Item("text", "thrice", 3), sender=Sender())
    assert ticks(filled, 6) == ["once", "thrice", "thrice", "thrice", None, None]


@pytest.mark.proves("W08")
def test_a_value_without_a_count_is_sent_until_another_one_comes():
    filled = inbox()
    filled.put(Item("number", "1", None), sender=Sender())
    assert ticks(filled, 3, "number") == [1, 1, 1]
    filled.put(Item("number", "2", None), sender=Sender())
    assert ticks(filled, 3, "number") == [2, 2, 2]
    filled.put(Item("number", "3", 1), sender=Sender())
    assert ticks(filled, 3, "number") == [3, None, None]


def test_numbers_that_come_faster_than_ticks_leave_the_newest_two():
    filled = inbox()
    for number in range(10):
        filled.put(Item("number", str(number)), sender=Sender())
    assert ticks(filled, 3, "number") == [8, 9, None]


@given(st.lists(st.text(max_size=3), max_size=20))
def test_strings_all_wait_for_their_tick(texts):
    filled = inbox()
    for text in texts:
        filled.put(Item("text", text), sender=Sender())
    assert ticks(filled, len(texts) + 1) == [*texts, None]


def test_of_too_many_strings_the_oldest_give_way():
    filled = inbox()
    for number in range(KEPT["string"] + 5):
        filled.put(Item("text", str(number)), sender=Sender())
    assert ticks(filled, 1) == ["5"]


def test_strings_of_a_port_take_a_megabyte_at_most_and_the_newest_always_stays():
    filled = inbox()
    texts = [f"{number} {'x' * 65_000}" for number in range(100)]
    for text in texts:
        filled.put(Item("text", text), sender=Sender())
    came = [text for text in ticks(filled, 100) if text is not None]
    assert came == texts[-len(came) :]
    assert KEPT_CHARACTERS - 65_100 < sum(map(len, came)) <= KEPT_CHARACTERS
    filled.put(Item("text", "y" * 2 * KEPT_CHARACTERS), sender=Sender())
    assert len(ticks(filled, 1)[0]) == 2 * KEPT_CHARACTERS


def test_ports_are_matched_by_name_and_values_by_datatype():
    filled = inbox()
    filled.put(Item("another", "x"), sender=Sender())
    assert filled.take() == {}
    with pytest.raises(ProtocolError, match='"x" is not a double'):
        filled.put(Item("text", "first"), Item("number", "x"), sender=Sender())
    assert filled.take() == {}


def test_a_value_has_the_time_of_its_senders_last_message_whatever_that_was():
    filled, sender, other = inbox(), Sender(), Sender()
    sender.spoken = 1.0
    filled.put(Item("number", "5", None), sender=sender)
    assert filled.take() == {"number": (5.0, 1.0)}
    sender.spoken = 2.0
    filled.put(Item("another", "x"), sender=sender)
    assert filled.take() == {"number": (5.0, 2.0)}
    other.spoken = 3.0
    filled.put(Item("text", "hello"), sender=other)
    assert filled.take() == {"number": (5.0, 2.0), "text": ("hello", 3.0)}


def test_a_sender_who_has_hung_up_never_spoke_though_what_it_said_stays():
    filled, sender = inbox(), Sender()
    sender.spoken = 1.0
    filled.put(Item("number", "5", None), sender=sender)
    sender.is_gone = True
    assert filled.take() == {"number": (5.0, -math.inf)}
