import math
from dataclasses import replace

import pytest
from hypothesis import given, settings, strategies as st

from hri.core.signals import Pose2D, Twist
from hri.drive.bases.protocol import BaseReport, Sensors
from hri.drive.supervisor.base_rules import Rules
from hri.drive.supervisor.cause import Cause
from hri.drive.supervisor.free_space import Body
from hri.drive.supervisor.supervisor import Supervisor
from hri.drive.supervisor.velocity_arbiter import Command
from hri.drive.velocity_limits import BaseLimits
from hri.hal.motion import REST, Way
from hri.hal.rank import WRITERS, Rank

from .track import PLACES, STEP, Track

GO = Twist(0.3)
anything = st.floats(allow_nan=True, allow_infinity=True)
twists = st.builds(Twist, anything, anything)
flags = st.dictionaries(st.sampled_from(PLACES), st.booleans())
reports = st.builds(
    BaseReport,
    st.floats(0, 3),
    st.builds(Way, st.floats(-5, 5), st.floats(-5, 5)),
    st.none() | twists,
    flags,
    flags,
    st.dictionaries(st.sampled_from(PLACES), st.integers(-5, 70000)),
    flags,
    st.dictionaries(st.sampled_from(("clean", "stop")), st.booleans()),
    st.dictionaries(st.sampled_from(("front", "back")), anything),
    st.none() | anything,
    st.none() | anything,
    st.booleans(),
    st.sampled_from(("off", "passive", "safe", "full", "ready")),
)
commands = st.lists(st.builds(Command, st.sampled_from(list(Rank)), twists, st.floats(0, 3)))
steps = st.lists(st.tuples(st.floats(0, 0.1), st.none() | reports, commands), max_size=30)


# --- the latch ---


@settings(deadline=None, max_examples=40)
@given(steps)
def test_the_latch_never_opens_by_itself_and_nothing_moves_while_it_is_closed(story) -> None:
    supervisor = Supervisor(Rules(Twist(0.5, 4.0)))
    now = 0.0
    for dt, report, asked in story:
        now += dt
        assert supervisor.step(now, report, asked).twist == REST
        assert supervisor.latch.is_closed


@settings(deadline=None, max_examples=40)
@given(steps)
def test_no_report_and_no_command_breaks_it_or_the_limits(story) -> None:
    supervisor = Supervisor(Rules(Twist(0.5, 4.0), mounts={"front": Pose2D(0.17)}))
    now, limits = 0.0, BaseLimits()
    for dt, report, asked in story:
        now += dt
        supervisor.release(now)
        twist = supervisor.step(now, report, asked).twist
        assert -limits.backward <= twist.linear <= limits.forward
        assert abs(twist.angular) <= limits.angular


@settings(deadline=None, max_examples=40)
@given(steps, st.sampled_from(("clean", "stop")))
def test_while_a_button_is_pressed_nothing_moves_it_and_nobody_releases_it(story, name) -> None:
    supervisor = Supervisor(Rules(Twist(0.5, 4.0)))
    now, was_pressed = 0.0, False
    for dt, report, asked in story:
        now += dt
        if report is not None:
            was_pressed = True
            report = replace(report, buttons={**report.buttons, name: True})
        supervisor.release(now)
        assert supervisor.step(now, report, asked).twist == REST
        assert supervisor.latch.is_closed or not was_pressed


def test_after_power_up_it_waits_for_a_release() -> None:
    track = Track()
    assert track.run(0.5, GO).reason.name == "power-up"
    assert track.decision.twist == REST
    assert track.released().run(1.0, GO).twist == GO


def test_an_emergency_stop_is_abrupt_and_stays() -> None:
    track = Track().released()
    track.run(1.0, GO)
    track.supervisor.trip(Cause("e-stop", "you said stop"))
    assert track.step((Command(Rank.TELEOP, GO, track.now),)).twist == REST
    assert track.run(5.0, GO, Rank.TELEOP).twist == REST
    assert track.decision.reason.words == "I stopped because you said stop"
    assert track.stops == ["e-stop"]
    assert track.released().run(1.0, GO).twist == GO


def test_what_was_asked_before_a_release_is_void() -> None:
    track = Track()
    track.step((Command(Rank.TASKS, GO, track.now),))
    track.released()
    assert track.run(0.1).twist == REST


def test_a_silent_base_cannot_be_released() -> None:
    track = Track()
    track.is_silent = True
    track.run(1.2)
    assert track.released().supervisor.latch.is_closed
    assert "silent" in track.supervisor.refusals[0]


# --- who is heard ---


