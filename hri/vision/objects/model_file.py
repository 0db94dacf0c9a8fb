"""Model sets as files: `NAME.mdl`, and lists of names.

The container is a ZIP archive that is stored without compression; one that another tool deflated
is read, too. `model_set.json` in it has the
keys `format` (1), `method` and `objects`; an object has `name`, `learned`, `views` and perhaps
`attributes` (numbers and texts by name); a view has `picture`, `points` and `descriptors` (names of
entries of the archive), `outline` (pairs of pixels), `scale` (meters to a pixel) and `source`. A
picture is a JPEG; points are rows of two float32, descriptors rows of uint8, both without any
header. All of it, each entry as often as it is named and each picture as it is decoded, has at most
`LARGEST` bytes.

A file of text is a list of names instead, one a line, with comments from "#": its objects have the
labels of these names (`printed_label`), which things of the simulated room bear.
"""

from __future__ import annotations

import io
import json
import os
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image as PillowImage

from hri.core import paths
from hri.core.errors import HriError
from hri.core.privacy import folder_for
from hri.core.reading import opened, parse_json, read_text
from hri.core.signals import Image
from hri.core.stored_data_index import note
from hri.core.writing import PRIVATE, write_bytes
from hri.core.zip_archive import opened_archive, unpacked_size
from hri.hal.drivers.image_size import count_scans, read_header
from hri.vision.objects.cutout import whole
from hri.vision.objects.learning import MOST_VIEWS, view_of
from hri.vision.objects.local_features import METHODS, SIFT, Features
from hri.vision.objects.object_attributes import Attributes, checked_attributes
from hri.vision.objects.object_model import ModelSet, ObjectModel, View
from hri.vision.objects.printed_label import SIZE, WIDTH, printed_label

KIND = "config/models"
SUFFIX = ".mdl"
OWN = f"objects{SUFFIX}"
MANIFEST = "model_set.json"
FORMAT = 1
MOST_OBJECTS = 1000
LONGEST_NAME = 60
MOST_NAMES = 150
"""Of a list of names: the features of a label take some time to find."""
LARGEST = 150_000_000
"""Bytes of a set in memory and as a file; sixty objects that were shown from eight sides."""
LARGEST_GROWTH = 5
"""Times that unpacking may swell a set: pictures and descriptors hardly pack at all."""
LONGEST_DIRECTORY = 4_000_000
"""Bytes of the directory of an archive."""
LARGEST_MANIFEST = 4_000_000
LARGEST_ENTRY = 4_000_000
LARGEST_SIDE = 2000
"""Pixels of a picture."""
MOST_SCANS = 20
"""Of a JPEG: each goes over the whole picture, however short it is."""
FORMATS, MODES = ("JPEG", "PNG"), ("L", "RGB")
"""Of pictures: what is written, and gray or color of 8 bits from elsewhere."""
MOST_FEATURES = 10_000
"""Of a view."""
MOST_CORNERS = 1000
FARTHEST = 1e4
"""Pixels of a point from the corner of its picture."""
QUALITY = 92
"""Of the pictures, as JPEG has it."""
REMEDY = 'name a set that "hri object learn" wrote, or a list of names'


def find_models(name: str) -> Path:
    """The file of a set: a path, or a name in `config/models`; `OWN` is the user's own set, which
    may not be there yet. Raises HriError.
    """
    name = name if name.endswith(SUFFIX) else name + SUFFIX
    return own_models() if name == OWN else paths.find(KIND, name)


def own_models() -> Path:
    """The set of the objects that the user has taught, which is private. Raises HriError."""
    return paths.data_folder() / OWN


def load_models(path: Path, method: str = SIFT) -> ModelSet:
    """Read a set; a list of names gets features of `method`. Raises HriError with what is wrong."""
    with opened(path, "model set", LARGEST) as file:
        if file.read(4) != b"PK\x03\x04":
            return _of_names(path, method)
        file.seek(0)
        try:
            with opened_archive(file, LONGEST_DIRECTORY) as archive:
                return _Reader(path, archive, os.fstat(file.fileno()).st_size).read()
        except ValueError as error:
            raise HriError(f"{path}: this model set is damaged: {error} - {REMEDY}") from error


def load_or_new(path: Path, method: str = SIFT) -> ModelSet:
    """A set; an empty one of this method where there is no file yet. Raises HriError."""
    return load_models(path, method) if paths.exists(path) else ModelSet(method)


