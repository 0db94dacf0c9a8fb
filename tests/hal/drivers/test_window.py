"""The window, on SDL's driver that shows nothing."""

import numpy as np
import pygame
import pytest

from hri.core.errors import AuthoringError, NotAvailable
from hri.hal.drivers import window
from hri.hal.drivers.memory import OffscreenScreen
from hri.hal.drivers.window import Window
from hri.hal.resource import Description

pytestmark = pytest.mark.filterwarnings("ignore:no fast renderer available")


@pytest.fixture
def open_window(open_driver, monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    monkeypatch.setattr(window, "UNSEEN", ())
    return lambda **parameters: open_driver(Window, **parameters)


def test_a_picture_is_shown_as_it_is(open_window):
    screen = open_window(width=64, height=48)
    image = np.random.default_rng(1).integers(0, 255, (48, 64, 3), np.uint8)
    screen.show(image, 0.0)
    assert (screen.width, screen.height) == (64, 48)
    shown = pygame.surfarray.array3d(pygame.display.get_surface()).swapaxes(0, 1)
    assert np.array_equal(shown, image)


@pytest.mark.parametrize("size", [(48, 64), (96, 128), (24, 32), (8, 400), (400, 8), (1, 1)])
def test_a_picture_of_any_size_is_seen_whole(open_window, size):
    screen = open_window(width=64, height=48)
    screen.show(np.full((48, 64, 3), 99, np.uint8), 0.0)
    height, width = size
    quarters = np.zeros((*size, 3), np.uint8)
    for number, (top, left) in enumerate([(0, 0), (0, 1), (1, 0), (1, 1)], start=1):
        quarters[top * height // 2 :, left * width // 2 :] = 60 * number
    screen.show(quarters, 0.1)
    shown = pygame.surfarray.array3d(pygame.display.get_surface()).swapaxes(0, 1)
    assert shown.shape == (48, 64, 3)
    lit = np.argwhere(shown[..., 0] > 0)
    (top, left), (bottom, right) = lit.min(axis=0), lit.max(axis=0)
    scale = min(48 / height, 64 / width)
    assert bottom - top + 1 == pytest.approx(max(1, height * scale), abs=1)
    assert right - left + 1 == pytest.approx(max(1, width * scale), abs=1)
    assert (top + bottom) / 2 == pytest.approx(23.5, abs=1)
    assert (left + right) / 2 == pytest.approx(31.5, abs=1)
    if min(size) > 8:
        assert shown[top, left, 0] == 60
        assert shown[bottom, right, 0] == 240


def test_keys_are_told_once_and_closing_is_seen(open_window):
    screen, image = open_window(width=64, height=48), np.zeros((48, 64, 3), np.uint8)
    pygame.event.post(pygame.event.Event(pygame.KEYDOWN, key=pygame.K_SPACE))
    screen.show(image, 0.0)
    assert screen.pressed_keys() == ["space"]
    assert screen.pressed_keys() == []
    assert not screen.is_closed
    pygame.event.post(pygame.event.Event(pygame.QUIT))
    screen.show(image, 0.1)
    assert screen.is_closed


def test_without_a_display_it_is_not_there(manager, monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    with pytest.raises(NotAvailable, match="screen: no display - connect one, or set DISPLAY"):
        Window(Description("screen", "Hri.Screen"), manager).activate()


def test_where_sdl_finds_no_display_it_may_be_tried_again(manager, monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "offscreen")
    monkeypatch.setattr(window, "has_display", lambda: True)
    for _ in range(3):
        with pytest.raises(NotAvailable, match="screen: SDL finds no display - connect"):
            Window(Description("screen", "Hri.Screen"), manager).activate()


@pytest.mark.parametrize("driver", [Window, OffscreenScreen])
@pytest.mark.parametrize("value", ["0", "-640", "1e9", "15", "320.5", "many"])
def test_a_size_out_of_range_is_refused(manager, driver, value):
    with pytest.raises(AuthoringError, match=r"width: .+ - write"):
        driver(Description("screen", "Hri.Screen", {"width": value}), manager).activate()
