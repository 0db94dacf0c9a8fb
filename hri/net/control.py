"""Lines of the bridge that are for the bridge itself: the tag `hri`.

    <hri><token>TOKEN</token></hri>         a peer shows the token; it is its first line
    <hri><stop/></hri>                      a peer stops the robot; on this machine without a token
    <hri><refused>why</refused></hri>       to a peer: what it sent did not come in

Receivers of 2003 ignore tags that they do not know.
"""

from __future__ import annotations

from hri.net.malleable_protocol import Item, Message, encode

TAG = "hri"
TOKEN, STOP, REFUSED = "token", "stop", "refused"


def introduction(token: str) -> bytes:
    """The line that shows a token."""
    return encode(Message(TAG, (Item(TOKEN, token, None),)))


def refusal(why: str) -> bytes:
    """The line that gives a peer the reason of a refusal."""
    return encode(Message(TAG, (Item(REFUSED, why, None),)))


def shown_token(message: Message) -> str | None:
    """The token that a message shows; None when it shows none."""
    return _value(message, TOKEN)


def asks_to_stop(message: Message) -> bool:
    """Whether a message stops the robot."""
    return _value(message, STOP) is not None


def why_refused(message: Message) -> str | None:
    """What the other end did not take; None when the message says something else."""
    return _value(message, REFUSED)


def _value(message: Message, port: str) -> str | None:
    return next((item.text for item in message.items if item.port == port), None)
