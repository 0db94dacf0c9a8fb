"""Robots that know each other, on Zenoh: their values, their events, and requests to them.

`docs/fleet.md` has who talks to whom. Nothing here is imported before a robot joins a fleet; raises
HriError where the packages of the extra are missing.
"""

from importlib.util import find_spec

from hri.core.errors import HriError

PACKAGES = {"zenoh": "eclipse-zenoh", "msgspec": "msgspec"}
"""What the extra installs, by module."""

for _module, _package in PACKAGES.items():
    if find_spec(_module) is None:
        raise HriError(f"a fleet needs the package {_package} - pip install 'hri[zenoh]'")
