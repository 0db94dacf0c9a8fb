import cv2
import numpy as np
import pytest

from hri.face.renderers.captions import add_caption
from hri.face.renderers.opencv import OpenCvRenderer
from hri.face.still import still_vector
from tests.face.pixels import MODEL

SIZE = (320, 240)


@pytest.fixture
def threads():  # type: ignore[no-untyped-def]
    before = cv2.getNumThreads()
    yield cv2.setNumThreads
    cv2.setNumThreads(before)


def test_the_number_of_threads_changes_no_byte(threads) -> None:  # type: ignore[no-untyped-def]
    vector = still_vector(MODEL, "happy", viseme="aa", gaze=(0.4, 0.1), time=1.7)
    pictures = []
    for count in (1, 2, 4):
        threads(count)
        pictures.append(OpenCvRenderer(MODEL, SIZE).render(vector))
    assert all(np.array_equal(pictures[0], other) for other in pictures)


def test_a_picture_does_not_depend_on_those_before() -> None:
    renderer = OpenCvRenderer(MODEL, SIZE)
    neutral = renderer.render(still_vector(MODEL))
    renderer.render(still_vector(MODEL, "surprised"))
    assert np.array_equal(neutral, renderer.render(still_vector(MODEL)))


def test_the_backdrop_moves_with_the_head() -> None:
    renderer = OpenCvRenderer(MODEL, (480, 480))
    vector = MODEL.vector({"headX": 1.0})
    still = renderer.render(MODEL.vector({})).astype(int)
    moved = renderer.render(vector).astype(int)
    shift = round(MODEL.settings.motion.shift)
    assert np.abs(moved[:, 20 + shift : 460] - still[:, 20 : 460 - shift]).mean() < 1.0


def test_a_larger_picture_shows_the_same_face() -> None:
    vector = still_vector(MODEL, "happy")
    small = OpenCvRenderer(MODEL, (240, 240)).render(vector)
    large = OpenCvRenderer(MODEL, (960, 960)).render(vector)
    reduced = cv2.resize(large, (240, 240), interpolation=cv2.INTER_AREA)
    assert np.abs(small.astype(int) - reduced.astype(int)).mean() < 1.5


def test_a_caption_is_written_at_the_bottom_only() -> None:
    picture = OpenCvRenderer(MODEL, SIZE).render(still_vector(MODEL))
    captioned = add_caption(picture, "I can go forward ten meters.")
    assert np.array_equal(captioned[:180], picture[:180])
    assert (captioned[200:] > 240).all(axis=2).sum() > 100, "white letters"
    assert captioned[230, 3].sum() < picture[230, 3].sum()


@pytest.mark.parametrize("text", ["", "  \n "])
def test_without_words_the_picture_stays_as_it_is(text: str) -> None:
    picture = np.full((48, 64, 3), 9, np.uint8)
    assert add_caption(picture, text) is picture


@pytest.mark.parametrize("text", ["word " * 400, "x" * 5000, "Grüße, 你好"])
def test_any_caption_fits(text: str) -> None:
    picture = np.zeros((240, 320, 3), np.uint8)
    assert add_caption(picture, text).shape == picture.shape
    assert not add_caption(picture, text)[:150].any()
