"""What the robot does while nothing happens: which acts fit, how often they come, and the file."""

import itertools
import math
from dataclasses import replace
from pathlib import Path
from statistics import NormalDist

import pytest
from hypothesis import given, strategies as st

from hri.conversation.idle_acts import (
    SPREAD,
    IdleAct,
    IdleActs,
    Idler,
    Stillness,
    load_idle_acts,
)
from hri.core.errors import AuthoringError
from hri.emotion.display import LABELS
from hri.face.model import load_face
from hri.face.motion.gesture_tracks import load_gestures

STEP = 0.25
GESTURES = load_gestures(load_face("robot"))
TABLE = load_idle_acts(gestures=GESTURES)
AWAKE = IdleActs(TABLE.every_s, {n: act for n, act in TABLE.acts.items() if not act.naps})
QUIET = Stillness(600.0)


def evening(
    seconds: float, seed: int = 0, table: IdleActs = AWAKE, still: Stillness = QUIET
) -> list[tuple[float, IdleAct]]:
    idler = Idler(table, seed)
    times = (step * STEP for step in range(round(seconds / STEP)))
    return [(now, act) for now in times if (act := idler.choose(now, still))]


def only(**changes: object) -> IdleActs:
    return IdleActs(10.0, {"a": replace(IdleAct("a", "does it", gesture="nod"), **changes)})  # type: ignore[arg-type]


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("is_seen", [False, True])
def test_nothing_is_done_twice_within_ten_minutes(seed: int, is_seen: bool) -> None:
    done = evening(3600, seed, still=replace(QUIET, feeling="relaxed", is_seen=is_seen))
    assert len({act.name for _, act in done}) >= 25
    for name, group in itertools.groupby(sorted((a.name, t) for t, a in done), lambda one: one[0]):
        times = [time for _, time in group]
        assert all(b - a >= 600 for a, b in itertools.pairwise(times)), name


def test_every_ten_minutes_are_others_and_the_same_seed_is_the_same() -> None:
    evenings = [tuple(act.name for _, act in evening(600, seed)) for seed in range(5)]
    assert len(set(evenings)) == 5
    assert evening(600, 3) == evening(600, 3)
    assert all(8 <= len(acts) <= 30 for acts in evenings)


def test_the_waits_are_log_normal_around_the_median_of_the_file() -> None:
    many = IdleActs(30.0, {str(n): IdleAct(str(n), "", again_s=0.0) for n in range(3)})
    times = [time for time, _ in evening(60_000, table=many)]
    logs = sorted(math.log(b - a - 3.0) for a, b in itertools.pairwise(times))
    expected = NormalDist(math.log(30.0), SPREAD)
    gaps = (abs((n + 0.5) / len(logs) - expected.cdf(log)) for n, log in enumerate(logs))
    assert max(gaps) < 1.36 / math.sqrt(len(logs)), "Kolmogorov-Smirnov at 5 %"


@pytest.mark.parametrize(
    ("act", "fits", "fits_not"),
    [
        ({"feelings": frozenset({"joy"})}, {"feeling": "joy"}, {"feeling": "calm"}),
        ({"company": "seen"}, {"is_seen": True}, {"is_seen": False}),
        ({"company": "alone"}, {"is_seen": False}, {"is_seen": True}),
        ({"hours": (22, 6)}, {"hour": 23}, {"hour": 6}),
        ({"hours": (22, 6)}, {"hour": 5}, {"hour": 21}),
        ({"hours": (8, 20)}, {"hour": 8}, {"hour": 20}),
        ({"energy": (0.0, 0.3)}, {"energy": 0.3}, {"energy": 0.31}),
        ({"after_s": 60.0}, {"still_s": 60.0}, {"still_s": 59.0}),
        ({"is_heard": True}, {}, {"may_sound": False}),
    ],
)
def test_an_act_needs_its_conditions(
    act: dict[str, object], fits: dict[str, object], fits_not: dict[str, object]
) -> None:
    still = Stillness(100.0)
    assert Idler(only(**act)).choose(0.0, replace(still, **fits)) is not None  # type: ignore[arg-type]
    assert Idler(only(**act)).choose(0.0, replace(still, **fits_not)) is None  # type: ignore[arg-type]


