"""A line to a base that is a resource: what an emulated base offers to its supervisor."""

from __future__ import annotations

from abc import abstractmethod

from hri.hal.port import Port
from hri.hal.resource import Resource


class BaseLine(Resource):
    """Where a base is connected to."""

    @abstractmethod
    def connect(self) -> Port:
        """The port; the same at each call."""
