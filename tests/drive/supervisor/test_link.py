import json
import math

from hypothesis import given, settings, strategies as st

from hri.core.signals import Twist
from hri.drive.bases.protocol import BaseReport, Note
from hri.drive.supervisor.cause import Cause
from hri.drive.supervisor.link import (
    LARGEST,
    MOST,
    Ask,
    Brake,
    Dock,
    Heartbeat,
    Lamps,
    Nearest,
    Numbered,
    Packets,
    Release,
    Song,
    State,
    Trip,
    decoded_order,
    decoded_state,
    encoded,
    pair,
)
from hri.drive.velocity_limits import Cap
from hri.hal.motion import Way
from hri.hal.rank import Rank

ORDERS = (
    Heartbeat(1.0),
    Ask(Rank.TASKS, Twist(0.1, -0.2), 1.5),
    Ask(Rank.TELEOP, None, 1.5),
    Brake(2.0),
    Trip(Cause("e-stop", "you said stop")),
    Trip(Cause("e-stop", "you said stop", 1.5)),
    Release(0.0, Cause("bump", "it hurt")),
    Song((Note(60, 0.5), Note(62, 0.25))),
    Lamps(0.5, True),
    Dock(1.0),
    Nearest(math.inf, 1.0),
)
JSON = st.recursive(
    st.none() | st.booleans() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner),
    max_leaves=8,
)
FIELDS = st.sampled_from(("echo", "source", "twist", "cause", "notes"))
NAMES = st.sampled_from(
    ("Ask", "Heartbeat", "Trip", "Nearest", "Release", "Song", "State", "Other")
)


def test_every_order_arrives_as_it_was_given() -> None:
    assert tuple(decoded_order(encoded(order)) for order in ORDERS) == ORDERS


def test_a_state_arrives_as_it_was_given() -> None:
    report = BaseReport(
        1.0,
        Way(0.5, -0.1),
        Twist(0.1),
        bumps={"left": True},
        cliffs={"left": False},
        cliff_signals={"left": 1500},
        buttons={"clean": True},
        ranges={"front": math.inf},
        battery=0.5,
        mode="safe",
    )
    state = State(
        2.0,
        report,
        Twist(0.1),
        Rank.TASKS,
        Cause("done", "I was asked to"),
        allowed=Cap(0.5, 0.2, 1.0),
        waiting=(Rank.TELEOP, Rank.TASKS),
        faults=("my left bumper says nothing",),
        news=(Numbered(3, Cause("bump", "it hurt")),),
    )
    assert decoded_state(encoded(state)) == state
    assert decoded_state(encoded(State(0.0))) == State(0.0)


def test_what_is_not_finite_arrives_to_be_refused() -> None:
    order = decoded_order(encoded(Ask(Rank.TASKS, Twist(math.nan, math.inf), 0.0)))
    assert isinstance(order, Ask)
    assert order.twist is not None
    assert math.isnan(order.twist.linear)


@given(st.binary(max_size=300))
def test_no_bytes_break_the_decoders(packet) -> None:
    assert decoded_order(packet) is None
    assert decoded_state(packet) is None


@settings(deadline=None, max_examples=50)
@given(NAMES, st.dictionaries(FIELDS, JSON) | JSON)
def test_no_fields_break_the_decoders(name, fields) -> None:
    packet = json.dumps({name: fields}).encode()
    decoded_order(packet)
    decoded_state(packet)


def test_deeply_nested_brackets_do_not_break_the_decoders() -> None:
    assert decoded_order(b'{"Heartbeat":' + b"[" * 60000) is None


def test_a_flood_is_taken_in_portions_and_a_full_line_drops() -> None:
    one, other = (Packets(end) for end in pair())
    sent = sum(one.send(b"x" * 100) for _ in range(5000))
    assert MOST < sent < 5000
    assert len(other.receive()) == MOST
    one.close()
    other.close()


def test_packets_stay_apart_and_the_end_is_noticed() -> None:
    one, other = (Packets(end) for end in pair())
    one.send(b"a")
    one.send(b"b" * (LARGEST // 2))
    assert [len(packet) for packet in other.receive()] == [1, LARGEST // 2]
    one.close()
    assert other.receive() == []
    assert other.is_over
    assert not other.send(b"c")
    other.close()
