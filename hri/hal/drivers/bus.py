"""A bus that only groups devices."""

from typing import ClassVar

from hri.hal.resource import Resource


class Bus(Resource):
    """The buses of 2003, each of which was a separate driver; devices do not need them any
    longer.
    """

    parameters: ClassVar[tuple[str, ...]] = ("device_index",)
