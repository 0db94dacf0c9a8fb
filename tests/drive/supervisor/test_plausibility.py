import math
from typing import Any

import pytest

from hri.core.signals import Twist
from hri.drive.bases.protocol import BaseReport, Sensors
from hri.drive.supervisor.cliffs import Floor, Light, edges
from hri.drive.supervisor.plausibility import HOLD, Plausibility
from hri.hal.motion import REST, Way

STEP = 0.015
FAR = Sensors(ranges=("front",))
DOWN = Sensors(cliffs=("left",), cliff_signals=("left",))


def faults(sensors: Sensors, told, asked: Twist = REST, seconds: float = 4.0) -> list[str]:
    """What is found while `told(seconds)` gives the fields of a report each 15 ms."""
    plausibility, floor, found = Plausibility(sensors, 0.12), Floor(), []
    for number in range(round(seconds / STEP)):
        now = number * STEP
        report = BaseReport(now, **{"rolled": Way(), "velocity": asked} | told(now))
        found = plausibility.step(now, report, floor.step(report), asked)
    return [fault.words for fault in found]


def along(now: float) -> Way:
    return Way(0.3 * now, 0.0)


def test_a_sound_sensor_is_believed() -> None:
    told = lambda now: {"rolled": along(now), "ranges": {"front": 3.0 - 0.3 * now}}  # noqa: E731
    assert faults(FAR, told, Twist(0.3)) == []


@pytest.mark.parametrize("value", [math.nan, -0.1, 1000.0])
def test_a_reading_that_cannot_be_is_told_by_name(value) -> None:
    (words,) = faults(FAR, lambda now: {"ranges": {"front": value}})
    assert words.startswith("my front range sensor says")


def test_a_reading_that_stays_while_the_base_goes_far_is_stuck() -> None:
    told = lambda now: {"rolled": Way(0.3 * now, 0.4 * now), "ranges": {"front": 0.42}}  # noqa: E731
    assert faults(FAR, told, Twist(0.3)) == ["my front range sensor is stuck at 0.42"]
    assert faults(FAR, lambda now: {"ranges": {"front": 0.42}}) == []


def test_along_a_wall_a_distance_may_stay_the_same() -> None:
    told = lambda now: {"rolled": along(now), "ranges": {"front": 0.42}}  # noqa: E731
    assert faults(FAR, told, Twist(0.3)) == []


@pytest.mark.parametrize(("signal", "is_stuck"), [(600, True), (1023, False), (4095, False)])
def test_a_signal_that_stays_is_stuck_but_for_its_full_scale(signal, is_stuck) -> None:
    def told(now: float) -> dict[str, Any]:
        signals = {"left": signal}
        return {"rolled": along(now), "cliffs": {"left": False}, "cliff_signals": signals}

    assert bool(faults(DOWN, told, Twist(0.3))) == is_stuck


def test_seeing_nothing_for_long_is_no_fault() -> None:
    told = lambda now: {"rolled": along(now), "ranges": {"front": math.inf}}  # noqa: E731
    assert faults(FAR, told, Twist(0.3)) == []


def test_a_reading_that_leaps_to_and_fro_is_told() -> None:
    told = lambda now: {"ranges": {"front": 0.5 + round(now / STEP) % 2}}  # noqa: E731
    assert faults(FAR, told) == ["my front range sensor jumps to and fro"]


def test_a_flag_and_a_signal_that_contradict_each_other_are_told() -> None:
    told = lambda now: {"cliffs": {"left": False}, "cliff_signals": {"left": 3}}  # noqa: E731
    (words,) = faults(DOWN, told)
    assert words.startswith("my left cliff sensor contradicts itself")


def test_a_bumper_that_stays_pressed_behind_the_base_is_stuck() -> None:
    told = lambda now: {"rolled": Way(-0.1 * now, 0.0), "bumps": {"left": True}}  # noqa: E731
    words = faults(Sensors(bumps=("left",)), told)
    assert words == ["my left bumper is still pressed after I backed off"]


def test_a_voltage_that_cannot_be_is_told() -> None:
    assert faults(Sensors(), lambda now: {"voltage": -3.0}) == [
        "my battery says -3 V, which cannot be"
    ]


def test_a_charge_that_cannot_be_is_told() -> None:
    for told, said in (
        ({"battery": 24.3}, "says 2430%"),
        ({"battery": math.nan}, "says nan%"),
        ({"voltage": math.nan}, "says nan V"),
        ({"battery_fault": "says 65529 of 2696 mAh"}, "says 65529 of 2696 mAh"),
    ):
        assert faults(Sensors(), lambda now, told=told: told) == [
            f"my battery {said}, which cannot be"
        ]


def test_a_fault_is_forgotten_some_time_after_it_was_seen_last() -> None:
    bad = lambda now: {"ranges": {"front": -1.0 if now < 1.0 else 1.0 + 0.01 * (now % 1)}}  # noqa: E731
    assert faults(FAR, bad, seconds=1.0 + HOLD - 0.1)
    assert not faults(FAR, bad, seconds=1.0 + HOLD + 0.1)


# --- votes for an edge ---

PLACES = ("left", "front_left", "front_right", "right")
CLEAR = dict.fromkeys(PLACES, False)
LIT = dict.fromkeys(PLACES, Light.LIT)


@pytest.mark.parametrize(
    ("flags", "lights", "seen"),
    [
        ({}, {}, []),
        ({"left": True}, {}, ["left"]),
        ({}, {"left": Light.DARK}, ["left"]),
        ({}, {"left": Light.DIM}, []),
        ({}, {"left": Light.DIM, "front_left": Light.DIM}, ["left", "front_left"]),
        ({}, {"left": Light.DIM, "right": Light.DIM}, []),
        ({"left": True}, {"front_left": Light.DIM}, ["left", "front_left"]),
        ({"left": True}, {"left": Light.UNKNOWN}, ["left"]),
    ],
)
@pytest.mark.proves("B27")
def test_flag_light_and_neighbors_vote(flags, lights, seen) -> None:
    assert edges(CLEAR | flags, LIT | lights) == seen


def test_a_darker_floor_is_learned() -> None:
    floor = Floor()

    def seen(signal: int) -> Light:
        return floor.step(
            BaseReport(0.0, Way(), None, cliffs={"left": False}, cliff_signals={"left": signal})
        )["left"]

    assert seen(1500) is Light.LIT
    assert seen(500) is Light.DIM
    assert {seen(500) for _ in range(200)} == {Light.DIM, Light.LIT}
    assert seen(500) is Light.LIT
    assert seen(5) is Light.DARK
