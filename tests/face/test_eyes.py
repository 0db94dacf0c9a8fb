"""The eyes on the smallest screen: 128x64 pixels, each on or off."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray

from hri.face import load_face
from hri.face.drawing.baking import Vector
from hri.face.motion.gesture_tracks import load_gestures, track_of
from hri.face.motion.mixer import Layers, Mixer
from hri.face.renderers.renderer import Renderer
from hri.face.renderers.small_screens import Bits, one_bit
from hri.face.still import still_vector
from hri.face.vocabulary import EXPRESSIONS, LABELS, VISEMES
from hri.testing.golden import Golden

MODEL = load_face("eyes")
SCREEN = Renderer(MODEL, (128, 64))

BASIC = ("neutral", "happy", "sad", "angry", "surprised", "scared", "disgusted")
HALF_SHUT = (
    "sad", "angry", "disgusted", "guilty", "disappointed", "rejected", "tired", "bored", "annoyed",
    "furious", "suspicious", "embarrassed", "despaired", "asleep",
)  # fmt: skip
LEFT_HALF, RIGHT_HALF = slice(0, 64), slice(64, 128)
BAR = (slice(50, 64), slice(48, 80))
"""Where the voice shows, below and between the eyes."""

GOLDEN_SIZE = (256, 128)
GOLDENS = (
    "neutral", "happy", "furious", "pleading", "asleep", "confused", "sad", "tired", "despaired",
    "disgusted",
)  # fmt: skip


def lit(vector: Vector, light: float = 1.0) -> Bits:
    """Which pixels of the screen are on, [64, 128]; `light` makes all colors brighter."""
    picture = np.clip(SCREEN.render(vector) * light, 0, 255).astype(np.uint8)
    return one_bit(picture, dither=False)


def shown(expression: str = "neutral", intensity: float = 1.0, **arguments: object) -> Bits:
    return lit(still_vector(MODEL, expression, intensity, **arguments))  # type: ignore[arg-type]


def seen(size: tuple[int, int], **look: object) -> NDArray[np.int16]:
    vector = still_vector(MODEL, **look)  # type: ignore[arg-type]
    return Renderer(MODEL, size).render(vector).astype(np.int16)


@cache
def looks() -> Mapping[str, Bits]:
    """What every expression looks like."""
    return {label: shown(label) for label in LABELS}


def middle_of(lit: Bits) -> tuple[float, float]:
    """The middle of all light: x, y."""
    rows, columns = np.nonzero(lit)
    return float(columns.mean()), float(rows.mean())


def height_at(lit: Bits, column: int) -> int:
    return int(lit[:, column].sum())


def top_at(lit: Bits, column: int) -> int:
    return int(np.argmax(lit[:, column]))


def columns_of(half: Bits) -> NDArray[np.int_]:
    return np.flatnonzero(half.any(axis=0))


# --- expressions ---------------------------------------------------------------------------------


def test_every_expression_has_a_look_of_its_own() -> None:
    for one, other in combinations(LABELS, 2):
        assert (looks()[one] != looks()[other]).sum() > 350, f"{one} looks like {other}"


def test_the_basic_expressions_differ_in_a_glance() -> None:
    for one, other in combinations(BASIC, 2):
        assert (looks()[one] != looks()[other]).sum() > 800, f"{one} looks like {other}"


def test_any_two_expressions_differ_clearly_at_400x300() -> None:
    pictures = {label: seen((400, 300), expression=label) for label in EXPRESSIONS}
    for one, other in combinations(EXPRESSIONS, 2):
        apart = np.abs(pictures[one] - pictures[other]).mean()
        assert apart >= (15.0 if {one, other} <= set(BASIC) else 9.5), (one, other)


def test_lids_are_not_seen_beside_the_light() -> None:
    """Of a screen that glows, only what is around the lit part is neither dark nor lit."""

    def dim(label: str) -> float:
        bright = seen((256, 128), expression=label).max(axis=2)
        return float(((bright > 18) & (bright < 90)).mean())

    for label in HALF_SHUT:
        assert dim(label) < 1.05 * dim("neutral"), label


def test_weary_and_weeping_eyes_are_light_enough_to_be_seen() -> None:
    asleep = looks()["asleep"].sum()
    for label in ("tired", "despaired"):
        assert looks()[label].sum() > 1.25 * asleep, label


def test_a_tear_hangs_beside_the_eye() -> None:
    """It neither touches it, which would be a bump in one bit, nor bites it."""
    for label in ("sad", "rejected"):
        weeping = still_vector(MODEL, label)
        dry = still_vector(MODEL, label, weights={"tear": -1.0})
        drop = lit(weeping) & ~lit(dry)
        assert drop.sum() > 25
        assert not (lit(dry) & ~lit(weeping)).any()
        apart = np.pad(drop, 1)[1:-1, 1:-1] | np.pad(drop, 1)[:-2, 1:-1] | np.pad(drop, 1)[2:, 1:-1]
        assert not (apart & lit(dry)).any(), label


def test_the_squiggle_of_disgust_is_between_the_eyes() -> None:
    weights = {"mouthWave": -1.0}
    eyes = shown("disgusted", weights=weights)
    squiggle = looks()["disgusted"] & ~eyes
    left, right = columns_of(eyes)[[0, -1]]
    assert abs(middle_of(squiggle)[0] - (left + right) / 2) < 2


@pytest.mark.parametrize("label", LABELS)
def test_no_shape_needs_gray(label: str) -> None:
    vector = still_vector(MODEL, label)
    for light in (0.84, 1.2):
        assert (lit(vector, light) != looks()[label]).sum() < 180


@pytest.mark.parametrize("label", [label for label in LABELS if label != "despaired"])
def test_every_expression_fits_the_screen(label: str) -> None:
    picture = looks()[label]
    border = (picture[0], picture[-1], picture[:, 0], picture[:, -1])
    assert not any(side.any() for side in border)


def test_the_neutral_eyes_are_round_open_and_alike() -> None:
    picture = looks()["neutral"]
    columns = columns_of(picture[:, LEFT_HALF])
    rows = np.flatnonzero(picture.any(axis=1))
    assert 0.8 < len(columns) / len(rows) < 1.1
    mirrored = picture[:, ::-1]
    lights = 170  # Both lights lie to the left, as if from one window.
    assert (picture != mirrored).sum() < lights


def test_a_happy_eye_is_an_arc() -> None:
    half = looks()["happy"][:, LEFT_HALF]
    columns = columns_of(half)
    middle = (columns[0] + columns[-1]) // 2
    for side in (columns[0] + 3, columns[-1] - 3):
        assert top_at(half, middle) + 6 < top_at(half, side)
    lowest = max(np.flatnonzero(half[:, middle]))
    assert lowest + 5 < max(np.flatnonzero(half[:, columns[0] + 3]))
    assert height_at(half, middle) < 0.35 * height_at(looks()["neutral"][:, LEFT_HALF], middle + 12)


def test_anger_and_sadness_slope_the_lids_against_each_other() -> None:
    def slope(label: str) -> int:
        """How much lower the upper lid is at the nose than outside."""
        half = looks()[label][:, LEFT_HALF]
        columns = columns_of(half)
        return top_at(half, columns[-1] - 6) - top_at(half, columns[0] + 6)

    assert slope("angry") > 6
    assert slope("furious") > slope("angry")
    assert abs(slope("neutral")) <= 1
    assert slope("sad") < -6
    assert slope("pleading") < -2


def test_surprise_opens_and_suspicion_narrows_the_eyes() -> None:
    def height(label: str) -> int:
        return int(looks()[label][:, LEFT_HALF].any(axis=1).sum())

    assert height("surprised") > 1.1 * height("neutral")
    assert height("horrified") >= height("surprised")
    assert height("suspicious") < 0.5 * height("neutral")
    assert height("tired") < 0.5 * height("bored")


def test_one_eye_of_a_skeptic_is_wide_and_the_other_narrow() -> None:
    picture = looks()["skeptical"]
    assert picture[:, RIGHT_HALF].sum() > 1.5 * picture[:, LEFT_HALF].sum()


@pytest.mark.parametrize("label", ["happy", "angry", "sad", "suspicious", "tired"])
def test_an_expression_grows_with_its_intensity(label: str) -> None:
    light = [int(shown(label, share).sum()) for share in (0.0, 0.25, 0.5, 0.75, 1.0)]
    assert light == sorted(light, reverse=True)
    assert light[1] < light[0]


def test_what_lies_beside_the_eyes_says_more() -> None:
    corner = (slice(0, 26), slice(111, 128))
    for label in ("furious", "asleep", "thinking", "scared"):
        assert looks()[label][corner].sum() > 15, label
        assert not looks()["neutral"][corner].any()
    assert looks()["confused"][:28, 56:72].sum() > 30
    assert looks()["listening"][:, :14].sum() > 40


# --- life ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("label", sorted({*LABELS} - {"error", "despaired"}))
def test_a_blink_shuts_the_eyes_of_every_expression(label: str) -> None:
    layers = Layers(
        expression=MODEL.vector(MODEL.expression(label)), viseme=MODEL.vector({}), blink=(1.0, 1.0)
    )
    lids: Bits = lit(Mixer(MODEL).mix(layers))[:50, 24:40]
    assert 2 <= np.sum(lids.any(axis=1)) <= 12, "a line is left"
    assert max(height_at(lids, column) for column in range(lids.shape[1])) <= 6


def test_a_wink_shuts_one_eye() -> None:
    picture = shown(weights={"eyeBlinkLeft": 1.0})
    assert picture[:, RIGHT_HALF].sum() < 0.25 * picture[:, LEFT_HALF].sum()
    assert (picture != looks()["neutral"])[:, LEFT_HALF].sum() < 12


def test_a_smiling_eye_winks_upward() -> None:
    smiling = shown("happy", weights={"eyeBlinkLeft": 1.0})[:, RIGHT_HALF]
    plain = shown(weights={"eyeBlinkLeft": 1.0})[:, RIGHT_HALF]

    def bend(half: Bits) -> int:
        columns = columns_of(half)
        return top_at(half, columns[len(columns) // 2]) - top_at(half, columns[0])

    assert bend(smiling) < 0 < bend(plain)


@pytest.mark.parametrize("bent", ["", "eyeSquint", "eyeDroop", "noseSneer", "browDown"])
@pytest.mark.parametrize("smile", [1.35, 1.5])
@pytest.mark.parametrize("shut", [0.0, 0.25, 0.5, 0.75, 1.0])
def test_smiling_eyes_are_arcs_however_they_are_shut(bent: str, smile: float, shut: float) -> None:
    weights = {"cheekSquint": smile, "eyeBlink": shut} | ({bent: 0.9} if bent else {})
    half = lit(MODEL.vector(weights))[:, LEFT_HALF]
    columns = columns_of(half)
    assert columns[-1] - columns[0] > 28
    lines = np.abs(np.diff(half.astype(int), axis=0)).sum(axis=0)[columns]
    assert (lines == 2).mean() > 0.9, "one piece, nothing above or below"
    middle = int(columns.mean())
    assert height_at(half, middle) >= 2
    for side in (columns[0] + 3, columns[-1] - 3):
        assert top_at(half, middle) + 2 < top_at(half, side)


def test_who_laughs_for_joy_keeps_smiling_eyes() -> None:
    track = track_of(load_gestures(MODEL)["laugh"], MODEL)
    happy = MODEL.vector(MODEL.expression("happy"))
    for time in np.linspace(0.0, track.duration, 25):
        half = lit((happy + track.at(float(time))[0]).astype(np.float32))[:50, LEFT_HALF]
        assert 120 < half.sum() < 700


def test_eyes_are_crossed_out_as_far_as_they_are_shut() -> None:
    def crossed(weights: Mapping[str, float]) -> float:
        """How much of the orange of the cross there is, at the ends of its strokes."""
        ends = SCREEN.render(MODEL.vector(weights))[20:42, 26:48].astype(int)
        return float(np.clip(ends[..., 0] - ends[..., 2], 0, None).mean())

    error = MODEL.expression("error")
    assert crossed(error) > 20
    assert crossed({"cross": 1.0}) == 0
    half_shut = {name: 0.5 * weight for name, weight in error.items()}
    assert crossed(half_shut) < 0.2 * crossed(error)


def test_the_light_goes_where_the_eyes_look() -> None:
    x, y = middle_of(looks()["neutral"])
    assert middle_of(shown(gaze=(1.0, 0.0)))[0] > x + 2
    assert middle_of(shown(gaze=(-1.0, 0.0)))[0] < x - 2
    assert middle_of(shown(gaze=(0.0, 1.0)))[1] < y - 1
    assert middle_of(shown(gaze=(0.0, -1.0)))[1] > y + 2


def test_the_pupils_go_there_too() -> None:
    def pupil(gaze: tuple[float, float]) -> float:
        """The middle of the dark in the left eye, from its own middle."""
        half = shown(gaze=gaze)[:, LEFT_HALF]
        columns = columns_of(half)
        row = ~half[28, columns[0] : columns[-1] + 1]
        return float(np.flatnonzero(row).mean()) - len(row) / 2

    assert pupil((1.0, 0.0)) > pupil((0.0, 0.0)) + 4
    assert pupil((-1.0, 0.0)) < pupil((0.0, 0.0)) - 4


def test_a_turned_head_narrows_the_eye_that_is_farther_away() -> None:
    def widths(yaw: float) -> tuple[int, int]:
        lit = shown(weights={"headYaw": yaw}).any(axis=0)
        columns = np.flatnonzero(lit)
        gap = int(np.argmax(np.diff(columns)))
        return gap + 1, len(columns) - gap - 1

    left, right = widths(1.0)
    assert right < 0.9 * left
    left, right = widths(-1.0)
    assert left < 0.9 * right
    assert middle_of(shown(weights={"headYaw": 1.0}))[0] > middle_of(looks()["neutral"])[0] + 5
    assert middle_of(shown(weights={"headPitch": 1.0}))[1] < middle_of(looks()["neutral"])[1] - 4


def test_hearts_have_a_notch_above_and_a_tip_below() -> None:
    half = lit(MODEL.vector({"heart": 1.0}))[:, LEFT_HALF]
    columns = columns_of(half)
    middle = (columns[0] + columns[-1]) // 2
    assert top_at(half, middle) > top_at(half, middle - 8) + 3
    lowest = half[np.flatnonzero(half.any(axis=1))[-1]]
    assert lowest.sum() < 6
    assert abs(float(np.flatnonzero(lowest).mean()) - middle) < 2


def test_its_gestures_are_its_own() -> None:
    gestures = load_gestures(MODEL)
    assert "heart" in gestures["love"].weights
    assert "mouthSmile" not in gestures["laugh"].weights
    assert "nod" in gestures


# --- speech --------------------------------------------------------------------------------------


def test_who_is_silent_shows_no_bar_and_who_talks_does() -> None:
    for viseme in MODEL.visemes:
        assert shown(viseme=viseme)[BAR].any() == (viseme != "sil")


def test_the_bar_opens_as_a_mouth_would() -> None:
    def bar(viseme: str) -> tuple[int, int]:
        lit = shown(viseme=viseme)[BAR]
        return int(lit.any(axis=0).sum()), int(lit.any(axis=1).sum())

    assert bar("aa")[1] > bar("E")[1] > bar("ih")[1] > bar("PP")[1]
    assert bar("ou")[0] < 0.7 * bar("aa")[0] < bar("SS")[0]


def test_the_eyes_bounce_with_the_voice() -> None:
    def height(viseme: str) -> int:
        return int(shown(viseme=viseme)[:, 20:44].any(axis=1).sum())

    assert height("aa") >= height("sil") + 3
    assert height("PP") <= height("sil") - 3


def test_any_two_visemes_differ_at_400x300() -> None:
    pictures = {name: seen((400, 300), viseme=name) for name in VISEMES}
    for one, other in combinations(VISEMES, 2):
        assert np.abs(pictures[one] - pictures[other]).mean() >= 1.5, (one, other)


# --- pictures ------------------------------------------------------------------------------------


@settings(max_examples=20, deadline=None)
@given(st.dictionaries(st.sampled_from(MODEL.channels), st.floats(-1.5, 1.5), max_size=6))
def test_any_weights_give_a_picture(weights: dict[str, float]) -> None:
    assert SCREEN.render(MODEL.vector(weights)).shape == (64, 128, 3)


@pytest.mark.parametrize("size", [(128, 64), (240, 240), (320, 240), (800, 480)])
def test_the_eyes_fill_any_screen(size: tuple[int, int]) -> None:
    picture = Renderer(MODEL, size).render(still_vector(MODEL))
    assert one_bit(picture, dither=False).any(axis=0).sum() > 0.58 * size[0]
    assert not picture[0, 0].any(), "the corners are dark"


def test_the_eyes_are_light_to_draw() -> None:
    assert MODEL.display.points < 2500, "less than a third of a whole face"
    assert len(MODEL.display.items) < 60


@pytest.mark.parametrize("label", GOLDENS)
def test_the_pictures_stay_as_they_were_approved(label: str, golden: Golden) -> None:
    golden.check(label, Renderer(MODEL, GOLDEN_SIZE).render(still_vector(MODEL, label)))
