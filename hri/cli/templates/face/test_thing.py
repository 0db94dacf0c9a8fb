from pathlib import Path

from hri.face import load_face, render_face

FACE = Path(__file__).parent / "faces" / "thing"


def test_every_expression_can_be_seen():
    neutral = render_face(FACE)
    for label in load_face(FACE).expressions:
        assert label == "neutral" or (render_face(FACE, label) != neutral).any(), label
