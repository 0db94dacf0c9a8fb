"""A protocol that talks to an emulated base, in fake time."""

from hri.core.signals import Twist
from hri.drive.bases.arduino import Wiring
from hri.drive.bases.protocol import BaseProtocol, BaseReport
from hri.simulation.bases.emulated_line import Line

STEP = 0.005
WIRING = Wiring(
    bumps={"left": 7, "right": 8},
    cliffs={"left": 0, "right": 1},
    sonars={"front_left": 4, "front": 5},
)


class Talk:
    """What a supervisor would do, without any of its care."""

    def __init__(self, protocol: BaseProtocol, line: Line) -> None:
        self.protocol, self.line = protocol, line
        self.now = 0.0
        self.reports: list[BaseReport] = []

    def greet(self) -> None:
        for step in self.protocol.greeting():
            self.say(step.data)
            self.run(step.pause)

    def say(self, data: bytes) -> None:
        self.hear(self.line.feed(data, self.now))

    def hear(self, data: bytes) -> None:
        self.reports += self.protocol.feed(data, self.now)

    def run(self, seconds: float, twist: Twist | None = None) -> None:
        """Let time pass, with a velocity now and then."""
        for step in range(round(seconds / STEP)):
            if twist is not None and step % 10 == 0:
                self.say(self.protocol.velocity(twist))
            self.say(self.protocol.poll(self.now))
            self.now += STEP
            self.hear(self.line.feed(b"", self.now))

    @property
    def last(self) -> BaseReport:
        return self.reports[-1]
