"""Arguments, names and rates, without a robot."""

import math

import jsonschema
import pytest
import trio
import trio.testing
from hypothesis import given, strategies as st

from hri.core.errors import HriError
from hri.net.mcp.arguments import checked, schema_of
from hri.net.mcp.names import SOMEONE, without
from hri.net.mcp.rate import Rate
from hri.net.mcp.tools import TOOLS

ANYTHING = st.one_of(
    st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=30),
    st.just(10**400), st.just("\ud800"), st.lists(st.integers(), max_size=2),
)  # fmt: skip


@pytest.mark.hypothesis
@given(st.sampled_from(sorted(TOOLS)), st.data())
def test_what_is_taken_fits_the_schema_that_is_shown(name, data):
    wanted = TOOLS[name].arguments
    keys = st.one_of(st.sampled_from([*wanted, "other"]), st.text(max_size=4))
    given_ = data.draw(st.dictionaries(keys, ANYTHING, max_size=4))
    try:
        found = checked(name, wanted, given_)
    except HriError:
        return
    jsonschema.validate(given_, schema_of(wanted))
    assert found.keys() == wanted.keys()
    assert all(not isinstance(one, float) or math.isfinite(one) for one in found.values())


@pytest.mark.parametrize("name", TOOLS)
def test_each_schema_is_one(name):
    schema = schema_of(TOOLS[name].arguments)
    jsonschema.Draft202012Validator.check_schema(schema)
    assert schema["additionalProperties"] is False


def test_names_are_hidden_where_they_are_words():
    names = frozenset(("Anna", "Anna Lena", "Bo"))
    assert without(names, "ANNA stopped me; Anna Lena's cup, Boat") == (
        f"{SOMEONE} stopped me; {SOMEONE}'s cup, Boat"
    )
    assert without(frozenset(), "Anna") == "Anna"


@pytest.mark.hypothesis
@given(st.lists(st.floats(0, 10), max_size=60), st.floats(1, 20), st.floats(0.1, 50))
def test_no_more_happens_than_the_rate_says(waits, burst, a_second):
    rate, now, taken = Rate(burst, a_second), 0.0, 0
    for wait in waits:
        now += wait
        taken += rate.take(now)
        assert taken <= burst + now * a_second + 1e-6


def test_who_comes_too_fast_waits():
    async def times():
        rate, came = Rate(2, 10), []
        for _ in range(6):
            await rate.turn()
            came.append(trio.current_time())
        return came

    came = trio.run(times, clock=trio.testing.MockClock(autojump_threshold=0))
    assert came[-1] - came[0] == pytest.approx(0.4)
