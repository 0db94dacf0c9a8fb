"""Write a behavior: it reads its inputs and writes its outputs once a tick."""

from hri.behavior import Behavior, Output, Param
from hri.testing import context, run_for


class Counter(Behavior):
    """Counts its ticks."""

    step = Param(1, "what is added in each tick")
    count = Output[float]("double", "the sum so far")
    _count = 0

    def compute(self, now: float, dt: float) -> None:
        self._count += self.step
        self.count.send(self._count)


counter = Counter(step=2)
run_for(1.0, [counter], context())
print(counter.count.value)
