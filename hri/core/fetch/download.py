"""Fetching one large file from a server, on as many connections as it takes."""

from __future__ import annotations

import hashlib
import http.client
import urllib.error
import urllib.request
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from hri.core.errors import HriError, NotAvailable

Progress = Callable[[int, int], None]
"""Called with the number of received bytes, and the total."""

ATTEMPTS = 5
"""Connections that are tried while each of them brings something."""
_TIMEOUT = 30.0
_BLOCK = 1 << 18


@dataclass(frozen=True, slots=True)
class RemoteFile:
    """A file that never changes, and what it must be."""

    url: str
    size: int
    """Bytes."""
    sha256: str


def download(remote: RemoteFile, file: Path, progress: Progress) -> None:
    """Download the whole file; an existing part is resumed, and kept if the download fails. Raises
    NotAvailable when it cannot be reached, and HriError when it is not what it should be.
    """
    _fill(remote, file, progress)
    if sha256_of(file) != remote.sha256:
        file.unlink()
        raise HriError(f"{remote.url}: its checksum is wrong - fetch it again")


def sha256_of(file: Path) -> str:
    """The checksum in hexadecimal digits. Raises OSError when the file cannot be read."""
    with file.open("rb") as opened:
        return hashlib.file_digest(opened, "sha256").hexdigest()


def _fill(remote: RemoteFile, file: Path, progress: Progress) -> None:
    here = _size(file)
    if here > remote.size:
        file.unlink()
        here = 0
    for attempt in range(ATTEMPTS):
        before = here
        try:
            _go_on(remote, file, here, progress)
        except (OSError, http.client.HTTPException) as error:
            here = _size(file)
            if here == before or attempt == ATTEMPTS - 1:
                raise NotAvailable(_unreachable(remote, error, here)) from error
        here = _size(file)
        if here == remote.size:
            return
    what = f"ends after {here} of {remote.size} bytes"
    raise NotAvailable(f"{remote.url}: {what} - fetch it again later")


def _size(file: Path) -> int:
    return file.stat().st_size if file.exists() else 0


def _go_on(remote: RemoteFile, file: Path, here: int, progress: Progress) -> None:
    if here == remote.size:
        return
    request = urllib.request.Request(remote.url, headers={"Range": f"bytes={here}-"})
    with urllib.request.urlopen(request, timeout=_TIMEOUT) as answer:
        # A server that knows no ranges sends all of it, from the start.
        goes_on = answer.status == 206 and _begins_at(answer, here)
        with file.open("ab" if goes_on else "wb") as opened:
            _copy(answer, opened, here if goes_on else 0, remote, progress)


def _begins_at(answer: http.client.HTTPResponse, here: int) -> bool:
    return answer.headers.get("Content-Range", "").startswith(f"bytes {here}-")


def _copy(
    answer: http.client.HTTPResponse,
    file: BinaryIO,
    here: int,
    remote: RemoteFile,
    progress: Progress,
) -> None:
    # At most one byte more than there should be: a server must not fill the disk.
    while here <= remote.size:
        block = answer.read1(min(_BLOCK, remote.size + 1 - here))
        if not block:
            return
        file.write(block)
        here += len(block)
        progress(here, remote.size)
    raise HriError(f"{remote.url}: larger than the {remote.size} bytes of the model - report this")


def _unreachable(remote: RemoteFile, error: Exception, here: int) -> str:
    match error:
        case urllib.error.HTTPError():
            reason = f"the server answers {error.code} {error.reason}"
        case urllib.error.URLError():
            reason = str(getattr(error.reason, "strerror", None) or error.reason)
        case _:
            reason = str(error) or type(error).__name__
    done = f" after {here} bytes, which are kept" if here else ""
    return f"{remote.url}: {reason}{done} - try again when you are online"