def test_whoever_falls_silent_lets_the_base_rest_at_once() -> None:
    track = Track().released()
    track.run(1.0, GO)
    begun = track.now
    while track.decision.twist != REST:
        track.run(STEP)
    assert track.now - begun <= 0.2 + 2 * STEP
    assert track.decision.reason.words == "I stopped because my tasks fell silent"
    assert track.stops == ["timeout"]


def test_teleoperation_goes_first_and_its_dead_man_leaves_the_wheels_to_the_next() -> None:
    track = Track().released()
    for _ in range(100):
        now = track.now
        track.step((Command(Rank.TASKS, GO, now), Command(Rank.TELEOP, Twist(0.1), now)))
    assert track.decision.level is Rank.TELEOP
    assert track.decision.twist == Twist(0.1)
    track.run(0.18, GO)
    assert track.decision.level is Rank.TELEOP
    assert track.run(0.5, GO).twist == GO


def test_what_is_asked_to_rest_slows_down_gently() -> None:
    track = Track().released()
    track.run(1.0, GO)
    assert 0.2 < track.run(0.1, REST).twist.linear < 0.3
    assert track.run(0.6, REST).twist == REST
    assert track.stops == ["done"]


@pytest.mark.parametrize("value", [math.nan, math.inf, 0.7])
def test_nonsense_stops_the_base_and_is_told_once(value) -> None:
    track = Track().released()
    track.run(1.0, GO)
    track.run(0.1, Twist(value))
    assert track.decision.twist == REST
    assert track.stops == ["refused"]
    assert len(track.supervisor.refusals) == 1


def test_a_supervisor_that_stood_still_begins_again_from_rest() -> None:
    track = Track().released()
    track.run(1.0, GO)
    track.now += 0.3
    track.step((Command(Rank.TASKS, GO, track.now),))
    assert track.decision.twist == REST
    assert track.stops == ["frozen"]
    assert 0 < track.run(0.1, GO).twist.linear < 0.1


def test_a_supervisor_that_stood_still_for_long_does_not_go_on_by_itself() -> None:
    track = Track().released()
    track.run(1.0, GO)
    track.now += 1.5
    track.step((Command(Rank.TASKS, GO, track.now),))
    assert track.run(0.5, GO).reason.name == "frozen"
    assert track.decision.twist == REST


def test_while_its_watchdog_is_late_the_base_rests_and_then_goes_on() -> None:
    track = Track().released()
    track.run(1.0, GO)
    track.supervisor.is_watched = False
    assert track.run(STEP, GO).twist == REST
    assert track.run(0.3, GO).reason.name == "watchdog"
    assert track.decision.twist == REST
    track.supervisor.is_watched = True
    assert track.run(1.0, GO).twist == GO


# --- people and obstacles ---


@pytest.mark.parametrize(
    ("distance", "speed"), [(None, 0.3), (0.8, 0.3), (3.0, 0.5), (math.nan, 0.3), (math.inf, 0.5)]
)
def test_it_is_slower_near_people_and_where_nobody_knows(distance, speed) -> None:
    track = Track().released()
    for _ in range(150):
        if distance is not None:
            track.supervisor.hear_person(distance, track.now)
        track.step((Command(Rank.TASKS, Twist(0.5), track.now),))
    assert track.decision.twist.linear == pytest.approx(speed)


def test_what_was_known_of_people_does_not_count_for_long() -> None:
    track = Track().released()
    track.supervisor.hear_person(5.0, track.now)
    assert track.run(0.9, Twist(0.5)).twist.linear > 0.3
    assert track.run(1.0, Twist(0.5)).twist.linear == pytest.approx(0.3)


def test_it_stops_before_what_its_range_sensors_see() -> None:
    track = Track(
        sensors=Sensors(ranges=("front",)), mounts={"front": Pose2D(0.17)}, body=Body(clearance=0.1)
    ).released()
    wall = 1.0
    for _ in range(600):
        track.feel(ranges={"front": wall - track.report.rolled.linear})
        track.step((Command(Rank.TASKS, GO, track.now),))
    assert track.decision.twist == REST
    assert 0.1 <= track.report.ranges["front"] < 0.16
    assert track.stops == ["obstacle"]
    assert track.run(0.5, Twist(0.0, 0.5)).twist.angular == pytest.approx(0.5)


def test_it_stands_when_somebody_walks_up_to_it() -> None:
    mounts = {"left": Pose2D(0.13, 0.13, math.pi / 4)}
    track = Track(sensors=Sensors(ranges=("left",)), mounts=mounts).released()
    away, speeds = 1.6, []
    while away > 0.02:
        away -= 0.01 * 0.9
        track.feel(ranges={"left": away if away < 0.8 else math.inf})
        speeds.append(track.step((Command(Rank.TASKS, GO, track.now),)).twist.linear)
    assert max(speeds) > 0.2
    assert speeds[-1] == 0.0


