"""Model sets as files: what is written is read again, and nothing else is believed."""

import json
import os
import stat
import struct
import zipfile
import zlib
from dataclasses import replace

import cv2
import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.errors import HriError
from hri.vision.objects.local_features import METHODS, SIFT
from hri.vision.objects.model_file import (
    MANIFEST,
    MOST_NAMES,
    MOST_OBJECTS,
    find_models,
    is_name,
    load_models,
    load_or_new,
    own_models,
    save_models,
)
from hri.vision.objects.object_attributes import checked_attributes
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


def test_attributes_are_kept_and_go_with_what_is_recognized(written, tmp_path):
    models, path = load_models(written), tmp_path / "noted.mdl"
    cup, *others = models.objects
    noted = replace(cup, attributes=checked_attributes({"owner": "Ann", "price": "3.5", "n": 2}))
    save_models(path, replace(models, objects=(noted, *others)))
    again = load_models(path)
    assert again.objects[0].attributes == {"owner": "Ann", "price": 3.5, "n": 2.0}
    found = {one.name: one for one in ObjectRecognizer(again).recognize(cup.views[0].picture)}
    assert found["cup"].attributes == {"owner": "Ann", "price": 3.5, "n": 2.0}
    relearned = again.with_object(replace(cup, learned="2026-01-01")).find("cup")
    assert relearned.attributes["owner"] == "Ann"


@pytest.mark.parametrize(
    ("attributes", "message"),
    [
        ({"": 1}, "not a valid name"),
        ({"a=b": 1}, "write NAME=VALUE"),
        ({"a" * 61: 1}, "too long"),
        ({"a": float("nan")}, "finite number or a text"),
        ({"a": None}, "finite number or a text"),
        ({"a": "x" * 1001}, "shorten it"),
    ],
)
def test_what_is_no_attribute_is_refused(attributes, message):
    with pytest.raises(HriError, match=message):
        checked_attributes(attributes)


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


def noted(attributes):
    return lambda manifest: manifest["objects"][0].update(attributes=attributes)


