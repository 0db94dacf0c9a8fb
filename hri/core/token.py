"""The token: whoever knows it may move the robot over a network, let it speak, and release it.

There is one for all programs of a user: in the environment variable HRI_TOKEN, else in a file that
only this user may read. `hri token` shows it, `hri token --new` replaces it.

Programs prove that they know the token instead of sending it (`proof`): whoever listens at the
other end of a connection may be a stranger.
"""

from __future__ import annotations

import hmac
import os
import re
import secrets
import stat
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from hri.core.errors import HriError
from hri.core.ownership import is_of_user
from hri.core.paths import state_folder
from hri.core.privacy import folder_for
from hri.core.reading import read_text
from hri.core.writing import PRIVATE, mark_of, not_written, write_new_text, write_text

VARIABLE = "HRI_TOKEN"
"""The environment variable that takes precedence over the file."""
_BYTES = 32
_FORM = re.compile(r"[A-Za-z0-9_.~+/=-]{16,200}")
"""What a token may look like: long enough not to be guessed, and the same in every form of text."""
_NONCE_BYTES = 16
_NONCE = re.compile(r"[A-Za-z0-9_-]{16,64}")

Role = Literal["client", "server"]
"""Who proves: a proof of one side is worth nothing to the other."""


@dataclass(frozen=True, slots=True)
class TokenFile:
    """A token that is kept in a file which only this user may read."""

    name: str
    """Of the file, in the state folder."""
    remedy: str
    """What makes another one."""
    variable: str = ""
    """The environment variable that takes precedence over the file; empty without one."""

    @property
    def path(self) -> Path:
        """Where it is kept."""
        return state_folder() / self.name

    def load(self) -> str | None:
        """The token; None when none has been made. Raises HriError as `load_token` does."""
        named = os.environ.get(self.variable, "") if self.variable else ""
        if named:
            return self._checked(named, self.variable)
        path = self.path
        if not path.exists():
            return None
        _require_replaceable(path)
        if not is_of_user(path) or stat.S_IMODE(path.stat().st_mode) & 0o077:
            what = "others may read or change it, so it is not used"
            raise HriError(f"{path}: {what} - {self.remedy}")
        try:
            text = read_text(path, "token")
        except HriError as error:
            raise HriError(f"{path}: no token can be read from it - {self.remedy}") from error
        return self._checked(text.strip(), str(path))

    def own(self) -> str:
        """The token, made where there is none: programs that make it at once get the same one.

        Raises HriError as `load` and `new` do.
        """
        if (found := self.load()) is not None:
            return found
        if not self.path.is_symlink():
            folder_for(self.path)
            write_new_text(self.path, secrets.token_urlsafe(_BYTES) + "\n", PRIVATE)
        return self.load() or self.new()

    def new(self) -> str:
        """Make another one; the one before is worth nothing from now on. Raises HriError as
        `new_token` does.
        """
        path, token = self.path, secrets.token_urlsafe(_BYTES)
        _require_replaceable(path)
        folder_for(path)
        try:
            if path.is_symlink():
                path.unlink()
        except OSError as error:
            raise not_written(path, error) from error
        write_text(path, token + "\n", PRIVATE)
        return token

    def is_shown(self, text: str) -> bool:
        """Whether a text is the token, compared in constant time. Raises HriError as `load`."""
        token = self.load()
        return token is not None and hmac.compare_digest(text.encode(), token.encode())

    def _checked(self, token: str, where: str) -> str:
        if not _FORM.fullmatch(token):
            what = f"{where}: a token has 16 to 200 letters, digits and -_.~+/="
            raise HriError(f"{what} - {self.remedy}")
        return token


_ROBOT = TokenFile("token", "hri token --new makes another one", VARIABLE)


def token_file() -> Path:
    """Where the token is kept."""
    return _ROBOT.path


def load_token() -> str | None:
    """The token of this user; None when none has been made.

    Raises HriError for one that others may read or change, that is too short, is unreadable, or
    is not a file.
    """
    return _ROBOT.load()


def new_token() -> str:
    """Make another token and keep it in the file; the one before is worth nothing from now on.

    A link in the place of the file is replaced, and what it leads to stays as it is. Raises
    HriError when the file cannot be written, or something else lies in its place.
    """
    return _ROBOT.new()


def own_token() -> str:
    """The token of this user, created if necessary. Raises HriError as the others do."""
    return _ROBOT.own()


@dataclass(frozen=True, slots=True)
class Challenge:
    """What a proof is made for: one connection, and a number of each side that is used once."""

    client: str
    """The client's nonce."""
    server: str
    """The server's nonce."""
    ends: str
    """The two ends of the connection, the client's first: `127.0.0.1 40112 127.0.0.1 25000`."""


def new_nonce() -> str:
    """128 random bits, as 22 characters."""
    return secrets.token_urlsafe(_NONCE_BYTES)


def is_nonce(text: str) -> bool:
    """Whether the other side may have chosen this as its nonce: 16 to 64 letters, digits, - _."""
    return _NONCE.fullmatch(text) is not None


def proof(token: str, role: Role, challenge: Challenge) -> str:
    """What only someone who knows the token can say: HMAC-SHA256 (RFC 2104), in hexadecimal."""
    told = f"hri {role} {challenge.ends} {challenge.client} {challenge.server}"
    return hmac.new(token.encode(), told.encode(), "sha256").hexdigest()


def is_proof(shown: str, token: str, role: Role, challenge: Challenge) -> bool:
    """Whether this is that proof, compared in constant time."""
    return hmac.compare_digest(shown.encode(), proof(token, role, challenge).encode())


class Grant:
    """The permission that a token gives while it is the current one."""

    def __init__(self, shown: str) -> None:
        """Raises HriError as `load_token` does."""
        self._shown = shown
        self._file = None if os.environ.get(VARIABLE) else token_file()
        self._look = _look(self._file)
        self._holds = is_token(shown)

    @property
    def holds(self) -> bool:
        """Whether it is the token now; takes 2 us, so ask before each thing that needs it."""
        look = _look(self._file)
        if look != self._look:
            self._look, self._holds = look, False
            with suppress(HriError):  # one that cannot be used is nobody's
                self._holds = is_token(self._shown)
        return self._holds


def is_token(shown: str) -> bool:
    """Whether a text is the token, compared in constant time.

    Raises HriError as `load_token` does.
    """
    return _ROBOT.is_shown(shown)


def _look(path: Path | None) -> tuple[int, ...]:
    """What changes when the token in a file does, or who may read it."""
    if path is None:
        return ()
    try:
        status = os.stat(path)
    except OSError:
        return ()
    return *mark_of(status), status.st_ctime_ns


def _require_replaceable(path: Path) -> None:
    """Raise HriError for a folder, a pipe, or anything else that a new token cannot replace."""
    if path.exists() and not path.is_file() and not path.is_symlink():
        raise HriError(f"{path}: the token belongs here, but this is not a file - move it away")
