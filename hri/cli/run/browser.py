"""Opens the studio's page in a browser, without its code on a command line.

All users of a machine can read the command lines of all programs. So the browser is given a file
that only this user can read, which leads it to the page, as Jupyter does.
"""

from __future__ import annotations

import html
import webbrowser
from contextlib import suppress
from pathlib import Path
from urllib.parse import urlsplit

from hri.core import paths
from hri.core.errors import HriError
from hri.core.privacy import PRIVATE_FOLDER, folder_for
from hri.core.writing import PRIVATE, write_text

SNAPS = Path("/snap/bin")
"""Where programs of snaps are: such a browser reads no hidden folder and no /tmp, only what can be
seen in the home folder."""
_PAGE = """<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<meta name="referrer" content="no-referrer">
<meta http-equiv="refresh" content="0; url={address}">
<title>Studio</title>
<p><a href="{address}">To the studio</a></p>
</html>
"""


def open_page(address: str) -> None:
    """Let a browser go to an address with a code. Raises HriError when it cannot be told."""
    file = _file(urlsplit(address).port)
    forget_page(urlsplit(address).port)
    _make_folder(file.parent)
    write_text(file, _PAGE.format(address=html.escape(address)), PRIVATE)
    if not webbrowser.open(file.as_uri()):
        raise HriError("no browser was found - set BROWSER to one")


def forget_page(port: int | None) -> None:
    """Delete the file for the studio at a port, as far as it is there and ours."""
    with suppress(HriError, OSError):
        file = _file(port)
        file.unlink(missing_ok=True)
        file.parent.rmdir()


def _file(port: int | None) -> Path:
    """Raises HriError where there is no home folder."""
    folder = paths.home() if SNAPS.is_dir() else paths.state_folder()
    return folder / f"hri-studio-{port}" / "open.html"


def _make_folder(folder: Path) -> None:
    """Raises HriError when it cannot be made, or is there: what is in it could be anyone's."""
    folder_for(folder)
    try:
        folder.mkdir(PRIVATE_FOLDER)
    except OSError as error:
        raise HriError(f"{folder}: cannot be made: {error.strerror} - move it away") from error
