"""Model sets as files: what is written is read again, and nothing else is believed."""

import json
import os
import stat
import zipfile

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.errors import HriError
from hri.vision.objects.local_features import METHODS, SIFT
from hri.vision.objects.model_file import (
    MANIFEST,
    MOST_OBJECTS,
    find_models,
    is_name,
    load_models,
    load_or_new,
    own_models,
    save_models,
)
from hri.vision.objects.object_model import ModelSet
from hri.vision.objects.recognizer import ObjectRecognizer
from tests.vision.objects.pictures import VIEW, learned, standing


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    path = tmp_path_factory.mktemp("sets") / "kitchen.mdl"
    save_models(path, learned("cup", "key"))
    return path


def changed(written, tmp_path, change):
    """The set with a changed manifest."""
    path = tmp_path / "changed.mdl"
    with zipfile.ZipFile(written) as old, zipfile.ZipFile(path, "w") as new:
        manifest = json.loads(old.read(MANIFEST))
        change(manifest)
        for name in old.namelist():
            new.writestr(name, json.dumps(manifest) if name == MANIFEST else old.read(name))
    return path


@pytest.mark.proves("R08")
@pytest.mark.parametrize("method", METHODS)
def test_what_is_written_is_read_again(tmp_path, method):
    path, models = tmp_path / "set.mdl", learned("cup", "Søren's \u00e9tui", method=method)
    save_models(path, models)
    read = load_models(path)
    assert [one.name for one in read.objects] == ["cup", "Søren's \u00e9tui"]
    for model, again in zip(models.objects, read.objects, strict=True):
        for view, same in zip(model.views, again.views, strict=True):
            assert np.array_equal(view.features.points, same.features.points)
            assert np.array_equal(view.features.descriptors, same.features.descriptors)
            assert same.outline == pytest.approx(view.outline, abs=0.01)
            assert (same.scale, same.source) == (view.scale, view.source)
    (found,) = ObjectRecognizer(read, VIEW).recognize(standing("cup", 0.7))
    assert found.name == "cup"


def test_the_same_set_is_the_same_file_and_private(written, tmp_path):
    again = tmp_path / "again.mdl"
    save_models(again, learned("cup", "key"))
    assert again.read_bytes() == written.read_bytes()
    assert stat.S_IMODE(os.stat(again).st_mode) == 0o600


def test_a_list_of_names_has_their_labels(tmp_path):
    path = tmp_path / "names.mdl"
    path.write_text("# the kitchen\ncup\n\nkey  # the spare one\ncup\n")
    assert [model.name for model in load_models(path).objects] == ["cup", "key"]


def test_a_set_without_a_file_is_empty(tmp_path):
    assert load_or_new(tmp_path / "new.mdl") == ModelSet(SIFT)


def test_the_own_set_lies_with_the_users_data():
    assert own_models().name == "objects.mdl"


def test_an_unknown_set_is_refused_with_where_it_was_looked_for():
    with pytest.raises(HriError, match=r"nowhere\.mdl"):
        find_models("nowhere")


@given(st.data())
def test_a_damaged_set_is_refused_in_a_line_or_read(written, tmp_path_factory, data):
    raw = bytearray(written.read_bytes())
    for _ in range(data.draw(st.integers(1, 8))):
        raw[data.draw(st.integers(0, len(raw) - 1))] = data.draw(st.integers(0, 255))
    path = tmp_path_factory.getbasetemp() / "damaged.mdl"
    path.write_bytes(raw)
    assert_read_or_refused(path)


@given(st.integers(0, 10_000_000))
def test_a_set_that_was_cut_is_refused(written, tmp_path_factory, length):
    raw = written.read_bytes()
    path = tmp_path_factory.getbasetemp() / "cut.mdl"
    path.write_bytes(raw[: length % len(raw)])
    assert_read_or_refused(path)


@given(st.binary(max_size=300))
def test_foreign_bytes_are_refused_or_are_names(tmp_path_factory, raw):
    path = tmp_path_factory.getbasetemp() / "foreign.mdl"
    path.write_bytes(raw)
    assert_read_or_refused(path)


def assert_read_or_refused(path):
    message = ""
    try:
        models = load_models(path)
    except HriError as error:
        message = str(error)
    else:
        assert all(is_name(model.name) for model in models.objects)
    assert "\n" not in message
    assert not message or path.name in message


def everywhere(key, value):
    def change(manifest):
        manifest["objects"][0]["views"][0][key] = value

    return change


DAMAGE = {
    "another format": (lambda m: m.update(format=2), "its format is 2, not 1"),
    "another method": (lambda m: m.update(method="surf"), "method 'surf'"),
    "objects of a wrong kind": (lambda m: m.update(objects={}), "objects"),
    "two of a name": (lambda m: m["objects"][1].update(name="cup"), "two objects have one name"),
    "no name": (lambda m: m["objects"][0].update(name=""), "an object is named ''"),
    "a name of two lines": (lambda m: m["objects"][0].update(name="a\nb"), "an object is named"),
    "no views": (lambda m: m["objects"][0].update(views=[]), "cup: views"),
    "a missing picture": (everywhere("picture", "none.jpg"), "'none.jpg' is missing"),
    "a picture that is none": (everywhere("picture", "0000-00.points"), "cannot be read"),
    "points of another view": (everywhere("points", "0000-00.jpg"), "cup:"),
    "descriptors for points": (everywhere("descriptors", "0000-00.points"), "cup:"),
    "an outline of a point": (everywhere("outline", [[0, 0]]), "cup: outline"),
    "an outline without numbers": (everywhere("outline", [["a", None]] * 4), "cup: outline"),
    "an outline far away": (everywhere("outline", [[1e9, 0]] * 4), "cup: outline"),
    "a scale without sense": (everywhere("scale", float("nan")), "cup: scale"),
    "a source that is a number": (everywhere("source", 5), "cup: source"),
}


@pytest.mark.parametrize("what", DAMAGE)
def test_every_damage_is_named(written, tmp_path, what):
    change, message = DAMAGE[what]
    with pytest.raises(HriError, match=r"this model set is damaged: .*" + message):
        load_models(changed(written, tmp_path, change))


def test_a_bomb_is_not_unpacked(tmp_path):
    path = tmp_path / "bomb.mdl"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(MANIFEST, b" " * 40_000_000)
    assert path.stat().st_size < 100_000
    with pytest.raises(HriError, match="is larger than"):
        load_models(path)


def test_deep_json_is_refused(tmp_path):
    path = tmp_path / "deep.mdl"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr(MANIFEST, "[" * 100_000)
    with pytest.raises(HriError, match="is not JSON"):
        load_models(path)


def test_more_objects_than_a_set_holds_are_refused(tmp_path):
    one = learned("cup").objects[0]
    path = tmp_path / "many.mdl"
    with pytest.raises(HriError, match="at most 1000 objects - split it"):
        save_models(path, ModelSet(SIFT, (one,) * (MOST_OBJECTS + 1)))
    path.write_text("\n".join(f"thing {n}" for n in range(MOST_OBJECTS + 1)))
    with pytest.raises(HriError, match="more than 1000 names"):
        load_models(path)


def test_a_failed_write_leaves_the_old_set(written, tmp_path):
    path = tmp_path / "set.mdl"
    path.write_bytes(written.read_bytes())
    with pytest.raises(HriError):
        save_models(path, ModelSet(SIFT, learned("cup").objects * (MOST_OBJECTS + 1)))
    assert [model.name for model in load_models(path).objects] == ["cup", "key"]
