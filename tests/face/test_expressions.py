"""What the astronaut shows, measured from its pixels: it has lids, lips, teeth and brows."""

from collections.abc import Iterator
from functools import cache
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.errors import HriError
from hri.face import render_face
from hri.face.drawing.baking import Opening, Shape
from hri.face.motion.mixer import Layers, Mixer
from hri.face.vocabulary import ARKIT, LABELS, TURNS, VISEMES, sides_of
from tests.face.pixels import MODEL, SIZE, Shot, face

STEPS = (0.0, 0.25, 0.5, 0.75, 1.0)
LIDS = ("eyeBlink", "eyeSquint", "cheekSquint", "eyeWide", "eyeDroop", "browDown", "noseSneer",
        "eyeLookDown", "eyeLookUp")  # fmt: skip
LIPS = ("jawOpen", "mouthClose", "mouthSmile", "mouthFrown", "mouthPucker", "mouthFunnel",
        "mouthStretch", "mouthPress", "mouthUpperUp", "mouthLowerDown", "mouthRollLower",
        "mouthShrugLower", "mouthWavy")  # fmt: skip


@cache
def shot(label: str) -> Shot:
    return face(label)


@cache
def said(viseme: str) -> Shot:
    return face(viseme=viseme)


def test_the_face_has_every_expression_and_state() -> None:
    assert set(LABELS) <= set(MODEL.expressions)


def test_the_face_has_all_of_arkit() -> None:
    assert not [name for name in ARKIT if name not in MODEL.channels]


def test_the_neutral_face_is_kind_and_its_mouth_is_shut() -> None:
    neutral = shot("neutral")
    assert 3 < neutral.corners_up < 12, "a hint of a smile"
    assert neutral.dark_mouth == 0
    assert neutral.teeth == 0
    assert -6 < neutral.brow_slope < 1, "nothing stern"


def test_the_upper_lid_cuts_the_iris_at_rest_and_not_in_surprise() -> None:
    assert shot("neutral").white_above_iris == 0
    assert shot("surprised").white_above_iris > 3
    assert shot("scared").white_above_iris > 3


def test_happy_lifts_the_corners_and_sad_lowers_them() -> None:
    neutral = shot("neutral").corners_up
    assert shot("happy").corners_up > neutral + 7
    assert face(weights={"mouthSmile": 1}).corners_up > neutral + 15
    assert shot("sad").corners_up < neutral - 15


def test_anger_and_sadness_slope_the_brows_against_each_other() -> None:
    assert shot("angry").brow_slope > 8
    assert shot("sad").brow_slope < -12
    assert shot("scared").brow_slope < -12
    assert shot("furious").brow_slope > shot("angry").brow_slope > shot("suspicious").brow_slope


def test_surprise_opens_mouth_and_eyes() -> None:
    surprised, neutral = shot("surprised"), shot("neutral")
    assert surprised.dark_mouth > 700
    assert surprised.lid_gap > 1.3 * neutral.lid_gap
    assert surprised.mouth_width < 0.6 * neutral.mouth_width


def test_fear_pulls_the_mouth_wide_where_surprise_rounds_it() -> None:
    scared, surprised = shot("scared"), shot("surprised")
    assert scared.mouth_width > 2 * surprised.mouth_width
    assert scared.teeth > 1.5 * surprised.teeth
    assert scared.dark_mouth < 0.8 * surprised.dark_mouth
    assert scared.dark_mouth < 0.5 * shot("horrified").dark_mouth


def test_disgust_narrows_the_eyes_that_anger_leaves_open() -> None:
    disgusted, angry = shot("disgusted"), shot("angry")
    assert disgusted.lid_gap < 0.75 * angry.lid_gap
    assert disgusted.iris < 0.75 * angry.iris
    assert disgusted.mouth_width < angry.mouth_width


def test_tired_eyes_are_half_shut_and_sleeping_ones_shut() -> None:
    assert 0 < shot("tired").iris < 0.5 * shot("neutral").iris
    assert 0 < shot("bored").iris < 0.7 * shot("neutral").iris
    assert shot("asleep").iris == shot("asleep").lid_gap == 0


def test_signs_tell_moods_apart_that_look_alike() -> None:
    def of(part: str, label: str) -> tuple[float, ...]:
        return tuple(shot(label).at(part).mean(axis=(0, 1)))

    red, green, _ = of("vein", "annoyed")
    plain_red, plain_green, _ = of("vein", "suspicious")
    assert red - green > plain_red - plain_green + 15, "a vein on the temple"
    assert sum(of("bagLeft", "tired")) < sum(of("bagLeft", "bored")) - 40, "rings under the eyes"
    assert np.diff(of("furrowLeft", "horrified"))[1] > np.diff(of("furrowLeft", "scared"))[1] + 30


