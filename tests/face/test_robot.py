"""The default face: what it shows, measured from its pixels, and how it looked when approved."""

from functools import cache
from itertools import combinations

import numpy as np
import pytest

from hri.core.signals import Image
from hri.face.model import load_face
from hri.face.motion.mixer import Layers, Mixer
from hri.face.renderers.renderer import Renderer
from hri.face.still import still_vector
from hri.face.vocabulary import ARKIT, EXPRESSIONS, LABELS, VISEMES
from hri.testing.golden import Golden, difference

MODEL = load_face("robot")
SEVEN = ("neutral", "happy", "sad", "angry", "surprised", "scared", "disgusted")
INK = (0x22, 0x1F, 0x33)
EYES, MOUTH = np.s_[190:345, 105:375], np.s_[345:450, 130:350]
"""Where they are in a picture of 480x480, on the body."""
CONTRAST = 4.5
"""Of ink on the body: WCAG 2.2, 1.4.3, contrast of text (minimum)."""
LOOKS: dict[str, dict[str, object]] = {
    **{label: {"expression": label} for label in (
        *SEVEN, "asleep", "thinking", "error", "furious", "pleading", "despaired",
    )},
    **{viseme: {"viseme": viseme} for viseme in ("FF", "TH", "ou", "SS")},
    "oh while happy": {"expression": "happy", "viseme": "oh"},
    "turned": {"yaw": 22.0, "pitch": -10.0, "gaze": (-0.8, 0.3)},
}  # fmt: skip


@cache
def drawn(size: tuple[int, int] = (480, 480), **look: object) -> Image:
    return Renderer(MODEL, size).render(still_vector(MODEL, **look))  # type: ignore[arg-type]


def ink(picture: Image) -> np.ndarray:
    """Where there is ink."""
    return np.asarray(np.abs(picture.astype(int) - INK).max(axis=2) < 8)


def box(marked: np.ndarray) -> tuple[int, int]:
    """Width and height of what is marked, pixels."""
    rows, columns = np.flatnonzero(marked.any(axis=1)), np.flatnonzero(marked.any(axis=0))
    return int(np.ptp(columns)) + 1, int(np.ptp(rows)) + 1


def luminance(colors: np.ndarray) -> np.ndarray:
    """Relative luminance of sRGB colors (WCAG 2.2)."""
    light = colors / 255
    linear = np.where(light <= 0.04045, light / 12.92, ((light + 0.055) / 1.055) ** 2.4)
    return np.asarray(linear @ (0.2126, 0.7152, 0.0722))


@pytest.mark.parametrize("name", LOOKS)
def test_the_face_stays_as_it_was_approved(name: str, golden: Golden) -> None:
    golden.check(name, drawn((160, 120), **LOOKS[name]))


def test_a_slight_change_is_noticed() -> None:
    happy, less = drawn(expression="happy"), drawn(expression="happy", intensity=0.93)
    assert "tiles changed" in difference(less, happy)


def test_the_face_has_all_that_others_know_by_name() -> None:
    assert set(LABELS) <= set(MODEL.expressions)
    assert not [name for name in ARKIT if name not in MODEL.channels]
    assert set(load_face("astronaut").channels) <= set(MODEL.channels)


@pytest.mark.parametrize("label", LABELS)
def test_ink_is_legible_on_the_body_in_every_light(label: str) -> None:
    """Of what lies three to six pixels beside ink, and is body: neither leaf nor ground."""
    picture = drawn(expression=label)
    near, far = (_grown(ink(picture), reach) for reach in (3, 6))
    beside = picture[far & ~near]
    body = beside[(beside[:, 0] > 130) & (beside[:, 0] > beside[:, 1])]
    darkest = np.percentile(luminance(body), 5)
    assert (darkest + 0.05) / (luminance(np.array(INK)) + 0.05) >= CONTRAST


def _grown(marked: np.ndarray, reach: int) -> np.ndarray:
    grown = marked
    for axis in (0, 1):
        grown = np.max([np.roll(grown, step, axis) for step in range(-reach, reach + 1)], axis=0)
    return grown


