"""Identifies files that cannot be read as pictures, and names the remedy."""

from __future__ import annotations

import re
from typing import IO

HEAD = 64
"""Bytes by which a file is known."""
CONVERT = "convert it to JPEG or PNG"
DAMAGED, AGAIN = "it is damaged, or its end is missing", "copy or save it again"
KINDS: tuple[tuple[bytes, str, str], ...] = (
    (rb"$", "this file is empty", AGAIN),
    (rb"\xff\xd8\xff|\x89PNG|GIF8|BM|P[1-7f]\s|RIFF.{4}WEBP", DAMAGED, AGAIN),
    (
        rb".{4}ftyp(hei|hev|mif1|msf1)",
        "a picture in HEIC, which is not read",
        f"{CONVERT}; an iPhone takes JPEG with Settings, Camera, Formats, Most Compatible",
    ),
    (rb".{4}ftypavi[fs]", "a picture in AVIF, which this Pillow does not read", CONVERT),
    (rb".{4}ftypcrx|II\*\0.{4}CR|FUJIFILM", "a raw picture of a camera", CONVERT),
    (rb".{4}ftyp|RIFF.{4}AVI |\x1aE\xdf\xa3", "a film", "give it to --video"),
    (rb"\0\0\0\x0cjP  |\xffO\xffQ", "a picture in JPEG 2000, which is not read", CONVERT),
    (rb"\0\0\0\x0cJXL |\xff\x0a", "a picture in JPEG XL, which is not read", CONVERT),
    (rb"#\?RADIANCE|v/1\x01", "a picture in HDR or EXR, which is not read", CONVERT),
    (rb"8BPS", "a picture of Photoshop, which is not read", CONVERT),
    (rb"II[*U+]\0|MM\0[*+]", "a raw picture of a camera, a rare kind of TIFF, or damaged", CONVERT),
    (rb"%PDF", "a PDF", "save its picture as JPEG or PNG"),
    (rb"\s*(<\?xml|<svg)", "a drawing in SVG, or XML", "save it as PNG"),
    (rb"(?i)\s*<(!doctype )?html", "a web page", "download the picture itself"),
    (rb"version https://git-lfs", "a pointer of Git LFS", "run: git lfs pull"),
)
"""Regular expressions for the first bytes, in order; what that is, and the remedy."""


def kind_of(file: IO[bytes]) -> str:
    """What a file is by its first bytes, and the remedy, as a message has them."""
    head = file.read(HEAD)
    for pattern, what, remedy in KINDS:
        if re.match(pattern, head, re.DOTALL):
            return f"not a readable picture: {what} - {remedy}"
    return "not a readable picture - name a JPEG or PNG"
