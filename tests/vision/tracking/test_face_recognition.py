import json
import stat
import warnings

import numpy as np
import pytest

from hri.core.errors import AuthoringError, HriError
from hri.vision.tracking.face_recognition import SIDE, Acquaintances, FaceRecognizer, aligned
from tests.vision.stage import Player, Spot, Stage, landmarks_at
from tests.vision.tracking.test_people import ANNA, BEN


class Colors:
    """An embedding of a kind: the mean colors of the crop, in quarters."""

    def embed(self, crop):
        assert crop.shape == (SIDE, SIDE, 3)
        assert crop.dtype == np.uint8
        half = SIDE // 2
        parts = [crop[y : y + half, x : x + half] for y in (0, half) for x in (0, half)]
        return np.array([part.mean(axis=(0, 1)) for part in parts]).ravel() - 128


def picture(clothes, spot=None):
    spot = spot or Spot(160, 100, 60)
    return Stage([Player(lambda time: spot, **clothes)]).image(), landmarks_at(spot)


@pytest.mark.proves("R11")
def test_who_was_named_is_recognized_and_others_are_not():
    recognizer = FaceRecognizer(Colors(), Acquaintances(alike=0.95))
    assert recognizer.name(*picture(ANNA)) == ""
    recognizer.learn("Anna", *picture(ANNA))
    assert recognizer.name(*picture(ANNA, Spot(100, 120, 80))) == "Anna"
    assert recognizer.name(*picture(BEN)) == ""
    recognizer.learn("Ben", *picture(BEN))
    assert recognizer.name(*picture(BEN)) == "Ben"
    assert recognizer.known.names == ["Anna", "Ben"]


def test_a_name_can_be_forgotten_and_all_of_them():
    recognizer = FaceRecognizer(Colors(), Acquaintances())
    recognizer.learn("Anna", *picture(ANNA))
    assert recognizer.known.forget("Anna")
    assert not recognizer.known.forget("Anna")
    assert recognizer.name(*picture(ANNA)) == ""
    recognizer.learn("Anna", *picture(ANNA))
    recognizer.known.forget_all()
    assert recognizer.known.names == []


def test_nothing_is_written_unless_asked_and_then_for_the_owner_alone(tmp_path):
    path = tmp_path / "private" / "faces.json"
    known = Acquaintances()
    known.learn("Anna", np.array([1.0, 0.0]))
    assert not path.exists()
    known.save(path)
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    again = Acquaintances.load(path)
    assert again.name_of(np.array([2.0, 0.1])) == "Anna"
    again.forget_all()
    again.save(path)
    assert json.loads(path.read_text()) == {}


TOO_LARGE = (
    '{"Anna": [' + "1," * 50 + "1]}",
    '{"Anna": [[' + "1," * 20_000 + "1]]}",
    '{"Anna": [' + "[1]," * 50 + "[1]]}",
    '{"Anna": [' + "[[]]," * 600_000 + "1]}",
)
"""What would take minutes or gigabytes."""


@pytest.mark.parametrize(
    "text", ["{", "[1]", '{"Anna": 3}', '{"Anna": [["x"]]}', '{"": [[1]]}', *TOO_LARGE]
)
def test_a_damaged_file_is_told(tmp_path, text):
    path = tmp_path / "faces.json"
    path.write_text(text)
    with pytest.raises(AuthoringError, match="learn the names again"):
        Acquaintances.load(path)
    assert Acquaintances.load(tmp_path / "none.json").names == []


@pytest.mark.parametrize("number", ["1e39", "1e30"])
def test_numbers_too_large_for_a_face_are_refused_without_a_warning(tmp_path, number):
    path = tmp_path / "faces.json"
    path.write_text(f'{{"Anna": [[{number}, {number}]]}}')
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(AuthoringError, match="learn the names again"):
            Acquaintances.load(path)


def test_a_file_that_cannot_be_read_or_written_is_told(tmp_path):
    with pytest.raises(HriError, match="not a regular file"):
        Acquaintances.load(tmp_path)
    with pytest.raises(HriError, match="cannot be written"):
        Acquaintances().save(tmp_path)
    (tmp_path / "faces.json").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(AuthoringError, match="learn the names again"):
        Acquaintances.load(tmp_path / "faces.json")


def test_a_vector_may_come_as_a_row_of_a_table():
    known = Acquaintances()
    for name, vector in (("Anna", [[1.0, 0.0]]), ("Ben", [[0.0, 1.0]])):
        known.learn(name, np.array(vector))
    assert known.name_of(np.array([[0.9, 0.1]])) == "Anna"


@pytest.mark.parametrize(
    ("name", "vector"), [("", [1.0]), ("Anna", [0.0, 0.0]), ("Anna", [np.nan]), ("Ben", [1.0] * 3)]
)
def test_what_is_no_name_or_no_vector_is_refused(name, vector):
    known = Acquaintances()
    known.learn("Cara", np.array([1.0, 0.0]))
    with pytest.raises(HriError):
        known.learn(name, np.array(vector))


def test_the_memory_of_a_name_is_bounded():
    known = Acquaintances()
    for angle in range(100):
        known.learn("Anna", np.array([np.cos(angle), np.sin(angle)]))
    assert len(known._samples["Anna"]) == 20


def test_the_crop_is_upright_and_has_the_face_where_networks_want_it():
    for spot in (Spot(160, 100, 60), Spot(60, 150, 40), Spot(5, 5, 90)):
        image, landmarks = picture(ANNA, spot)
        crop = aligned(image, landmarks)
        assert crop.shape == (SIDE, SIDE, 3)
    image, landmarks = picture(ANNA)
    assert np.abs(aligned(image, landmarks)[60, 56].astype(int) - (200, 150, 130)).max() < 12
    turned, middle = image.transpose(1, 0, 2)[:, ::-1], landmarks.copy()
    middle[:, 0], middle[:, 1] = image.shape[0] - 1 - landmarks[:, 1], landmarks[:, 0]
    difference = aligned(turned, middle).astype(int) - aligned(image, landmarks)
    assert np.abs(difference).mean() < 3, "a rolled head gives the same crop"