def test_the_base_keeps_still_where_it_must() -> None:
    moving = IdleActs(1.0, {n: act for n, act in AWAKE.acts.items() if act.move})
    glad = replace(QUIET, feeling="joy")
    assert evening(60, table=moving, still=glad)
    assert not evening(3600, table=moving, still=replace(glad, may_move=False))


def test_an_act_that_answers_an_event_comes_with_it_alone() -> None:
    idler = Idler(only(on="person.entered", again_s=120.0))
    assert idler.choose(0.0, QUIET) is None
    assert idler.answer("bumper.pressed", 0.0, QUIET) is None
    assert idler.answer("person.entered", 1.0, QUIET) is not None
    assert idler.answer("person.entered", 100.0, QUIET) is None
    assert idler.answer("person.entered", 121.0, QUIET) is not None


@given(
    label=st.sampled_from(LABELS),
    hour=st.integers(0, 23),
    energy=st.floats(0, 1),
    is_seen=st.booleans(),
)
def test_there_is_something_for_every_mood_hour_and_charge(
    label: str, hour: int, energy: float, is_seen: bool
) -> None:
    still = Stillness(600.0, label, energy, hour, is_seen, may_sound=False, may_move=False)
    assert len(evening(600, still=still)) >= 8


def test_alone_it_is_bored_then_sleepy_then_asleep() -> None:
    for seed in range(5):
        idler, names = Idler(TABLE, seed), []
        for step in range(round(1200 / STEP)):
            if act := idler.choose(step * STEP, Stillness(step * STEP, "bored")):
                names.append(act.name)
                if act.naps:
                    break
        assert names[-1] == "falls_asleep"
        assert {"nods_off", "yawns"} & set(names)
        assert len(names) >= 8


BROKEN = [
    ('[act.a]\nabout = "x"\ngesture = "nodd"\n', '2:1|3:1: the face has no gesture "nodd" - did'),
    ('[act.a]\nabout = "x"\nsound = "[humm]"\n', '3:1: no sound \\[humm\\] - did you mean "hum"'),
    ('[act.a]\nabout = "x"\ngesture = "nod"\nfeelings = ["jo"]\n', '4:1: no feeling "jo"'),
    ('[act.a]\nabout = "x"\n', 'the act "a" does nothing - add such as gesture = "yawn"'),
    ('[act.a]\nabout = "x"\ngesture = "nod"\nhours = [25, 3]\n', "4:1: hours are 25 and 3"),
    ('[act.a]\nabout = "x"\ngesture = "nod"\nenergy = [0.5, 0.2]\n', "4:1: energy is 0.5 to 0.2"),
    ('[act.a]\nabout = "x"\ngesture = "nod"\nafter = 3\n', '4:1: unknown key "after"'),
    ('[act.a]\nabout = "x"\ngesture = "nod"\nweight = -1\n', "4:1: weight is -1"),
    ('[act.a]\nabout = "x"\nmove = { turns = [90] }\n', "turns is"),
    ("every_s = 0\n", "1:1: every_s is 0"),
]


@pytest.mark.parametrize(("text", "error"), BROKEN)
def test_a_broken_file_is_refused_with_place_and_remedy(
    text: str, error: str, tmp_path: Path
) -> None:
    file = tmp_path / "idle.toml"
    file.write_text(text)
    with pytest.raises(AuthoringError, match=error):
        load_idle_acts([file], GESTURES)


def test_a_file_adds_acts_replaces_one_and_takes_one_away(tmp_path: Path) -> None:
    file = tmp_path / "idle.toml"
    file.write_text(
        '[act.dances]\nabout = "dances"\ngesture = "bounce"\n'
        '[act.yawns]\nabout = "yawns rarely"\ngesture = "yawn"\nweight = 0.1\n'
        '[act.sneezes]\nabout = "never"\ngesture = "sneeze"\nweight = 0\n'
    )
    acts = load_idle_acts([file], GESTURES).acts
    assert acts["dances"].gesture == "bounce"
    assert acts["yawns"].weight == 0.1
    assert "sneezes" not in acts
    assert set(TABLE.acts) - set(acts) == {"sneezes"}
