"""The camera interface."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections import deque
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

import trio
from numpy.typing import NDArray

from hri.core.origin import origin
from hri.core.signals import Frame
from hri.hal.picture import TURNS, as_picture, oriented
from hri.hal.resource import Description, Resource, Resources

LOOK = 0.01
"""Seconds between looks for the next picture."""
STALL = 3.0
"""Seconds without a picture after which the camera counts as lost."""
AHEAD = 0.5
"""Seconds; what is dated further ahead of the clock is dated wrong."""
RATE_WINDOW = 60
"""Pictures over which the rate is measured."""
MOST_NOTICES = 20
"""Most different faults of a camera that are reported."""
FIELD_OF_VIEW = (1.05, 0.1, 3.0)
"""Radians: that of a common webcam, the least and the most."""


@dataclass(frozen=True, slots=True)
class Footage:
    """What a camera has given so far."""

    width: int
    """Pixels, of the latest picture."""
    height: int
    rate: float
    """Pictures a second that were read lately; 0 before the second one."""
    lost: int
    """Pictures that were taken but never read, because a newer one was there or they were bad."""
    refused: int
    """Number of invalid pictures: empty, too large, or of an unknown format."""


@dataclass(slots=True)
class _Log:
    """What a camera keeps in mind of the pictures it gave since it was opened."""

    times: deque[float] = field(default_factory=lambda: deque(maxlen=RATE_WINDOW))
    lost: int = 0
    refused: int = 0
    sequence: int | None = None
    """Of the latest picture."""
    seen: float = math.inf
    """Seconds, when a picture came last."""
    is_lost: bool = False
    told: set[str] = field(default_factory=set)
    """What people were told since all was well."""


class Camera(Resource):
    """Pictures with the time they were taken.

    A driver writes `_read`. What it gives is made a picture of three channels of 8 bits here,
    turned (`rotate`) and mirrored back (`mirror`) as the configuration says. `switch(False)` lets
    the device go, whoever uses it, until `switch(True)`.
    """

    parameters: ClassVar[tuple[str, ...]] = ("mirror", "rotate")

    width: int = 320
    height: int = 240
    field_of_view: float = FIELD_OF_VIEW[0]
    """Horizontal, radians."""
    is_recording: bool = False
    """True when its times are those of a recording, which may be ahead of the clock."""

    def __init__(self, description: Description, manager: Resources) -> None:
        super().__init__(description, manager)
        self._is_on = True
        self.switched_by = ""
        """Who switched it last, as `hri.core.origin` has it."""
        self._log = _Log()

    @classmethod
    def check(cls, description: Description) -> None:
        super().check(description)
        _ = _turn(description), _is_mirrored(description)

    @abstractmethod
    def _read(self, now: float) -> Frame | None:
        """The newest picture taken since the last call, for drivers; None when there is none."""

    def read(self, now: float) -> Frame | None:
        """The newest picture taken since the last call; None when there is none yet.

        Also None while the camera is switched off, and for an invalid picture, which is reported
        once. The times of pictures only grow.
        """
        if not self._is_on:
            return None
        frame = self._read(now)
        if frame is not None:
            frame = self._checked(frame, now)
        self._watch(now, frame is not None)
        return frame

    def look_ahead(self, is_ahead: bool) -> None:
        """Ask a camera on a neck to look straight ahead, not at people; others always do."""

    def take(self, timeout: float = 5.0) -> Any:
        """Wait for the next picture, a Frame; in a task it is awaited: `await camera.take()`.

        Raises NotAvailable when none comes within `timeout` seconds, or it is switched off.
        """
        if trio.lowlevel.in_trio_run():
            return self._awaited(timeout)
        clock = self.manager.clock
        end = clock.now() + timeout
        while (frame := self._look_for(end, timeout)) is None:
            clock.advance(LOOK)
        return frame

    async def _awaited(self, timeout: float) -> Frame:
        clock = self.manager.clock
        end = clock.now() + timeout
        while (frame := self._look_for(end, timeout)) is None:
            await clock.sleep(LOOK)
        return frame

    def _look_for(self, end: float, timeout: float) -> Frame | None:
        """The next picture; None while it is worth to wait for one. Raises NotAvailable."""
        now = self.manager.clock.now()
        if (frame := self.read(now)) is not None:
            return frame
        if not self._is_on:
            raise self.not_available("switched off", "switch it on")
        if now >= end:
            why = f"no picture within {timeout:g} s"
            raise self.not_available(why, "unplug it and plug it in again")
        return None

    def try_out(self, seconds: float = 0.6) -> None:
        """Read for a moment, so that `footage` and `describe` can tell the rate."""
        clock = self.manager.clock
        end = clock.now() + seconds
        while clock.now() < end:
            self.read(clock.now())
            clock.advance(LOOK)

    def pan(self, now: float) -> float:
        """Where it points, from the robot's straight ahead to the left, radians."""
        return 0.0

    @property
    def has_ended(self) -> bool:
        """True when no further picture will come (a file is spent)."""
        return False

    @property
    def is_on(self) -> bool:
        """False while someone has switched it off."""
        return self._is_on

    @property
    def is_lost(self) -> bool:
        """True while it should give pictures but has given none for 3 seconds."""
        return self._log.is_lost

    @property
    def is_watching(self) -> bool:
        """True while pictures of the world come; people want to know."""
        return (
            self._is_on and bool(self._log.times) and not self._log.is_lost and not self.has_ended
        )

    def switch(self, on: bool) -> None:
        """Turn it on or off; off lets the device go, so that its light goes out.

        It stays off for whoever asks for it next. Raises NotAvailable when it cannot be opened
        again; it is then off still.
        """
        with self._lock:
            if on == self._is_on:
                return
            self.switched_by = origin()
            if on:
                self._is_on = True
                if self._is_active:
                    self._reopen()
                return
            self._is_on = False
            if self._is_active:
                try:
                    self._close()
                finally:
                    self._let_go()
                    self._log = _Log()

    def _reopen(self) -> None:
        self._is_active = False
        try:
            self.activate()
        except BaseException:
            self._is_active, self._is_on = True, False
            raise

    def activate(self) -> None:
        """Open, unless it is switched off. Raises NotAvailable when the thing is not there."""
        with self._lock:
            if not self._is_on:
                self._is_active = True
                return
            if not self._is_active:
                self._log = _Log()
                self._turn = _turn(self.description)
                self._is_mirrored = _is_mirrored(self.description)
            super().activate()

    def deactivate(self) -> None:
        """Close, whoever still uses it; a second call does nothing."""
        with self._lock:
            if self._is_on:
                super().deactivate()
            else:
                self._is_active, self._reservations = False, 0

    def _take_size(self, picture: NDArray[Any]) -> None:
        """For drivers: note the size, and the view across, that such a picture has once turned."""
        self.height, self.width = picture.shape[:2]
        if TURNS[self._turn] % 2:
            self.height, self.width = self.width, self.height
            across = math.tan(self.field_of_view / 2) * self.width / self.height
            self.field_of_view = 2 * math.atan(across)

    def footage(self) -> Footage:
        """What it has given since it was opened."""
        times = self._log.times
        span = times[-1] - times[0] if len(times) > 1 else 0.0
        rate = (len(times) - 1) / span if span > 0 else 0.0
        return Footage(self.width, self.height, rate, self._log.lost, self._log.refused)

    def describe(self) -> str:
        """Type, size, view, and once it has given pictures how many and how many were lost."""
        size = f"{self.width} x {self.height}"
        view = f"{math.degrees(self.field_of_view):.0f} degrees wide"
        words = [f"{self.description.type} {size}", view]
        footage = self.footage()
        if footage.rate:
            words.append(f"{footage.rate:.0f} pictures a second, {footage.lost} lost")
        if not self._is_on:
            words.append("switched off")
        return ", ".join(words)

    def _checked(self, frame: Frame, now: float) -> Frame | None:
        """The frame as all others expect it; None when that cannot be."""
        last = self._log.times[-1] if self._log.times else -math.inf
        time = frame.time
        latest = math.inf if self.is_recording else now + AHEAD
        if not (last < time <= latest) or math.isinf(time):
            # A source that lost its time: the arrival is the next best.
            time = now
        if time <= last:
            self._log.lost += 1
            return None
        try:
            image = oriented(as_picture(frame.image), self._turn, self._is_mirrored)
        except ValueError as error:
            self._refuse(str(error))
            return None
        if self._log.sequence is not None:
            self._log.lost += max(0, frame.sequence - self._log.sequence - 1)
        self._log.sequence = frame.sequence
        self._log.times.append(time)
        self.height, self.width = image.shape[:2]
        return replace(frame, image=image, time=time)

    def _refuse(self, reason: str) -> None:
        self._log.refused += 1
        self._tell(f"gives {reason} - it is passed over; check the device and its settings")

    def _watch(self, now: float, has_picture: bool) -> None:
        """Tell when it falls silent, and when it is back."""
        if has_picture or self._log.seen == math.inf or self.has_ended:
            self._log.seen = now
            if has_picture and self._log.is_lost:
                self._log.is_lost = False
                self._log.told.clear()
                self.manager.notice(f"{self.id}: is back")
        elif now - self._log.seen > STALL and not self._log.is_lost:
            self._log.is_lost = True
            self._tell(self._why_silent(now))

    def _why_silent(self, now: float) -> str:
        """What people are told when no picture came for three seconds: "what - remedy"."""
        return f"no picture for {STALL:g} s - waiting for it; see that it is plugged in"

    def _tell(self, what: str) -> None:
        """One line for people, each only once until the camera is well again."""
        if what not in self._log.told and len(self._log.told) < MOST_NOTICES:
            self._log.told.add(what)
            self.manager.notice(f"{self.id}: {what}")


def _turn(description: Description) -> str:
    return description.choice("rotate", "0", TURNS)


def _is_mirrored(description: Description) -> bool:
    return description.choice("mirror", "false", ("false", "true")) == "true"
