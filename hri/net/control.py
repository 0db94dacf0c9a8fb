"""Lines of the bridge that are for the bridge itself: the tag `hri`.

    <hri><hello>NONCE</hello></hri>         a client asks for a challenge; it is its first line
    <hri><challenge>NONCE</challenge><ends>FROM TO</ends><proof>PROOF</proof></hri>
                                            the server's answer, with its own proof
    <hri><proof>PROOF</proof></hri>         the client proves that it knows the token
    <hri><token>TOKEN</token></hri>         a peer sends the token itself; no program of ours does
    <hri><stop/></hri>                      a peer stops the robot; on this machine without a token
    <hri><refused>why</refused></hri>       to a peer: what it sent did not come in

Receivers of 2003 ignore tags that they do not know. `handshake` has the order of these lines.
"""

from __future__ import annotations

from hri.core.token import Challenge
from hri.net.malleable_protocol import Item, Message, encode

TAG = "hri"
HELLO, CHALLENGE, ENDS, PROOF = "hello", "challenge", "ends", "proof"
TOKEN, STOP, REFUSED = "token", "stop", "refused"


def hello(nonce: str) -> bytes:
    """The line with which a client asks for a challenge."""
    return _line((HELLO, nonce))


def challenge(made: Challenge, proof: str) -> bytes:
    """The line that challenges a client; `proof` is the server's own, empty without a token."""
    return _line((CHALLENGE, made.server), (ENDS, made.ends), (PROOF, proof))


def proven(proof: str) -> bytes:
    """The line with the client's proof."""
    return _line((PROOF, proof))


def refusal(why: str) -> bytes:
    """The line that gives a peer the reason of a refusal."""
    return _line((REFUSED, why))


def said(message: Message, what: str) -> str | None:
    """What a message says under a name, such as `HELLO`; None when it does not have it."""
    return next((item.text for item in message.items if item.port == what), None)


def _line(*items: tuple[str, str]) -> bytes:
    return encode(Message(TAG, tuple(Item(name, text, None) for name, text in items)))
