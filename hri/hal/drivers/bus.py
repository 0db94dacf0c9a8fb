"""A bus that only groups devices."""

from typing import ClassVar

from hri.hal.resource import Resource


class Bus(Resource):
    """The buses of 2003, each of which was a driver of its own; devices find their own way now."""

    parameters: ClassVar[tuple[str, ...]] = ("device_index",)