# --- reflexes ---


@pytest.mark.proves("B27")
@pytest.mark.parametrize("side", ["left", "right"])
def test_a_bump_backs_off_turns_away_and_goes_on(side) -> None:
    track = Track().released()
    track.run(1.0, GO)
    where = track.report.rolled
    track.feel(bumps={**track.report.bumps, side: True})
    assert track.step().twist == REST
    assert track.decision.reason.words == f"I stopped because my {side} bumper touches something"
    track.run(0.5, GO)
    track.feel(bumps={"left": False, "right": False})
    track.run(1.2, GO)
    assert where.linear - track.report.rolled.linear == pytest.approx(0.1, abs=0.02)
    track.run(1.2, GO)
    turned = track.report.rolled.angular - where.angular
    # It rolls out a little.
    assert turned == pytest.approx(-0.7 if side == "left" else 0.7, abs=0.1)
    assert track.run(1.5, GO).twist == GO


@pytest.mark.proves("B27")
@pytest.mark.parametrize("place", PLACES)
def test_an_edge_stops_and_backs_off(place) -> None:
    track = Track().released()
    track.run(1.0, GO)
    track.feel(cliffs={**track.report.cliffs, place: True})
    assert track.step((Command(Rank.TELEOP, GO, track.now),)).twist == REST
    assert "cliff sensor sees an edge" in track.decision.reason.because
    before = track.report.rolled.linear
    track.run(2.0, GO)
    assert track.report.rolled.linear < before - 0.08


def test_before_an_edge_it_does_not_drive_on_but_turns() -> None:
    track = Track().released()
    track.feel(cliffs={**track.report.cliffs, "left": True})
    assert track.run(0.2, GO).twist == REST
    assert track.decision.reason.name == "cliff"
    assert track.run(0.2, Twist(-0.1)).twist.linear < 0
    assert track.run(0.5, Twist(0.3, 0.5)).twist.linear <= 0


def test_its_own_guard_may_stop_the_base_at_an_edge_and_it_is_woken() -> None:
    track = Track().released()
    track.run(1.0, GO)
    track.feel(cliffs={**track.report.cliffs, "left": True}, mode="passive")
    track.run(0.15, GO)
    assert track.wakes == 1
    track.feel(mode="safe")
    assert track.run(0.5, GO).twist.linear < 0
    assert not track.supervisor.latch.is_closed


def test_a_base_that_no_longer_obeys_stays_until_it_is_released() -> None:
    track = Track().released()
    track.run(1.0, GO)
    track.feel(mode="passive")
    assert track.step().twist == REST
    assert track.supervisor.latch.is_closed
    track.released().step()
    assert track.decision.must_wake


@pytest.mark.parametrize("wheel", ["left", "right"])
def test_a_dropped_wheel_stops_until_it_is_released_on_the_floor(wheel) -> None:
    track = Track().released()
    track.run(1.0, GO)
    track.feel(wheel_drops={**track.report.wheel_drops, wheel: True})
    assert track.step().twist == REST
    assert f"my {wheel} wheel hangs in the air" in track.decision.reason.words
    track.released()
    assert track.supervisor.latch.is_closed
    assert "a wheel hangs in the air" in track.supervisor.refusals[0]
    track.run(0.1, GO)
    assert track.decision.twist == REST
    track.feel(wheel_drops={"left": False, "right": False})
    assert track.run(0.5, GO).twist == REST
    assert track.released().run(1.0, GO).twist == GO


def test_a_button_latches_until_somebody_lets_it_go_and_releases_the_base() -> None:
    track = Track().released()
    track.run(1.0, GO)
    track.feel(buttons={"clean": True, "dock": False})
    assert track.step((Command(Rank.TELEOP, GO, track.now),)).twist == REST
    assert track.decision.must_cut
    assert track.decision.reason.words == "I stopped because someone pressed my clean button"
    assert track.stops == ["button"]
    assert track.released().supervisor.latch.is_closed
    assert "while someone presses my clean button" in track.supervisor.refusals[0]
    track.feel(buttons={"clean": False, "dock": False})
    assert track.run(5.0, GO).twist == REST
    assert track.released().run(1.0, GO).twist == GO
    assert track.stops == ["button"]


