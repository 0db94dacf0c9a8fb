"""Following hands with detectors that know where they are: costs, owners, and bad input."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.errors import NotAvailable
from hri.core.models import folder_of
from hri.core.signals import FaceBox, Frame, HeadPose, Image, People, Person
from hri.vision.camera_view import CameraView
from hri.vision.detectors.hand_mesh import FittedHand, HandMesh, region_of_hand
from hri.vision.detectors.mesh import Region
from hri.vision.detectors.palm import FoundPalm, PalmDetector
from hri.vision.engagement import Zones
from hri.vision.face_models import FACE, HAND, PALM
from hri.vision.hands.hand_tracker import INCOME, LOOK_COST, SAVED, SEARCH_COST, HandTracker
from hri.vision.hands.reach import owner_of
from hri.vision.tracking.people import Seeing
from tests.recorded import picture
from tests.vision.hands.test_hand_shape import drawn

SIZE = (640, 480)
RATE = 15.0
ALL = (0, 1, 2, 3, 4)
FACE_BOX = FaceBox(280, 80, 80, 80)
MODELS = folder_of(FACE.name)


def image(seed: int = 0) -> Image:
    return np.random.default_rng(seed).integers(90, 120, (SIZE[1], SIZE[0], 3)).astype(np.uint8)


def person(id: str = "p1", box: FaceBox = FACE_BOX) -> Person:
    return Person(id, HeadPose(0.0, 0.0, 0.0, box=box))


@dataclass
class Hands:
    """Palm detector and mesh of hands at known places; how often they were asked."""

    places: Sequence[tuple[float, float]] = ((200.0, 150.0),)
    presence: float = 0.95
    searches: int = 0
    looks: int = 0
    costs: list[float] = field(default_factory=list)

    def find(self, image: Image, part: Region) -> list[FoundPalm]:
        self.searches += 1
        self.costs.append(SEARCH_COST)
        points = np.zeros((7, 2), np.float32)
        found = []
        for x, y in self.places:
            if max(abs(x - part.x), abs(y - part.y)) < part.side / 2:
                placed = points + np.array((x, y), np.float32)
                placed[0, 1] += 20
                placed[2, 1] -= 20
                found.append(FoundPalm(FaceBox(x - 25, y - 25, 50, 50), 0.9, placed))
        return found

    def fit(self, image: Image, region: Region) -> FittedHand | None:
        self.looks += 1
        self.costs.append(LOOK_COST)
        away = [math.hypot(region.x - x, region.y - y) for x, y in self.places]
        if not away or min(away) > region.side:
            return FittedHand(drawn(*ALL), 0.0, 0.5)
        x, y = self.places[int(np.argmin(away))]
        points = drawn(*ALL, size=50)
        middle = points[[0, 9], :2].mean(axis=0)
        points[:, :2] += np.array((x, y), np.float32) - middle
        return FittedHand(points, self.presence, 0.9)

    def tracker(self) -> HandTracker:
        return HandTracker(self, self, CameraView())  # type: ignore[arg-type]


def watch(
    hands: Hands, seconds: float = 4.0, persons: Sequence[Person] = (person(),)
) -> list[People]:
    tracker, found = hands.tracker(), []
    for number in range(round(seconds * RATE)):
        time = number / RATE
        people = People(time, tuple(persons), "p1")
        found.append(tracker.see(Frame(image(number % 2), time, number), people))
    return found


def test_a_hand_of_someone_is_found_and_described() -> None:
    (shown,) = watch(Hands())[-1].persons[0].hands
    assert (shown.side, shown.shape, shown.fingers, shown.number) == ("left", "open", 5, 1)
    assert shown.bearing > 0.1
    assert shown.is_palm


def test_a_hand_far_from_everyone_is_of_nobody() -> None:
    assert watch(Hands(places=[(600.0, 460.0)], presence=0.9))[-1].persons[0].hands == ()


def test_what_does_not_fit_is_no_hand() -> None:
    assert watch(Hands(presence=0.3))[-1].persons[0].hands == ()


def test_nobody_has_no_hands_and_costs_nothing() -> None:
    hands = Hands()
    watch(hands, persons=())
    assert (hands.searches, hands.looks) == (0, 0)


def test_someone_has_two_hands_at_most() -> None:
    hands = Hands(places=[(180.0, 150.0), (260.0, 260.0), (440.0, 170.0)])
    last = watch(hands, seconds=8)[-1].persons[0].hands
    assert len(last) == 2
    assert len({shown.number for shown in last}) == 2


@pytest.mark.parametrize("count", [1, 4])
def test_the_cost_is_bounded_whatever_there_is_to_see(count: int) -> None:
    boxes = [FaceBox(40 + 150 * n, 80, 60, 60) for n in range(count)]
    persons = [person(f"p{n + 1}", box) for n, box in enumerate(boxes)]
    hands = Hands(places=[(box.x - 20, 160.0) for box in boxes])
    watch(hands, seconds=10, persons=persons)
    assert sum(hands.costs) <= INCOME * 10 + SAVED
    assert hands.looks > 20


@pytest.mark.parametrize("is_late", [False, True])
def test_a_picture_has_a_search_and_two_looks_at_most_and_a_late_one_a_look(is_late: bool) -> None:
    hands = Hands(places=[(180.0, 150.0), (440.0, 170.0)])
    tracker = hands.tracker()
    for number in range(90):
        before = len(hands.costs)
        frame = Frame(image(number % 2), number / RATE, number)
        late = is_late and number > 30
        tracker.see(frame, People(frame.time, (person(),)), late)
        spent = hands.costs[before:]
        assert sum(spent) <= (LOOK_COST if late else SAVED)
    assert hands.looks > 60


def raised(number: int) -> Image:
    """A room where a bright hand comes up from below within half a second, after two."""
    shown = np.full((SIZE[1], SIZE[0], 3), 100, np.uint8)
    y = round(460 - 300 * min(1.0, max(0.0, number / RATE - 2.0) / 0.5))
    shown[y - 40 : y + 40, 160:240] = 220
    return shown


def test_a_hand_that_rises_is_searched_for_at_once() -> None:
    hands = Hands(places=())
    tracker, searched = hands.tracker(), 0
    for number in range(50):
        time = number / RATE
        if number == round(2.5 * RATE):
            searched, hands.places = hands.searches, [(200.0, 160.0)]
        seen = tracker.see(Frame(raised(number), time, number), People(time, (person(),)))
        if seen.persons[0].hands:
            break
    assert time <= 2.85
    assert hands.searches > searched


def test_the_same_pictures_give_the_same_hands() -> None:
    first, second = (watch(Hands()) for _ in range(2))
    for one, other in zip(first, second, strict=True):
        hands = one.persons[0].hands, other.persons[0].hands
        assert len(hands[0]) == len(hands[1])
        for shown, again in zip(*hands, strict=True):
            assert (shown.time, shown.number, shown.side) == (again.time, again.number, again.side)
            assert (shown.landmarks == again.landmarks).all()


def test_a_hand_that_is_taken_away_is_gone() -> None:
    hands = Hands()
    tracker = hands.tracker()
    for number in range(90):
        time = number / RATE
        if time > 3:
            hands.places = ()
        seen = tracker.see(Frame(image(number % 2), time, number), People(time, (person(),)))
        if 2 < time < 3:
            assert seen.persons[0].hands
    assert seen.persons[0].hands == ()


def test_who_leaves_takes_the_hands_along() -> None:
    tracker = Hands().tracker()
    for number in range(60):
        time = number / RATE
        tracker.see(Frame(image(number % 2), time, number), People(time, (person(),)))
    other = tracker.see(
        Frame(image(), 4.1, 62), People(4.1, (person("p2", FaceBox(500, 80, 80, 80)),))
    )
    assert other.persons[0].hands == ()


def test_a_picture_that_cost_much_already_is_not_searched() -> None:
    hands = Hands()
    tracker = hands.tracker()
    for number in range(60):
        time = number / RATE
        tracker.see(Frame(image(number % 2), time, number), People(time, (person(),)), is_late=True)
    assert (hands.searches, hands.looks) == (0, 0)


@settings(max_examples=30, deadline=None)
@given(
    st.lists(
        st.tuples(
            st.floats() | st.floats(0, 5),
            st.sampled_from(["good", "small", "gray", "none", "empty", "float"]),
            st.floats(-1e5, 1e5) | st.just(math.nan),
        ),
        max_size=12,
    )
)
def test_nothing_breaks_it(steps: list[tuple[float, str, float]]) -> None:
    tracker = Hands().tracker()
    pictures = {
        "good": image(),
        "small": image()[:8, :8],
        "gray": image()[..., 0],
        "none": None,
        "empty": image()[:0],
        "float": image().astype(np.float64),
    }
    for time, kind, x in steps:
        box = FaceBox(x, 80, 80, 80)
        people = People(time, (person(box=box), replace(person("p2"), is_visible=False)))
        seen = tracker.see(Frame(pictures[kind], time, 0), people)  # type: ignore[arg-type]
        assert [one.id for one in seen.persons] == ["p1", "p2"]


@given(st.floats(0, 640), st.floats(0, 480), st.floats(1, 500))
def test_a_hand_belongs_to_who_can_reach_it(x: float, y: float, side: float) -> None:
    owner = owner_of(Region(x, y, side), [FACE_BOX, FaceBox(2000, 2000, 80, 80)])
    assert owner in (None, 0)
    if owner == 0:
        assert math.hypot(x - 320, y - 200) < 400


@pytest.fixture(scope="module")
def networks() -> tuple[PalmDetector, HandMesh]:
    if not all((MODELS / part.name).is_file() for part in (PALM, HAND)):
        pytest.skip("the networks of hands are not here: hri models fetch face")
    return PalmDetector(MODELS / PALM.name), HandMesh(MODELS / HAND.name)


def test_the_hand_in_a_portrait_is_found_and_fits(
    networks: tuple[PalmDetector, HandMesh],
) -> None:
    palms, mesh = networks
    portrait = picture("obama")
    height, width = portrait.shape[:2]
    (palm, *_) = palms.find(portrait, Region(0.6 * width, 0.7 * height, 0.7 * height))
    region = Region(
        palm.box.x + palm.box.width / 2, palm.box.y + palm.box.height / 2, 3 * palm.box.width, 0.6
    )
    fitted = mesh.fit(portrait, region)
    assert fitted is not None
    again = mesh.fit(portrait, region_of_hand(fitted.landmarks))
    assert again is not None
    assert again.presence > 0.5
    assert 0.6 < again.landmarks[:, 0].mean() / width < 0.95
    assert 0.6 < again.landmarks[:, 1].mean() / height < 0.9


def film() -> list[Frame]:
    """A portrait with a hand, before which the camera trembles."""
    whole = picture("obama")
    step = max(1, whole.shape[0] // 600)
    small = whole[::step, ::step]
    frames = []
    for number in range(40):
        x, y = round(4 + 4 * math.sin(number)), round(4 + 4 * math.cos(2 * number))
        shown = np.ascontiguousarray(small[y : y + small.shape[0] - 8, x : x + small.shape[1] - 8])
        frames.append(Frame(shown, number / RATE, number))
    return frames


def seen_by(seeing: Seeing) -> list[tuple[float, int, str, bytes]]:
    see = seeing()
    shown = [see(frame) for frame in film()]
    return [
        (people.time, hand.number, hand.side, hand.landmarks.tobytes())
        for people in shown
        for one in people.persons
        for hand in one.hands
    ]


def test_one_film_gives_the_same_hands_twice(
    face_models: Path, networks: tuple[PalmDetector, HandMesh]
) -> None:
    seeing = Seeing("auto", CameraView(), Zones(), hands=True)
    first = seen_by(seeing)
    assert first
    assert seen_by(seeing) == first


@pytest.mark.parametrize("name", ["brick", "coffee", "rocket"])
def test_no_hand_is_where_there_is_none(name: str, networks: tuple[PalmDetector, HandMesh]) -> None:
    palms, mesh = networks
    empty = picture(name)
    height, width = empty.shape[:2]
    for palm in palms.find(empty, Region(width / 2, height / 2, max(height, width))):
        region = Region(palm.box.x, palm.box.y, 3 * palm.box.width)
        fitted = mesh.fit(empty, region)
        assert fitted is None or fitted.presence < 0.5


def test_what_is_no_picture_or_lies_outside_has_no_hand(
    networks: tuple[PalmDetector, HandMesh],
) -> None:
    palms, mesh = networks
    good, bad = Region(100, 100, 200), Region(math.nan, 100, 200)
    for shown in (np.zeros((0, 5, 3), np.uint8), np.zeros((100, 100), np.uint8)):
        assert palms.find(shown, good) == []
        assert mesh.fit(shown, good) is None
    for part in (bad, Region(-5, 5, 100), Region(100, 100, math.inf)):
        assert palms.find(image(), part) == []
        assert mesh.fit(image(), part) is None


def test_another_network_is_refused(tmp_path: Path) -> None:
    (tmp_path / "other.tflite").write_bytes(b"no network")
    for network in (PalmDetector, HandMesh):
        with pytest.raises(NotAvailable, match="hri models fetch face"):
            network(tmp_path / "other.tflite")
