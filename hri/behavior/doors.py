"""What a program lets in from outside: whoever starts it decides that, never a network file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from string import ascii_uppercase

from hri.core.errors import did_you_mean
from hri.core.event_bus import matches

NAMES_OF_2003 = tuple(f"{letter}*" for letter in ascii_uppercase)
"""Patterns of events that begin with a capital, such as `Examples.PhotoEvent.Shoot`; the robot
itself raises none of these."""


@dataclass(frozen=True)
class Doors:
    """What the command line, app.toml and the resource configuration say together."""

    allows_remote: bool = False
    """Whether other machines may connect."""
    trusted: tuple[str, ...] = ()
    """Ports of the bridge that anyone may write to, as `tag` or `tag.port`; `*` in a name stands
    for any characters."""
    events: tuple[str, ...] = NAMES_OF_2003
    """Names of events that may come from outside, with `*` as above."""

    def with_more(self, trusted: Iterable[str] = (), events: Iterable[str] = ()) -> Doors:
        """The same, and these as well."""
        return replace(self, trusted=(*self.trusted, *trusted), events=(*self.events, *events))

    def trusts(self, tag: str, port: str) -> bool:
        """Whether anyone may write to a port."""
        return any(matches(one, tag) or matches(one, f"{tag}.{port}") for one in self.trusted)

    def unknown(self, ports: Iterable[tuple[str, str]]) -> Iterator[str]:
        """A line for each trusted name that none of these ports, as tag and name, has."""
        names = {name for tag, port in ports for name in (tag, f"{tag}.{port}")}
        for trusted in self.trusted:
            if not any(matches(trusted, name) for name in names):
                remedy = did_you_mean(trusted, names)
                what = f'trusted "{trusted}": these networks have no such port on the bridge'
                yield f"{what} - {remedy}"

    def takes(self, event: str) -> bool:
        """Whether an event of that name may come from outside."""
        return any(matches(pattern, event) for pattern in self.events)
