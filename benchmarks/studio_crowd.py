"""A crowd that presses on the port of a studio: `python -m benchmarks.studio_crowd PORT COOKIE`.

Each of it opens another connection as soon as its own is closed.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator

import trio

SLOW, CODES, PAGES = 100, 8, 200
"""Strangers of each slow kind, those who guess codes, and clients of the WebSocket."""
AGAIN_S, DRIP_S = 0.02, 1.0
"""Seconds until the next connection, and between two bytes of a slow body."""


def _members(port: int, cookie: str) -> Iterator[tuple[str, str, bool]]:
    """Of each member what it says first and then drips, and whether it asks again at once."""
    host = f"Host: 127.0.0.1:{port}\r\n"
    stop = f"POST /api/v1/stop HTTP/1.1\r\n{host}"
    live = (
        f"GET /api/v1/live HTTP/1.1\r\n{host}Upgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
    )
    for _ in range(SLOW):
        yield "", "", False
        yield stop, "", False
        yield f"{stop}Content-Length: 60000\r\n\r\n{{", " ", False
    for number in range(CODES):
        yield f"GET /?code=guess{number} HTTP/1.1\r\n{host}\r\n", "", True
    for number in range(PAGES):
        known = f"Cookie: {cookie}\r\n" if number % 2 else ""
        yield f"{live}{known}\r\n", "", False


async def _press(port: int, words: str, drip: str, is_hasty: bool) -> None:
    while True:
        try:
            async with await trio.open_tcp_stream("127.0.0.1", port) as stream:
                await stream.send_all(words.encode())
                if is_hasty:
                    await stream.receive_some()
                elif drip:
                    while True:
                        await trio.sleep(DRIP_S)
                        await stream.send_all(drip.encode())
                else:
                    while await stream.receive_some():
                        pass
        except (OSError, trio.BrokenResourceError):
            pass
        await trio.sleep(AGAIN_S)


async def crowd(port: int, cookie: str) -> None:
    """Press, for ever."""
    async with trio.open_nursery() as nursery:
        for words, drip, is_hasty in _members(port, cookie):
            nursery.start_soon(_press, port, words, drip, is_hasty)


if __name__ == "__main__":
    trio.run(crowd, int(sys.argv[1]), sys.argv[2])
