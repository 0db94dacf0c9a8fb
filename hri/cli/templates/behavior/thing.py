"""A behavior of your own."""

from hri.behavior import Behavior, Input, Output, Param


class Thing(Behavior):
    """Multiplies what comes in."""

    category = "my"

    number = Input[float]("double", "any number")
    gain = Param(2.0, "what it is multiplied with")
    product = Output[float]("double", "number times gain")

    def compute(self, now: float, dt: float) -> None:
        if (number := self.number.value) is not None:
            self.product.send(number * self.gain)
