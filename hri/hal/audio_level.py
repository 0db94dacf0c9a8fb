"""The audio level interface."""

from abc import abstractmethod

from hri.hal.resource import Resource

QUIETEST = -60.0
"""dBFS that count as silence."""


class AudioLevel(Resource):
    """How loud the sound around the robot is."""

    @abstractmethod
    def level_dbfs(self, now: float) -> float:
        """The last tenth of a second as root mean square, -120 to 0 dB against full scale."""

    def level(self, now: float) -> float:
        """The same on the scale of a meter: 0 at -60 dBFS and below, 1 at full scale."""
        return min(1.0, max(0.0, 1.0 - self.level_dbfs(now) / QUIETEST))
