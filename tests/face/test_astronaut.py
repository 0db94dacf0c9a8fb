"""The astronaut as it was approved."""

import numpy as np
import pytest

from hri.core.signals import Image
from hri.face.renderers.renderer import Renderer
from hri.face.still import still_vector
from hri.testing.golden import Golden, difference
from tests.face.pixels import MODEL

SIZE = (320, 240)
FRAME = (slice(46, 200), slice(85, 235))
"""What is kept of such a picture: the face without its shell."""
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


def drawn(**look: object) -> Image:
    picture = Renderer(MODEL, SIZE).render(still_vector(MODEL, **look))  # type: ignore[arg-type]
    return np.ascontiguousarray(picture[FRAME])


@pytest.mark.parametrize("name", LOOKS)
def test_the_face_stays_as_it_was_approved(name: str, golden: Golden) -> None:
    golden.check(name, drawn(**LOOKS[name]))


def test_a_slight_change_is_noticed() -> None:
    happy, less = drawn(expression="happy"), drawn(expression="happy", intensity=0.93)
    assert "tiles changed" in difference(less, happy)
    assert difference(happy, happy) == ""
