"""The screen as a window, or full screen, through pygame."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any

from hri.core.quoting import escaped
from hri.core.signals import Image
from hri.hal.drivers.scaling import by_area
from hri.hal.drivers.silence import silenced_libraries
from hri.hal.picture import fitted
from hri.hal.screen import Screen

UNSEEN = ("dummy", "offscreen")
"""SDL's drivers that show nothing."""


def has_display() -> bool:
    """Whether this machine seems to have something to draw on."""
    if os.environ.get("SDL_VIDEODRIVER"):
        return os.environ["SDL_VIDEODRIVER"] not in UNSEEN
    if sys.platform in ("win32", "darwin"):
        return True
    if os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"):
        return True
    # A Raspberry Pi without a desktop draws straight to its display.
    return any(Path("/dev/dri").glob("card*")) and os.access("/dev/dri/card0", os.W_OK)


class Window(Screen):
    """A window; closing it, or Escape, ends the program that watches `is_closed`.

    A picture of another size is fitted into it, with black bars.
    With `key_repeat` a held key repeats with that period, seconds.
    """

    parameters = ("width", "height", "fullscreen", "title", "key_repeat")
    is_hardware = True

    def _open(self) -> None:
        self._take_size()
        if not has_display():
            raise self.not_available("no display", "connect one, or set DISPLAY")
        import pygame

        self._pygame = pygame
        flags = pygame.SCALED
        if self.description.text("fullscreen") == "true":
            flags |= pygame.FULLSCREEN
        try:
            with silenced_libraries():  # of Wayland
                pygame.display.init()
            if pygame.display.get_driver() in UNSEEN:  # where SDL cannot open a second window
                raise pygame.error("SDL finds no display")
            self._surface: Any = pygame.display.set_mode((self.width, self.height), flags)
        except pygame.error as error:
            pygame.display.quit()
            raise self.not_available(str(error), "connect a display, or set DISPLAY") from error
        pygame.display.set_caption(escaped(self.description.text("title", "hri")))
        repeat = self.description.number_within("key_repeat", 0.0, 0.0, 10.0)
        if repeat:
            pygame.key.set_repeat(round(repeat * 1000))
        self._keys: list[str] = []
        self._is_closed = False

    def show(self, image: Image, time: float) -> None:
        image = fitted(image, self.width, self.height, by_area)
        size = self.width, self.height
        picture = self._pygame.image.frombuffer(image.tobytes(), size, "RGB")
        self._surface.blit(picture, (0, 0))
        self._pygame.display.flip()
        self._take_events()

    def _take_events(self) -> None:
        for event in self._pygame.event.get():
            if event.type == self._pygame.QUIT:
                self._is_closed = True
            elif event.type == self._pygame.KEYDOWN:
                self._keys.append(self._pygame.key.name(event.key))

    def pressed_keys(self) -> list[str]:
        keys, self._keys = self._keys, []
        return keys

    @property
    def is_closed(self) -> bool:
        return self._is_closed

    def _close(self) -> None:
        self._pygame.display.quit()
