"""The WebSocket of a page: what it looks at comes to it, and its Stop goes to the robot."""

from __future__ import annotations

import json
import logging
import math
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import trio
from starlette.requests import HTTPConnection
from starlette.websockets import WebSocket, WebSocketDisconnect

from hri.core.errors import HriError
from hri.studio.commands import checked
from hri.studio.connections import SEAT
from hri.studio.hub import Hub, Page
from hri.studio.link import NETWORK, PICTURES, REASON, THUMBNAIL
from hri.studio.request_queue import STOP

MOST_PAGES, MOST_PAGES_EACH = 32, 16
"""Pages that look at once, of all and with the same cookie or token."""
BEHIND_S = 1.0
"""Seconds for which a page that reads nothing keeps its place when another wants it."""
MESSAGE_EVERY = 0.02
"""Seconds between two messages of a page."""
MOST_WANTED = 4
"""Whose values, and whose pictures, a page may want."""
LONGEST_NAME = 300
"""Letters of such a name."""
log = logging.getLogger("hri.studio")


class PageSockets:
    """Serves the pages that look."""

    def __init__(self, hub: Hub, proof_of: Callable[[HTTPConnection], str]) -> None:
        """`proof_of`: the cookie or the token by which a page is known; empty for a stranger."""
        self._hub, self._proof_of = hub, proof_of

    async def serve(self, websocket: WebSocket) -> None:
        """One page, until it goes."""
        if not (proof := self._proof_of(websocket)):
            await websocket.close(1008)
            return
        page = Page(proof, websocket.scope.get(SEAT))
        if not self._has_room(page):
            await websocket.close(1013)
            return
        await self._hub.add(page)  # before anything else, so that it counts
        if page.seat is not None:
            page.seat.kind = "page"
        try:
            await websocket.accept()
            async with trio.open_nursery() as nursery:
                nursery.start_soon(_send_news, websocket, page)
                await self._listen(websocket, page, nursery)
                nursery.cancel_scope.cancel()
        except* (WebSocketDisconnect, RuntimeError, OSError):
            pass  # it has gone
        finally:
            with trio.CancelScope(shield=True), suppress(HriError):
                await self._hub.remove(page)

    def _has_room(self, page: Page) -> bool:
        """Whether one more page may look; one that reads nothing is sent away for it."""
        pages = self._hub.pages
        if sum(one.proof == page.proof for one in pages) >= MOST_PAGES_EACH:
            return False
        if len(pages) < MOST_PAGES:
            return True
        slowest = min(pages, key=lambda one: one.sending_since)
        if slowest.seat is None or slowest.sending_since > trio.current_time() - BEHIND_S:
            return False
        pages.discard(slowest)
        slowest.seat.close()
        return True

    async def _listen(self, websocket: WebSocket, page: Page, nursery: trio.Nursery) -> None:
        """What a page says, until it goes: which pictures it wants, and stop."""
        while True:
            message = await websocket.receive()
            if message["type"] == "websocket.disconnect":
                return
            try:
                said = json.loads(message.get("text") or "{}")
                if not isinstance(said, dict):
                    raise TypeError("a page sends objects")
                if "command" in said:
                    await self._stop(page, said, nursery)
                else:
                    page.wanted = _wanted(said)
                    await self._hub.want()
            except (ValueError, KeyError, TypeError, RecursionError):
                await websocket.close(1003)
                return
            except HriError as error:
                log.debug("a page was not heard: %s", error)
            await trio.sleep(MESSAGE_EVERY)  # no page keeps the others waiting

    async def _stop(self, page: Page, message: dict[str, Any], nursery: trio.Nursery) -> None:
        """Stop the robot, also for a page that has gone meanwhile. It is the one command that a
        page may send here. Raises ValueError for any other, HriError.
        """
        number = message.pop("number", None)
        if message.pop("command") != STOP or type(number) is not int:
            raise ValueError("a page sends other commands as requests")
        try:
            arguments = checked(STOP, message)
        except HriError as error:
            raise ValueError(str(error)) from error
        question = await self._hub.begin(STOP, arguments)

        async def tell() -> None:
            failed: str | None = None
            try:
                await self._hub.answer(question)
            except HriError as error:
                failed = str(error)
            page.answers.append(json.dumps({"answer": number, "error": failed}))
            page.news.set()

        nursery.start_soon(tell)


def _wanted(message: dict[str, list[str]]) -> frozenset[str]:
    """What a page wants to see. Raises KeyError, TypeError, or ValueError for nonsense."""
    pictures = frozenset(message["pictures"]) & PICTURES.keys()
    values: set[str] = set()
    for key, mark in (("networks", NETWORK), ("thumbnails", THUMBNAIL), ("reasons", REASON)):
        wanted = [mark + one for one in message.get(key, [])]
        if len(wanted) > MOST_WANTED:
            raise ValueError("too much is wanted")
        if any(len(one) > LONGEST_NAME for one in wanted):
            raise ValueError("a name is too long")
        values.update(wanted)
    return pictures | values


async def _send_news(websocket: WebSocket, page: Page) -> None:
    while True:
        await page.news.wait()
        for message in page.take():
            page.sending_since = trio.current_time()
            if isinstance(message, bytes):
                await websocket.send_bytes(message)
            else:
                await websocket.send_text(message)
            page.sending_since = math.inf