def save_models(path: Path, models: ModelSet) -> None:
    """Write a set that only its owner may read; an old file stays whole until the new one is.

    Raises HriError.
    """
    if len(models.objects) > MOST_OBJECTS:
        raise _too_large(path, f"{MOST_OBJECTS} objects")
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_STORED) as archive:
        objects = []
        for number, model in enumerate(models.objects):
            views = [
                _write_view(archive, f"{number:04d}-{index:02d}", view)
                for index, view in enumerate(model.views)
            ]
            more = {"attributes": dict(model.attributes)} if model.attributes else {}
            objects.append({"name": model.name, "learned": model.learned, "views": views} | more)
        manifest = {"format": FORMAT, "method": models.method, "objects": objects}
        text = json.dumps(manifest, ensure_ascii=False).encode(errors="replace")
        _put(archive, MANIFEST, text)
    decoded = sum(view.picture.nbytes for model in models.objects for view in model.views)
    if buffer.tell() + decoded > LARGEST or len(text) > LARGEST_MANIFEST:
        raise _too_large(path, f"{LARGEST:,} bytes")
    folder_for(path)
    write_bytes(path, buffer.getvalue(), PRIVATE)
    note("objects", path)


def _too_large(path: Path, most: str) -> HriError:
    return HriError(f"{path}: a set holds at most {most} - split it: hri object split")


def _write_view(archive: zipfile.ZipFile, stem: str, view: View) -> dict[str, object]:
    picture = np.ascontiguousarray(view.picture[..., ::-1])
    _, coded = cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, QUALITY])
    entries = {
        "picture": (f"{stem}.jpg", coded.tobytes()),
        "points": (f"{stem}.points", view.features.points.astype("<f4").tobytes()),
        "descriptors": (f"{stem}.descriptors", view.features.descriptors.tobytes()),
    }
    for name, data in entries.values():
        _put(archive, name, data)
    names: dict[str, object] = {key: name for key, (name, _) in entries.items()}
    outline = [[round(float(part), 2) for part in corner] for corner in view.outline]
    return names | {"outline": outline, "scale": view.scale, "source": view.source}


def _put(archive: zipfile.ZipFile, name: str, data: bytes) -> None:
    # Without the time of day: the same set is the same file.
    archive.writestr(zipfile.ZipInfo(name), data)


def _of_names(path: Path, method: str) -> ModelSet:
    lines = read_text(path, "model set").splitlines()
    names = [name for line in lines if (name := line.partition("#")[0].strip())]
    if len(names) > MOST_NAMES:
        raise HriError(f"{path}: more than {MOST_NAMES} names - split the list")
    for number, name in enumerate(names, 1):
        if not is_name(name):
            what = f'name {number} is "{name[:LONGEST_NAME]}"'
            raise HriError(f"{path}: {what} - {NAME_REMEDY}")
    labels = [(name, printed_label(name)) for name in dict.fromkeys(names)]
    return ModelSet(
        method,
        tuple(
            ObjectModel(name, (view_of(label, whole(label), method, WIDTH / SIZE, "its label"),))
            for name, label in labels
        ),
    )


NAME_REMEDY = f"a name is a line of 1 to {LONGEST_NAME} printable characters"


def is_name(name: object) -> bool:
    """Whether an object may be named so."""
    return isinstance(name, str) and 0 < len(name) <= LONGEST_NAME and name.isprintable()


