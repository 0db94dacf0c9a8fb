import math

import numpy as np
import pytest

from hri.behavior.library.printing import InputCollector, PrintBehavior
from hri.core.signals import Frame, Pose2D, Twist, Utterance
from tests.behavior.library.ticking import Links, tick

pytestmark = pytest.mark.proves("B10", "B11", "B19")


@pytest.mark.parametrize(
    ("value", "printed"),
    [
        ("dollar_front.jpg", "string: dollar_front.jpg"),
        (7.62887, "double: 7.62887"),
        (7.628871234, "double: 7.62887"),
        (5.0, "double: 5"),
        (5, "double: 5"),
        (1234567.0, "double: 1.23457e+06"),
        (math.inf, "double: 1.79769e+308"),
        (-math.inf, "double: -1.79769e+308"),
        ((1.0, 2.5, math.inf), "DoubleArray.\n0: 1\n1: 2.5\n2: 1.79769e+308"),
        (math.nan, "double: nan"),
        ((), "DoubleArray."),
        (True, "boolean: true"),
        (
            Utterance("dim it", "dim", {"percent": -25.0}, 0.974, start=0.5),
            "utterance: \"dim it\" is dim {'percent': -25.0}, confidence 0.97",
        ),
        (Twist(0.25, -1.0), "twist: linear 0.25, angular -1"),
        (Pose2D(), "pose: x 0, y 0, heading 0"),
        (Frame(np.zeros((240, 320, 3), np.uint8), 0.0, 7), "image: 320 x 240, number 7"),
    ],
)
def test_a_collector_prints_each_datatype_as_in_2003(value, printed, capsys):
    tick(InputCollector("behavior4"), input=value)
    assert capsys.readouterr().out == f"Input behavior4  {printed}\n"


def test_it_takes_links_of_any_count_and_datatype_and_skips_those_without_a_value(capsys):
    collector = InputCollector("all")
    tick(collector, input=Links(["cup", None, 2.0]))
    assert collector.collected == ["cup", 2.0]
    assert capsys.readouterr().out == "Input all  string: cup\nInput all  double: 2\n"
    tick(collector)
    assert collector.collected == []


def test_it_keeps_quiet_on_request(capsys):
    collector = InputCollector(print_input=False)
    tick(collector, input=1.0)
    assert collector.collected == [1.0]
    assert capsys.readouterr().out == ""


def test_print_writes_the_value_after_a_text(capsys):
    tick(PrintBehavior(text="range: "), input=Links([0.1 + 0.2, None, (1.0, 2.0)]))
    assert capsys.readouterr().out == "range: 0.3\nrange: (1, 2)\n"


@pytest.mark.parametrize("behavior", [InputCollector, PrintBehavior])
@pytest.mark.parametrize("value", [(1.5,) * 30_000, "x" * 65_000], ids=["array", "text"])
def test_a_value_that_is_longer_than_a_screen_is_cut(behavior, value, capsys):
    """One line over the bridge, repeated at every tick, filled the disk."""
    tick(behavior("show"), input=value)
    printed = capsys.readouterr().out
    assert len(printed) < 1200
    assert "and 29900 more" in printed or "..." in printed


def test_an_array_that_fits_is_shown_whole(capsys):
    tick(InputCollector("show"), input=tuple(map(float, range(100))))
    assert capsys.readouterr().out.endswith("98: 98\n99: 99\n")
