"""Gives the page the values and small pictures that it wants of the networks that run."""

from __future__ import annotations

import json
import logging
from collections.abc import Callable, Mapping

from hri.behavior.explanation import why
from hri.behavior.runner import Runner
from hri.behavior.running import Networks
from hri.core.errors import HriError
from hri.core.signals import Frame
from hri.studio.link import NETWORK, REASON, THUMBNAIL, RobotEnd
from hri.studio.port_values import PortSampler, Sample, shown, thumbnail
from hri.studio.topics import ReasonStep
from hri.task.context import TaskContext

LOOK_EVERY, IDLE_EVERY = 0.05, 0.2
"""Seconds between two looks, while something is wanted and while nothing is."""
PICTURES_EVERY = 6
"""Looks between two of the pictures, and of the reasons."""
MOST_PICTURES = 4
log = logging.getLogger("hri.studio")


class NetworkWatch:
    """Used in the robot's loop."""

    def __init__(
        self, networks: Networks, link: RobotEnd, is_debugged: Callable[[Runner], bool]
    ) -> None:
        """`is_debugged`: whether a network may pause by itself, so that its values must be there
        when a page comes to look.
        """
        self._networks, self._link, self._is_debugged = networks, link, is_debugged
        self._samplers: dict[Runner, PortSampler] = {}
        self._samples: dict[Runner, Sample] = {}
        self._told: _Values | None = None
        self._frames: dict[str, Frame] = {}
        self._shown: dict[str, Frame] = {}

    async def watch(self, context: TaskContext) -> None:
        """Look as long as the robot lives."""
        looks = 0
        while True:
            self._follow()
            self._take_pictures()
            self._take_values()
            if looks % PICTURES_EVERY == 0:
                self._tell_pictures()
                self._tell_reasons()
            looks += 1
            await context.clock.sleep(LOOK_EVERY if self._samplers else IDLE_EVERY)

    def _follow(self) -> None:
        """Have a sampler for each network that is wanted, or paused since it was."""
        runners = self._networks.runners
        wanted = {*self._link.wanted_of(NETWORK), *(name for name, _ in self._pictures())}
        followed = {one for name, one in runners.items() if name in wanted}
        for runner in runners.values():
            if self._is_debugged(runner) or (runner.is_paused and runner in self._samplers):
                followed.add(runner)
        for runner in self._samplers.keys() - followed:
            self._samplers.pop(runner).close()
            self._samples.pop(runner, None)
        for runner in followed - self._samplers.keys():
            self._samplers[runner] = PortSampler(runner)

    def _take_values(self) -> None:
        names = self._link.wanted_of(NETWORK)
        runners = {n: r for n, r in self._networks.runners.items() if n in names}
        if not runners:
            self._link.put("ports", {})
            self._told = None
            return
        if self._told is not None and not self._told.is_written:
            return  # the server is slow: the samplers keep what comes
        for runner, sampler in self._samplers.items():
            if runner in runners.values() and (sample := sampler.look()) is not None:
                self._samples[runner] = sample
        samples = {n: self._samples[r] for n, r in runners.items() if r in self._samples}
        if self._told is None or samples != self._told.samples:
            self._told = _Values(samples)
            self._link.put_later("ports", self._told)

    def _tell_reasons(self) -> None:
        reasons: dict[str, list[ReasonStep]] = {}
        for wanted in self._link.wanted_of(REASON):
            name, _, port = wanted.partition("/")
            if (runner := self._networks.runners.get(name)) is not None:
                reasons[wanted] = _reasons(runner, port)
        self._link.put("reasons", reasons)

    def _pictures(self) -> list[tuple[str, str]]:
        """Networks and outputs whose pictures are wanted."""
        wanted = self._link.wanted_of(THUMBNAIL)[:MOST_PICTURES]
        return [(name, port) for name, _, port in (one.partition("/") for one in wanted)]

    def _take_pictures(self) -> None:
        """Before the values: those forget what they have told."""
        found: dict[str, Frame] = {}
        for name, port in self._pictures():
            key = f"{name}/{port}"
            runner = self._networks.runners.get(name)
            frame = self._samplers[runner].picture(port) if runner in self._samplers else None
            if frame is not None or (frame := self._frames.get(key)) is not None:
                found[key] = frame
        self._frames = found

    def _tell_pictures(self) -> None:
        if not self._frames:
            self._link.put("thumbnails", {})
        elif not _is_same(self._frames, self._shown):
            self._link.put_later("thumbnails", _Thumbnails(self._frames))
        self._shown = self._frames


def _is_same(some: Mapping[str, Frame], others: Mapping[str, Frame]) -> bool:
    # By identity: pictures that are compared say of each pixel whether it is the same.
    return some.keys() == others.keys() and all(some[name] is others[name] for name in some)


def _reasons(runner: Runner, port: str) -> list[ReasonStep]:
    """The way back; one step where the network has no such port."""
    try:
        steps = why(runner.network, port, runner.resting)
    except HriError as error:
        return [{"port": port, "value": None, "words": str(error)}]
    return [{"port": s.port, "value": shown(s.value), "words": s.words} for s in steps]


class _Values:
    """The samples of one look, which the link writes in its thread."""

    def __init__(self, samples: Mapping[str, Sample]) -> None:
        self.samples, self.is_written = samples, False

    def __call__(self) -> str:
        parts = [f"{json.dumps(name)}:{one.written()}" for name, one in self.samples.items()]
        self.is_written = True
        return f"{{{','.join(parts)}}}"


class _Thumbnails:
    """Pictures which the link compresses in its thread."""

    def __init__(self, frames: Mapping[str, Frame]) -> None:
        self._frames, self._text = frames, ""

    def __call__(self) -> str:
        if not self._text:
            found = {name: _thumbnail_of(name, frame) for name, frame in self._frames.items()}
            self._text = json.dumps({name: text for name, text in found.items() if text})
        return self._text


def _thumbnail_of(name: str, frame: Frame) -> str:
    try:
        return thumbnail(frame.image)
    except Exception as error:  # what an author sends need not be a picture
        log.debug("%s cannot be shown: %s", name, error)
        return ""
