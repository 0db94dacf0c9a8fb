"""Colors on films of real scenes, blurred and noisy; a film gives the same in any process."""

from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import cv2
import numpy as np
import pytest

from hri.behavior.behavior import Context
from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.core.signals import Frame
from hri.hal.resource_manager import ResourceManager
from hri.simulation.people.actors import ACTORS, Appearance, render_people
from hri.simulation.people.lens import Lens
from hri.vision.color.color_behaviors import ColorSegmentation
from hri.vision.color.color_constancy import chromaticity
from hri.vision.color.color_model import find_color, learn_color, save_color
from hri.vision.color.segmentation import LIKELY, ColorSegmenter, tables_of
from hri.vision.color.skin import skin_samples, skin_table
from hri.vision.detectors.haar import HaarDetector
from tests.behavior.library.ticking import tick
from tests.recorded import SHARED, needs_shared, picture

GREEN = (40, 190, 70)
SIZE = (640, 480)
COUNT = 40
RADIUS = 26


def place(number):
    """Of the ball's center, pixels: it flies from the left to the right."""
    return 60 + 13 * number, round(380 - 14 * number + 0.28 * number**2)


def film(name, color=GREEN, seed=3):
    """A ball of a color flies before a photograph; it is blurred by its own motion."""
    scene = cv2.resize(picture(name), SIZE, interpolation=cv2.INTER_AREA)
    lens = Lens(noise=5.0, flicker=0.05, blur=1.0, seed=seed)
    for number in range(COUNT):
        ball = np.zeros((SIZE[1], SIZE[0]), np.float32)
        for part in (-0.25, -0.1, 0.1, 0.25):
            center = tuple(round(16 * value) for value in place(number + part))
            drawn = np.zeros_like(ball)
            cv2.circle(drawn, center, 16 * RADIUS, 1.0, -1, cv2.LINE_AA, 4)
            ball += drawn / 4
        image = scene + ball[..., None] * (np.array(color, np.float32) - scene)
        yield lens.take(image.astype(np.uint8), number)


@pytest.fixture(scope="module")
def ball(tmp_path_factory):
    """Learned from the first picture of another film."""
    path, (x, y) = tmp_path_factory.mktemp("colors") / "ball.color", place(0)
    first = next(film("brick", seed=8))
    save_color(path, learn_color("ball", [(first, [(x - 15, y - 15, 30, 30)])]))
    return path


@pytest.mark.proves("R10")
@pytest.mark.parametrize("name", ["brick", "chelsea", "coffee", "rocket"])
def test_a_ball_that_flies_before_a_real_scene_is_found_in_each_picture(ball, name):
    segmenter = ColorSegmenter(tables_of([ball]))
    for number, image in enumerate(film(name)):
        (found,) = segmenter.segment(image)
        assert (found.x, found.y) == pytest.approx(place(number), abs=4)
        assert found.area == pytest.approx(np.pi * RADIUS**2, rel=0.25)


@pytest.mark.parametrize("name", ["brick", "chelsea", "rocket"])
def test_a_scene_without_the_ball_has_no_blob(ball, name):
    lens, scene = Lens(noise=5.0, seed=4), picture(name)
    segmenter = ColorSegmenter(tables_of([ball]))
    assert all(segmenter.segment(lens.take(scene, number)) == () for number in range(10))


def seen(path):
    """What the behavior sends for each picture of a film."""
    clock = FakeClock()
    with ResourceManager([], clock) as resources:
        behavior = ColorSegmentation("colors", colors=str(path))
        behavior.check()
        behavior.start(Context(clock, EventBus(clock), resources))
        sent = []
        for number, image in enumerate(film("chelsea")):
            clock.advance(0.1)
            frame = Frame(image, clock.now(), number)
            sent.append(tick(behavior, now=clock.now(), image=frame)["blobs"])
        behavior.stop()
    return sent


@pytest.mark.proves("R10")
def test_a_film_gives_the_same_twice_and_in_another_process(ball):
    first = seen(ball)
    assert len(first) == COUNT
    assert all(blobs.found for blobs in first)
    assert seen(ball) == first
    with ProcessPoolExecutor(1, get_context("spawn")) as pool:
        assert pool.submit(seen, ball).result() == first


@pytest.mark.proves("R10")
@pytest.mark.parametrize("scene", [1, 2])
@pytest.mark.parametrize("actor", ACTORS)
def test_skin_of_everyone_is_found_light_or_dark(actor, scene):
    lens = Lens(2.5, seed=1)
    image = lens.take(render_people([Appearance(actor)], (320, 240), scene), 0)
    (face,) = (one.box for one in HaarDetector().find(image))
    table = skin_table(*skin_samples(image, [face]))
    levels = chromaticity(image).chroma
    is_skin = table.ratios[levels[..., 0], levels[..., 1]] >= LIKELY
    down = slice(round(face.y + 0.3 * face.height), round(face.y + 0.8 * face.height))
    across = slice(round(face.x + face.width / 4), round(face.x + face.width * 3 / 4))
    assert is_skin[down, across].mean() > 0.7
    assert is_skin[: round(face.y - face.height / 2)].mean() < 0.03


@needs_shared("vision/stills")
def test_blobs_of_real_pictures_lie_within_them_and_are_likely():
    for file in sorted((SHARED / "vision/stills").glob("*.*g")):
        image = cv2.cvtColor(cv2.imread(str(file)), cv2.COLOR_BGR2RGB)
        height, width = image.shape[:2]
        for blob in ColorSegmenter(tables_of([find_color("red_ball")])).segment(image):
            assert 0 <= blob.x < width
            assert 0 <= blob.y < height
            assert 0.001 * width * height <= blob.area <= width * height
            assert 0 <= blob.confidence <= 0.6, "there is no red ball"
