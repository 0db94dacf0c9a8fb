"""A feeling moves the base a little: when it may, and never when it must not."""

import math

import pytest

from hri.core.geometry import wrapped
from hri.emotion import EmotionModel
from hri.robot import verbs
from hri.simulation.world import SimulatedWorld
from hri.speech.behaviors import Listener
from tests.apps.test_companion import Visit
from tests.apps.test_manners import typing


def feeling(stimuli):
    """A job in which the robot feels stimuli at times."""

    async def job(context):
        for time, stimulus in stimuli.items():
            await context.clock.sleep_until(time)
            context.behavior(EmotionModel).feel(stimulus)

    return job


def headings(visit):
    """Degrees to the left of where it stood first."""
    first = visit.poses[0][1].heading
    return [math.degrees(wrapped(pose.heading - first)) for _, pose in visit.poses]


def moved(visit):
    return [event.properties["emotion"] for event in visit.named("emotion.moved")]


def test_it_wiggles_when_it_is_praised_once_and_not_for_every_praise():
    visit = Visit(9, {}, jobs=[feeling({1.0: "praise", 4.0: "praise"})])
    assert moved(visit) == ["joy"]
    turned = headings(visit)
    assert max(turned) == pytest.approx(8, abs=1.5)
    assert min(turned) == pytest.approx(-8, abs=1.5)
    assert turned[-1] == pytest.approx(0, abs=1)


def test_it_backs_off_over_the_ground_it_came_over():
    async def come(context):
        await verbs.move(context, 0.3)

    visit = Visit(9, {}, jobs=[come, feeling({5.0: "cliff_found", 5.1: "kicked"})])
    assert moved(visit)
    ahead = [pose.x for _, pose in visit.poses]
    assert ahead[-1] == pytest.approx(0.22, abs=0.01)


def test_it_does_not_back_off_where_it_has_not_been():
    visit = Visit(3, {}, jobs=[feeling({1.0: "cliff_found"})])
    assert moved(visit) == []
    assert math.dist((visit.poses[-1][1].x, visit.poses[-1][1].y), (0, 0)) < 0.005


def test_after_a_stop_it_stands_still_until_it_is_told_to_move():
    lines = {1.0: "stop", 6.0: "turn right"}
    visit = Visit(26, lines, jobs=[feeling({4.0: "praise", 12.0: "kicked", 20.0: "kicked"})])
    assert all(abs(pose.heading) < 0.01 for time, pose in visit.poses if time < 6)
    assert [event.time > 12 for event in visit.named("emotion.moved")] == [True]


def test_a_stop_ends_the_motion():
    visit = Visit(6, {}, keys=[(1.4, "space")], jobs=[feeling({1.0: "praise"})])
    assert moved(visit) == ["joy"]
    at = visit.pose_at(2.0)
    assert visit.poses[-1][1].heading == pytest.approx(at.heading, abs=0.002)
    assert min(headings(visit)) > -4


def test_an_order_to_move_replaces_it():
    visit = Visit(8, {1.6: "turn around"}, jobs=[feeling({1.0: "praise"})])
    assert abs(headings(visit)[-1]) == pytest.approx(180, abs=9)  # from the midst of a wiggle


def test_it_stands_still_while_someone_answers():
    async def ask(context):
        await verbs.ask(context, "Do you want a pizza?", timeout=6)

    visit = Visit(6, {}, jobs=[ask, feeling({1.5: "praise"})])
    assert moved(visit) == []
    assert max(map(abs, headings(visit))) < 0.5


def test_it_feels_a_kick_and_is_less_angry_once_that_is_explained():
    def kick(robot):
        world = robot.resources.obtain("world", SimulatedWorld)
        robot.clock.call_at(2.0, lambda: world.base.push(0.1, robot.clock.now()))

    async def talk(context):
        listener, emotion = context.behavior(Listener), context.behavior(EmotionModel)
        await context.clock.sleep_until(3.0)
        listener.type_line("why are you angry")
        await context.clock.sleep_until(6.0)
        angry.append(emotion.feeling().emotions["anger"])
        listener.type_line("it was an accident")
        await context.clock.sleep_until(7.0)
        angry.append(emotion.feeling().emotions["anger"])

    angry = []
    visit = Visit(8, {}, prepare=kick, jobs=[talk])
    assert "kicked me" in visit.said()[0]
    assert angry[1] < 0.7 * angry[0]


def test_it_feels_stuck_where_it_cannot_go_on_and_free_again_after():
    def block(robot):
        robot.resources.obtain("world", SimulatedWorld).put_obstacle("box", 0.7, 0.0, 0.0)

    ask = "how are you"
    lines = {0.5: "go forward one meter", 25.0: ask, 30.0: "go back half a meter", 36.0: ask}
    visit = Visit(40, {}, jobs=[typing(lines)], prepare=block)
    assert visit.said()[1] == "Something's in my way."
    assert "because I'm stuck" in visit.said()[3]
    assert "because I can move again" in visit.said()[5]
