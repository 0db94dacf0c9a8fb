"""Layers of a face: pictures of some of its parts, with the background left out or not."""

from pathlib import Path

import numpy as np
import pytest

from hri.core.errors import AuthoringError, HriError
from hri.face import FaceModel, load_face, render_face
from hri.face.layers import Layers
from hri.face.lint import findings
from hri.face.renderers.renderer import Renderer
from hri.face.still import still_vector
from tests.face.small_face import write_face

LAYERS = """
[layers]
body = ["neck", "head"]
ink = ["eye*", "brow", "dark"]
"""


def face_with(tmp_path: Path, layers: str) -> FaceModel:
    folder = write_face(tmp_path / "mine")
    with (folder / "face.toml").open("a") as file:
        file.write(layers)
    return load_face(folder)


@pytest.fixture
def model(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> FaceModel:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return face_with(tmp_path, LAYERS)


@pytest.mark.parametrize("face", ["robot", "astronaut", "person", "eyes"])
@pytest.mark.parametrize("expression", ["neutral", "sad", "excited"])
def test_a_transparent_face_over_its_background_is_the_opaque_one(
    face: str, expression: str
) -> None:
    model = load_face(face)
    vector = still_vector(model, expression, viseme="aa", time=2.0)
    opaque = Renderer(model, (200, 150))
    clear = Renderer(model, (200, 150), transparent=True).render(vector).astype(float)
    alpha = clear[..., 3:] / 255
    over = clear[..., :3] * alpha + opaque.background * (1 - alpha)
    assert np.abs(over - opaque.render(vector)).max() < 4.0


def test_an_edge_is_as_opaque_as_it_is_covered_and_keeps_its_color(model: FaceModel) -> None:
    picture = Renderer(model, (64, 64), transparent=True, layers=["body"]).render(model.vector({}))
    assert picture.shape == (64, 64, 4)
    assert not picture[62, :25].any()
    assert picture[62, 26:38].tolist() == [[0x77, 0x77, 0x77, 255]] * 12
    *color, alpha = picture[62, 25].tolist()
    assert alpha == 102, "the neck begins at 25.6 pixels: 0.4 of this one is covered"
    assert color == pytest.approx([0x77] * 3, abs=1)


def test_only_the_parts_of_the_layers_are_drawn(model: FaceModel) -> None:
    vector = model.vector({"jawOpen": 1.0})
    ink, body, both = (
        Renderer(model, (100, 100), transparent=True, layers=layers).render(vector)[..., 3]
        for layers in (["ink"], ["body"], ["body", "ink"])
    )
    assert ink[45, 35] == ink[75, 50] == 255, "an eye, and the mouth in its opening"
    assert ink[50, 50] == ink[90, 50] == 0
    assert ink[85, 32] == 0, "what is seen through the lips ends at them"
    assert body[50, 50] == body[90, 50] == 255
    assert np.array_equal(both, np.maximum(body, ink))


def test_a_layer_over_the_background_is_possible_too(model: FaceModel) -> None:
    picture = render_face(model, size=(100, 100), layers=["ink"])
    assert picture.shape == (100, 100, 3)
    assert np.array_equal(picture[60, 50], Renderer(model, (100, 100)).background[60, 50])


def test_of_several_patterns_the_last_counts() -> None:
    layers = Layers({"*": "body", "eye*": "ink"})
    assert [layers.of(id) for id in ("head", "eyeLeft", "eyeLeft:stroke")] == ["body", "ink", "ink"]
    assert Layers({}).of("head") is None


def test_a_layer_that_a_face_lacks_is_refused_with_a_remedy(model: FaceModel) -> None:
    with pytest.raises(HriError, match=r'mine has no layer "face" - add face = .* to \[layers\]'):
        Renderer(model, layers=["face"])
    with pytest.raises(HriError, match=r'no layer "inks" - did you mean "ink"'):
        Renderer(model, layers=["inks"])


@pytest.mark.parametrize(
    ("layers", "what"),
    [
        ('[layers]\nbodi = ["head"]', 'no layer "bodi" - did you mean "body"'),
        ('[layers]\nbody = "head"', "body"),
        ('[layers]\nbody = ["head"]\nlit = ["inc"]', 'no layer "inc" - did you mean "ink"'),
        ('[layers]\nbody = ["head"]\nink = ["head"]', '"head" is in body and in ink'),
    ],
)
def test_a_table_that_is_wrong_is_refused_with_its_place(
    layers: str, what: str, tmp_path: Path
) -> None:
    with pytest.raises(AuthoringError) as caught:
        face_with(tmp_path, layers)
    assert what in str(caught.value)
    assert caught.value.place.line > 40


def test_a_pattern_that_fits_no_part_is_told_with_its_place(tmp_path: Path) -> None:
    model = face_with(tmp_path, '[layers]\nbody = ["head"]\nink = ["eyeRihgt"]\n')
    (finding,) = (each for each in findings(model, model.folder) if "fits no part" in each.what)
    assert '"eyeRihgt" fits no part' in finding.what
    assert 'did you mean "eyeRight"' in finding.remedy
    lines = (model.folder / "face.toml").read_text().splitlines()
    assert lines[finding.place.line - 1].startswith("ink")
