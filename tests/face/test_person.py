"""The cartoon person: its parts are measured where they are drawn, its looks from the pixels."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

import cv2
import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray

from hri.core.signals import Image
from hri.face import load_face
from hri.face.drawing.baking import Item, Opening, Shape, Vector
from hri.face.motion.mixer import Layers, Mixer
from hri.face.renderers.renderer import Renderer
from hri.face.still import still_vector
from hri.face.vocabulary import ARKIT, EXPRESSIONS, LABELS, VISEMES
from hri.testing.golden import Golden
from tests.face.pixels import Shot, face

MODEL = load_face("person")
SMALL = Renderer(MODEL, (240, 240))
MOUTH = (slice(152, 204), slice(80, 160))
"""In such a picture, of a head held still."""
SEVEN = ("neutral", "happy", "sad", "angry", "surprised", "scared", "disgusted")
STEPS = (0.0, 0.25, 0.5, 0.75, 1.0)

GOLDEN_SIZE = (320, 240)
GOLDENS = (
    "neutral", "happy", "sad", "angry", "surprised", "disgusted", "asleep", "excited", "error",
    "turned", "furious", "horrified", "embarrassed", "amazed", "annoyed",
)  # fmt: skip
FRAME = (slice(60, 210), slice(85, 235))
"""What is kept of such a picture."""

Points = NDArray[np.float64]


def _shapes(items: tuple[Item, ...]) -> Iterator[Shape]:
    for item in items:
        if isinstance(item, Opening):
            yield item.clip
            yield from _shapes(item.content)
        else:
            yield item


SHAPES = {shape.id: shape for shape in _shapes(MODEL.display.items)}


def drawn(id: str, vector: Vector) -> Points:
    """The outline of a part, [n, 2] in units of the drawing, before the head moves as a whole."""
    points, _ = MODEL.blend(vector)
    return points[SHAPES[id].contours[0][0] : SHAPES[id].contours[-1][1]].astype(float)


def opacity(id: str, vector: Vector) -> float:
    return float(MODEL.blend(vector)[1][SHAPES[id].opacity])


def shown(expression: str = "neutral", intensity: float = 1.0, **arguments: object) -> Vector:
    """An expression of a head that does not turn, so that parts stay where they are measured."""
    vector = still_vector(MODEL, expression, intensity, **arguments)  # type: ignore[arg-type]
    return np.where([name.startswith("head") for name in MODEL.channels], 0.0, vector).astype(
        np.float32
    )


def area(edge: Points) -> float:
    x, y = edge.T
    return float(abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2)


def mouth_open(vector: Vector) -> float:
    return area(drawn("mouthOpening", vector))


def eye_open(vector: Vector, side: str = "Left") -> float:
    return area(drawn(f"eyeOpening{side}", vector))


def seen(expression: str = "neutral", intensity: float = 1.0, **arguments: object) -> Shot:
    return face(expression, intensity, MODEL, **arguments)  # type: ignore[arg-type]


def middle_of(id: str, vector: Vector) -> Points:
    return np.asarray(drawn(id, vector).mean(axis=0))


# --- at rest -------------------------------------------------------------------------------------


def test_it_can_be_weighted_by_every_name_of_arkit() -> None:
    assert set(ARKIT) <= set(MODEL.channels)


def test_at_rest_it_looks_at_you_kindly_with_its_mouth_shut() -> None:
    rest = seen()
    assert 5 < rest.corners_up < 15
    assert rest.dark_mouth == rest.teeth == 0
    assert -8 < rest.brow_slope < 0, "the inner ends of the brows are a little raised"
    assert rest.white_above_iris == 0, "the lid cuts the iris"
    for extra in ("tear", "sweat", "gloom", "flush", "furrowLeft", "vein", "alert", "spiralLeft"):
        assert opacity(extra, shown()) == 0


def test_both_halves_mirror_each_other() -> None:
    rest = shown()
    for id in SHAPES:
        other = id.replace("Left", "Right")
        if other != id and not id.startswith(("glint", "sparkle")):
            mirrored = drawn(other, rest) * [-1, 1] + [MODEL.display.width, 0]
            mine = drawn(id, rest)
            apart = np.linalg.norm(mine[:, None] - mirrored[None], axis=2).min(axis=1)
            assert apart.max() < 6.5, id
            assert np.abs(mine.mean(axis=0) - mirrored.mean(axis=0)).max() < 0.3, id


# --- expressions ---------------------------------------------------------------------------------


def test_happy_lifts_the_corners_and_sad_lowers_them() -> None:
    assert seen("happy").corners_up > seen().corners_up + 5
    assert seen("sad").corners_up < seen().corners_up - 20


def test_brows_slope_in_for_anger_and_out_for_sorrow_and_fear() -> None:
    assert seen("furious").brow_slope > seen("angry").brow_slope > 7
    for label in ("sad", "scared", "pleading", "despaired", "rejected"):
        assert seen(label).brow_slope < -15, label


def test_surprise_and_fear_show_white_above_the_iris_and_differ_at_the_mouth() -> None:
    surprised, scared = seen("surprised"), seen("scared")
    assert min(surprised.white_above_iris, scared.white_above_iris) > 3
    assert scared.mouth_width > 1.5 * surprised.mouth_width
    assert scared.teeth > 2 * surprised.teeth
    assert surprised.dark_mouth > 2 * scared.dark_mouth


def test_disgust_narrows_the_eyes_more_than_anger_and_shows_the_tongue() -> None:
    assert seen("disgusted").iris < 0.75 * seen("angry").iris
    lip = drawn("lipLower", shown("disgusted"))[:, 1].max()
    assert drawn("tongueOut", shown("disgusted"))[:, 1].max() > lip - 6


def test_a_smile_narrows_the_eyes_from_below() -> None:
    lower = {label: drawn("lidLowerLineLeft", shown(label))[:, 1].max() for label in LABELS}
    assert lower["happy"] < lower["neutral"] - 10
    assert 0.5 < eye_open(shown("happy")) / eye_open(shown()) < 0.75, "yet they are seen"


def test_pleading_eyes_are_larger_than_vulnerable_ones() -> None:
    pleading, vulnerable = shown("pleading"), shown("vulnerable")
    assert eye_open(pleading) > 1.2 * eye_open(vulnerable)
    assert area(drawn("irisLeft", pleading)) > 1.1 * area(drawn("irisLeft", vulnerable))
    assert seen("pleading").brow_slope < seen("vulnerable").brow_slope - 3


@pytest.mark.parametrize("label", ["sad", "scared", "surprised", "horrified", "pleading"])
def test_the_fringe_leaves_the_brows_free(label: str) -> None:
    vector = shown(label)
    hair = drawn("hair", vector).astype(np.float32)
    for side in ("Left", "Right"):
        brow = drawn(f"brow{side}", vector)
        under = [cv2.pointPolygonTest(hair, (x, y), False) > 0 for x, y in brow.tolist()]
        assert np.mean(under) < 0.2


def test_doubt_is_lopsided() -> None:
    for label in ("skeptical", "confused", "thinking"):
        vector = shown(label)
        left, right = (middle_of(f"brow{side}", vector)[1] for side in ("Left", "Right"))
        assert right > left + 12, label
        assert eye_open(vector, "Left") > 1.15 * eye_open(vector, "Right"), label


def test_weariness_closes_the_eyes_by_degrees() -> None:
    order = ("neutral", "bored", "tired", "asleep")
    gaps = [eye_open(shown(label)) for label in order]
    assert gaps == sorted(gaps, reverse=True)
    assert gaps[-1] < 0.02 * gaps[0]


def test_extras_belong_to_the_expressions_that_need_them() -> None:
    assert opacity("tear", shown("sad")) == pytest.approx(1)
    assert opacity("sweat", shown("embarrassed")) == pytest.approx(1)
    assert opacity("gloom", shown("horrified")) > 0.5
    assert opacity("flush", shown("furious")) > 0.4
    assert opacity("sparkleLeft", shown("amazed")) == pytest.approx(1)
    assert opacity("vein", shown("annoyed")) == pytest.approx(1)
    assert opacity("eyeBagLeft", shown("tired")) > 0.7
    for id in ("alert", "alertMark", "spiralLeft", "spiralRight"):
        assert opacity(id, shown("error")) == pytest.approx(1)
    assert opacity("irisLeft", shown("error")) == pytest.approx(0)
    assert opacity("tear", shown("despaired")) == opacity("tearRight", shown("despaired")) == 1


def test_a_tear_is_a_blue_drop_that_comes_from_the_eye() -> None:
    drop = seen("sad").at("tear")
    red, _, blue = drop[round(0.8 * len(drop)), drop.shape[1] // 2]
    assert blue > red + 60
    for side, id in (("Left", "tear"), ("Right", "tearRight")):
        tear = drawn(id, shown("despaired"))
        assert area(tear) > 400
        assert np.ptp(tear[:, 0]) < 0.5 * np.ptp(tear[:, 1]), "it runs"
        lid = drawn(f"lidLowerLine{side}", shown("despaired"))[:, 1].max()
        assert abs(tear[:, 1].min() - lid) < 12, "from the lower lid"


def skin(label: str, id: str, dx: float, dy: float) -> NDArray[np.int_]:
    """The color of the skin beside the middle of a part."""
    vector = shown(label)
    x, y = middle_of(id, vector) + np.array([dx, dy])
    picture = Renderer(MODEL, (480, 480)).render(vector)
    patch = picture[round(y) - 2 : round(y) + 3, round(x) - 2 : round(x) + 3]
    return patch.reshape(-1, 3).mean(axis=0).astype(int)


def test_a_flush_fades_out_before_the_chin() -> None:
    """At the edge of the jaw it would be a mask."""
    for id, dy, least, most in (("noseBridge", 0, 25, 120), ("chinLight", 14, -12, 12)):
        red, green, _ = skin("furious", id, 0, dy)
        calm_red, calm_green, _ = skin("neutral", id, 0, dy)
        assert least < (calm_green - green) - (calm_red - red) < most, id


def test_a_face_of_horror_is_pale_not_bruised() -> None:
    for id, dx, dy in (("noseBridge", 0, -60), ("irisLeft", 20, 40), ("irisRight", -20, 40)):
        pale, calm = skin("horrified", id, dx, dy), skin("neutral", id, dx, dy)
        assert np.ptp(pale) < np.ptp(calm) - 15, "less color"
        assert pale.sum() > 0.9 * calm.sum(), "yet no darker"


def test_marks_lie_on_the_skin() -> None:
    for label, id in (("embarrassed", "sweat"), ("annoyed", "vein")):
        vector = shown(label)
        mark = drawn(id, vector).astype(np.float32)
        hair, head = (drawn(part, vector).astype(np.float32) for part in ("hair", "head"))
        on_hair = [cv2.pointPolygonTest(hair, (x, y), False) > 0 for x, y in mark.tolist()]
        on_head = [cv2.pointPolygonTest(head, (x, y), False) > 0 for x, y in mark.tolist()]
        assert np.mean(on_hair) < 0.1, id
        assert all(on_head), id


def test_freckles_fade_where_the_skin_is_red_or_wrinkled() -> None:
    for label in ("furious", "disgusted"):
        assert opacity("frecklesLeft", shown(label)) < 0.4 * opacity("frecklesLeft", shown())


def test_any_two_expressions_differ_clearly_at_400x300() -> None:
    """Mean differences: as much as those of the astronaut, all of them and the basic ones."""
    wide = Renderer(MODEL, (400, 300))
    pictures = {
        label: wide.render(still_vector(MODEL, label)).astype(np.int16) for label in EXPRESSIONS
    }
    for first, second in combinations(EXPRESSIONS, 2):
        apart = np.abs(pictures[first] - pictures[second]).mean()
        assert apart >= (5.6 if {first, second} <= set(SEVEN) else 5.15), (first, second)


def test_every_two_expressions_can_be_told_apart() -> None:
    pictures = {label: SMALL.render(shown(label))[60:210:2, 60:180:2] for label in LABELS}
    for first, second in combinations(LABELS, 2):
        changed = cv2.absdiff(pictures[first], pictures[second]).max(axis=2) > 30
        assert changed.sum() > 75, (first, second)


@pytest.mark.parametrize(
    ("label", "measure", "sign"),
    [
        ("happy", "dark_mouth", 1),
        ("happy", "iris", -1),
        ("sad", "corners_up", -1),
        ("sad", "brow_slope", -1),
        ("angry", "brow_slope", 1),
        ("surprised", "lid_gap", 1),
        ("surprised", "dark_mouth", 1),
        ("scared", "white_above_iris", 1),
        ("scared", "teeth", 1),
        ("disgusted", "iris", -1),
        ("suspicious", "iris", -1),
    ],
)
def test_an_expression_grows_with_its_intensity(label: str, measure: str, sign: int) -> None:
    values = [sign * float(getattr(seen(label, share), measure)) for share in STEPS]
    assert np.all(np.diff(values) > -1.5 - 0.02 * abs(values[-1])), values
    assert values[-1] > values[0] + 3


# --- eyes and head -------------------------------------------------------------------------------


def lids_apart(vector: Vector) -> float:
    """At most, in units of the drawing, whichever lid is above."""
    edge = drawn("eyeOpeningLeft", vector)
    corner = int(edge[:, 0].argmax())
    upper, lower = edge[: corner + 1], edge[:corner:-1]
    across = np.linspace(edge[:, 0].min() + 1, edge[:, 0].max() - 1, 40)
    return float(np.abs(np.interp(across, *upper.T) - np.interp(across, *lower.T)).max())


@pytest.mark.parametrize("label", LABELS)
def test_a_blink_shuts_the_eyes_whatever_is_felt(label: str) -> None:
    felt = MODEL.vector(MODEL.expression(label))
    blink = Mixer(MODEL).mix(Layers(expression=felt, viseme=MODEL.vector({}), blink=(1.0, 1.0)))
    turned = [name.startswith("head") for name in MODEL.channels]
    assert lids_apart(np.where(turned, 0, blink).astype(np.float32)) < 1


@pytest.mark.parametrize("yaw", [-1.0, 0.0, 1.0])
@pytest.mark.parametrize("pitch", [-1.0, 1.0])
def test_shut_eyes_stay_shut_when_the_head_turns(yaw: float, pitch: float) -> None:
    eye = seen(weights={"eyeBlink": 1.0, "headYaw": yaw, "headPitch": pitch}).at("eyeLeft")
    assert (eye.min(axis=2) > 190).sum() < 4


LIDS = ("eyeSquint", "eyeWide", "eyeDroop", "cheekSquint", "browDown", "eyeLookDown", "eyeLookUp")


@settings(max_examples=40, deadline=None)
@given(st.sampled_from(LIDS), st.floats(0, 1))
def test_a_wink_shuts_an_eye_from_any_look(target: str, weight: float) -> None:
    assert lids_apart(MODEL.vector({target: weight, "eyeBlinkLeft": 1.0})) < 1


def test_a_wink_leaves_the_other_eye_alone() -> None:
    wink = MODEL.vector({"eyeBlinkLeft": 1.0})
    assert eye_open(wink, "Left") < 20
    assert eye_open(wink, "Right") == pytest.approx(eye_open(shown(), "Right"), rel=0.01)


def test_laughing_eyes_shut_upward_and_sleeping_ones_downward() -> None:
    def bend(label: str) -> float:
        edge = drawn("lidLowerLineLeft", shown(label))
        return float(edge[len(edge) // 2, 1] - edge[[0, -1], 1].mean())

    assert bend("excited") < -8
    assert bend("asleep") > 8


def test_the_eyes_look_where_they_are_told_and_the_lids_follow() -> None:
    x, y = middle_of("pupilLeft", shown())
    assert middle_of("pupilLeft", shown(gaze=(1, 0)))[0] > x + 8
    assert middle_of("pupilRight", shown(gaze=(-1, 0)))[0] < middle_of("pupilRight", shown())[0] - 8
    assert middle_of("pupilLeft", shown(gaze=(0, 1)))[1] < y - 6
    assert middle_of("pupilLeft", shown(gaze=(0, -1)))[1] > y + 6
    lid = [drawn("eyeOpeningLeft", shown(gaze=(0, way)))[:, 1].min() for way in (1, 0, -1)]
    assert lid == sorted(lid)


@pytest.mark.parametrize("way", [1, -1])
def test_a_turned_head_shows_its_depth(way: int) -> None:
    turned = MODEL.vector({"headYaw": way})

    def moved(id: str) -> float:
        return float(way * (middle_of(id, turned)[0] - middle_of(id, shown())[0]))

    assert moved("nose") > moved("mouthLine") > moved("head") - 1
    assert moved("nose") > 25
    assert moved("hairBack") < -10, "what lies behind goes the other way"
    assert moved("earLeft") < 0
    assert moved("neck") == 0
    near, far = ("Right", "Left") if way > 0 else ("Left", "Right")
    assert eye_open(turned, far) < 0.85 * eye_open(turned, near)


def test_a_nod_moves_the_nose_more_than_the_neck() -> None:
    up = MODEL.vector({"headPitch": 1})
    assert middle_of("nose", up)[1] < middle_of("nose", shown())[1] - 15
    assert middle_of("neck", up)[1] == middle_of("neck", shown())[1]


# --- speech --------------------------------------------------------------------------------------


def test_every_two_visemes_can_be_told_apart() -> None:
    mouths = {name: SMALL.render(shown(viseme=name))[MOUTH] for name in VISEMES}
    for first, second in combinations(VISEMES, 2):
        changed = cv2.absdiff(mouths[first], mouths[second]).max(axis=2) > 40
        assert changed.sum() > 60, (first, second)


def test_any_two_visemes_differ_at_400x300() -> None:
    wide = Renderer(MODEL, (400, 300))
    pictures = {
        name: wide.render(still_vector(MODEL, viseme=name)).astype(np.int16) for name in VISEMES
    }
    for first, second in combinations(VISEMES, 2):
        assert np.abs(pictures[first] - pictures[second]).mean() >= 0.3, (first, second)


@pytest.mark.parametrize("label", LABELS)
def test_the_lips_meet_for_b_and_in_silence_whatever_is_felt(label: str) -> None:
    assert mouth_open(shown(label, viseme="PP")) < 2
    assert mouth_open(shown(label, viseme="sil")) < 2


def test_vowels_open_and_round_the_mouth_as_they_are_said() -> None:
    said = {name: seen(viseme=name) for name in ("sil", "aa", "E", "ih", "oh", "ou")}
    dark = {name: shot.dark_mouth for name, shot in said.items()}
    assert dark["aa"] > dark["E"] > dark["ih"] > dark["sil"] == 0
    assert dark["aa"] > dark["oh"] > dark["ou"] > 0
    width = {name: shot.mouth_width for name, shot in said.items()}
    assert width["ou"] < width["oh"] < width["aa"] < width["E"] < width["ih"]


def test_teeth_and_tongue_show_where_they_make_the_sound() -> None:
    said = {name: seen(viseme=name) for name in ("PP", "FF", "SS", "CH", "ou")}
    assert said["PP"].teeth == said["PP"].dark_mouth == said["ou"].teeth == 0
    assert 100 < said["FF"].teeth < 0.6 * said["SS"].teeth
    tucked = drawn("lipLower", shown(viseme="FF"))[:, 1]
    assert 3 < np.ptp(tucked) < 24, "the lower lip is tucked in and seen"
    assert said["FF"].dark_mouth < 20, "the lower lip touches the upper teeth"
    assert min(said["SS"].teeth, said["CH"].teeth) > 400
    lip = drawn("lipLower", shown(viseme="TH"))[:, 1].max()
    assert drawn("tongueOut", shown(viseme="TH"))[:, 1].max() > lip - 12, "over the lower lip"
    upper = drawn("teethUpper", shown(viseme="DD"))[:, 1].max()
    assert drawn("tongueTip", shown(viseme="DD"))[:, 1].min() < upper + 2, "behind the upper teeth"


def test_the_tongue_comes_out_between_the_lips() -> None:
    out = shown(weights={"tongueOut": 1.0})
    assert mouth_open(out) > 400
    tongue = drawn("tongueOut", out)[:, 1]
    assert tongue.min() > drawn("mouthLine", out)[:, 1].max() - 8, "below the upper lip"
    assert tongue.max() > drawn("lipLower", out)[:, 1].max() + 2, "over the lower lip"


def test_an_earring_goes_with_its_ear() -> None:
    for yaw in STEPS[1:]:
        far, near = (MODEL.vector({"headYaw": sign * yaw}) for sign in (1.0, -1.0))
        beyond = drawn("earring", far)[:, 0].max() - drawn("earLeft", far)[:, 0].max()
        assert beyond < 0
        to_ear = drawn("earLeft", near) - middle_of("earring", near)
        assert np.linalg.norm(to_ear, axis=1).min() < 6
    assert beyond < -8, "hidden behind the cheek"


def test_a_tall_picture_shows_a_body() -> None:
    below = Renderer(MODEL, (200, 400)).render(shown())[330:].astype(int)
    assert (below[..., 0] - below[..., 2] > 30).mean() > 0.9, "the hoodie, from side to side"
    assert np.ptp(below.mean(axis=(1, 2))) > 10, "round, with seams"


def test_a_smile_stays_in_the_corners_of_a_talking_mouth() -> None:
    said = seen(viseme="PP").corners_up
    assert seen("happy", viseme="PP").corners_up > said + 4
    assert seen("sad", viseme="PP").corners_up < said - 4


# --- pictures ------------------------------------------------------------------------------------


def drawn_now(name: str) -> Image:
    turned = name == "turned"
    vector = (
        MODEL.vector({"headYaw": 1.0, "headPitch": 0.5}) if turned else still_vector(MODEL, name)
    )
    return Renderer(MODEL, GOLDEN_SIZE).render(vector)[FRAME]


@pytest.mark.parametrize("name", GOLDENS)
def test_the_pictures_stay_as_they_were_approved(name: str, golden: Golden) -> None:
    golden.check(name, drawn_now(name))