class _Reader:
    """Reads the entries of an archive, and believes none of them."""

    def __init__(self, path: Path, archive: zipfile.ZipFile, size: int) -> None:
        """`size` is that of the file in bytes."""
        self._path, self._archive = path, archive
        self._left = LARGEST
        """Bytes that may still be read, or be decoded."""
        swollen = unpacked_size(archive)
        self._require(swollen <= LARGEST_GROWTH * size, f"it swells to {swollen} bytes")
        self._left_of_file = LARGEST_GROWTH * size

    def read(self) -> ModelSet:
        try:
            manifest = parse_json(self._entry(MANIFEST, LARGEST_MANIFEST))
        except ValueError as error:
            raise self._error(f"{MANIFEST} is not JSON: {error}") from error
        self._require(isinstance(manifest, dict), f"{MANIFEST} is not an object")
        version = manifest.get("format")
        self._require(version == FORMAT, f"its format is {_brief(version)}, not {FORMAT}")
        method = manifest.get("method")
        is_known = isinstance(method, str) and method in METHODS
        self._require(is_known, f"method {_brief(method)}")
        objects = manifest.get("objects")
        self._require(isinstance(objects, list) and len(objects) <= MOST_OBJECTS, "objects")
        self._width = METHODS[method].width
        models = tuple(self._object(each) for each in objects)
        names = [model.name for model in models]
        self._require(len(set(names)) == len(names), "two objects have one name")
        return ModelSet(method, models)

    def _object(self, data: Any) -> ObjectModel:
        self._require(isinstance(data, dict), "an object is not a table")
        name, learned, views = data.get("name"), data.get("learned"), data.get("views")
        self._require(is_name(name), f"an object is named {_brief(name)}")
        is_day = isinstance(learned, str) and len(learned) <= LONGEST_NAME
        self._require(is_day and learned.isprintable(), f"{name}: learned")
        is_list = isinstance(views, list) and 0 < len(views) <= MOST_VIEWS
        self._require(is_list, f"{name}: views")
        attributes = self._attributes(name, data.get("attributes", {}))
        return ObjectModel(
            name, tuple(self._view(name, each) for each in views), learned, attributes
        )

    def _attributes(self, name: str, data: Any) -> Attributes:
        self._require(isinstance(data, dict), f"{name}: attributes")
        try:
            return checked_attributes(data)
        except HriError as error:
            raise self._error(f"{name}: {error}") from error

    def _view(self, name: str, data: Any) -> View:
        self._require(isinstance(data, dict), f"{name}: a view is not a table")
        picture = self._picture(name, data)
        points = self._array(name, data, "points", 8).view("<f4").reshape(-1, 2)
        self._require(bool((np.abs(points) < FARTHEST).all()), f"{name}: points")
        descriptors = self._array(name, data, "descriptors", self._width)
        descriptors = descriptors.reshape(-1, self._width)
        is_even = len(points) == len(descriptors) <= MOST_FEATURES
        self._require(is_even, f"{name}: {len(points)} points, {len(descriptors)} descriptors")
        scale, source = data.get("scale"), data.get("source")
        is_scale = isinstance(scale, (int, float)) and 0 <= scale <= 10
        self._require(is_scale, f"{name}: scale")
        self._require(isinstance(source, str) and len(source) <= 1000, f"{name}: source")
        features = Features(points.astype(np.float32), descriptors)
        return View(picture, self._outline(name, data), features, float(scale), source)

    def _picture(self, name: str, data: Mapping[str, Any]) -> Image:
        raw = self._named(name, data, "picture")
        header = read_header(io.BytesIO(raw))
        is_usual = header is not None and header.format in FORMATS and header.mode in MODES
        if header is None or not is_usual or count_scans(io.BytesIO(raw)) > MOST_SCANS:
            raise self._error(f"{name}: a picture is not a usual JPEG or PNG")
        width, height = header.size
        self._require(max(width, height) <= LARGEST_SIDE, f"{name}: a picture is too large")
        self._spend(3 * width * height)
        try:
            with PillowImage.open(io.BytesIO(raw), formats=FORMATS) as stored:
                return np.asarray(stored.convert("RGB"), np.uint8)
        except Exception as error:  # of what Pillow raises for broken files there is no list
            raise self._error(f"{name}: a picture cannot be read") from error

    def _array(self, name: str, data: Mapping[str, Any], key: str, row: int) -> NDArray[np.uint8]:
        raw = self._named(name, data, key)
        self._require(len(raw) % row == 0, f"{name}: {key} end in the middle of a row")
        return np.frombuffer(raw, np.uint8)

    def _outline(self, name: str, data: Mapping[str, Any]) -> NDArray[np.float32]:
        outline = data.get("outline")
        if (
            not isinstance(outline, list)
            or not 3 <= len(outline) <= MOST_CORNERS
            or not all(map(_is_corner, outline))
        ):
            raise self._error(f"{name}: outline")
        return np.array(outline, np.float32)

    def _named(self, name: str, data: Mapping[str, Any], key: str) -> bytes:
        entry = data.get(key)
        if not isinstance(entry, str):
            raise self._error(f"{name}: {key}")
        return self._entry(entry, LARGEST_ENTRY)

    def _entry(self, name: str, largest: int) -> bytes:
        try:
            info = self._archive.getinfo(name)
        except KeyError as error:
            raise self._error(f"{name!r:.80} is missing") from error
        self._require(info.file_size <= largest, f"{name} is larger than {largest} bytes")
        self._left_of_file -= info.file_size
        self._require(self._left_of_file >= 0, "its parts are named again and again")
        self._spend(info.file_size)
        return self._archive.read(info)

    def _spend(self, size: int) -> None:
        self._left -= size
        self._require(self._left >= 0, f"it holds more than {LARGEST} bytes")

    def _require(self, holds: bool, what: str) -> None:
        if not holds:
            raise self._error(what)

    def _error(self, what: str) -> HriError:
        return HriError(f"{self._path}: this model set is damaged: {what} - {REMEDY}")


def _brief(value: object) -> str:
    """A value of a manifest for a message."""
    is_plain = value is None or isinstance(value, (str, int, float))
    return f"{value!r:.80}" if is_plain else f"a {type(value).__name__}"


def _is_corner(corner: object) -> bool:
    """Whether it is a pair of numbers near a picture."""
    return (
        isinstance(corner, list)
        and len(corner) == 2
        and all(isinstance(part, (int, float)) and abs(part) < FARTHEST for part in corner)
    )