def test_any_two_expressions_differ_clearly_at_400x300() -> None:
    """Mean differences; the astronaut's smallest are 5.15 of all and 5.58 of the basic ones."""
    pictures = {
        label: drawn((400, 300), expression=label).astype(np.int16) for label in EXPRESSIONS
    }
    for first, second in combinations(EXPRESSIONS, 2):
        apart = np.abs(pictures[first] - pictures[second]).mean()
        assert apart >= (5.6 if {first, second} <= set(SEVEN) else 5.15), (first, second)


def test_any_two_visemes_differ_at_400x300() -> None:
    pictures = {name: drawn((400, 300), viseme=name).astype(np.int16) for name in VISEMES}
    for first, second in combinations(VISEMES, 2):
        assert np.abs(pictures[first] - pictures[second]).mean() >= 0.22, (first, second)


def test_a_blink_shuts_the_eyes_of_every_expression() -> None:
    """What is left is a line as thick as that of the mouth, without its lights."""
    for label in LABELS:
        expression = MODEL.vector(MODEL.expression(label)).astype(float)
        if label == "error":
            continue  # crosses do not blink
        shut = Mixer(MODEL).mix(Layers(expression, np.zeros_like(expression), blink=(1.0, 1.0)))
        eyes = Renderer(MODEL, (480, 480)).render(shut)[EYES]
        marked = ink(eyes)
        assert 3 < marked.sum(axis=0).max() <= 16, label
        lights = (eyes.min(axis=2) > 225) & _grown(marked, 3)
        assert lights.sum() == 0, label


def test_the_mouths_of_speech_are_what_their_sounds_need() -> None:
    boxes = {name: box(ink(drawn(viseme=name)[MOUTH])) for name in VISEMES}
    heights = {name: height for name, (_, height) in boxes.items()}
    assert heights["PP"] <= 17, "closed"
    assert heights["FF"] <= heights["sil"] + 8, "bitten"
    assert heights["aa"] > heights["E"] > heights["ih"] > heights["PP"]
    for rounded in ("CH", "ou", "oh"):
        width, height = boxes[rounded]
        assert width <= height, rounded
    assert boxes["SS"][0] > 1.5 * boxes["oh"][0]
    assert boxes["ih"][0] > boxes["sil"][0]


def test_happy_eyes_are_arches_and_surprised_ones_tall() -> None:
    heights = {label: box(ink(drawn(expression=label)[EYES]))[1] for label in SEVEN}
    assert heights["happy"] < 0.75 * heights["neutral"] < 0.75 * heights["surprised"]
    assert heights["scared"] < 0.9 * heights["neutral"]


def test_the_leaves_speak_too() -> None:
    def leaves(label: str) -> tuple[int, int]:
        picture = drawn(expression=label).astype(int)
        return box((picture[..., 1] > picture[..., 0] + 15) & (picture[..., 1] > 90))

    neutral, happy, sad, surprised = map(leaves, ("neutral", "happy", "sad", "surprised"))
    assert happy[0] > 1.2 * neutral[0], "spread"
    assert sad[0] > 1.2 * neutral[0], "hanging to both sides"
    assert surprised[0] < 0.6 * neutral[0], "together"
    assert surprised[1] > 1.2 * neutral[1], "upright"


@cache
def silhouette(face: str, label: str) -> np.ndarray:
    """What a face covers at 64x64, [height, width]."""
    model = load_face(face)
    layers = () if face == "eyes" else ("body", "face", "ink")  # it glows, and has none
    renderer = Renderer(model, (64, 64), transparent=True, layers=layers)
    return np.asarray(renderer.render(still_vector(model, label))[..., 3] >= 128)


def overlap(one: np.ndarray, other: np.ndarray) -> float:
    """Intersection over union."""
    return float((one & other).sum() / (one | other).sum())


@pytest.mark.parametrize("other", ["astronaut", "person", "eyes"])
def test_its_silhouette_is_its_own(other: str) -> None:
    assert overlap(silhouette("robot", "neutral"), silhouette(other, "neutral")) < 0.80


def test_its_silhouette_differs_from_one_basic_expression_to_another() -> None:
    for first, second in combinations(SEVEN, 2):
        shared = overlap(silhouette("robot", first), silhouette("robot", second))
        assert shared < 0.93, (first, second)
