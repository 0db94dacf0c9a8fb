"""An emulated base behind a pseudo-terminal: for programs that open a serial port by its path."""

from __future__ import annotations

import os
import select
import tempfile
import threading
import tty
from pathlib import Path
from types import TracebackType
from typing import Self

from hri.core.clock import Clock
from hri.simulation.bases.emulated_line import Line

PERIOD = 0.001
"""Seconds between two looks whether the base has something to say."""
CHUNK = 4096
MOST_RECEIVED = 1_000_000


class PseudoTerminal:
    """Open while a `with` lasts. `path` stays the same when the base is pulled out and comes back,
    unless it is plugged in as another; the link in the folder `by_id` leads to it under any path.

    What nobody reads is lost as soon as the terminal holds no more, as on a real line.
    """

    def __init__(self, line: Line, clock: Clock) -> None:
        """`clock` is that of the base; it has to run in real time."""
        self._line, self._clock = line, clock
        self._lock = threading.Lock()
        self._is_over = threading.Event()
        self._ends: tuple[int, int] | None = None
        self.received = bytearray()
        """What came in, the last MOST_RECEIVED bytes, for who wants to see them."""

    def __enter__(self) -> Self:
        self._folder = tempfile.TemporaryDirectory(prefix="hri-base-")
        self.by_id = str(Path(self._folder.name, "by-id"))
        os.mkdir(self.by_id)
        self.plug()
        self._thread = threading.Thread(target=self._serve, name="emulated base", daemon=True)
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._is_over.set()
        self._thread.join()
        self.unplug()
        self._folder.cleanup()

    def plug(self, name: str = "port") -> None:
        """Let the port be there, under a name in its folder; a second call does nothing."""
        with self._lock:
            if self._ends is not None:
                return
            ours, theirs = os.openpty()
            tty.setraw(ours)
            tty.setraw(theirs)
            os.set_blocking(ours, False)
            # We keep their end open too: with nobody there, ours could not even be waited for.
            self._ends = ours, theirs
            self.path = str(Path(self._folder.name, name))
            os.symlink(os.ttyname(theirs), self.path)
            os.symlink(self.path, self._link)

    def unplug(self) -> None:
        """Let the port vanish, whoever has it open; a second call does nothing."""
        with self._lock:
            if self._ends is None:
                return
            for path in (self._link, self.path):
                os.unlink(path)
            for end in self._ends:
                os.close(end)
            self._ends = None

    @property
    def _link(self) -> str:
        return str(Path(self.by_id, "usb-emulated_base"))

    def _serve(self) -> None:
        while not self._is_over.is_set():
            ends = self._ends
            if ends is None:
                self._is_over.wait(PERIOD)
                continue
            try:
                ready, _, _ = select.select([ends[0]], [], [], PERIOD)
            except (OSError, ValueError):
                continue  # pulled out meanwhile
            with self._lock:
                if self._ends is ends:
                    self._pass_on(ends[0], bool(ready))

    def _pass_on(self, end: int, is_ready: bool) -> None:
        try:
            data = os.read(end, CHUNK) if is_ready else b""
        except BlockingIOError:
            data = b""  # it was pulled out and came back in between
        self.received += data
        del self.received[:-MOST_RECEIVED]
        answer = self._line.feed(data, self._clock.now())
        if answer:
            try:
                os.write(end, answer)
            except BlockingIOError:
                return  # nobody reads
