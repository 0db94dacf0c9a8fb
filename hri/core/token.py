"""The token: whoever shows it over a network may move the robot, let it speak, and release it.

There is one for all programs of a user: in the environment variable HRI_TOKEN, else in a file that
only this user may read. `hri token` shows it, `hri token --new` replaces it.
"""

from __future__ import annotations

import hmac
import os
import re
import secrets
import stat
from pathlib import Path

from hri.core.errors import HriError
from hri.core.ownership import is_of_user
from hri.core.paths import state_folder
from hri.core.privacy import folder_for
from hri.core.reading import read_text
from hri.core.writing import PRIVATE, not_written, write_text

VARIABLE = "HRI_TOKEN"
"""The environment variable that takes precedence over the file."""
_BYTES = 32
_FORM = re.compile(r"[A-Za-z0-9_.~+/=-]{16,200}")
"""What a token may look like: long enough not to be guessed, and the same in every form of text."""


def token_file() -> Path:
    """Where the token is kept."""
    return state_folder() / "token"


def load_token() -> str | None:
    """The token of this user; None when none has been made.

    Raises HriError for one that others may read or change, that is too short, or is unreadable.
    """
    named = os.environ.get(VARIABLE, "")
    if named:
        return _checked(named, VARIABLE)
    path = token_file()
    if not path.exists():
        return None
    remedy = "hri token --new makes another one"
    if not is_of_user(path) or stat.S_IMODE(path.stat().st_mode) & 0o077:
        raise HriError(f"{path}: others may read or change it, so it is not used - {remedy}")
    try:
        text = read_text(path, "token")
    except HriError as error:
        raise HriError(f"{path}: no token can be read from it - {remedy}") from error
    return _checked(text.strip(), str(path))


def new_token() -> str:
    """Make another token and keep it in the file; the one before is worth nothing from now on.

    A link in the place of the file is replaced, and what it leads to stays as it is. Raises
    HriError when the file cannot be written.
    """
    path, token = token_file(), secrets.token_urlsafe(_BYTES)
    folder_for(path)
    try:
        if path.is_symlink():
            path.unlink()
    except OSError as error:
        raise not_written(path, error) from error
    write_text(path, token + "\n", PRIVATE)
    return token


def own_token() -> str:
    """The token of this user, made now if there was none. Raises HriError as the others do."""
    return load_token() or new_token()


def is_token(shown: str) -> bool:
    """Whether a text is the token; how long that takes does not tell how much of it is right.

    Raises HriError as `load_token` does.
    """
    token = load_token()
    return token is not None and hmac.compare_digest(shown.encode(), token.encode())


def _checked(token: str, where: str) -> str:
    if not _FORM.fullmatch(token):
        what = f"{where}: a token has 16 to 200 letters, digits and -_.~+/="
        raise HriError(f"{what} - hri token --new makes one")
    return token
