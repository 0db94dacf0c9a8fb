"""What the page shows of the past is bounded, and says what it should."""

import itertools
import logging

from hypothesis import given, strategies as st

from hri.core.signals import EmotionState, Pose2D
from hri.studio.history import (
    LONGEST_LINE,
    MOST_LINES,
    MOST_MOODS,
    MOST_POINTS,
    MOST_REASONS,
    MOST_STOPS,
    MOST_TYPED,
    STRIDE,
    LogLines,
    MoodHistory,
    Trail,
    Troubles,
    TypedSentences,
)


def feeling(label="joy", pleasure=0.5):
    return EmotionState(label, 0.5, pleasure, 0.1, -0.1)


def test_the_mood_is_kept_once_a_second_with_what_caused_it():
    moods = MoodHistory()
    for tick in range(40):
        cause, why = ("praise", f"I am happy, {tick}") if tick >= 20 else ("", "I am calm.")
        moods.add(tick * 0.1, feeling(pleasure=tick / 40), cause, why)
    told = moods.told()
    assert told["points"] == [[float(s), s / 4, 0.1, -0.1] for s in range(4)]
    assert [(one["t"], one["why"][:8]) for one in told["reasons"]] == [
        (0, "I am cal"),
        (2, "I am hap"),
    ]


def test_days_of_moods_are_not_kept():
    moods = MoodHistory()
    for second in range(2 * MOST_MOODS):
        moods.add(second, feeling(), f"reason {second}", "I am happy.")
    told = moods.told()
    assert (len(told["points"]), len(told["reasons"])) == (MOST_MOODS, MOST_REASONS)
    assert told["points"][-1][0] == 2 * MOST_MOODS - 1


@given(st.lists(st.tuples(st.floats(-9, 9), st.floats(-9, 9)), max_size=60))
def test_points_of_a_path_are_a_stride_apart(places):
    trail = Trail()
    for x, y in places:
        trail.add(Pose2D(x, y, 0.0))
    been = trail.been
    gaps = [((a - c) ** 2 + (b - d) ** 2) ** 0.5 for (a, b), (c, d) in itertools.pairwise(been)]
    assert all(gap >= STRIDE - 0.002 for gap in gaps)
    assert bool(been) == bool(places)


def test_a_stop_is_where_the_base_was_and_old_ones_are_forgotten():
    trail = Trail()
    for number in range(2 * MOST_POINTS):
        trail.add(Pose2D(number * 1.0, 0.0, 0.0))
        trail.add_stop(number, "bumper", "I stopped because something touched me")
    assert (len(trail.been), len(trail.stops)) == (MOST_POINTS, MOST_STOPS)
    assert trail.stops[-1]["x"] == 2 * MOST_POINTS - 1


def test_a_device_is_in_trouble_until_it_is_back():
    troubles = Troubles()
    troubles.note("camera: no picture for 2 s - waiting for it; see that it is plugged in")
    assert troubles.of("camera").startswith("no picture for 2 s")
    assert troubles.of("microphone") == ""
    troubles.note("camera: is back")
    assert troubles.of("camera") == ""


def test_the_log_keeps_its_last_lines_and_survives_bad_ones():
    lines = LogLines(lambda: 1.234)
    log = logging.Logger("hri.drive")
    log.addHandler(lines)
    log.info("%s: slow", "base")
    assert lines.told() == [{"t": 1.23, "level": "info", "part": "drive", "text": "base: slow"}]
    log.info("%d", "not a number")
    log.debug("too small")
    assert len(lines.told()) == 1
    for _ in range(MOST_LINES + 5):
        log.warning("x" * 10_000)
    assert len(lines.told()) == MOST_LINES
    assert {len(line["text"]) for line in lines.told()} == {LONGEST_LINE}


def test_a_typed_sentence_is_known_again_once_whatever_its_case_and_blanks():
    typed = TypedSentences()
    for number in range(MOST_TYPED + 1):
        typed.add(f"Turn  {number}")
    assert typed.take("turn 0") is None  # forgotten
    assert [typed.take("turn 1"), typed.take("turn 1")] == ["Turn  1", None]
