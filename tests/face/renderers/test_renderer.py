import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import cv2
import numba
import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.errors import HriError
from hri.face.drawing.baking import Item, Opening, Shape
from hri.face.drawing.paint import Gradient, Paint, Solid, Stop
from hri.face.renderers.captions import add_caption
from hri.face.renderers.compiling import compiled
from hri.face.renderers.instructions import STEPS
from hri.face.renderers.kernel import paint
from hri.face.renderers.program import DEEPEST, lines, program_of, scratch_for
from hri.face.renderers.renderer import Renderer
from hri.face.renderers.strokes import Strokes
from hri.face.still import still_vector
from tests.face.pixels import MODEL

SIZE = (320, 240)
WEIGHTS = st.dictionaries(
    st.sampled_from(MODEL.channels), st.floats(-1, 1, width=32), min_size=1, max_size=6
)


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
        pictures.append(Renderer(MODEL, SIZE).render(vector))
    assert all(np.array_equal(pictures[0], other) for other in pictures)


OLD = Renderer(MODEL, (160, 120))


@settings(max_examples=12)
@given(st.lists(WEIGHTS, min_size=1, max_size=3))
def test_a_picture_does_not_depend_on_those_before(weights: list[dict[str, float]]) -> None:
    vectors = [MODEL.vector(each) for each in weights]
    for vector in vectors:
        last = OLD.render(vector)
    assert np.array_equal(last, Renderer(MODEL, (160, 120)).render(vectors[-1]))


def test_eyes_that_come_back_to_where_they_were_are_the_same_again() -> None:
    talking = [MODEL.vector({"jawOpen": jaw}) for jaw in (0.1, 0.2, 0.3, 0.4)]
    looking = MODEL.vector({"eyeLookUp": 0.7, "jawOpen": 0.4})
    for vector in (*talking, looking, talking[-1], looking):
        seen = OLD.render(vector)
        assert np.array_equal(seen, Renderer(MODEL, (160, 120)).render(vector))


def test_the_picture_that_was_given_out_may_be_drawn_on() -> None:
    vector = still_vector(MODEL, "happy")
    first = OLD.render(vector)
    kept = first.copy()
    first[:] = 0
    assert np.array_equal(OLD.render(vector), kept)


def test_a_picture_is_drawn_into_the_array_that_is_given() -> None:
    batch = np.zeros((3, 120, 160, 3), np.uint8)
    vectors = [still_vector(MODEL, label) for label in ("happy", "sad", "angry")]
    for vector, out in zip(vectors, batch, strict=True):
        assert OLD.render(vector, out) is out
        assert np.array_equal(out, OLD.render(vector))


@pytest.mark.parametrize(
    "out",
    [
        np.zeros((120, 160, 4), np.uint8),
        np.zeros((120, 160, 3), np.float32),
        np.zeros((120, 320, 3), np.uint8)[:, ::2],
    ],
)
def test_an_array_that_does_not_fit_is_refused(out: np.ndarray) -> None:
    with pytest.raises(ValueError, match=r"give uint8, \(120, 160, 3\), contiguous"):
        OLD.render(HAPPY, out)


def test_the_head_moves_before_its_background() -> None:
    renderer = Renderer(MODEL, (480, 480))
    still = renderer.render(MODEL.vector({})).astype(int)
    moved = renderer.render(MODEL.vector({"headX": 1.0})).astype(int)
    shift = MODEL.settings.motion.shift
    assert shift == round(shift)
    face = still[150:350, 150:330]
    assert np.abs(moved[150:350, 150 + round(shift) : 330 + round(shift)] - face).mean() < 0.5
    assert np.array_equal(moved[:20, :20], still[:20, :20])


HAPPY = still_vector(MODEL, "happy")
LARGE = Renderer(MODEL, (720, 720)).render(HAPPY)


