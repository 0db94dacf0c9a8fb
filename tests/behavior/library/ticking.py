"""A behavior ticked by hand: values go in by the name of the port, values come out by theirs."""

from typing import Any

from hri.behavior.behavior import Behavior
from hri.behavior.ports import OutputPort


class Links(list[Any]):
    """What several links of one port carry; None for a link that carries nothing."""


def tick(behavior: Behavior, now: float = 0.0, dt: float = 0.1, **inputs: Any) -> dict[str, Any]:
    """One tick; a port that is not named has no link. What was sent, by the name of the output."""
    for name in behavior.inputs:
        value = inputs.pop(name, Links())
        links = value if isinstance(value, Links) else Links([value])
        getattr(behavior, name).sources = [OutputPort(carried) for carried in links]
    assert not inputs, f"no such ports: {inputs}"
    for name in behavior.outputs:
        getattr(behavior, name).value = None
    behavior.compute(now, dt)
    sent = {name: getattr(behavior, name).value for name in behavior.outputs}
    return {name: value for name, value in sent.items() if value is not None}
