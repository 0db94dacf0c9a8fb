"""What the companion does while nothing happens, and that it leaves off when something does."""

import math

import pytest

from apps.companion.companion import Companion
from hri.core import HriError
from hri.emotion import EmotionModel
from hri.robot.verbs import SHOWN
from hri.speech.behaviors import Voice
from tests.apps.test_companion import Visit
from tests.apps.test_manners import typing


def acts(visit):
    return [(e.time, e.properties["act"]) for e in visit.events if e.name == "idle.acted"]


def sounds(visit):
    return [text for text in visit.said() if text.startswith("[")]


@pytest.mark.parametrize(
    ("stimulus", "heard"),
    [("praise", {"[hum soft]", "[mmm soft]", "[whee soft short]", "[puff soft]"}),
     ("scold", {"[sniff soft]", "[puff soft]"})],
)  # fmt: skip
def test_it_does_something_when_it_is_quiet_and_sounds_come_after_a_minute(stimulus, heard):
    async def feel(context):
        for second in (5.0, 40.0, 80.0):
            await context.clock.sleep_until(second)
            context.behavior(EmotionModel).feel(stimulus)

    visit = Visit(110, {}, jobs=[typing({1.0: "you are great"}), feel])
    done = acts(visit)
    assert len(done) >= 2
    assert len({name for _, name in done}) == len(done)
    assert all(time > 15 for time, _ in done)
    assert set(sounds(visit)) <= heard


def test_it_makes_no_sound_once_sounds_are_not_wanted():
    async def mute(context):
        context.behavior(Voice).makes_sounds = False

    visit = Visit(80, {}, jobs=[typing({1.0: "you are great"}), mute])
    assert acts(visit)
    assert not sounds(visit)


def test_it_leaves_off_when_someone_speaks():
    visit = Visit(90, {}, jobs=[typing(dict.fromkeys(range(1, 90, 9), "how are you"))])
    assert not acts(visit)


SLEEPY = """
every_s = 2
[act.falls_asleep]
about = "falls asleep"
naps = true
show = "asleep"
after_s = 8
again_s = 0
weight = 1000
"""


def test_it_falls_asleep_and_a_word_wakes_it(tmp_path, monkeypatch):
    (tmp_path / "emotions").mkdir()
    (tmp_path / "emotions" / "idle.toml").write_text(SLEEPY)
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    shown = {}

    async def look(context):
        slot = context.board.slot(SHOWN)
        while True:
            await context.clock.sleep(1.0)
            shown[round(context.clock.now())] = slot.value and slot.value.label

    visit = Visit(66, {}, jobs=[typing({1.0: "hello robot", 56.0: "how are you"}), look])
    assert "falls_asleep" in {name for _, name in acts(visit)}
    assert shown[55] == "asleep"
    assert shown[58] != "asleep"
    answers = [e for e in visit.events if e.name == "speech.said" and e.time > 56]
    assert answers, "it hears while it dozes"
    begun, ended = (
        [e.time for e in visit.events if e.name == name and e.properties["name"] == "wakeUp"]
        for name in ("gesture.started", "gesture.ended")
    )
    assert ended[-1] - begun[-1] > 2.0, "it wakes up to the end"


def test_it_keeps_still_by_word():
    async def look(context):
        companion = Companion.of(context)
        await context.clock.sleep_until(10.0)
        assert not companion.fidgets
        await context.clock.sleep_until(20.0)
        assert companion.fidgets

    typed = typing({1.0: "stop fidgeting", 12.0: "you may fidget again"})
    assert Visit(22, {}, jobs=[typed, look]).said()


def test_a_broken_file_of_acts_is_refused_at_the_start(tmp_path, monkeypatch):
    (tmp_path / "emotions").mkdir()
    (tmp_path / "emotions" / "idle.toml").write_text('[act.a]\nabout = "a"\ngesture = "nodd"\n')
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    with pytest.raises(HriError, match='has no gesture "nodd" - did you mean "nod"'):
        Visit(5, {})


FIDGETY = """
every_s = 1
[act.looks_the_other_way]
about = "turns"
move = { above = 0.1, turns = [40, -40, 40, -40, 40], pace = 0.2 }
after_s = 1
again_s = 0
weight = 1000
"""


@pytest.mark.parametrize(("order", "goes"), [("go forward one meter", True), ("stop", False)])
def test_an_order_within_an_act_that_moves_is_carried_out(order, goes, tmp_path, monkeypatch):
    (tmp_path / "emotions").mkdir()
    (tmp_path / "emotions" / "idle.toml").write_text(FIDGETY)
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    visit = Visit(16, {}, jobs=[typing({8.0: order})])
    begun = [time for time, name in acts(visit) if name == "looks_the_other_way"]
    assert begun, "it fidgets"
    assert begun[0] < 8.0
    assert abs(visit.pose_at(7.9).heading - visit.pose_at(0.5).heading) > 0.01, "it turns when told"
    before, after = visit.pose_at(8.0), visit.pose_at(15.5)
    way = math.hypot(after.x - before.x, after.y - before.y)
    if goes:
        assert way > 0.9
    else:
        stopped = visit.pose_at(9.0)
        assert abs(after.heading - stopped.heading) < 0.01
        assert way < 0.02