@pytest.mark.parametrize("size", [(128, 64), (240, 240), (1920, 1080)])
def test_the_same_face_is_shown_at_any_size(size: tuple[int, int]) -> None:
    picture = Renderer(MODEL, size).render(HAPPY)
    side = min(size)
    left, top = (size[0] - side) // 2, (size[1] - side) // 2
    face = picture[top : top + side, left : left + side]
    common = min(side, len(LARGE))
    seen, expected = (
        cv2.resize(each, (common, common), interpolation=cv2.INTER_AREA).astype(int)
        for each in (face, LARGE)
    )
    # Away from the background, whose corners lie elsewhere in a wide picture.
    inner = slice(common * 3 // 10, common * 7 // 10)
    assert np.abs(seen[inner, inner] - expected[inner, inner]).mean() < 4.0


@pytest.mark.parametrize("size", [(4, 480), (640, 5000)])
def test_a_size_out_of_range_is_refused(size: tuple[int, int]) -> None:
    with pytest.raises(HriError, match="give sides from"):
        Renderer(MODEL, size)


def test_weights_that_are_no_numbers_are_refused() -> None:
    with pytest.raises(HriError, match="give finite ones"):
        OLD.render(np.full(len(MODEL.channels), np.nan, np.float32))
    assert np.array_equal(OLD.render(HAPPY), Renderer(MODEL, (160, 120)).render(HAPPY))


def test_faces_are_loaded_and_checked_without_the_compiler() -> None:
    program = "import hri.cli.face, hri.face, sys; print('numba' in sys.modules)"
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert run.stdout == "False\n"


def test_the_first_picture_needs_no_compiler() -> None:
    program = "import hri.face, sys; hri.face.render_face(); print('numba' in sys.modules)"
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert run.stdout == "False\n"


# --- shapes ---

Corners = Sequence[tuple[float, float]]
WHITE = Solid((255, 255, 255))


def shape(first: int, count: int, number: int, paint: Paint = WHITE, stroke: bool = False) -> Shape:
    anchors = (first + count, first + count + (2 if isinstance(paint, Gradient) else 0))
    contours = ((first, first + count, not stroke),)
    return Shape(str(number), contours, paint, anchors, 2 * number, stroke, True)


def painted(
    items: Sequence[Item],
    points: Corners,
    size: tuple[int, int],
    scalars: Sequence[float] = (1.0, 0.0) * 20,
    canvas: np.ndarray | None = None,
) -> np.ndarray:
    """Red, green and blue, 0 to 255, of items on black."""
    strokes = Strokes(lines(items))
    program = program_of(items, strokes)
    found = np.array(points, np.float32).reshape(-1, 2)
    numbers = np.array(scalars, np.float32)
    vertices = np.concatenate([strokes.outline(found, numbers, 1.0), found])
    steps = np.rint(vertices * STEPS).astype(np.int32)
    width, height = size
    canvas = np.zeros((height, width), np.uint32) if canvas is None else canvas
    paint(program, steps, numbers, scratch_for(program, width, height), canvas)
    return canvas.view(np.uint8).reshape(height, width, 4)[..., :3].astype(int)


def covered(corners: Corners, size: tuple[int, int]) -> np.ndarray:
    return painted([shape(0, len(corners), 0)], corners, size)[..., 0] / 255


def test_a_pixel_gets_the_share_of_it_that_is_covered() -> None:
    mask = covered([(1.25, 1.5), (3.5, 1.5), (3.5, 3), (1.25, 3)], (5, 4))
    expected = np.outer([0, 0.5, 1, 0], [0, 0.75, 1, 0.5, 0])
    assert np.abs(mask - expected).max() < 0.01


COORDINATE = st.floats(0, 80, width=32)


@given(st.lists(st.tuples(COORDINATE, COORDINATE), min_size=3, max_size=3))
def test_a_triangle_covers_its_area_wherever_it_lies(corners: list[tuple[float, float]]) -> None:
    (ax, ay), (bx, by), (cx, cy) = corners
    area = abs((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2
    assert covered(corners, (80, 80)).sum() == pytest.approx(area, rel=0.01, abs=1.0)


@given(st.lists(st.tuples(COORDINATE, COORDINATE), min_size=3, max_size=9))
def test_a_part_of_a_picture_is_what_it_is_in_the_whole(corners: list[tuple[float, float]]) -> None:
    whole = covered(corners, (80, 80))
    part = covered([(x - 30, y - 35) for x, y in corners], (20, 10))
    assert np.array_equal(part, whole[35:45, 30:50])


def test_what_overlaps_itself_is_covered_once() -> None:
    around = [(1, 1), (5, 1), (5, 5), (1, 5)]
    assert covered(around * 2, (6, 6)).max() == 1.0


SQUARE = [(2.0, 2.0), (38.0, 2.0), (38.0, 38.0), (2.0, 38.0)]


@given(st.integers(0, 2**24 - 1), st.integers(0, 2**24 - 1), st.floats(0.01, 1))
def test_a_color_is_laid_over_another_to_the_nearest_level(
    above: int, below: int, opacity: float
) -> None:
    color = (above & 255, above >> 8 & 255, above >> 16)
    expected = [
        round(over * opacity + under * (1 - opacity))
        for over, under in zip(color, (below & 255, below >> 8 & 255, below >> 16), strict=True)
    ]
    canvas = np.full((40, 40), below, np.uint32)
    item = shape(0, 4, 0, Solid(color))
    picture = painted([item], SQUARE, (40, 40), (opacity, 0.0), canvas)
    assert np.abs(picture[20, 20] - expected).max() <= 1


def test_a_gradient_goes_from_its_start_to_its_end() -> None:
    stops = (Stop(0.0, (0, 0, 0)), Stop(1.0, (255, 0, 0)))
    item = shape(0, 4, 0, Gradient(np.zeros((2, 2)), stops))
    reds = painted([item], [*SQUARE, (10, 0), (30, 0)], (40, 40))[20, :, 0]
    expected = np.clip((np.arange(40) + 0.5 - 10) / 20, 0, 1) * 255
    assert np.abs(reds - expected)[2:38].max() <= 1


def test_a_line_is_as_wide_as_it_says_with_round_ends() -> None:
    item = shape(0, 2, 0, WHITE, stroke=True)
    mask = painted([item], [(12.0, 20.0), (28.0, 20.0)], (40, 40), (1.0, 8.0))[..., 0] / 255
    assert mask[:, 20].sum() == pytest.approx(8, abs=0.02)
    assert mask.sum() == pytest.approx(16 * 8 + np.pi * 16, rel=0.02)


def test_what_is_seen_through_an_opening_ends_at_its_edge_without_a_seam() -> None:
    half = [(2.5, 2.0), (38.0, 2.0), (38.0, 38.0), (2.5, 38.0)]
    green, red = Solid((0, 255, 0)), Solid((255, 0, 0))
    content = (shape(4, 4, 1, green), shape(4, 4, 2, red))
    opening = Opening(shape(0, 4, 0), content)
    wide = [(0.0, 0.0), (40.0, 0.0), (40.0, 40.0), (0.0, 40.0)]
    picture = painted([opening], [*half, *wide], (40, 40))
    assert picture[20, 20].tolist() == [255, 0, 0]
    assert picture[20, 2].tolist() == [128, 0, 0], "no green below the red at the edge"
    assert not picture[20, :2].any()


def test_a_hidden_opening_hides_all_that_is_in_it() -> None:
    items = [Opening(shape(0, 4, 0), (shape(0, 4, 1),)), shape(0, 4, 2, Solid((9, 9, 9)))]
    picture = painted(items, SQUARE, (40, 40), (0.0, 0.0, 1.0, 0.0, 1.0, 0.0))
    assert picture[20, 20].tolist() == [9, 9, 9]


def test_openings_in_openings_have_an_end() -> None:
    item: Item = shape(0, 4, 0)
    for _ in range(DEEPEST + 1):
        item = Opening(shape(0, 4, 0), (item,))
    with pytest.raises(HriError, match=f"keep to {DEEPEST}"):
        painted([item], SQUARE, (40, 40))


# --- machine code that is kept ---


def twice(number: int) -> int:
    return 2 * number


def test_kept_machine_code_that_is_damaged_is_made_anew(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(numba.config, "CACHE_DIR", "")
    assert compiled(twice)(3) == 6
    kept = [file for file in (tmp_path / "hri" / "compiled").rglob("*") if file.is_file()]
    assert kept
    for file in kept:
        file.write_bytes(b"")
    assert compiled(twice)(4) == 8


def test_without_a_folder_to_keep_it_in_machine_code_is_made_all_the_same(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path / "file"))
    only = "UserProvidedCacheLocator"  # numba 0.61 knows no such setting
    monkeypatch.setattr(numba.config, "CACHE_LOCATOR_CLASSES", only, raising=False)
    assert compiled(twice)(5) == 10


# --- captions ---


def test_a_caption_is_written_at_the_bottom_only() -> None:
    picture = Renderer(MODEL, SIZE).render(still_vector(MODEL))
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
