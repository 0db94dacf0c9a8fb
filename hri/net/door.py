"""Who may write to the ports of one behavior of the bridge.

A port from which nothing moves, speaks or releases takes what anyone sends, as in 2003. Any other
takes the values of a peer that has proven the token, and those for which whoever started the
program has said `trusted`.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Iterable, Mapping

from hri.behavior.behavior import Behavior, Context
from hri.behavior.effects import ANYTHING, Effect
from hri.behavior.reach import Reach
from hri.core.errors import HriError
from hri.core.token import own_token
from hri.net.control import refusal
from hri.net.malleable_protocol import Item, Sender

TELL_EVERY = 10.0
"""Seconds between two words about the same port."""

log = logging.getLogger("hri.net")


class Door:
    """Decides by what the outputs of a behavior reach in the networks that run now."""

    def __init__(self, behavior: Behavior, tag: str, context: Context) -> None:
        self._behavior, self._tag, self._context = behavior, tag, context
        self._trusted = context.doors.with_more(context.resources.trusted)
        self._seen: object = None
        self._guarded: dict[str, frozenset[Effect]] = {}
        self._told: dict[str, float] = {}
        """When a write to a port without the token was logged."""

    def prepare(self) -> None:
        """Make the token, if one may be needed, before anyone can connect."""
        self.look()
        # A task may begin to watch a port after someone has connected.
        if self._context.has_tasks and any(self._closed_outputs()):
            _make_token()

    def look(self) -> None:
        """Find out again what the outputs reach, if other networks run; call it in each tick."""
        context = self._context
        seen = [(runner, runner.watched) for runner in context.runners], context.has_tasks
        if seen == self._seen:
            return
        self._seen = seen
        reach = Reach(context.runners, context.has_tasks)
        effects = {name: reach.of(self._behavior, name) for name in self._closed_outputs()}
        guarded = {name: e for name, e in effects.items() if e}
        if guarded and not self._guarded:
            # Before the first refusal: whoever is refused looks for the token at once.
            self._announce(guarded)
        self._guarded = guarded

    def admits(self, port: str, sender: Sender) -> bool:
        """Whether a value of that sender may come in; called by any thread."""
        return sender.is_authorized or port not in self._guarded

    def admitted(self, items: Iterable[Item], sender: Sender) -> list[Item]:
        """Those that may come in; the sender and the log get a line about the others."""
        kept = []
        for item in items:
            if self.admits(item.port, sender):
                kept.append(item)
            elif item.port not in sender.refused:
                sender.refused |= {item.port}
                self._refuse(item.port, sender)
        return kept

    def _refuse(self, port: str, sender: Sender) -> None:
        effects = _words(self._guarded.get(port, ANYTHING))
        what = f"{self._tag}.{port} {effects} and takes no value without the token"
        sender.tell(refusal(what))
        now = self._context.clock.now()
        # A peer that comes again and again must not fill the log.
        if now - self._told.get(port, -math.inf) >= TELL_EVERY:
            self._told[port] = now
            remedy = f"prove it (hri token), or start this with --trusted {self._tag}.{port}"
            log.warning("%s: %s - %s", sender.name, what, remedy)

    def _closed_outputs(self) -> Iterable[str]:
        return (o for o in self._behavior.outputs if not self._trusted.trusts(self._tag, o))

    def _announce(self, guarded: Mapping[str, frozenset[Effect]]) -> None:
        """Say that a token is needed, and make one if there is none."""
        for port, effects in guarded.items():
            log.info(
                "%s.%s %s: who writes to it proves the token", self._tag, port, _words(effects)
            )
        _make_token()


def _make_token() -> None:
    try:
        own_token()
    except HriError as error:
        log.warning("nobody can prove a token: %s", error)


def _words(effects: Iterable[Effect]) -> str:
    found = set(effects)
    if found == set(Effect):
        return "may do anything"
    return " and ".join(effect.value for effect in Effect if effect in found)
