"""Joysticks: one in memory, and the one of this machine where there is none."""

import pytest

from hri.core.clock import RealClock
from hri.core.errors import NotAvailable
from hri.hal.drivers.memory import MemoryJoystick
from hri.hal.drivers.pygame_joystick import PygameJoystick
from hri.hal.joystick import Joystick
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager

pytestmark = pytest.mark.proves("H11")


def test_a_joystick_in_memory_is_held_as_told(open_driver):
    joystick = open_driver(MemoryJoystick, axes=3, buttons=2)
    assert joystick.axes(0.0) == (0.0, 0.0, 0.0)
    joystick.hold((0.5, -1.0), (True,))
    assert joystick.axes(0.0) == (0.5, -1.0, 0.0)
    assert joystick.buttons(0.0) == (True, False)
    joystick.hold(())
    assert joystick.axes(0.0) == (0.0, 0.0, 0.0)
    assert joystick.buttons(0.0) == (False, False)


def test_the_type_of_2003_is_missing_in_one_line(monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    device = Description("joystick", "Evolution.JoystickWin32DirectInput", {"device": "15"})
    manager = ResourceManager([device], RealClock())
    with pytest.raises(NotAvailable, match="joystick: no joystick 15 - plug one in"):
        manager.obtain("joystick", Joystick)


class FakePygame:
    """What the driver asks of pygame, with a joystick that can be unplugged."""

    def __init__(self):
        self.count = 1
        self.display = self.event = self.joystick = self

    def get_init(self):
        return True

    def pump(self):
        """All is up to date."""

    def get_count(self):
        return self.count

    def Joystick(self, index):
        return self

    def get_numaxes(self):
        return 2

    def get_axis(self, index):
        return (0.25, -0.5)[index]

    def get_numbuttons(self):
        return 1

    def get_button(self, index):
        return 1

    def quit(self):
        self.count = 0


class StagedJoystick(PygameJoystick):
    def _open(self):
        self._pygame, self._index, self._stick = FakePygame(), 0, None


def test_an_unplugged_joystick_reads_as_nothing_until_it_is_back(open_driver):
    joystick = open_driver(StagedJoystick)
    assert joystick.axes(0.0) == (0.25, -0.5)
    assert joystick.buttons(0.0) == (True,)
    joystick._pygame.count = 0
    assert joystick.axes(1.0) == ()
    assert joystick.buttons(1.0) == ()
    joystick._pygame.count = 1
    assert joystick.axes(2.0) == (0.25, -0.5)
