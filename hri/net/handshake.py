"""How a client proves that it knows the token, without sending it.

    client    <hri><hello>NONCE</hello></hri>
    server    <hri><challenge>NONCE</challenge><ends>...</ends><proof>...</proof></hri>
    client    <hri><proof>...</proof></hri>

A listener that does not know the token gets nothing made with it: the client proves only to a
server that has proven first. Both proofs are for this connection, by its two ends as each side sees
them, and for both nonces. So none can be used again, and none passes from a stranger's port to the
robot's: two connections on one machine never have the same ends. RFC 5929 calls this channel
binding.
"""

from __future__ import annotations

import socket

from hri.core.errors import HriError
from hri.core.token import Challenge, is_nonce, is_proof, new_nonce, proof
from hri.net import control
from hri.net.malleable_protocol import Message
from hri.net.other_end import ends_of_client, is_program_of_this_user

TUNNEL = "docs/bridge.md says how to go through a tunnel"


class Handshake:
    """The client's side of one connection."""

    def __init__(self, token: str) -> None:
        self._token = token
        self._nonce = new_nonce()

    @property
    def hello(self) -> bytes:
        """The first line."""
        return control.hello(self._nonce)

    def answer(self, asked: Message, connection: socket.socket) -> bytes:
        """The line that answers a challenge.

        Raises HriError when the other end does not know the token, or another program stands
        between. One of this user may: it leads where this user wants, as `ssh -L` does.
        """
        nonce, told, shown = (
            control.said(asked, name) or ""
            for name in (control.CHALLENGE, control.ENDS, control.PROOF)
        )
        seen = ends_of_client(connection)
        direct, relayed = (Challenge(self._nonce, nonce, ends) for ends in (seen, told))
        if is_nonce(nonce) and is_proof(shown, self._token, "server", direct):
            return control.proven(proof(self._token, "client", direct))
        if not is_nonce(nonce) or not is_proof(shown, self._token, "server", relayed):
            what = "the program there does not know the token, so it gets no proof of it"
            raise HriError(f"{what} - see who listens there; both sides need the same hri token")
        if not is_program_of_this_user(connection):
            what = "another program stands between this one and the robot, so it gets no proof"
            raise HriError(f"{what} - end it, or connect directly; {TUNNEL}")
        return control.proven(proof(self._token, "client", relayed))
