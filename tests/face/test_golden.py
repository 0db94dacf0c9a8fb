"""The default face as it was approved, region by region.

`python -m tests.face.test_golden` draws the pictures in golden/robot anew; look at each of them.
"""

from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from hri.face.renderers.renderer import Renderer
from hri.face.still import still_vector
from tests.face.pixels import MODEL

GOLDEN = Path(__file__).parent / "golden" / "robot"
SIZE = (320, 240)
FRAME = (slice(46, 200), slice(85, 235))
"""What is kept of such a picture: the face without its shell."""
REGIONS = {"brows": slice(0, 40), "eyes": slice(34, 92), "mouth": slice(86, 154)}
"""Rows of that."""
LOOKS: dict[str, dict[str, object]] = {
    **{label: {"expression": label} for label in (
        "neutral", "happy", "sad", "angry", "surprised", "scared", "disgusted", "asleep",
        "thinking", "error", "guilty", "annoyed",
    )},
    "FF": {"viseme": "FF"},
    "TH": {"viseme": "TH"},
    "oh while happy": {"expression": "happy", "viseme": "oh"},
    "turned": {"yaw": 25.0, "pitch": -10.0, "gaze": (-0.8, 0.3)},
}  # fmt: skip


def drawn(name: str) -> NDArray[np.uint8]:
    picture = Renderer(MODEL, SIZE).render(still_vector(MODEL, **LOOKS[name]))  # type: ignore[arg-type]
    return np.asarray(picture[FRAME], np.uint8)


def file_of(name: str) -> Path:
    return GOLDEN / f"{name.replace(' ', '-')}.png"


@pytest.mark.parametrize("name", LOOKS)
def test_the_face_stays_as_it_was_approved(name: str, tmp_path: Path) -> None:
    golden = cv2.imread(str(file_of(name)))
    assert golden is not None, "python -m tests.face.test_golden draws it"
    difference = np.abs(drawn(name)[..., ::-1].astype(int) - golden)
    for region, rows in REGIONS.items():
        if difference[rows].mean() >= 0.5 or np.quantile(difference[rows], 0.999) >= 24:
            seen = tmp_path / file_of(name).name
            cv2.imwrite(str(seen), np.minimum(8 * difference, 255))
            pytest.fail(f"the {region} changed: {seen} shows eight times the difference")


def test_a_slight_change_of_a_region_is_noticed() -> None:
    with_less = still_vector(MODEL, "happy", 0.93)
    picture = Renderer(MODEL, SIZE).render(with_less)[FRAME]
    difference = np.abs(picture.astype(int) - drawn("happy"))
    assert difference[REGIONS["mouth"]].mean() > 0.5


if __name__ == "__main__":
    GOLDEN.mkdir(parents=True, exist_ok=True)
    for name in LOOKS:
        cv2.imwrite(str(file_of(name)), drawn(name)[..., ::-1])
