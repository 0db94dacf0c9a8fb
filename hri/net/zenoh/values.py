"""Values of ports as bytes: MessagePack (msgpack.org), read back against the class of a datatype.

A picture travels as a JPEG, sound as 16 bit samples. What does not have the class that was agreed
on is refused, with the field that is wrong.
"""

from __future__ import annotations

import io
import math
from functools import cache
from typing import Any

import cv2
import msgspec
import numpy as np
import PIL.Image

from hri.behavior.ports import ANY, DATATYPES
from hri.core.errors import HriError
from hri.core.signals import Frame

LONGEST = 4 << 20
"""Bytes of a value."""
MOST_PIXELS = 4096
"""Of a side of a picture that arrives."""
DEEPEST_ARRAY = 3
"""Dimensions of an array that arrives."""
QUALITY = 85
"""Of the JPEG of a picture, of 100."""
_ARRAYS = {"int16": np.int16, "float32": np.float32, "float64": np.float64, "uint8": np.uint8}
"""Types of numbers in arrays that travel."""


class _Array(msgspec.Struct, array_like=True, forbid_unknown_fields=True):
    """An array of numbers."""

    kind: str
    shape: tuple[int, ...]
    numbers: bytes


class _Picture(msgspec.Struct, array_like=True, forbid_unknown_fields=True):
    """A frame of the camera; its time is that of the sender."""

    jpeg: bytes
    time: float
    sequence: int


class Row(msgspec.Struct, array_like=True, forbid_unknown_fields=True, frozen=True):
    """A value as it travels."""

    address: str
    made: float
    """Seconds of the sender's clock."""
    datatype: str
    """Empty for "there is none"."""
    data: bytes
    meaning: str = ""
    """Of the port that it comes from, such as `Evolution.LinearVelocity`; empty for whatever."""

    def value(self) -> Any:
        """The value itself; None for none. Raises HriError as `read` does."""
        return read(self.datatype, self.data) if self.datatype else None


def row(address: str, value: Any, made: float, meaning: str = "") -> Row:
    """A value as it travels. Raises HriError for one that cannot."""
    if value is None:
        return Row(address, made, "", b"")
    datatype = datatype_of(value)
    return Row(address, made, datatype, written(datatype, value), meaning)


def rows_of(data: bytes) -> list[Row]:
    """The values in a message. Raises HriError for a damaged one."""
    try:
        return msgspec.msgpack.decode(data, type=list[Row])
    except (ValueError, RecursionError) as error:
        raise HriError(f"these values are damaged: {error}") from error


def datatype_of(value: Any) -> str:
    """The name of the datatype of a value. Raises HriError for one that has none."""
    kind = float if type(value) is int else type(value)
    for name, known in DATATYPES.items():
        if known is kind and name != ANY:
            return name
    raise HriError(f"a {kind.__name__} cannot travel - link something else")


def written(datatype: str, value: Any) -> bytes:
    """The bytes of a value. Raises HriError for one that is too long or cannot travel."""
    try:
        if isinstance(value, Frame):
            value = _picture(value)
        data = _encoder().encode(value)
    except (TypeError, ValueError, OverflowError, cv2.error) as error:
        raise HriError(f"a {datatype} cannot travel: {error} - link something else") from error
    if len(data) > LONGEST:
        raise HriError(f"a {datatype} of {len(data)} bytes cannot travel - it may have {LONGEST}")
    return data


def read(datatype: str, data: bytes) -> Any:
    """The value of bytes that someone else wrote. Raises HriError for any that is not of the
    datatype, not finite where it is a number, or too long.
    """
    if datatype == ANY or datatype not in DATATYPES:
        raise HriError(f'"{datatype}" cannot travel - name a datatype')
    if len(data) > LONGEST:
        raise HriError(f"{len(data)} bytes are too many for a {datatype} - {LONGEST} are the limit")
    try:
        if DATATYPES[datatype] is Frame:
            return _frame(_decoder(_Picture).decode(data))
        value = _decoder(DATATYPES[datatype]).decode(data)
    except (ValueError, TypeError, RecursionError, OverflowError, OSError, cv2.error) as error:
        raise HriError(f"these bytes are not a {datatype}: {error}") from error
    if isinstance(value, float) and math.isnan(value):
        raise HriError("NaN is not a number that travels")
    return tuple(map(_number, value)) if datatype == "doublearray" else value


def _number(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or math.isnan(value):
        raise HriError(f"{value!r:.40} is not a number of an array")
    return float(value)


@cache
def _encoder() -> msgspec.msgpack.Encoder:
    return msgspec.msgpack.Encoder(enc_hook=_as_plain)


@cache
def _decoder(kind: Any) -> msgspec.msgpack.Decoder[Any]:
    return msgspec.msgpack.Decoder(kind, dec_hook=_as_array)


def _as_plain(value: Any) -> Any:
    """An array, a number of NumPy, or a mark (a bare object) as MessagePack has it."""
    if isinstance(value, np.ndarray) and value.dtype.name in _ARRAYS:
        return _Array(value.dtype.name, value.shape, np.ascontiguousarray(value).tobytes())
    if isinstance(value, np.floating | np.integer | np.bool_):
        return value.item()
    if type(value) is object:
        return None
    raise TypeError(f"it holds a {type(value).__name__}")


def _as_array(kind: Any, value: Any) -> Any:
    """What an annotation of NumPy, such as `Samples`, stands for; of a mark nothing is left."""
    if kind is object:
        return None
    array = msgspec.convert(value, _Array)
    if array.kind not in _ARRAYS or not 0 < len(array.shape) <= DEEPEST_ARRAY:
        raise ValueError(f"an array of {array.kind!r:.20} with {len(array.shape)} dimensions")
    numbers = np.frombuffer(array.numbers, _ARRAYS[array.kind])
    return numbers.reshape(array.shape)


def _picture(frame: Frame) -> _Picture:
    done, jpeg = cv2.imencode(
        ".jpg", cv2.cvtColor(frame.image, cv2.COLOR_RGB2BGR), (cv2.IMWRITE_JPEG_QUALITY, QUALITY)
    )
    if not done:
        raise ValueError("no JPEG can be made of it")
    return _Picture(jpeg.tobytes(), frame.time, frame.sequence)


def _frame(picture: _Picture) -> Frame:
    """The frame of a picture. Raises ValueError for what is not one, or is too large."""
    with PIL.Image.open(io.BytesIO(picture.jpeg), formats=("JPEG",)) as header:
        if max(header.size) > MOST_PIXELS:
            raise ValueError(f"a picture of {header.width} x {header.height} pixels")
    image = cv2.imdecode(np.frombuffer(picture.jpeg, np.uint8), cv2.IMREAD_COLOR)
    if image is None:
        raise ValueError("a picture that cannot be read")
    rgb = np.asarray(cv2.cvtColor(image, cv2.COLOR_BGR2RGB), np.uint8)
    return Frame(rgb, picture.time, picture.sequence)
