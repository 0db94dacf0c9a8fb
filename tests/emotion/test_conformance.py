"""The published constants, where the tables are at hand."""

import csv
import json
from pathlib import Path

import pytest

from hri.emotion.appraisal import GoalEvent, appraise
from hri.emotion.emotions import EMOTIONS
from hri.emotion.label import OCTANTS, known_as, mood_name
from hri.emotion.personality import FARTHEST, baseline_of, load_personality
from tests.recorded import SHARED, needs_shared

TABLES = SHARED / "emotion_tables"
published_here = needs_shared("emotion_tables")

AXES = {e.name: [e.pleasure, e.arousal, e.dominance] for e in EMOTIONS}
OUR_WORDS = {
    "joy/happiness": "joy",
    "distress": "sadness",
    "liking": "",
    "disliking": "",
    "fear-confirmed": "fears_confirmed",
}
"""ALMA's liking and disliking are not emotions of OCC's 22."""


def rows(name: str) -> list[list[str]]:
    lines = (TABLES / name).read_text(encoding="utf-8").splitlines()
    return list(csv.reader((line for line in lines if line[0] != "#"), delimiter="\t"))[1:]


def ours(name: str) -> str:
    if name.lower() in OUR_WORDS:
        return OUR_WORDS[name.lower()]
    words = "".join(f"_{letter}" if letter.isupper() else letter for letter in name).lstrip("_")
    return words.lower().replace("-", "_")


@published_here
def test_octants_are_those_of_alma() -> None:
    table = rows("alma_octants.tsv")
    assert len(table) == len(OCTANTS)
    for pleasure, arousal, dominance, name in table:
        assert OCTANTS[pleasure == "1", arousal == "1", dominance == "1"] == known_as(name.lower())


@published_here
def test_all_emotions_of_alma_lie_in_their_octant() -> None:
    table = rows("alma_occ_pad.tsv")
    assert len(table) == 24
    for _, pleasure, arousal, dominance, octant in table:
        assert mood_name((float(pleasure), float(arousal), float(dominance))) == known_as(
            octant.lower()
        )


@published_here
def test_the_basic_emotions_stand_where_russell_and_mehrabian_put_them() -> None:
    table = rows("russell_mehrabian_1977_ekman6.tsv")
    assert len(table) == 6
    for name, *axes in table:
        assert AXES[ours(name)] == [float(axis) for axis in axes]


@published_here
def test_all_others_stand_where_alma_puts_them() -> None:
    basic = {ours(row[0]) for row in rows("russell_mehrabian_1977_ekman6.tsv")}
    table = {ours(name): list(map(float, axes)) for name, *axes, _ in rows("alma_occ_pad.tsv")}
    del table[""]
    assert set(AXES) == set(table) | basic
    for name in set(AXES) - basic:
        assert AXES[name] == table[name]


@published_here
def test_the_five_factors_give_the_baseline_of_the_worked_example() -> None:
    published = json.loads((TABLES / "ocean_to_pad.json").read_text(encoding="utf-8"))
    example = published["worked_example_ALMA_as_printed"]
    factors = [example[factor] for factor in "OCEA"]
    stable = baseline_of(*factors, neuroticism=-example["N_as_printed"])
    assert stable == pytest.approx([example[axis] for axis in ("P", "A_out", "D")], abs=1e-9)
    assert mood_name(stable) == "relaxed"
    right = published["same_traits_with_S=-N"]
    neurotic = baseline_of(*factors, neuroticism=example["N_as_printed"])
    assert neurotic == pytest.approx([right[axis] for axis in ("P", "A_out", "D")], abs=1e-9)


@published_here
def test_each_factor_has_its_published_coefficients() -> None:
    published = json.loads((TABLES / "ocean_to_pad.json").read_text(encoding="utf-8"))
    for number, factor in enumerate("OCEAS"):
        factors = [0.5 if at == number else 0.0 for at in range(5)]
        factors[4] = -factors[4]
        baseline = dict(zip("PAD", baseline_of(*factors), strict=True))
        for axis, coefficients in published["coefficients"].items():
            assert baseline[axis] == pytest.approx(0.5 * coefficients.get(factor, 0.0), abs=1e-12)


def test_a_personality_can_be_given_by_the_five_factors(tmp_path: Path) -> None:
    path = tmp_path / "five.toml"
    path.write_text(
        "[ocean]\nopenness = 0.4\nconscientiousness = 0.8\nextraversion = 0.6\n"
        "agreeableness = 0.3\nneuroticism = 0.4\n",
        encoding="utf-8",
    )
    assert load_personality(str(path)).baseline == pytest.approx((0.227, 0.378, 0.5), abs=1e-9)
    assert max(map(abs, baseline_of(1, 1, 1, -1, 1))) <= FARTHEST


@pytest.mark.parametrize(
    ("event", "felt"),
    [
        # likelihood before and after, utility: what GAMYGDALA's listings give
        ((1.0, 0.5, 0.8), {"hope"}),
        ((1.0, 0.5, 0.2), {"fear"}),
        ((-1.0, 0.5, 0.8), {"fear"}),
        ((-1.0, 0.5, 0.2), {"hope"}),
        ((1.0, 0.2, 1.0), {"joy"}),
        ((1.0, 0.8, 1.0), {"joy", "satisfaction"}),
        ((-1.0, 0.2, 1.0), {"sadness"}),
        ((-1.0, 0.8, 1.0), {"sadness", "fears_confirmed"}),
        ((1.0, 0.2, 0.0), {"sadness"}),
        ((-1.0, 0.2, 0.0), {"joy"}),
        # ... and what it means to give, but never does
        ((1.0, 0.8, 0.0), {"sadness", "disappointment"}),
        ((-1.0, 0.8, 0.0), {"joy", "relief"}),
    ],
)
def test_goals_are_appraised_as_in_gamygdala(
    event: tuple[float, float, float], felt: set[str]
) -> None:
    utility, before, after = event
    goal = GoalEvent("goal", utility, likelihood_before=before, likelihood_after=after)
    assert set(appraise(goal).charges) == felt


@published_here
def test_every_emotion_of_gamygdala_is_one_of_ours() -> None:
    assert {ours(row[0]) for row in rows("gamygdala_occ_pad.tsv")} <= set(AXES)
