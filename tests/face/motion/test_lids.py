"""A blink shuts what is open, and is not seen on eyes that are shut."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray

from hri.core.signals import Expression
from hri.face import load_face
from hri.face.animator import Animator
from hri.face.model import FaceModel
from hri.face.motion.blinking import Blinks
from hri.face.motion.lids import BENT, Lids
from hri.face.motion.mixer import Layers, Mixer
from tests.face.pixels import MODEL
from tests.face.small_face import write_face

NAMES = ("robot", "astronaut", "person", "eyes")
WEIGHTS = st.floats(0, 1)
LIDS = st.fixed_dictionaries(
    dict.fromkeys(("eyeBlinkLeft", "eyeBlinkRight", "cheekSquint", "eyeWide", "eyeDroop"), WEIGHTS)
)


def blinked(face: FaceModel, weights: dict[str, float], blink: float) -> NDArray[np.float32]:
    shown = face.vector(weights)
    return Mixer(face).mix(
        Layers(expression=shown, viseme=np.zeros(len(shown)), blink=(blink, blink))
    )


@given(LIDS, WEIGHTS)
def test_a_blink_never_opens_an_eye_and_shuts_it_wholly(
    weights: dict[str, float], blink: float
) -> None:
    shut = [MODEL.channels.index("eyeBlink" + side) for side in ("Left", "Right")]
    rest, half, full = (blinked(MODEL, weights, share)[shut] for share in (0.0, blink, 1.0))
    assert (half >= rest - 1e-6).all()
    assert full == pytest.approx([1.0, 1.0], abs=1e-6)


@pytest.mark.parametrize("name", NAMES)
@given(st.data())
@settings(max_examples=20)
def test_a_blink_of_shut_eyes_changes_nothing(name: str, data: st.DataObject) -> None:
    """Such as those of somebody who laughs."""
    face = load_face(name)
    bent = [channel for channel in face.channels if channel.startswith(BENT)]
    weights = data.draw(st.dictionaries(st.sampled_from(bent), WEIGHTS)) | {"eyeBlink": 1.0}
    assert np.array_equal(blinked(face, weights, 1.0), blinked(face, weights, 0.0))


def test_each_eye_shuts_as_far_as_its_blink() -> None:
    weights = np.zeros(len(MODEL.channels))
    shown = MODEL.weights(Mixer(MODEL).mix(Layers(weights, weights, blink=(0.9, 0.4))))
    assert shown["eyeBlinkLeft"] == pytest.approx(0.9)
    assert shown["eyeBlinkRight"] == pytest.approx(0.4)


@given(LIDS, WEIGHTS)
def test_a_blink_begins_and_ends_without_a_jump(weights: dict[str, float], blink: float) -> None:
    step = 1e-3
    one, other = (blinked(MODEL, weights, share) for share in (blink * (1 - step), blink))
    assert np.abs(one - other).max() <= 1.5 * step


def test_who_laughs_with_shut_eyes_blinks_unseen() -> None:
    """The lids of the person in "excited" are shut to arcs, and stay as they are for 10 s."""
    face = load_face("person")
    animator = Animator(face, seed=3)
    animator.express(Expression("excited"))
    path = np.array([animator.vector(number * 0.04, 0.04) for number in range(250)])[60:]
    lids = [n for n, name in enumerate(face.channels) if name.startswith(("eyeBlink", *BENT))]
    assert np.ptp(path[:, lids], axis=0).max() < 0.02


def test_without_a_corrective_a_blink_takes_away_what_holds_the_lids_open(tmp_path) -> None:  # type: ignore[no-untyped-def]
    folder = write_face(tmp_path / "mine")
    (folder / "targets" / "eyeBlink.svg").rename(folder / "targets" / "eyeWide.svg")
    (folder / "targets" / "eyeBlink.svg").write_text(
        (folder / "targets" / "eyeWide.svg").read_text().replace('ry="1"', 'ry="2"')
    )
    face = load_face(folder)
    assert face.weights(blinked(face, {"eyeWide": 1.0}, 1.0)) == {
        "eyeBlinkLeft": 1.0,
        "eyeBlinkRight": 1.0,
    }


TICK = 1 / 60


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("by_state", [False, True])
def test_who_falls_asleep_shuts_the_eyes_once(name: str, by_state: bool) -> None:
    face = load_face(name)
    lids = Lids(face)
    for seed in range(6):
        animator = Animator(face, seed)
        for number in range(90):
            animator.vector(number * TICK, TICK)
        if by_state:
            animator.be("asleep")
        else:
            animator.express(Expression("asleep"))
        shut = [
            lids.shut(animator.vector(1.5 + number * TICK, TICK).astype(float))
            for number in range(150)
        ]
        opened = -np.diff(shut)
        # A blink that was over half already may end first.
        begin = next(n for n, move in enumerate(opened) if move <= 0)
        assert opened[begin:].max() < 0.01, seed
        assert shut[-1] > 0.95


def test_a_blink_that_was_shut_when_eyes_began_to_shut_stays_shut() -> None:
    blink = replace(MODEL.settings.blink, half=0.0, uneven=0.0)
    blinks = Blinks(blink, seed=0)
    times = np.arange(0, 60, 0.01)
    begun = next(t for t in times if min(blinks.closure(t, 40.0)) > 0.5)
    held = [blinks.closure(begun + n * 0.01, 40.0, shutting=True) for n in range(100)]
    assert (np.diff(held, axis=0) >= 0).all()
    assert max(held[-1]) == 1.0
    assert min(held[-1]) > 0.95
    assert held[-1] == held[20]
    after = begun + 1.0
    opened = [blinks.closure(after + n * 0.01, 0.0) for n in range(60)]
    assert np.abs(np.diff(opened, axis=0)).max() < 0.02 / blink.open_s
    assert opened[-1] == (0.0, 0.0)


def test_events_bring_no_blink_to_eyes_that_are_shut_or_shut_now() -> None:
    shown = Animator(MODEL, 2)
    lids = Lids(MODEL)
    for number in range(900):
        if number % 90 == 0:
            shown.express(Expression("despaired" if number % 180 else "asleep"))
        weights = shown.vector(number * TICK, TICK)
        assert number < 90 or lids.shut(weights.astype(float)) > 0.95


@pytest.mark.parametrize("face", ["robot", "astronaut", "person", "eyes"])
def test_a_gesture_adds_no_more_than_all_there_is(face: str) -> None:
    model = load_face(face)
    glad, laughing = (
        model.vector({"eyeBlink": blink, "cheekSquint": squint, "headSize": size})
        for blink, squint, size in ((0.9, 1.2, -0.6), (1.0, 0.6, -0.8))
    )
    layers = Layers(glad, np.zeros_like(glad), gesture=laughing, owned=np.zeros(len(glad)))

    mixed = model.weights(Mixer(model).mix(layers))

    assert mixed["eyeBlinkLeft"] == pytest.approx(1.0)
    assert mixed["cheekSquintLeft"] == pytest.approx(1.2)
    assert mixed["headSize"] == pytest.approx(-1.0)


def test_shut_lids_do_not_cross_however_much_is_asked_for() -> None:
    model = load_face("person")
    shut, more = (model.blend(model.vector({"eyeBlink": weight}))[0] for weight in (1.0, 1.5))
    assert np.array_equal(shut, more)
