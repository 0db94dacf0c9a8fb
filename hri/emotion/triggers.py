"""What happens on the robot becomes stimuli: events by name, and ports of behaviors.

An event is felt each time it is raised. A port is felt when the formula of its stimulus rises above
zero, so that it does not matter how often the port is read; it counts again after a zero. What
lasts is felt as strongly as its event or port says, until that is zero or another event ends it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import partial
from typing import Any

from hri.behavior.behavior import Context, Running
from hri.behavior.runner import Watch
from hri.core.errors import HriError
from hri.core.event_bus import Subscription
from hri.core.signals import Event
from hri.emotion.stimulus import StimulusSpec

STEP = 0.05
"""A change of the intensity of a state that counts; less is too little to be felt."""
MOST_REFUSED = 100
"""Most stimuli whose refusals are reported, so that nonsense does not fill the memory."""

Felt = Callable[[str, float, str | None], object]
"""Takes the name of a stimulus, its intensity and who it comes from."""


class Triggers:
    """Listens for `stimulus.felt` and for all stimuli that have a trigger, until it is closed.

    Faulty stimuli, such as an unknown name, or an event without a property that a formula uses, are
    reported by the event `stimulus.refused`, once per stimulus.
    """

    def __init__(
        self,
        stimuli: Iterable[StimulusSpec],
        context: Context,
        feel: Felt,
        levels: Mapping[str, float] | None = None,
    ) -> None:
        """`levels` are those of the triggers in whose place these come."""
        self.levels = dict(levels or {})
        """How strong the stimuli of ports are, by name; what did not rise is not felt again."""
        self._context = context
        self._feel = feel
        self._refused: set[str] = set()
        stimuli = list(stimuli)
        self._triggered = [spec for spec in stimuli if spec.trigger]
        subscribe = context.events.subscribe
        self._subscriptions: list[Subscription] = [
            subscribe("stimulus.felt", self._on_felt),
            *(subscribe(spec.trigger, partial(self._on_event, spec)) for spec in self._triggered),
            *(
                subscribe(spec.held.ended_by, partial(self._on_end, spec))
                for spec in stimuli
                if spec.held is not None and spec.held.ended_by
            ),
        ]
        self._watches: dict[str, tuple[Running, Watch]] = {}
        """Ports that turned out to be triggers, and what runs them, by stimulus."""
        self._searched: tuple[Running, ...] = ()
        """The networks in which ports were looked for."""

    def connect(self) -> None:
        """Watch the ports that have come up since, and again those whose network was swapped.

        Called now and then.
        """
        running = tuple(self._context.runners)
        if running == self._searched:
            return
        self._searched = running
        for spec in self._triggered:
            runner, watch = self._watches.get(spec.name, (None, None))
            if runner in running:
                continue
            if watch is not None:
                watch.cancel()
                del self._watches[spec.name]
            for candidate in running:
                self._watch(spec, candidate)

    def close(self) -> None:
        """Listen no more; a second call does nothing."""
        for subscription in self._subscriptions:
            subscription.cancel()
        for _, watch in self._watches.values():
            watch.cancel()
        self._subscriptions.clear()
        self._watches.clear()
        self._triggered.clear()

    def feel(self, name: str, intensity: Any = 1.0, person: Any = None) -> None:
        """Feel a stimulus, or report why it cannot be felt."""
        try:
            self._feel(name, float(intensity), None if person is None else str(person))
        except (HriError, TypeError, ValueError) as error:
            self._refuse(name, error)

    def _on_felt(self, event: Event) -> None:
        properties = event.properties
        name = str(properties.get("stimulus", ""))
        self.feel(name, properties.get("intensity", 1.0), properties.get("person"))

    def _on_event(self, spec: StimulusSpec, event: Event) -> None:
        intensity = self._intensity(spec, event.properties)
        if intensity > 0 or spec.held is not None:
            self.feel(spec.name, intensity, spec.doer(event.properties))

    def _on_end(self, spec: StimulusSpec, event: Event) -> None:
        self.feel(spec.name, 0.0, spec.doer(event.properties))

    def _on_port(self, spec: StimulusSpec, value: Any, now: float) -> None:
        intensity = self._intensity(spec, {"value": value})
        before = self.levels.get(spec.name, 0.0)
        is_other = spec.held is not None and (
            abs(intensity - before) >= STEP or (intensity == 0.0) != (before == 0.0)
        )
        is_new = before == 0.0 < intensity
        if spec.held is None or is_new or is_other:
            self.levels[spec.name] = intensity
        if is_new or is_other:
            self.feel(spec.name, intensity, spec.doer({}))

    def _intensity(self, spec: StimulusSpec, properties: Mapping[str, Any]) -> float:
        """Its intensity; 0 when unknown."""
        try:
            return spec.intensity(properties)
        except ValueError as error:
            self._refuse(spec.name, error)
            return 0.0

    def _watch(self, spec: StimulusSpec, runner: Running) -> None:
        """Watch the trigger if it is a port there: "battery.level" of the behavior "battery"."""
        behavior_id, _, output = spec.trigger.rpartition(".")
        for behavior in runner.network.behaviors:
            names = (behavior.id, f"{runner.network.name}.{behavior.id}")
            is_port = behavior_id in names and output in behavior.outputs
            if is_port and spec.name not in self._watches:
                watch = runner.watch(behavior.id, output, partial(self._on_port, spec))
                self._watches[spec.name] = runner, watch

    def _refuse(self, name: str, error: Exception) -> None:
        if name not in self._refused and len(self._refused) < MOST_REFUSED:
            self._refused.add(name)
            reason = f"{name}: {error}"
            self._context.events.raise_event("stimulus.refused", reason=reason)
