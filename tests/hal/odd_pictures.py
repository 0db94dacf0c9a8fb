"""One picture in every kind of file: what must be seen is always the same.

Each row of TABLE is a name, what makes the file, what must be seen, and by how many levels it may
differ. docs/vision.md says the same in words.
"""

import io
import struct
from collections.abc import Callable, Iterator, Mapping

import cv2
import numpy as np
from PIL import Image as PillowImage, ImageCms

from hri.hal.drivers.still_image import ORIENTATION

HEIGHT, WIDTH = 48, 64
DOWN, ACROSS = np.mgrid[0:HEIGHT, 0:WIDTH]
COLOR = np.dstack([ACROSS * 4, DOWN * 5, ACROSS + DOWN]).astype(np.uint8)
GRAY = np.asarray(PillowImage.fromarray(COLOR).convert("L"))
OPAQUE = np.where(ACROSS < 20, 0, 255).astype(np.uint8)
"""Its left part is transparent."""
BITS = np.where(ACROSS // 8 % 2 == DOWN // 8 % 2, 255, 0).astype(np.uint8)
EXACT, ROUNDED, LOSSY = 0, 1, 20

Picture = np.ndarray
Row = tuple[str, bytes, Picture, int]

UPRIGHT: Mapping[int, Callable[[Picture], Picture]] = {
    1: lambda seen: seen,
    2: lambda seen: seen[:, ::-1],
    3: lambda seen: seen[::-1, ::-1],
    4: lambda seen: seen[::-1],
    5: lambda seen: seen.swapaxes(0, 1),
    6: lambda seen: np.rot90(seen, -1),
    7: lambda seen: np.rot90(seen)[:, ::-1],
    8: np.rot90,
}
"""By the orientation of EXIF, which is how the camera was held."""


def tiff(samples: Picture, orientation: int = 1, photometric: int = 2, kind: int = 1) -> bytes:
    """A plain TIFF of any numbers; `kind` is 1 without a sign, 2 with one, 3 with a point."""
    height, width = samples.shape[:2]
    channels = samples.shape[2] if samples.ndim == 3 else 1
    data, bits = samples.tobytes(), 8 * samples.itemsize
    tags = {256: width, 257: height, 259: 1, 262: photometric, 274: orientation, 277: channels}
    tags |= {258: [bits] * channels, 278: height, 279: len(data), 339: [kind] * channels}
    if channels in (2, 4):
        tags[338] = 2
    tags[273] = 0
    place = 8 + 2 + 12 * len(tags) + 4
    lists = b""
    entries = b""
    for tag, value in sorted(tags.items()):
        values = value if isinstance(value, list) else [value]
        if tag == 273:
            values = [place + 4 * channels]
        form = "I" if tag in (273, 279) else "H"
        packed = struct.pack(f"<{len(values)}{form}", *values)
        if len(packed) > 4:
            lists, packed = lists + packed, struct.pack("<I", place + len(lists))
        entries += struct.pack("<HHI", tag, 4 if form == "I" else 3, len(values)) + packed[
            :4
        ].ljust(4, b"\0")
    head = b"II*\0" + struct.pack("<IH", 8, len(tags))
    return head + entries + bytes(4) + lists.ljust(4 * channels, b"\0") + data


def coded(suffix: str, samples: Picture) -> bytes:
    """As OpenCV writes it, from RGB, RGBA, or gray."""
    if samples.ndim == 3:
        order = [2, 1, 0, 3][: samples.shape[2]]
        samples = np.ascontiguousarray(samples[..., order])
    return cv2.imencode(suffix, samples)[1].tobytes()


def saved(picture: Picture | PillowImage.Image, kind: str, **options: object) -> bytes:
    """As Pillow writes it."""
    file = io.BytesIO()
    if not isinstance(picture, PillowImage.Image):
        picture = PillowImage.fromarray(picture)
    picture.save(file, kind, **options)
    return file.getvalue()


def wide(samples: Picture, bits: int, dtype: type = np.uint16) -> Picture:
    """The same with white as the largest number of so many bits."""
    return np.rint(samples / 255 * (2.0**bits - 1)).astype(dtype)


def text_of(magic: bytes, samples: Picture, white: int) -> bytes:
    """A plain PGM or PPM."""
    numbers = " ".join(map(str, samples.ravel())).encode()
    return magic + b" %d %d %d\n" % (WIDTH, HEIGHT, white) + numbers


def depths() -> Iterator[Row]:
    """What only uses some bits of 16 is scaled by those, what declares its white by that."""
    for bits in (8, 10, 12, 14, 16):
        gray, color = wide(GRAY, bits), wide(COLOR, bits)
        for suffix in (".png", ".tif", ".pgm"):
            yield f"gray of {bits} in 16 bits{suffix}", coded(suffix, gray), GRAY, EXACT
        for suffix in (".png", ".tif", ".ppm"):
            yield f"color of {bits} in 16 bits{suffix}", coded(suffix, color), COLOR, EXACT
        if bits > 8:
            white = 2**bits - 1
            dark = np.rint(GRAY / 8)
            size = b" %d %d %d\n" % (WIDTH, HEIGHT, white)
            told = wide(dark, bits).astype(">u2").tobytes()
            yield (
                f"dark, white is {white}.pgm",
                b"P5" + size + told,
                dark,
                ROUNDED if bits < 16 else 255,
            )
            told = wide(COLOR, bits).astype(">u2").tobytes()
            yield f"white is {white}.ppm", b"P6" + size + told, COLOR, EXACT
            yield f"text, {white}.pgm", text_of(b"P2", gray, white), GRAY, EXACT
            yield f"text, {white}.ppm", text_of(b"P3", color, white), COLOR, EXACT
    shifted = GRAY.astype(np.uint16) << 8
    yield "gray of 16 bits, shifted.png", coded(".png", shifted), GRAY, ROUNDED
    inverse = 65535 - wide(GRAY, 16)
    yield "gray of 16 bits, 0 is white.tif", tiff(inverse, photometric=0), GRAY, EXACT
    yield "gray of 16 bits, signed.tif", tiff(wide(GRAY, 15, np.int16), 1, 1, 2), GRAY, EXACT


def numbers() -> Iterator[Row]:
    """Of 32 and 64 bits, whole or with a point."""
    for bits in (8, 12, 16, 31):
        yield f"signed, {bits} of 32.tif", coded(".tif", wide(GRAY, bits, np.int32)), GRAY, EXACT
    yield "signed color, 8 of 32.tif", coded(".tif", COLOR.astype(np.int32)), COLOR, EXACT
    yield "unsigned, 32.tif", tiff(wide(GRAY, 32, np.uint32), 1, 1), GRAY, EXACT
    for white in (1, 255, 65535):
        gray, color = (np.float32(each / 255 * white) for each in (GRAY, COLOR))
        yield f"point, white is {white}.tif", coded(".tif", gray), GRAY, EXACT
        yield f"color with a point, white is {white}.tif", coded(".tif", color), COLOR, EXACT
        yield f"point, 64 bits, white is {white}.tif", coded(".tif", np.float64(gray)), GRAY, EXACT
    damaged, seen = np.float32(GRAY / 255), GRAY.copy()
    for place, (number, shade) in enumerate(((np.nan, 0), (np.inf, 255), (-1, 0), (3, 255))):
        damaged[3, place], seen[3, place] = number, shade
    yield "no number, and beyond.tif", coded(".tif", damaged), seen, EXACT
    yield "no number at all.tif", coded(".tif", damaged * np.nan), GRAY * 0, EXACT
    yield "point.pfm", coded(".pfm", np.float32(GRAY / 255)), GRAY, EXACT


def colors() -> Iterator[Row]:
    """Spaces of color, palettes, one bit."""
    picture, bits = PillowImage.fromarray(COLOR), PillowImage.fromarray(BITS).convert("1")
    profiles = [ImageCms.createProfile(space) for space in ("sRGB", "LAB")]
    lab = ImageCms.profileToProfile(picture, *profiles, outputMode="LAB")
    yield "lab.tif", saved(lab, "TIFF"), COLOR, 40  # of what is out of its range
    for mode in ("CMYK", "YCbCr", "P"):
        yield f"{mode}.tif", saved(picture.convert(mode), "TIFF"), _shown(picture, mode), 4
    yield "cmyk.jpg", saved(picture.convert("CMYK"), "JPEG", quality=100), COLOR, 4
    for suffix, kind in KINDS.items():
        if suffix not in (".jpg", ".webp", ".avif"):
            yield f"one bit{suffix}", saved(bits, kind), BITS, EXACT
    yield "one bit, fax.tif", saved(bits, "TIFF", compression="group4"), BITS, EXACT
    for count, kind, suffix in ((256, "PNG", ".png"), (16, "PNG", ".png"), (16, "BMP", ".bmp")):
        few = picture.quantize(count)
        yield f"{count} colors{suffix}", saved(few, kind), np.asarray(few.convert("RGB")), EXACT
    for packing in ("tiff_lzw", "tiff_adobe_deflate", "packbits"):
        yield f"{packing}.tif", saved(COLOR, "TIFF", compression=packing), COLOR, EXACT
    yield "jpeg.tif", saved(COLOR, "TIFF", compression="jpeg", quality=95), COLOR, LOSSY


KINDS = {
    ".png": "PNG",
    ".tif": "TIFF",
    ".webp": "WEBP",
    ".avif": "AVIF",
    ".jpg": "JPEG",
    ".gif": "GIF",
    ".bmp": "BMP",
    ".pbm": "PPM",
}
BEST: Mapping[str, Mapping[str, object]] = {
    ".webp": {"lossless": True},
    ".avif": {"quality": 100, "subsampling": "4:4:4"},
    ".jpg": {"quality": 98, "subsampling": 0},
}


def _shown(picture: PillowImage.Image, mode: str) -> Picture:
    return np.asarray(picture.convert(mode).convert("RGB"))


def transparent() -> Iterator[Row]:
    """What is transparent lies over white."""
    color, gray = np.dstack([COLOR, OPAQUE]), np.dstack([GRAY, OPAQUE])
    seen = np.where(OPAQUE[..., None] > 0, COLOR, 255).astype(np.uint8)
    for suffix in (".png", ".tif", ".webp"):
        yield f"rgba{suffix}", saved(color, KINDS[suffix], **BEST.get(suffix, {})), seen, EXACT
    yield "rgba.avif", saved(color, "AVIF", **BEST[".avif"]), seen, LOSSY
    for suffix in (".png", ".tif"):
        both = PillowImage.fromarray(gray, "LA")
        yield f"gray{suffix}", saved(both, KINDS[suffix]), _over_white(GRAY), EXACT
    for bits in (10, 12, 16):
        deep = np.dstack([wide(COLOR, bits), wide(OPAQUE, 16)])
        yield f"rgba of {bits} in 16 bits.png", coded(".png", deep), seen, EXACT
    yield "rgba of 16 bits.tif", tiff(wide(color, 16)), seen, EXACT
    yield "rgba with a point.tif", tiff(np.float32(color / 255), 1, 2, 3), seen, EXACT
    palette = PillowImage.fromarray(BITS).convert("P")
    yield "palette.png", saved(palette, "PNG", transparency=0), np.full_like(BITS, 255), EXACT
    yield "palette.gif", saved(palette, "GIF", transparency=0), np.full_like(BITS, 255), EXACT
    key = int(wide(GRAY, 16)[HEIGHT // 2, WIDTH // 2])
    keyed = saved(PillowImage.fromarray(wide(GRAY, 16)), "PNG", transparency=key)
    yield "a gray of 16 bits.png", keyed, np.where(wide(GRAY, 16) == key, 255, GRAY), EXACT


def _over_white(gray: Picture) -> Picture:
    return np.where(OPAQUE > 0, gray, 255).astype(np.uint8)


def turned() -> Iterator[Row]:
    """Held in eight ways."""
    deep = wide(COLOR, 16)
    for orientation, upright in UPRIGHT.items():
        for suffix in (".png", ".tif", ".webp", ".avif", ".jpg"):
            exif = PillowImage.Exif()
            exif[ORIENTATION] = orientation
            data = saved(COLOR, KINDS[suffix], exif=exif, **BEST.get(suffix, {}))
            is_exact = suffix in (".png", ".tif", ".webp")
            yield f"held {orientation}{suffix}", data, upright(COLOR), EXACT if is_exact else LOSSY
        data = tiff(deep, orientation)
        yield f"held {orientation}, 16 bits.tif", data, upright(COLOR), EXACT
        data = tiff(np.float32(COLOR / 255), orientation, kind=3)
        yield f"held {orientation}, with a point.tif", data, upright(COLOR), EXACT
        exif = PillowImage.Exif()
        exif[ORIENTATION] = orientation
        whole = saved(COLOR, "PNG", exif=exif)
        start = whole.find(b"eXIf") - 4
        chunk = whole[start : start + 12 + int.from_bytes(whole[start : start + 4])]
        plain = coded(".png", deep)
        data = plain[:33] + (chunk if start > 0 else b"") + plain[33:]
        yield f"held {orientation}, 16 bits.png", data, upright(COLOR), EXACT


def several() -> Iterator[Row]:
    """The first of several."""
    first, second = PillowImage.fromarray(COLOR), PillowImage.fromarray(255 - COLOR)
    rest = {"save_all": True, "append_images": [second]}
    for suffix in (".png", ".tif", ".webp"):
        data = saved(first, KINDS[suffix], **rest, **BEST.get(suffix, {}))
        yield f"several{suffix}", data, COLOR, EXACT
    bits = [PillowImage.fromarray(each).convert("1") for each in (BITS, 255 - BITS)]
    yield "several.gif", saved(bits[0], "GIF", save_all=True, append_images=bits[1:]), BITS, EXACT
    yield "several.mpo", saved(first, "MPO", **rest, **BEST[".jpg"]), COLOR, LOSSY
    yield "more behind.jpg", saved(first, "JPEG", **BEST[".jpg"]) + bytes(999), COLOR, LOSSY


def all_rows() -> list[Row]:
    return [
        row for rows in (depths, numbers, colors, transparent, turned, several) for row in rows()
    ]


def refused() -> Iterator[tuple[str, bytes, str]]:
    """Files that are no picture that can be read: name, content, and what the message says."""
    jpeg, png = saved(COLOR, "JPEG"), saved(COLOR, "PNG")
    missing = "its end is missing - copy or save it again"
    for share in (0.3, 0.5, 0.7):
        yield f"{share} of it.jpg", jpeg[: int(share * len(jpeg))], missing
        yield f"{share} of it.png", png[: int(share * len(png))], missing
    yield "27 bytes short.jpg", jpeg[:-27], missing
    for suffix in (".webp", ".avif", ".gif", ".bmp"):
        whole = saved(COLOR, KINDS[suffix])
        yield f"short{suffix}", whole[:-60], "not a readable picture"
    yield "short.tif", saved(COLOR, "TIFF")[:-60], missing
    for suffix, told in ((".png", missing), (".ppm", missing), (".tif", "or damaged")):
        yield f"short, 16 bits{suffix}", coded(suffix, wide(COLOR, 16))[:-60], told
    yield "16 bits and opacity.tif", tiff(wide(np.dstack([GRAY, GRAY]), 16), 1, 1), "2 channels of"
    yield "points of 16 bits.tif", tiff(np.float16(GRAY / 255), 1, 1, 3), "a rare kind, or damaged"
    yield "whole numbers of 64 bits.tif", tiff(np.uint64(GRAY), 1, 1), "a rare kind, or damaged"
    yield "lab of 16 bits.tif", tiff(wide(COLOR, 16), 1, 8), "a rare kind of TIFF"
    yield "iphone.heic", b"\0\0\0\x18ftypheic\0\0\0\0mif1heic", "an iPhone takes JPEG with Settings"
    yield "phone.jpg", b"\0\0\0\x18ftypmif1\0\0\0\0mif1heic", "a picture in HEIC"
    yield "a.jp2", coded(".jp2", COLOR), "JPEG 2000"
    yield "a.jxl", b"\xff\x0a\xfa\x1f", "JPEG XL"
    yield "a.hdr", coded(".hdr", np.float32(COLOR / 255)), "HDR"
    yield "empty.jpg", b"", "this file is empty"
    yield "page.jpg", b"<!DOCTYPE html><html><body>404", "a web page"
    yield "drawing.svg", b'<svg xmlns="http://www.w3.org/2000/svg"/>', "save it as PNG"
    yield "film.mp4", b"\0\0\0\x18ftypisom", "give it to --video"
    yield "pointer.png", b"version https://git-lfs.github.com/spec/v1\n", "git lfs pull"
    yield "text.png", b"no picture", "name a JPEG or PNG"
