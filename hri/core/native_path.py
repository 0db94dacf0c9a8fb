"""Names of files for libraries written in C, which take text.

On Linux a name is any bytes, and Python spells those that are not UTF-8 as lone surrogates. OpenCV
ends the process when it is given one, others raise various errors.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from hri.core.errors import HriError


@contextmanager
def native_path(path: Path | str) -> Iterator[str]:
    """A name by which every library opens the file, or the folder, while the block runs.

    It begins with "/" or "./", so that none takes it for an address or for standard input. Instead
    of a name that is not UTF-8 it is a link of the same suffix in a temporary folder. Raises
    HriError when there can be no link.
    """
    name = os.path.join(os.curdir, path)
    if _is_text(name):
        yield name
        return
    with TemporaryDirectory(prefix="hri-") as folder:
        suffix = Path(path).suffix
        link = os.path.join(folder, f"file{suffix if _is_text(suffix) else ''}")
        if not _is_text(link):
            raise HriError(f"{path}: this name is not UTF-8, nor is $TMPDIR - rename one of them")
        os.symlink(os.path.abspath(path), link)
        yield link


def _is_text(name: str) -> bool:
    """Whether a name is one in UTF-8, too."""
    try:
        name.encode()
    except UnicodeEncodeError:
        return False
    return True
