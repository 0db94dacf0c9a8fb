"""Your own behavior."""

from hri.behavior import Behavior, Input, Output, Param


class Thing(Behavior):
    """Multiplies its input."""

    category = "my"

    number = Input[float]("double", "any number")
    gain = Param(2.0, "the factor")
    product = Output[float]("double", "number times gain")

    def compute(self, now: float, dt: float) -> None:
        if (number := self.number.value) is not None:
            self.product.send(number * self.gain)
