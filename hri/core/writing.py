"""Writing files so that whoever looks finds the old one or the new one, whole.

The new content is written to a file beside, flushed to the disk, and given the name of the old
one in one step. A full disk, a killed program or a pulled plug leaves the old file as it was.
Files that grow while a robot runs, such as recordings, cannot be written this way.
"""

from __future__ import annotations

import errno
import os
import secrets
import shutil
import stat
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from hri.core.errors import HriError
from hri.core.open_files import AT_ONCE, BINARY, MAY_RENAME_OPEN, NO_LINK, lock

PRIVATE = 0o600
"""Permissions of a file that only its owner may read."""
Mark = tuple[int, int]
"""By which a file is known again: its number on the disk, and when it was written (nanoseconds)."""
SUFFIX = ".new"
"""Suffix of the temporary file: no loader reads it."""
_LONGEST = 180
"""Bytes of a name that the name of the file beside repeats; file systems end at 255."""
_REMEDIES = {
    errno.ENOSPC: "make room on the disk",
    errno.EDQUOT: "make room on the disk",
    errno.EFBIG: "make room on the disk",
    errno.EROFS: "choose another folder",
    errno.ENAMETOOLONG: "choose a shorter name",
    errno.EISDIR: "name a file, not a folder",
}


class NotWritten(HriError):
    """A file could not be written; its previous contents are intact."""


def not_written(path: Path, error: OSError) -> NotWritten:
    """The error that says which file could not be written, why, and what to do."""
    return NotWritten(f"{path}: cannot be written: {reason_of(error)}")


def reason_of(error: OSError) -> str:
    """Why the disk refused something, and what to do."""
    remedy = _REMEDIES.get(error.errno or 0, "check the path")
    return f"{error.strerror or error} - {remedy}"


def write_text(path: Path, text: str, mode: int | None = None) -> os.stat_result:
    """Write a text in UTF-8; otherwise the same as `write_bytes`."""
    return write_bytes(path, text.encode("utf-8"), mode)


def write_bytes(path: Path, data: bytes, mode: int | None = None) -> os.stat_result:
    """Make `data` the content of a file, or leave the file as it was; the status of the new file.

    An existing file keeps its permissions and, where allowed, its owner, unless `mode` sets the
    permissions; a link keeps pointing where it points, and its target is replaced. What is not a
    regular file, such as a pipe, is written to. Raises NotWritten.
    """
    with _refusing(path):
        if _is_stream(path):
            with path.open("wb", buffering=0) as stream:
                write_all(stream.fileno(), data)
                return os.fstat(stream.fileno())
        with _beside(path, mode, SUFFIX) as (handle, _):
            write_all(handle, data)
            return os.fstat(handle)


def write_new_text(path: Path, text: str, mode: int = PRIVATE) -> bool:
    """Write a file that is not there yet; False, and nothing is changed, where something is.

    Of two programs that write the same file, one succeeds; no one sees half of it. Raises
    NotWritten.
    """
    with _refusing(path):
        target = _resolved(path.parent) / path.name
        handle, new = _made_locked(target, mode, SUFFIX)
        try:
            write_all(handle, text.encode("utf-8"))
            os.fsync(handle)
            is_new = _linked(new, target)
        finally:
            new.unlink(missing_ok=True)
            os.close(handle)
        _flush(target.parent)
        return is_new


def _linked(new: Path, target: Path) -> bool:
    """Give a whole file its name, unless that is taken."""
    try:
        os.link(new, target, follow_symlinks=False)
    except FileExistsError:
        return False
    except OSError:  # a file system without links, where a file may be seen before it is whole
        try:
            handle = os.open(target, os.O_WRONLY | os.O_CREAT | os.O_EXCL | BINARY, PRIVATE)
        except FileExistsError:
            return False
        try:
            write_all(handle, new.read_bytes())
        finally:
            os.close(handle)
    return True


def append_line(path: Path, line: str, mode: int = PRIVATE) -> None:
    """Add a line to the end of a file, whole or not at all; a new file has these permissions.

    Half a line that was left at the end stands alone from then on. Raises NotWritten.
    """
    with _refusing(path):
        handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND | BINARY, mode)
        try:
            size = os.fstat(handle).st_size
            is_torn = size > 0 and _last_byte(handle) != b"\n"
            before = "\n" if is_torn else ""
            try:
                write_all(handle, f"{before}{line}\n".encode())
            except OSError:
                os.ftruncate(handle, size)
                raise
        finally:
            os.close(handle)


def _last_byte(handle: int) -> bytes:
    os.lseek(handle, -1, os.SEEK_END)
    return os.read(handle, 1)


@contextmanager
def replacing(path: Path, mode: int | None = None, suffix: str = SUFFIX) -> Iterator[Path]:
    """A new, empty file beside `path` for a library to write, which replaces `path` at the end.

    It is flushed to the disk and gets the name of `path` when the block ends, and is deleted when
    the block raises. `suffix` is for libraries that go by it. Permissions are as for `write_bytes`.
    Raises NotWritten, also for an OSError of the block.
    """
    with _refusing(path), _beside(path, mode, suffix) as (_, new):
        yield new


@contextmanager
def new_folder(folder: Path) -> Iterator[Path]:
    """A new folder beside a place, which takes the place when the block ends.

    It is deleted when the block raises. Raises NotWritten, also for an OSError of the block.
    """
    with _refusing(folder):
        new = folder.with_name(f".new-{secrets.token_hex(4)}")
        new.mkdir()
        try:
            yield new
            for entry in new.rglob("*"):
                _flush(entry)
            new.rename(folder)
        except BaseException:
            shutil.rmtree(new, ignore_errors=True)
            raise
        _flush(folder.parent)