DAMAGE = {
    "another format": (lambda m: m.update(format=2), "its format is 2, not 1"),
    "another method": (lambda m: m.update(method="surf"), "method 'surf'"),
    "objects of a wrong kind": (lambda m: m.update(objects={}), "objects"),
    "two of a name": (lambda m: m["objects"][1].update(name="cup"), "two objects have one name"),
    "no name": (lambda m: m["objects"][0].update(name=""), "an object is named ''"),
    "a name of two lines": (lambda m: m["objects"][0].update(name="a\nb"), "an object is named"),
    "no views": (lambda m: m["objects"][0].update(views=[]), "cup: views"),
    "a missing picture": (everywhere("picture", "none.jpg"), "'none.jpg' is missing"),
    "a picture that is none": (
        everywhere("picture", "0000-00.points"),
        "is not a usual JPEG or PNG",
    ),
    "points of another view": (everywhere("points", "0000-00.jpg"), "cup:"),
    "descriptors for points": (everywhere("descriptors", "0000-00.points"), "cup:"),
    "an outline of a point": (everywhere("outline", [[0, 0]]), "cup: outline"),
    "an outline without numbers": (everywhere("outline", [["a", None]] * 4), "cup: outline"),
    "an outline far away": (everywhere("outline", [[1e9, 0]] * 4), "cup: outline"),
    "a scale without sense": (everywhere("scale", float("nan")), "cup: scale"),
    "a source that is a number": (everywhere("source", 5), "cup: source"),
    "attributes that are a list": (noted([1]), "cup: attributes"),
    "an attribute that is a list": (noted({"a": [1]}), "cup: the property a is .*give a finite"),
    "an attribute of two lines": (noted({"a": "b\nc"}), "cup: the attribute a is not a line"),
    "an attribute of two words": (noted({"a b": 1}), "cup: .*is not a valid name"),
    "too many attributes": (noted({f"a{n}": n for n in range(51)}), "cup: 51 attributes"),
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
    with pytest.raises(HriError, match="it swells to 40000000 bytes"):
        load_models(path)


def with_pictures(written, path, picture, method=zipfile.ZIP_STORED):
    """The set with another file for each picture."""
    with zipfile.ZipFile(written) as old, zipfile.ZipFile(path, "w", method) as new:
        for name in old.namelist():
            new.writestr(name, picture if name.endswith(".jpg") else old.read(name))
    return path


def png(width, height, depth=8, color=2, data=b""):
    """A PNG of one color, with the header that it is given."""
    head = struct.pack(">IIBBBBB", width, height, depth, color, 0, 0, 0)
    parts = ((b"IHDR", head), (b"IDAT", data), (b"IEND", b""))
    chunks = (
        struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
        for kind, body in parts
    )
    return b"\x89PNG\r\n\x1a\n" + b"".join(chunks)


def jpeg(shape=(64, 64, 3)):
    return cv2.imencode(".jpg", np.full(shape, 99, np.uint8))[1].tobytes()


def scanned_again(times):
    """A JPEG whose only scan comes again and again."""
    whole = jpeg()
    start, end = whole.index(b"\xff\xda"), whole.rindex(b"\xff\xd9")
    return whole[:start] + whole[start:end] * times + whole[end:]


REFUSED = {
    "1 bit for each of a billion pixels": (png(32_000, 32_000, 1, 0), "usual|too large"),
    "a giant": (png(8000, 8000), "a picture is too large"),
    "a side over the limit": (png(2001, 10), "a picture is too large"),
    "16 bits": (png(10, 10, 16, 0), "usual"),
    "a palette": (png(10, 10, 8, 3), "usual"),
    "transparent": (png(10, 10, 8, 6), "usual"),
    "without pixels": (png(10, 10), "cannot be read"),
    "a GIF": (b"GIF89a\x01\x00\x01\x00\x00\x00\x00;", "usual"),
    "a WebP": (cv2.imencode(".webp", np.zeros((9, 9, 3), np.uint8))[1].tobytes(), "usual"),
    "a JPEG of many scans": (scanned_again(500), "usual"),
    "nothing": (b"", "usual"),
}


@pytest.mark.parametrize("what", REFUSED)
def test_a_picture_is_looked_at_before_it_is_decoded(written, tmp_path, what):
    picture, reason = REFUSED[what]
    for method in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        path = with_pictures(written, tmp_path / "odd.mdl", picture, method)
        with pytest.raises(HriError, match=rf"damaged: .*{reason}"):
            load_models(path)


def test_gray_pictures_and_png_are_read(written, tmp_path):
    for picture in (jpeg((40, 30)), cv2.imencode(".png", np.zeros((40, 30, 3), "u1"))[1].tobytes()):
        models = load_models(with_pictures(written, tmp_path / "other.mdl", picture))
        assert models.objects[0].views[0].picture.shape == (40, 30, 3)


def test_a_set_that_another_tool_deflated_is_read(written, tmp_path):
    with zipfile.ZipFile(written) as old:
        path = with_pictures(written, tmp_path / "a.mdl", jpeg(), zipfile.ZIP_DEFLATED)
        assert path.stat().st_size < sum(entry.file_size for entry in old.infolist())
    assert [model.name for model in load_models(path).objects] == ["cup", "key"]


@pytest.mark.parametrize("method", [zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_only_stored_and_deflated_entries_are_taken(written, tmp_path, method):
    path = with_pictures(written, tmp_path / "packed.mdl", jpeg(), method)
    with pytest.raises(HriError, match="packed in an unusual way"):
        load_models(path)


def test_entries_that_are_named_again_count_again(written, tmp_path):
    def multiply(manifest):
        view = manifest["objects"][0]["views"][0]
        manifest["objects"] = [
            {"name": f"thing {n}", "learned": "", "views": [view] * 12} for n in range(1000)
        ]

    with pytest.raises(HriError, match="named again and again"):
        load_models(changed(written, tmp_path, multiply))


def test_all_pictures_together_are_bounded(written, tmp_path):
    """Each is small in the file and large in memory."""
    large = jpeg((2000, 2000, 3))
    path = tmp_path / "many.mdl"
    with zipfile.ZipFile(written) as old, zipfile.ZipFile(path, "w") as new:
        manifest = json.loads(old.read(MANIFEST))
        view = manifest["objects"][0]["views"][0]
        for number in range(20):
            new.writestr(f"{number}.jpg", large)
        views = [view | {"picture": f"{number}.jpg"} for number in range(20)]
        manifest["objects"] = [
            {"name": "one", "learned": "", "views": views[:10]},
            {"name": "two", "learned": "", "views": views[10:]},
        ]
        for name in old.namelist():
            new.writestr(name, json.dumps(manifest) if name == MANIFEST else old.read(name))
    with pytest.raises(HriError, match="it holds more than 150000000 bytes"):
        load_models(path)


def test_a_directory_that_is_longer_than_any_set_needs_is_not_read(tmp_path):
    path = tmp_path / "many.mdl"
    entry = b"PK\x01\x02" + bytes(42)
    count = 200_000
    end = struct.pack("<4s4H2IH", b"PK\x05\x06", 0, 0, 65535, 65535, 46 * count, 4, 0)
    path.write_bytes(b"PK\x03\x04" + entry * count + end)
    with pytest.raises(HriError, match="its directory has more than 4000000 bytes"):
        load_models(path)


def test_damage_of_the_packed_data_is_one_line(written, tmp_path):
    path = with_pictures(written, tmp_path / "deflated.mdl", jpeg(), zipfile.ZIP_DEFLATED)
    raw = bytearray(path.read_bytes())
    for at in range(60, len(raw), 97):
        broken = bytearray(raw)
        broken[at : at + 9] = b"\xff" * 9
        path.write_bytes(broken)
        assert_read_or_refused(path)


def test_an_encrypted_set_is_refused(written, tmp_path):
    raw = bytearray(written.read_bytes())
    for signature, flags in ((b"PK\x03\x04", 6), (b"PK\x01\x02", 8)):
        at = -1
        while (at := raw.find(signature, at + 1)) >= 0:
            raw[at + flags] |= 1
    path = tmp_path / "secret.mdl"
    path.write_bytes(raw)
    with pytest.raises(HriError, match=r"damaged: .*password"):
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
    path.write_text("\n".join(f"thing {n}" for n in range(MOST_NAMES + 1)))
    with pytest.raises(HriError, match="more than 150 names"):
        load_models(path)


def test_a_set_that_could_not_be_read_again_is_not_written(tmp_path, monkeypatch):
    monkeypatch.setattr("hri.vision.objects.model_file.LARGEST", 200_000)
    path = tmp_path / "large.mdl"
    save_models(path, learned("cup"))
    assert load_models(path).objects[0].name == "cup"
    with pytest.raises(HriError, match="at most 200,000 bytes - split it"):
        save_models(path, learned("cup", "key", "box"))


def test_a_failed_write_leaves_the_old_set(written, tmp_path):
    path = tmp_path / "set.mdl"
    path.write_bytes(written.read_bytes())
    with pytest.raises(HriError):
        save_models(path, ModelSet(SIFT, learned("cup").objects * (MOST_OBJECTS + 1)))
    assert [model.name for model in load_models(path).objects] == ["cup", "key"]
