import math
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.errors import NotAvailable
from hri.core.fetch.archive import Part
from hri.core.signals import FaceBox, Image
from hri.simulation.people.actors import ACTORS, Appearance, render_people
from hri.vision.detectors import yunet
from hri.vision.detectors.blazeface import BlazeFace
from hri.vision.detectors.detector_choice import load_detectors
from hri.vision.detectors.face import FoundFace, is_same, merged, overlap
from hri.vision.detectors.flow import FaceFlow
from hri.vision.detectors.haar import HaarDetector
from hri.vision.detectors.preprocessing import Gray, evened, gray_picture
from hri.vision.detectors.yunet import YuNet
from hri.vision.face_models import DETECTOR, MESH
from tests.vision.film import render_head

BOX = FaceBox(120, 90, 80, 80)
NO_PICTURES = [
    np.zeros((240, 320), np.uint8),
    np.zeros((240, 320, 4), np.uint8),
    np.zeros((240, 320, 3), np.uint16),
    np.zeros((240, 320, 3), np.float32),
    np.zeros((1, 1, 3), np.uint8),
    np.zeros((0, 0, 3), np.uint8),
    np.zeros((40, 10_000, 3), np.uint8),
    None,
    "picture",
]


def view(
    pitch: float = 0.0,
    yaw: float = 0.0,
    center: tuple[float, float] = (160.0, 120.0),
    height: float = 105.0,
) -> Gray:
    """The person's head, angles in degrees."""
    image = render_head(math.radians(pitch), math.radians(yaw), 0.0, center=center, height=height)
    picture = gray_picture(image)
    assert picture is not None
    return picture.gray


def people(*persons: Appearance) -> Image:
    return render_people(persons, (640, 480))


def middle(box: FaceBox) -> tuple[float, float]:
    return box.x + box.width / 2, box.y + box.height / 2


def test_a_large_picture_becomes_small_and_a_small_one_stays() -> None:
    large = gray_picture(np.zeros((480, 640, 3), np.uint8))
    small = gray_picture(np.zeros((240, 320, 3), np.uint8)[:, ::-1])
    assert large is not None
    assert small is not None
    assert (large.gray.shape, large.scale) == ((240, 320), 2.0)
    assert (small.gray.shape, small.scale) == ((240, 320), 1.0)


@pytest.mark.parametrize("image", NO_PICTURES)
def test_what_is_no_picture_is_none_and_holds_no_face(image: object) -> None:
    assert gray_picture(image) is None  # type: ignore[arg-type]
    assert HaarDetector().find(image) == []  # type: ignore[arg-type]


@pytest.mark.parametrize("image", NO_PICTURES)
def test_blazeface_finds_nothing_in_what_is_no_picture(image: Image, blazeface: BlazeFace) -> None:
    assert blazeface.find(image) == []


@given(st.integers(0, 255))
def test_an_evened_picture_is_bright_where_it_was_dark_and_stays_within_its_range(
    level: int,
) -> None:
    bright = evened(np.full((40, 40, 3), level, np.uint8))
    assert bright.min() >= level / 255 - 1e-6
    assert bright.max() <= 1
    assert bright.mean() > 0.9 or level < 235 / 8


