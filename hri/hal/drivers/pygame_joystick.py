"""A joystick of this machine, read through pygame."""

from __future__ import annotations

import os
from typing import Any

from hri.hal.drivers.window import has_display
from hri.hal.joystick import Joystick


class PygameJoystick(Joystick):
    """The joystick with the number `device`, 0 being the first.

    One that is unplugged reads as nothing until it is back, so that a base stops.
    """

    parameters = ("device",)
    is_hardware = True

    def _open(self) -> None:
        # SDL hands out the news of joysticks with those of windows, so it wants a display.
        if not has_display():
            os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
        os.environ.setdefault("SDL_JOYSTICK_ALLOW_BACKGROUND_EVENTS", "1")
        import pygame

        self._pygame = pygame
        self._index = self.description.count("device", 0, 0, 15)
        self._stick: Any = None
        pygame.joystick.init()
        if self._present() is None:
            raise self.not_available(f"no joystick {self._index}", "plug one in")

    def axes(self, now: float) -> tuple[float, ...]:
        if (stick := self._present()) is None:
            return ()
        return tuple(stick.get_axis(i) for i in range(stick.get_numaxes()))

    def buttons(self, now: float) -> tuple[bool, ...]:
        if (stick := self._present()) is None:
            return ()
        return tuple(bool(stick.get_button(i)) for i in range(stick.get_numbuttons()))

    def _present(self) -> Any:
        """The joystick with what it says now; None while it is away."""
        if not self._pygame.display.get_init():  # at first, and after a window was closed
            self._pygame.display.init()
        self._pygame.event.pump()
        if self._pygame.joystick.get_count() <= self._index:
            self._stick = None
        elif self._stick is None:
            self._stick = self._pygame.joystick.Joystick(self._index)
        return self._stick

    def _close(self) -> None:
        self._stick = None
        self._pygame.joystick.quit()
