"""Names of serial ports that stay with the adapter, whatever number it gets when it is plugged in.

Linux (udev) keeps them in a folder: a link for each adapter, by its maker, kind and serial number.
"""

from __future__ import annotations

import os

BY_ID = "/dev/serial/by-id"


def id_of(path: str, folder: str = BY_ID) -> str:
    """The link in that folder to the port at a path; empty where there is none.

    A path that belongs to a socket of the computer, in a folder `by-path`, is its own id.
    """
    if os.path.basename(os.path.dirname(path)) == "by-path":
        return path
    try:
        links = [os.path.join(folder, name) for name in sorted(os.listdir(folder))]
    except OSError:
        return ""  # no adapter is plugged in, or this system keeps no such links
    if path in links:
        return path
    port = os.path.realpath(path)
    return next((link for link in links if os.path.realpath(link) == port), "")
