import csv
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hri.emotion.emotions import EMOTIONS, INDEX, NAMES, PAD
from hri.emotion.label import CALM, FALL, LEAD, MOODS, NOTHING, OCTANTS, RISE, leader, mood_name

TABLES = Path(__file__).resolve().parents[3] / "shared" / "emotion_tables"
needs_tables = pytest.mark.skipif(not TABLES.is_dir(), reason="the published tables are not here")

RATES = 1 / np.array([emotion.tau_s for emotion in EMOTIONS])
charges = st.lists(st.floats(0, 5), min_size=len(NAMES), max_size=len(NAMES)).map(np.array)


def rows(name: str) -> list[list[str]]:
    lines = (TABLES / name).read_text(encoding="utf-8").splitlines()
    return list(csv.reader((line for line in lines if line[0] != "#"), delimiter="\t"))[1:]


def charged(**values: float) -> np.ndarray:
    return np.array([values.get(name, 0.0) for name in NAMES])


def test_the_strongest_emotion_gives_the_label() -> None:
    assert leader(NOTHING, charged(joy=1.0, pride=0.6), RATES, 0.0) == INDEX["joy"]
    assert leader(NOTHING, charged(joy=0.9 * RISE), RATES, 0.0) == NOTHING


def test_a_label_is_kept_until_it_has_faded_well_below() -> None:
    start = charged(joy=0.5)
    falls = EMOTIONS[INDEX["joy"]].tau_s * np.log(0.5 / FALL)
    assert leader(INDEX["joy"], start, RATES, falls - 0.01) == INDEX["joy"]
    assert leader(INDEX["joy"], start, RATES, falls + 0.01) == NOTHING


def test_a_rival_must_clearly_lead() -> None:
    joy = INDEX["joy"]
    assert leader(joy, charged(joy=1.0, anger=1.1), RATES, 0.0) == joy
    assert leader(joy, charged(joy=1.0, anger=1.01 * LEAD), RATES, 0.0) == INDEX["anger"]


def test_surprise_gives_way_to_what_lasts_longer() -> None:
    start = charged(surprise=1.4, fear=0.6, anger=0.5)
    seen = [leader(NOTHING, start, RATES, tick / 10) for tick in range(300)]
    names = [NAMES[index] if index >= 0 else "" for index in dict.fromkeys(seen)]
    assert names == ["surprise", "anger", ""]


@settings(deadline=None)
@given(st.integers(NOTHING, len(NAMES) - 1), charges, st.floats(0, 100), st.floats(0, 1))
def test_it_does_not_matter_when_anyone_looks(
    current: int, start: np.ndarray, seconds: float, share: float
) -> None:
    first = seconds * share
    between = leader(current, start, RATES, first)
    later = leader(between, start * np.exp(-RATES * first), RATES, seconds - first)
    assert later == leader(current, start, RATES, seconds)


@needs_tables
def test_octants_are_those_of_alma() -> None:
    for pleasure, arousal, dominance, name in rows("alma_octants.tsv"):
        assert OCTANTS[pleasure == "1", arousal == "1", dominance == "1"] == name.lower()


@needs_tables
def test_all_emotions_of_alma_lie_in_their_octant() -> None:
    table = rows("alma_occ_pad.tsv")
    assert len(table) == 24
    for _, pleasure, arousal, dominance, octant in table:
        mood = np.array([float(pleasure), float(arousal), float(dominance)])
        assert mood_name(mood) == octant.lower()


@needs_tables
def test_the_basic_emotions_stand_where_russell_and_mehrabian_put_them() -> None:
    ours = {"joy/happiness": "joy"}
    for name, *axes in rows("russell_mehrabian_1977_ekman6.tsv"):
        assert PAD[INDEX[ours.get(name, name)]].tolist() == [float(axis) for axis in axes]


def test_near_the_origin_the_mood_is_calm() -> None:
    assert mood_name(np.zeros(3)) == CALM
    assert mood_name(np.array([0.3, -0.01, -0.02])) == "exuberant"
    assert len(set(MOODS)) == 9