def test_guilt_bares_its_teeth_and_looks_away_where_disappointment_looks_down() -> None:
    guilty, disappointed = shot("guilty"), shot("disappointed")
    assert guilty.teeth > 150 > disappointed.teeth
    assert guilty.iris_center[0] > shot("neutral").iris_center[0] + 10
    assert disappointed.iris_center[1] > shot("neutral").iris_center[1] + 3


def test_any_two_expressions_differ_clearly() -> None:
    pictures = {label: shot(label).image[::2, ::2].astype(int) for label in LABELS}
    for first, second in combinations(LABELS, 2):
        changed = np.abs(pictures[first] - pictures[second]).max(axis=2) > 30
        assert changed.mean() > 0.01, (first, second)


def test_afraid_is_another_word_for_scared() -> None:
    assert np.array_equal(face("afraid").image, shot("scared").image)


@pytest.mark.parametrize(
    ("label", "measure", "sign"),
    [
        ("happy", "corners_up", 1),
        ("sad", "corners_up", -1),
        ("angry", "brow_slope", 1),
        ("sad", "brow_slope", -1),
        ("surprised", "dark_mouth", 1),
        ("surprised", "lid_gap", 1),
        ("scared", "white_above_iris", 1),
        ("disgusted", "iris", -1),
        ("tired", "lid_gap", -1),
    ],
)
def test_an_expression_grows_with_its_intensity(label: str, measure: str, sign: int) -> None:
    values = [sign * getattr(face(label, intensity), measure) for intensity in STEPS]
    slack = 0.02 * abs(values[-1] - values[0]) + 1.5
    assert (np.diff(values) >= -slack).all(), values
    assert values[-1] > values[0]


def test_a_blink_shuts_the_eyes() -> None:
    gaps = [face(weights={"eyeBlink": share}).lid_gap for share in STEPS]
    assert gaps == sorted(gaps, reverse=True)
    assert gaps[-1] == 0


@pytest.mark.parametrize("label", LABELS)
def test_a_blink_shuts_the_eyes_whatever_is_felt(label: str) -> None:
    expression = MODEL.vector(MODEL.expression(label))
    vector = Mixer(MODEL).mix(Layers(expression, np.zeros_like(expression), blink=(1.0, 1.0)))
    vector[[MODEL.channels.index(turn) for turn in TURNS]] = 0.0
    assert all(np.abs(gaps).max() < 1.5 for gaps in _gaps(vector, "scleraLeft", "scleraRight"))


@pytest.mark.parametrize("yaw", [-1.0, 0.0, 1.0])
@pytest.mark.parametrize("pitch", [-1.0, 1.0])
def test_shut_eyes_stay_shut_when_the_head_turns(yaw: float, pitch: float) -> None:
    turned = face(weights={"eyeBlink": 1.0, "headYaw": yaw, "headPitch": pitch})
    assert turned.iris < 4
    assert turned.lid_gap == 0


def test_eyes_are_crossed_out_as_far_as_they_are_shut() -> None:
    def crossed(vector: np.ndarray) -> float:
        _, scalars = MODEL.blend(vector)
        return float(scalars[_shape("crossLeft").opacity])

    assert crossed(MODEL.vector({"eyeCross": 1.0})) == crossed(MODEL.vector({"eyeBlink": 1.0})) == 0
    error = MODEL.vector(MODEL.expression("error"))
    assert crossed(error) == pytest.approx(1)
    for share in STEPS:
        (gaps, _) = _gaps(share * error, "scleraLeft", "scleraRight")
        assert crossed(share * error) < 0.3 or gaps.max() < 16, share


def test_one_eye_can_wink() -> None:
    assert face(weights={"eyeBlinkLeft": 1.0}).lid_gap == 0
    assert face(weights={"eyeBlinkRight": 1.0}).lid_gap == shot("neutral").lid_gap


