import math

import pytest

from hri.behavior.network import Network
from hri.core.errors import HriError
from hri.task.context import TaskContext
from hri.vision.behaviors import Attention, PersonTracker
from hri.vision.tasks import look_at, wait_for_person
from hri.vision.tracking import people
from tests.task.stage import Stage as Loop
from tests.vision.stage import Player, Spot, Stage, standing
from tests.vision.test_behaviors import Projector
from tests.vision.tracking.test_people import ANNA, BEN, away_between, until


@pytest.fixture
def perform(monkeypatch):
    """Runs a job before a stage, with a network that sees it; what the job returns."""

    def run(stage: Stage, job, *arguments):
        monkeypatch.setattr(people, "load_detectors", lambda setting: stage.detectors())
        projector = Projector("projector")
        projector.stage, projector.odd = stage, []
        network = Network("seeing", 1 / 15)
        for behavior in (projector, PersonTracker("tracker"), Attention("attention")):
            network.add(behavior)
        network.connect("projector.image", "tracker.image")
        network.connect("tracker.people", "attention.people")
        loop = Loop()

        async def start(context: TaskContext):
            context.networks.start(network)
            return await job(context, *arguments)

        return loop.run(start)

    return run


def test_who_is_there_already_ends_the_wait(perform):
    async def job(context: TaskContext):
        return await wait_for_person(context), context.clock.now()

    person, now = perform(Stage([Player(standing())]), job)
    assert person == "p1"
    assert now < 0.5


def test_the_wait_is_for_somebody_and_not_for_ever(perform):
    late = Stage([Player(away_between(0.0, 2.0, standing()))])
    assert perform(late, wait_for_person, False, 0.0, 5.0) == "p1"
    assert perform(Stage([]), wait_for_person, False, 0.0, 1.0) is None


def test_the_wait_may_be_for_a_look_or_for_somebody_near(perform):
    def turning(time: float) -> Spot:
        return Spot(160, 110, 40 if time < 3 else 90, 0.0, 1.0 if time < 1.5 else 0.0)

    async def times(context: TaskContext):
        assert await wait_for_person(context, looking=True) == "p1"
        looked = context.clock.now()
        assert await wait_for_person(context, within=0.7) == "p1"
        return looked, context.clock.now()

    looked, near = perform(Stage([Player(turning)]), times)
    assert 1.6 < looked < 2.4
    assert 3.0 < near < 4.0


def test_the_eyes_stay_on_a_person_for_as_long_as_asked(perform):
    stage = Stage([Player(standing(90, size=90), **ANNA), Player(standing(250), **BEN)])

    async def job(context: TaskContext):
        await context.clock.sleep(1.5)
        start = context.clock.now()
        was_there = await look_at(context, "p2", 1.0)
        return was_there, context.clock.now() - start, context.behavior(Attention)._asked

    was_there, seconds, asked = perform(stage, job)
    assert (was_there, asked) == (True, "")
    assert seconds == pytest.approx(1.0, abs=0.1)


def test_looking_ends_when_the_person_has_gone(perform):
    async def job(context: TaskContext):
        await wait_for_person(context)
        return await look_at(context), context.clock.now()

    was_there, now = perform(Stage([Player(until(2.0, standing()))]), job)
    assert not was_there
    assert now == pytest.approx(5.0, abs=0.5), "given up three seconds later"


def test_without_a_tracker_it_is_told_what_to_add():
    with pytest.raises(HriError, match=r"add an Hri\.PersonTracker"):
        Loop().run(wait_for_person, False, 0.0, math.inf)