class TestBlazeFace:
    @pytest.mark.parametrize("actor", ACTORS)
    @pytest.mark.parametrize("height", [100, 240])
    def test_finds_every_face_with_its_eyes_and_nose(
        self, blazeface: BlazeFace, actor: str, height: float
    ) -> None:
        (face,) = blazeface.find(people(Appearance(actor, center=(330, 240), height=height)))
        x, y = middle(face.box)
        assert math.hypot(x - 330, y - 240) < 0.25 * height
        assert face.points is not None
        right, left, nose = face.points[:3]
        assert right[0] < nose[0] < left[0]
        assert max(right[1], left[1]) < nose[1]

    @pytest.mark.parametrize("light", [0.4, 0.15])
    def test_finds_a_face_in_the_dark(self, blazeface: BlazeFace, light: float) -> None:
        bright = people(Appearance("mei", center=(300, 240), height=140))
        noise = np.random.default_rng(0).normal(0, 4, bright.shape)
        dark = np.clip(bright * light + noise, 0, 255).astype(np.uint8)
        assert len(blazeface.find(dark)) == 1

    @pytest.mark.parametrize("roll", [-45, 45])
    def test_finds_a_head_laid_aside(self, blazeface: BlazeFace, roll: float) -> None:
        leaned = Appearance("ada", roll=math.radians(roll), center=(320, 240), height=180)
        face = blazeface.find(people(leaned))[0]
        assert face.points is not None
        x, y = face.points[1] - face.points[0]
        assert math.degrees(math.atan2(y, x)) == pytest.approx(roll, abs=12)

    def test_finds_four_people_at_once(self, blazeface: BlazeFace) -> None:
        centers = [(90, 200), (240, 260), (400, 220), (550, 250)]
        image = people(
            *(
                Appearance(actor, center=center, height=115)
                for actor, center in zip(ACTORS, centers, strict=False)
            )
        )
        found = sorted(middle(face.box) for face in blazeface.find(image))
        assert len(found) == 4
        for (x, y), center in zip(found, centers, strict=True):
            assert math.hypot(x - center[0], y - center[1]) < 40

    @pytest.mark.parametrize("height", [25, 36, 64])
    def test_finds_a_far_face(self, blazeface: BlazeFace, height: float) -> None:
        image = people(Appearance("bruno", center=(470, 150), height=height))
        found = [middle(face.box) for face in blazeface.find(image)]
        assert any(math.hypot(x - 470, y - 150) < 20 for x, y in found)

    def test_finds_a_face_that_fills_the_picture(self, blazeface: BlazeFace) -> None:
        image = people(Appearance("ada", center=(320, 240), height=470))
        assert blazeface.find(image)

    def test_finds_the_same_in_a_much_larger_picture(self, blazeface: BlazeFace) -> None:
        small = people(Appearance("ada", center=(320, 240), height=200))
        large = cv2.resize(small, None, fx=6, fy=6, interpolation=cv2.INTER_NEAREST)
        (face,), (giant,) = blazeface.find(small), blazeface.find(np.asarray(large, np.uint8))
        box = face.box
        grown = FaceBox(6 * box.x, 6 * box.y, 6 * box.width, 6 * box.height)
        assert overlap(grown, giant.box) > 0.7

    def test_finds_no_face_in_an_empty_room_and_none_in_noise(self, blazeface: BlazeFace) -> None:
        noise = np.random.default_rng(0).integers(0, 255, (480, 640, 3), np.uint8)
        for image in (noise, noise // 20, np.zeros((480, 640, 3), np.uint8)):
            assert blazeface.find(image) == []

    def test_what_it_finds_does_not_depend_on_what_it_saw_before(
        self, blazeface: BlazeFace
    ) -> None:
        image = people(Appearance("bruno", center=(470, 150), height=64))

        def boxes() -> list[FaceBox]:
            return [face.box for face in blazeface.find(image)]

        first = boxes()
        blazeface.find(people(Appearance("ada", center=(330, 240))))
        assert boxes() == first


BOXES = st.builds(FaceBox, *[st.floats(0, 200)] * 2, *[st.floats(1, 100)] * 2)
FOUND = st.lists(st.builds(FoundFace, BOXES, st.floats(0.1, 1)), max_size=8)


@given(BOXES, BOXES)
def test_overlap_is_symmetric_and_whole_for_the_same_box(first: FaceBox, second: FaceBox) -> None:
    assert overlap(first, second) == pytest.approx(overlap(second, first))
    assert 0 <= overlap(first, second) <= 1 + 1e-9
    assert overlap(first, first) == pytest.approx(1)
    assert is_same(first, second) == is_same(second, first)


@given(FOUND)
def test_merging_does_not_depend_on_the_order_and_keeps_the_surest_first(
    found: list[FoundFace],
) -> None:
    faces = merged(found)
    assert len(faces) <= len(found)
    assert bool(faces) == bool(found)
    scores = [face.score for face in faces]
    assert scores == sorted(scores, reverse=True)
    assert [face.score for face in merged(reversed(found))] == scores


def test_findings_of_one_face_become_its_average() -> None:
    near = [FoundFace(FaceBox(100 + i, 100, 50, 50), 0.8) for i in (0, 4)]
    other = FoundFace(FaceBox(300, 100, 50, 50), 0.9)
    first, second = merged([*near, other])
    assert first == other
    box = second.box
    assert [box.x, box.y, box.width, box.height] == pytest.approx([102, 100, 50, 50])


class TestHaar:
    @pytest.mark.parametrize("height", [70, 105, 160])
    def test_finds_the_face_at_all_poses_of_a_conversation(self, height: float) -> None:
        detector = HaarDetector()
        for pitch in (-20, 0, 20):
            for yaw in (-20, 0, 20):
                image = render_head(
                    math.radians(pitch), math.radians(yaw), 0, center=(160, 120), height=height
                )
                (face,) = detector.find(image)
                x, y = middle(face.box)
                assert math.hypot(x - 160, y - 125) < height / 3

    def test_finds_two_people_in_pixels_of_the_picture(self) -> None:
        image = people(
            Appearance("ada", center=(170, 240), height=200),
            Appearance("bruno", center=(470, 240), height=200),
        )
        found = sorted(middle(face.box)[0] for face in HaarDetector().find(image))
        assert found == [pytest.approx(170, abs=20), pytest.approx(470, abs=20)]

    def test_finds_no_face_in_an_empty_room_or_in_noise(self) -> None:
        noise = np.random.default_rng(0).integers(0, 255, (240, 320, 3), np.uint8)
        empty = render_head(0, 0, 0, center=(2000, 0), height=105)
        assert HaarDetector().find(empty) == HaarDetector().find(noise) == []


class FoundByYuNet:
    """What OpenCV's detector answers, in its own layout."""

    def setInputSize(self, size: tuple[int, int]) -> None:
        self.size = size

    def detect(self, image: Image) -> tuple[int, np.ndarray | None]:
        if not image.any():
            return 0, None
        assert image.shape[1::-1] == self.size
        points = [110, 100, 150, 100, 130, 120, 115, 140, 145, 140]
        return 1, np.array([[100, 80, 60, 70, *points, 0.9]], np.float32)


class TestYuNet:
    @pytest.mark.parametrize("content", [b"", b"onnx", bytes(range(256)) * 40])
    def test_refuses_a_damaged_file(self, tmp_path: Path, content: bytes) -> None:
        file = tmp_path / "yunet.onnx"
        file.write_bytes(content)
        with pytest.raises(NotAvailable, match=r"yunet\.onnx: .* - take face_detection_yunet"):
            YuNet(file)

    def test_refuses_another_network_and_what_is_no_file(
        self, tmp_path: Path, face_models: Path
    ) -> None:
        for file in (face_models / MESH.name, tmp_path, tmp_path / "nowhere", Path("a\0b")):
            with pytest.raises(NotAvailable, match="take face_detection_yunet"):
                YuNet(file)

    def test_tells_faces_in_pixels_of_the_picture(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        file = tmp_path / "yunet.onnx"
        file.write_bytes(b"any")
        monkeypatch.setattr(
            yunet.cv2.FaceDetectorYN, "create", lambda *_: FoundByYuNet(), raising=True
        )
        finder = YuNet(file)
        (face,) = finder.find(np.full((480, 640, 3), 9, np.uint8))
        assert face.box == FaceBox(200, 160, 120, 140)
        assert face.score == pytest.approx(0.9)
        assert face.points is not None
        assert face.points.tolist() == [[220, 200], [300, 200], [260, 240], [260, 280]]
        assert finder.find(np.zeros((480, 640, 3), np.uint8)) == []
        assert finder.find(np.zeros((480, 640), np.uint8)) == []


class TestLoading:
    @pytest.fixture(autouse=True)
    def home(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
        monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
        folder = tmp_path / "hri" / "models" / "face"
        folder.mkdir(parents=True)
        return folder

    def put(self, folder: Path, face_models: Path) -> None:
        for part in (DETECTOR, MESH):
            (folder / part.name).write_bytes((face_models / part.name).read_bytes())

    def test_takes_the_networks_when_they_are_here(self, home: Path, face_models: Path) -> None:
        self.put(home, face_models)
        loaded = load_detectors()
        assert isinstance(loaded.finder, BlazeFace)
        assert loaded.mesh is not None
        assert loaded.problems == ()
        assert isinstance(load_detectors("haar").finder, HaarDetector)

    def test_takes_the_cascade_without_them_and_tells_how_to_get_them(self, home: Path) -> None:
        home.rmdir()
        loaded = load_detectors()
        assert isinstance(loaded.finder, HaarDetector)
        assert loaded.mesh is None
        (problem,) = loaded.problems
        assert "hri models fetch face" in problem

    @pytest.mark.parametrize("part", [DETECTOR, MESH], ids=["detector", "mesh"])
    @pytest.mark.parametrize("size", [0, 5000, -1])
    def test_a_damaged_file_costs_what_it_is_for(
        self, home: Path, face_models: Path, part: Part, size: int
    ) -> None:
        self.put(home, face_models)
        file = home / part.name
        content = bytearray(file.read_bytes()[: size if size >= 0 else None])
        content[-1:] = bytes([content[-1] ^ 1]) if content else b""
        file.write_bytes(content)
        loaded = load_detectors()
        (problem,) = loaded.problems
        assert str(file) in problem
        assert "hri models fetch face" in problem
        assert (loaded.mesh is None) == (part is MESH)
        assert isinstance(loaded.finder, HaarDetector if part is DETECTOR else BlazeFace)

    @pytest.mark.parametrize("folder", ["~", "~nobody-of-this-name"])
    def test_a_lost_yunet_is_told_and_replaced(
        self, home: Path, face_models: Path, folder: str
    ) -> None:
        self.put(home, face_models)
        loaded = load_detectors(f"{folder}/nowhere/yunet.onnx")
        assert isinstance(loaded.finder, BlazeFace)
        assert loaded.mesh is not None
        (problem,) = loaded.problems
        assert "nowhere/yunet.onnx" in problem or "home" in problem


class TestFlow:
    def test_of_a_face_that_moves_or_comes_nearer(self) -> None:
        flow = FaceFlow()
        flow.start(view(), BOX)
        shift = flow.follow(view(center=(163, 118)))
        assert shift is not None
        assert (shift.x, shift.y) == (pytest.approx(3, abs=0.3), pytest.approx(-2, abs=0.3))
        assert abs(shift.growth) < 0.01
        nearer = flow.follow(view(center=(163, 118), height=110))
        assert nearer is not None
        assert nearer.growth == pytest.approx(110 / 105 - 1, abs=0.015)

    def test_of_a_head_that_turns(self) -> None:
        flow = FaceFlow()
        flow.start(view(), BOX)
        turned = flow.follow(view(yaw=5))
        bowed = flow.follow(view(yaw=5, pitch=4))
        assert turned is not None
        assert bowed is not None
        assert turned.x > 2 > abs(turned.y), "to the person's left is to the right of the picture"
        assert bowed.y > 1.5 > abs(bowed.x)
        assert abs(turned.growth) < 0.01

    def test_knows_when_it_cannot_tell(self) -> None:
        flow = FaceFlow()
        assert flow.follow(view()) is None
        flow.start(np.full((240, 320), 128, np.uint8), BOX)
        assert flow.follow(view()) is None
        flow.start(view(), BOX)
        assert flow.follow(view()[:200]) is None, "a picture of another size"
        for box in (FaceBox(-90, -90, 50, 50), FaceBox(900, 90, 50, 50), FaceBox(9, 9, 0, 0)):
            flow.start(view(), box)
            assert flow.follow(view()) is None
        flow.start(view(), BOX)
        assert flow.follow(np.random.default_rng(0).integers(0, 255, (240, 320), np.uint8)) is None