def _gaps(vector: np.ndarray, *contents: str) -> Iterator[np.ndarray]:
    """Height of openings at even steps across them; below 0 where their edges cross."""
    points, _ = MODEL.blend(vector)
    for item in MODEL.display.items:
        if isinstance(item, Opening) and any(
            isinstance(part, Shape) and part.id in contents for part in item.content
        ):
            start, stop, _ = item.clip.contours[0]
            edge = np.concatenate([points[start:stop], points[start : start + 1]])
            upper, lower = edge[: len(edge) // 2 + 1], edge[len(edge) // 2 :]
            across = np.linspace(edge[:, 0].min(), edge[:, 0].max(), 15)[1:-1]
            yield _height(lower, across) - _height(upper, across)


def _shape(id: str) -> Shape:
    return next(item for item in MODEL.display.items if isinstance(item, Shape) and item.id == id)


def _heights(id: str, vector: np.ndarray) -> np.ndarray:
    """How low the points of a part lie."""
    start, stop, _ = _shape(id).contours[0]
    return np.asarray(MODEL.blend(vector)[0][start:stop, 1])


def _height(edge: np.ndarray, across: np.ndarray) -> np.ndarray:
    order = np.argsort(edge[:, 0])
    return np.asarray(np.interp(across, edge[order, 0], edge[order, 1]))


def _weights(names: tuple[str, ...]) -> st.SearchStrategy[dict[str, float]]:
    channels = [side for name in names for side in sides_of(name)]
    return st.dictionaries(st.sampled_from(channels), st.floats(0, 1), max_size=8)


@settings(max_examples=150, deadline=None)
@given(_weights(LIDS), _weights(LIPS))
def test_neither_lids_nor_lips_cross(lids: dict[str, float], lips: dict[str, float]) -> None:
    vector = MODEL.vector(lids | lips)
    for gaps in _gaps(vector, "scleraLeft", "scleraRight", "mouthDark"):
        assert gaps.min() > -1.0


def test_the_widest_mouth_stays_behind_the_visor() -> None:
    wide = MODEL.vector({"jawOpen": 1.5})
    assert _heights("lipLower", wide).max() < _heights("plate", wide).max() + 1


@pytest.mark.parametrize("label", LABELS)
def test_the_glow_of_the_antenna_stays_in_a_wide_picture(label: str) -> None:
    top = render_face(MODEL, label, size=(320, 240))[0, 80:240].astype(int)
    assert np.ptp(top, axis=0).max() < 24


def test_a_tall_picture_shows_a_body() -> None:
    below = render_face(MODEL, size=(200, 400))[290:].astype(int)
    assert (below.min(axis=2) > 80).mean() > 0.95, "from side to side"
    assert (below[..., 0] - below[..., 2] > 90).sum() > 150, "with a light on its chest"
    assert below[:40].mean() > below[-40:].mean() + 10, "and round"


def test_the_eyes_look_where_they_are_told() -> None:
    x, y = shot("neutral").iris_center
    still = {"headX": 0.0}
    assert face(gaze=(1, 0), weights=still).iris_center[0] > x + 10
    assert face(gaze=(-1, 0), weights=still).iris_center[0] < x - 8
    assert face(gaze=(0, 1)).iris_center[1] < y - 4
    assert face(gaze=(0, -1)).iris_center[1] > y + 2


def test_every_viseme_closes_or_opens_the_mouth_as_it_must() -> None:
    dark = {name: said(name).dark_mouth for name in VISEMES}
    assert dark["PP"] == dark["sil"] == 0
    assert dark["aa"] > dark["E"] > dark["ih"]
    assert dark["aa"] > dark["oh"] > dark["ou"] > 100
    assert dark["FF"] < 30
    assert 150 < said("FF").teeth < 0.6 * said("SS").teeth, "upper teeth rest on the lower lip"
    lip = _heights("lipLower", MODEL.vector(MODEL.viseme("FF")))
    assert 3 < lip.max() - lip.min() < 16, "which is tucked in and seen"
    assert said("SS").teeth > 700, "both rows of teeth"
    assert said("SS").teeth > said("ih").teeth > said("nn").teeth


def test_any_two_visemes_differ() -> None:
    mouth = (slice(280, 400), slice(140, 340))
    pictures = {name: said(name).image[mouth].astype(int) for name in VISEMES}
    for first, second in combinations(VISEMES, 2):
        changed = np.abs(pictures[first] - pictures[second]).max(axis=2) > 30
        assert changed.sum() > 350, (first, second)


def test_the_tongue_shows_where_it_makes_the_sound() -> None:
    pink = {name: _pink(said(name)) for name in ("sil", "E", "TH", "DD", "nn")}
    assert min(pink["TH"], pink["DD"], pink["nn"]) > max(pink["sil"], pink["E"]) + 200


def test_the_tongue_comes_out_between_the_lips() -> None:
    vector = MODEL.vector({"tongueOut": 1.0})
    (gaps,) = _gaps(vector, "mouthDark")
    assert gaps.max() > 10
    tongue, upper = _heights("tongueTip", vector), _heights("mouthLine", vector)
    assert tongue.min() > upper.max() - 4, "below the upper lip"
    assert tongue.max() > _heights("lipLower", vector).max() + 2, "over the lower lip"


def _pink(shown: Shot) -> int:
    """Pixels of tongue and lips: both are pink, the lips alike in all visemes compared."""
    red, green, blue = np.moveaxis(shown.mouth, 2, 0)
    return int(((red > 200) & (green < 150) & (abs(green - blue) < 22)).sum())


def test_round_vowels_round_the_lips() -> None:
    width = {name: said(name).mouth_width for name in ("ou", "oh", "aa", "ih")}
    assert width["ou"] < width["oh"] < width["aa"] < width["ih"]


@pytest.mark.parametrize("label", LABELS)
def test_lips_meet_for_b_whatever_is_felt(label: str) -> None:
    assert face(label, viseme="PP").dark_mouth == 0


@pytest.mark.parametrize("name", ["mouthSmile", "mouthFrown", "browDown", "eyeBlink", "eyeSquint"])
def test_left_and_right_mirror_each_other(name: str) -> None:
    neutral = shot("neutral").image.astype(int)
    left, right = (
        face(weights={name + side: 1.0}).image.astype(int) - neutral for side in ("Left", "Right")
    )
    assert np.abs(left - right[:, ::-1]).mean() < 0.35 * np.abs(left).mean()
    assert np.abs(left[:, :200]).sum() < 0.05 * np.abs(left).sum(), "its left, the viewer's right"


def test_a_turned_head_shows_its_nose_beside_the_middle_and_one_ear_more() -> None:
    def shown(yaw: float) -> dict[str, tuple[int, int, int, int]]:
        return dict(face(weights={"headYaw": yaw}).boxes)

    left, ahead, right = shown(-1), shown(0), shown(1)
    assert right["nose"][0] > ahead["nose"][0] + 30 > left["nose"][0] + 60
    assert right["earRight"][0] < ahead["earRight"][0] - 15
    assert left["earLeft"][2] > ahead["earLeft"][2] + 15
    assert right["nose"][0] - ahead["nose"][0] > right["plate"][0] - ahead["plate"][0] + 5


@pytest.mark.parametrize("roll", [-1.0, 0.0, 1.0])
def test_the_shoulders_run_out_of_a_wide_picture_without_an_edge(roll: float) -> None:
    wide = render_face(MODEL, weights={"headRoll": roll}, yaw=-25, size=(854, 480))
    light = wide[400:].min(axis=2) > 140
    height = np.where(light.any(axis=0), light.shape[0] - light.argmax(axis=0), 0)
    for side in (height[:260], height[-260:]):
        assert np.abs(np.diff(side)).max() < 8


def test_the_same_arguments_give_the_same_bytes() -> None:
    first = render_face(MODEL, "happy", time=3.3, seed=4, size=(160, 120))
    again = render_face(MODEL, "happy", time=3.3, seed=4, size=(160, 120))
    assert np.array_equal(first, again)
    assert first.shape == (120, 160, 3)
    assert first.dtype == np.uint8
    other = render_face(MODEL, "happy", time=3.3, seed=5, size=(160, 120))
    assert not np.array_equal(first, other)


@pytest.mark.parametrize("size", [(16, 16), (128, 64), (320, 480), (600, 200)])
def test_any_size_can_be_drawn(size: tuple[int, int]) -> None:
    picture = render_face(MODEL, "surprised", size=size)
    assert picture.shape == (size[1], size[0], 3)
    assert picture.std() > 10


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"expression": "hapy"}, 'did you mean "happy"'),
        ({"viseme": "pp"}, 'did you mean "PP"'),
        ({"weights": {"jawOpne": 1.0}}, 'did you mean "jawOpen"'),
        ({"weights": {"jawOpen": float("nan")}}, "finite"),
        ({"intensity": float("inf")}, "number from 0 to 1"),
        ({"intensity": 7.0}, "from 0 to 1"),
        ({"gaze": (float("nan"), 0.0)}, "number from -1 to 1"),
        ({"size": (4, 4)}, "4x4"),
        ({"face": "robbot"}, 'did you mean "robot"'),
    ],
)
def test_what_cannot_be_drawn_is_refused(arguments: dict[str, object], message: str) -> None:
    with pytest.raises(HriError, match=message):
        render_face(**{"size": SIZE, **arguments})  # type: ignore[arg-type]


def test_weights_far_out_of_range_still_give_a_picture() -> None:
    wild = {"jawOpen": 1e30, "headX": -1e30, "eyeBlink": -50.0}
    assert render_face(MODEL, weights=wild, size=SIZE).shape == (480, 480, 3)


@pytest.mark.parametrize(
    ("viseme", "jaw", "round_lips"),
    [
        ("PP", (0.0, 0.05), (0.0, 0.2)),
        ("aa", (0.5, 1.0), (0.0, 0.2)),
        ("oh", (0.4, 0.7), (0.6, 1.0)),
        ("ou", (0.05, 0.3), (0.4, 1.0)),
    ],
)
def test_a_viseme_opens_and_rounds_the_mouth(viseme, jaw, round_lips):
    weights = MODEL.viseme(viseme)
    assert jaw[0] <= weights.get("jawOpen", 0.0) <= jaw[1]
    assert round_lips[0] <= weights.get("mouthFunnel", 0.0) <= round_lips[1]