def test_a_button_ends_a_reflex_and_an_emergency_stop_given_meanwhile_keeps_its_reason() -> None:
    track = Track().released()
    track.run(1.0, GO)
    track.feel(bumps={"left": True, "right": False})
    assert track.run(0.5, GO).twist.linear < 0
    track.feel(buttons={"clean": False, "dock": True})
    assert track.step().twist == REST
    track.supervisor.trip(Cause("e-stop", "you said stop"))
    assert track.run(3.0, GO).reason.name == "e-stop"
    assert track.decision.twist == REST
    assert track.released().supervisor.latch.is_closed


def test_a_touch_of_a_button_between_two_turns_counts() -> None:
    track = Track().released()
    track.run(1.0, GO)
    touched = replace(track.report, buttons={"clean": True, "dock": False})
    assert track.supervisor.step(track.now, touched).twist == REST
    assert track.supervisor.step(track.now, track.report, ()).must_cut
    assert track.supervisor.latch.is_closed


def test_a_wheel_that_drops_in_the_middle_of_a_reflex_ends_it() -> None:
    track = Track().released()
    track.run(1.0, GO)
    track.feel(bumps={"left": True, "right": False})
    assert track.run(0.5, GO).twist.linear < 0
    track.feel(wheel_drops={"left": True, "right": False})
    assert track.step().twist == REST
    assert track.run(3.0, GO).reason.name == "wheel drop"
    assert track.decision.twist == REST


def test_an_emergency_stop_ends_a_reflex_which_does_not_go_on_after_the_release() -> None:
    track = Track().released()
    track.run(1.0, GO)
    track.feel(bumps={"left": True, "right": False})
    assert track.run(0.5, GO).twist.linear < 0
    track.supervisor.trip(Cause("e-stop", "you said stop"))
    assert track.run(0.5).twist == REST
    assert track.released().run(0.5).twist == REST
    assert track.run(0.5, GO).reason.name == "bump"
    assert track.decision.twist == REST


REAR = Sensors(cliffs=("left", "rear"))
FLOOR_ALL_AROUND = {"left": False, "rear": False}


def test_a_reflex_that_backs_off_toward_an_edge_stops_before_it() -> None:
    track = Track(sensors=REAR).released()
    track.feel(cliffs=FLOOR_ALL_AROUND, cliff_signals={})
    track.run(1.0, GO)
    track.feel(bumps={"left": True, "right": False})
    assert track.run(0.5, GO).twist.linear < 0
    track.feel(cliffs={"left": False, "rear": True})
    assert track.step().twist == REST
    assert track.run(3.0).twist.linear == 0.0


def test_behind_an_edge_it_does_not_back_off_but_drives_ahead() -> None:
    track = Track(sensors=REAR).released()
    track.feel(cliffs=FLOOR_ALL_AROUND, cliff_signals={})
    track.run(1.0, Twist(-0.1))
    track.feel(cliffs={"left": False, "rear": True})
    assert track.step().twist == REST
    for _ in range(200):
        track.step((Command(Rank.TELEOP, Twist(-0.1), track.now),))
        assert track.decision.twist.linear >= 0
    assert track.decision.reason.name == "cliff"
    assert track.run(1.0, Twist(0.1)).twist.linear == pytest.approx(0.1)


# --- faults ---


@pytest.mark.parametrize("time", [math.nan, math.inf, -math.inf, 1e6])
def test_a_report_of_no_time_or_of_another_is_no_report(time) -> None:
    track = Track().released()
    track.run(1.0, GO)
    track.is_silent = True
    track.feel(time=time)
    assert track.run(0.02, GO).twist == REST
    track.run(1.2, GO)
    assert track.released().supervisor.latch.is_closed


def test_a_way_that_is_no_number_latches_it() -> None:
    track = Track().released()
    track.run(1.0, GO)
    track.feel(rolled=Way(math.nan, 0.0))
    assert track.step().twist == REST
    assert "my wheels say what is not a number" in track.decision.reason.words


@pytest.mark.parametrize("measured", [Twist(0.15, 1.2), Twist(0.15, -1.2), Twist(-0.3)])
def test_a_single_wheel_that_stands_or_turns_the_wrong_way_latches_it(measured) -> None:
    track = Track().released()
    track.measured = measured
    track.run(2.0, GO)
    assert track.supervisor.latch.is_closed
    assert "my wheels do not turn" in track.decision.reason.words


def test_each_of_several_reports_of_one_time_counts() -> None:
    track = Track().released()
    track.run(1.0, GO)
    touched = replace(track.report, bumps={"left": True, "right": False})
    assert track.supervisor.step(track.now, touched).twist == REST
    assert track.supervisor.step(track.now, track.report).twist == REST


