"""Who may use the studio: a code that works once, the cookie it is exchanged for, or the token.

Pure: times are arguments, in seconds since 1970.
"""

from __future__ import annotations

import hmac
import ipaddress
import secrets
from contextlib import suppress
from urllib.parse import urlsplit

LASTS = 30 * 24 * 3600.0
"""Seconds for which a cookie is good, as long as the robot runs that gave it."""
MOST_CODES = 20
"""Codes that wait to be used; a further one makes the oldest worthless."""


class Codes:
    """Codes that each work once."""

    def __init__(self, secret: str) -> None:
        """`secret` signs them, so that `is_signed_code` knows guesses without asking here."""
        self._secret = secret
        self._open: list[str] = []

    def new(self) -> str:
        """Another code."""
        told = secrets.token_urlsafe(16)
        code = f"{told}.{_code_signature(self._secret, told)}"
        self._open = [*self._open, code][-MOST_CODES:]
        return code

    def redeem(self, code: str) -> bool:
        """Whether a code is good; it works no more from now on."""
        found = [one for one in self._open if hmac.compare_digest(one.encode(), code.encode())]
        self._open = [one for one in self._open if one not in found]
        return bool(found)


def is_signed_code(secret: str, code: str) -> bool:
    """Whether `Codes` of this secret made a code, which may have been used since."""
    told, _, signature = code.rpartition(".")
    expected = _code_signature(secret, told)
    return hmac.compare_digest(expected.encode(), signature.encode())


def _code_signature(secret: str, told: str) -> str:
    """Not that of a cookie, whatever was told."""
    return hmac.new(secret.encode(), f"code {told}".encode(), "sha256").hexdigest()[:16]


class Cookies:
    """Cookies that prove that a code was shown, and need not be remembered."""

    def __init__(self, secret: str) -> None:
        """Cookies of the same secret are good for all servers that have it."""
        self._secret = secret.encode()

    def new(self, now: float) -> str:
        """A cookie that is good for `LASTS`."""
        told = f"{now + LASTS:.0f}.{secrets.token_urlsafe(9)}"
        return f"{told}.{self._signature(told)}"

    def is_good(self, cookie: str, now: float) -> bool:
        """Whether it was made with this secret, and lasts yet."""
        told, _, signature = cookie.rpartition(".")
        if not hmac.compare_digest(self._signature(told).encode(), signature.encode()):
            return False
        with suppress(ValueError):
            return float(told.partition(".")[0]) > now
        return False

    def _signature(self, told: str) -> str:
        return hmac.new(self._secret, told.encode(), "sha256").hexdigest()


def is_own_host(host: str, allows_remote: bool) -> bool:
    """Whether a request may name this host: never a foreign name that leads here (DNS rebinding).

    This machine by its usual names; with `allows_remote` also any address, and names that a
    home network gives (`pi`, `pi.local`).
    """
    with suppress(ValueError):
        name = urlsplit(f"//{host}").hostname or ""
        if name == "localhost":
            return True
        with suppress(ValueError):
            return ipaddress.ip_address(name).is_loopback or allows_remote
        return allows_remote and ("." not in name or name.endswith(".local"))
    return False


def is_own_origin(origin: str | None, host: str) -> bool:
    """Whether a request comes from the page of this host, or from no page at all."""
    if origin is None:
        return True
    with suppress(ValueError):
        return urlsplit(origin).netloc == host
    return False


def is_loopback(address: str) -> bool:
    """Whether the other end is on this machine."""
    with suppress(ValueError):
        parsed = ipaddress.ip_address(address.partition("%")[0])
        return (getattr(parsed, "ipv4_mapped", None) or parsed).is_loopback
    return False