def leftovers(path: Path) -> list[Path]:
    """What writers of this file that were killed have left beside it, sorted.

    Files that a running program is writing are not among them. The next writer of the same file
    deletes them.
    """
    return [file for file in _all_beside(path.resolve()) if _if_abandoned(file, Path.exists)]


def delete_leftovers(path: Path) -> None:
    """Delete what `leftovers` lists. Raises NotWritten."""
    with _refusing(path):
        for file in _all_beside(path.resolve()):
            _if_abandoned(file, Path.unlink)


def mark_of(status: os.stat_result) -> Mark:
    """The mark of the file that has this status."""
    return status.st_ino, status.st_mtime_ns


def delete(*files: Path) -> None:
    """Delete files, as far as they are there. Raises HriError at the first that cannot be."""
    for file in files:
        try:
            file.unlink(missing_ok=True)
        except OSError as error:
            reason = error.strerror or str(error)
            raise HriError(f"{file}: cannot be deleted: {reason} - delete it") from error


def make_folder(folder: Path, mode: int = 0o777) -> None:
    """Make a folder, and those it lies in, where it is missing. Raises NotWritten."""
    with _refusing(folder):
        folder.mkdir(mode, parents=True, exist_ok=True)


@contextmanager
def _refusing(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise not_written(path, error) from error


def _is_stream(path: Path) -> bool:
    """Whether there is something at the path whose place no file may take."""
    with suppress(OSError):
        is_device = path.parts[:2] in (("/", "dev"), ("/", "proc"))
        return is_device or not (path.is_file() or path.is_dir() or not path.exists())
    return False


@contextmanager
def _beside(path: Path, mode: int | None, suffix: str) -> Iterator[tuple[int, Path]]:
    """A new file and its handle; it replaces the other when all goes well, and else is deleted."""
    target = _resolved(path)
    handle, new = _made_beside(target, mode, suffix)
    with ExitStack() as stack:
        stack.callback(os.close, handle)
        try:
            yield handle, new
            os.fsync(handle)
            if not MAY_RENAME_OPEN:
                stack.close()
            os.replace(new, target)
        except BaseException:
            if not MAY_RENAME_OPEN:
                stack.close()
            with suppress(OSError):
                new.unlink(missing_ok=True)
            raise
    _flush(target.parent)


def _resolved(path: Path) -> Path:
    """Where links lead from a path, whether or not a file is there."""
    try:
        return path.resolve()
    except (RuntimeError, ValueError) as error:  # links in a circle, a zero byte in the name
        what = f"{str(path)!r:.80}: cannot be written: {error}"
        raise NotWritten(f"{what} - choose another name") from error


def _made_beside(target: Path, mode: int | None, suffix: str) -> tuple[int, Path]:
    """A new file with the permissions that the target is to have, locked while it is in use."""
    if target.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    before = target.stat() if target.exists() else None
    if mode is None and before is not None:
        mode = stat.S_IMODE(before.st_mode)
    with suppress(NotWritten):  # someone else's, in a folder of all
        delete_leftovers(target)
    handle, new = _made_locked(target, 0o666 if mode is None else mode & 0o777, suffix)
    if before is not None and hasattr(os, "fchown"):
        with suppress(OSError):  # only the superuser may give files away
            os.fchown(handle, before.st_uid, before.st_gid)
    if mode is not None and hasattr(os, "fchmod"):
        os.fchmod(handle, mode)
    return handle, new


def _made_locked(target: Path, mode: int, suffix: str) -> tuple[int, Path]:
    flags = os.O_RDWR | os.O_CREAT | os.O_EXCL | BINARY
    while True:
        new = name_beside(target, suffix)
        handle = os.open(new, flags, mode)
        if _is_ours(handle):
            return handle, new
        os.close(handle)


def name_beside(target: Path, suffix: str = SUFFIX) -> Path:
    """A name for a file that does not last, which `leftovers` knows after a crash."""
    return target.with_name(f"{_beginning(target)}{secrets.token_hex(4)}{suffix}")


def _beginning(target: Path) -> str:
    """How the names of the files begin that are to replace the target."""
    return f".{os.fsdecode(os.fsencode(target.name)[:_LONGEST])}.new-"


def write_all(handle: int, data: bytes) -> None:
    """Write to an open file, however many calls that takes. Raises OSError."""
    rest = memoryview(data)
    while rest:
        rest = rest[os.write(handle, rest) :]


def _is_ours(handle: int) -> bool:
    """Lock a new file; false when another writer took it for an abandoned one before that."""
    try:
        lock(handle)
    except BlockingIOError:
        return False
    except OSError:  # a file system without locks, where nothing is taken for abandoned
        return True
    return os.fstat(handle).st_nlink > 0


def _all_beside(target: Path) -> list[Path]:
    """Files that were made to replace the target, sorted."""
    try:
        names = sorted(os.listdir(target.parent))
    except OSError:
        return []
    beginning = _beginning(target)
    return [target.with_name(name) for name in names if name.startswith(beginning)]


def _if_abandoned(file: Path, act: Callable[[Path], object]) -> bool:
    """Act on a file that was made to replace another, unless its writer lives; whether it did.

    The lock is held meanwhile, so that a writer that just made the file notices.
    """
    try:
        handle = os.open(file, os.O_RDONLY | NO_LINK | AT_ONCE | BINARY)
    except OSError:
        return False
    try:
        lock(handle)
    except OSError:
        os.close(handle)
        return False
    try:
        with suppress(FileNotFoundError):
            act(file)
    finally:
        os.close(handle)
    return True


def _flush(entry: Path) -> None:
    """Let a file, or the names in a folder, survive a pulled plug, where the system can."""
    with suppress(OSError):
        handle = os.open(entry, os.O_RDONLY | BINARY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