def test_reports_that_cease_stop_it_and_when_they_stay_away_latch_it() -> None:
    track = Track().released()
    track.run(1.0, GO)
    track.is_silent = True
    assert track.run(0.12, GO).twist == REST
    assert track.decision.reason.name == "stale"
    track.is_silent = False
    assert track.run(1.0, GO).twist == GO
    track.is_silent = True
    track.run(1.2, GO)
    track.is_silent = False
    assert track.run(0.5, GO).twist == REST
    assert track.supervisor.latch.is_closed


def test_a_base_that_falls_silent_again_and_again_needs_a_release() -> None:
    track = Track().released()
    for _ in range(3):
        track.is_silent = False
        track.run(1.0, GO)
        track.is_silent = True
        track.run(0.2, GO)
    track.is_silent = False
    assert track.run(1.0, GO).twist == REST
    assert track.decision.reason.name == "unsteady"
    assert track.released().run(1.0, GO).twist == GO


def test_a_base_that_falls_silent_now_and_then_goes_on() -> None:
    track = Track().released()
    for _ in range(5):
        track.is_silent = False
        assert track.run(6.0, GO).twist == GO
        track.is_silent = True
        track.run(0.2, GO)


def test_too_much_that_makes_no_sense_latches_a_base_and_keeps_an_earlier_reason() -> None:
    track = Track().released()
    track.run(1.0, GO)
    track.supervisor.hear_noise(0.2)
    assert track.run(STEP, GO).twist != REST
    track.supervisor.hear_noise(0.5)
    assert track.run(1.0, GO).reason.name == "garbled"
    track.supervisor.trip(Cause("e-stop", "you said stop"))
    track.supervisor.hear_noise(0.5)
    assert track.run(1.0, GO).reason.name == "e-stop"


@pytest.mark.proves("B27")
def test_a_cliff_sensor_that_says_nothing_is_a_hazard_with_a_name() -> None:
    track = Track().released()
    track.run(1.0, GO)
    cliffs = {place: False for place in PLACES if place != "front_left"}
    track.feel(cliffs=cliffs)
    assert track.step().twist == REST
    words = "I stopped because my front left cliff sensor says nothing"
    assert track.decision.reason.words == words
    assert track.run(1.0, GO).twist == REST


def test_wheels_that_do_not_turn_latch_it() -> None:
    track = Track().released()
    track.follows = False
    track.run(2.0, GO)
    assert track.supervisor.latch.is_closed
    assert "my wheels do not turn" in track.decision.reason.words


@pytest.mark.parametrize("source", WRITERS)
def test_nobody_talks_it_out_of_a_hazard(source) -> None:
    track = Track().released()
    track.feel(bumps={"left": True, "right": True})
    for _ in range(100):
        track.step((Command(source, GO, track.now),))
        assert track.decision.twist.linear <= 0


# --- a stop that was said ---

SAID = Cause("e-stop", "someone said stop", 1.0)


def _garble(track: Track) -> None:
    track.supervisor.hear_noise(0.5)


def _freeze(track: Track) -> None:
    track.now += 1.5


def _fall_silent(track: Track) -> None:
    track.is_silent = True
    track.run(1.2)
    track.is_silent = False


@pytest.mark.parametrize(
    ("name", "happen"),
    [
        ("bump", lambda track: track.feel(bumps={"left": True, "right": False})),
        ("cliff", lambda track: track.feel(cliffs=dict.fromkeys(PLACES, True))),
        ("wheel drop", lambda track: track.feel(wheel_drops={"left": True, "right": False})),
        ("button", lambda track: track.feel(buttons={"clean": True, "dock": False})),
        ("fault", lambda track: track.feel(bumps={"right": False})),
        ("garbled", _garble),
        ("frozen", _freeze),
        ("stale", _fall_silent),
    ],
)
def test_what_happens_while_a_spoken_stop_holds_it_takes_its_place(name, happen) -> None:
    track = Track().released()
    track.run(1.0, GO)
    track.supervisor.trip(SAID)
    track.run(0.5, GO)
    assert track.supervisor.latch.cause == SAID
    happen(track)
    track.run(0.1, GO)
    assert track.supervisor.latch.cause.name == name
    assert track.supervisor.latch.is_firm
    track.supervisor.trip(SAID)
    assert track.supervisor.latch.is_firm


def test_what_it_met_before_a_spoken_stop_is_not_held_against_it() -> None:
    track = Track().released()
    track.run(1.0, GO)
    track.feel(bumps={"left": True, "right": False})
    track.run(0.05, GO)
    track.supervisor.trip(SAID)
    track.run(0.5, GO)
    assert track.supervisor.latch.cause == SAID
