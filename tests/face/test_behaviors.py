import numpy as np
import pytest

from hri.behavior.behavior import Behavior, Context
from hri.behavior.network import Network
from hri.behavior.ports import Output
from hri.behavior.runner import Runner
from hri.core.clock import FakeClock
from hri.core.events import EventBus
from hri.core.signals import Event, Expression, FaceWeights, Image, Speech
from hri.face.behaviors import Face, FaceRenderer
from hri.hal.drivers.memory import OffscreenScreen
from hri.hal.manager import ResourceManager
from hri.hal.resource import Description
from tests.face.test_motion import TICK, spoken


class Director(Behavior):
    """Sends what a test wants."""

    speech = Output[Speech]("speech", "said")
    position = Output[float]("double", "heard")
    is_speaking = Output[bool]("boolean", "speaks")
    expression = Output[Expression]("expression", "shown")
    weights = Output[FaceWeights]("weights", "for the renderer alone")

    said: Speech | None = None
    since = 0.0
    shown: Expression | None = None
    forced: FaceWeights | None = None

    def compute(self, now: float, dt: float) -> None:
        if self.shown is not None:
            self.expression.send(self.shown)
        if self.forced is not None:
            self.weights.send(self.forced)
        self.is_speaking.send(self.said is not None)
        if self.said is not None:
            self.speech.send(self.said)
            self.position.send(now - self.since)


class Recorder(OffscreenScreen):
    """Keeps all pictures and when they were shown."""

    def _open(self) -> None:
        super()._open()
        self.pictures: list[tuple[float, Image]] = []

    def show(self, image: Image, time: float) -> None:
        super().show(image, time)
        self.pictures.append((time, image))


class Stage:
    """A director, a face, a renderer and a screen on a fake clock."""

    def __init__(self, *, is_face_wired: bool = True, captions: bool = False) -> None:
        self.clock = FakeClock()
        self.resources = ResourceManager([], self.clock)
        size = {"width": "160", "height": "120"}
        self.screen = Recorder(Description("screen", "Hri.OffscreenScreen", size), self.resources)
        self.screen.activate()
        self.resources.substitute("screen", self.screen)
        self.events: list[Event] = []
        context = Context(self.clock, EventBus(self.clock), self.resources, seed=7)
        context.events.subscribe("*", self.events.append)
        network = Network("stage", TICK)
        self.director, self.face = Director("director"), Face("face")
        self.renderer = FaceRenderer("renderer", captions=captions)
        for behavior in (self.director, self.face, self.renderer):
            network.add(behavior)
        for port in ("speech", "position", "is_speaking", "expression"):
            network.connect(f"director.{port}", f"face.{port}")
        source = "face" if is_face_wired else "director"
        network.connect(f"{source}.weights", "renderer.weights")
        network.connect("face.caption", "renderer.caption")
        network.sort()
        self.runner = Runner(network, context)
        self.runner.start()
        self.ticks = 0

    def run(self, seconds: float) -> None:
        for _ in range(round(seconds / TICK)):
            self.clock.advance(self.ticks * TICK - self.clock.now())
            self.runner.tick(self.clock.now())
            self.ticks += 1


def test_every_tick_shows_one_picture() -> None:
    stage = Stage()
    stage.run(2.0)
    times = [time for time, _ in stage.screen.pictures]
    assert len(times) == stage.ticks - 1, "the first picture is ready at the second tick"
    assert np.diff(times) == pytest.approx(TICK)
    assert stage.renderer.frames == len(times)
    stage.runner.stop()


def test_two_runs_show_the_same_pictures() -> None:
    stages = [Stage(), Stage()]
    for stage in stages:
        stage.director.shown = Expression("surprised")
        stage.run(1.0)
    for (time, one), (again, other) in zip(
        stages[0].screen.pictures, stages[1].screen.pictures, strict=True
    ):
        assert time == again
        assert np.array_equal(one, other)


def test_the_lips_follow_what_is_heard_and_rest_when_it_is_cut() -> None:
    stage = Stage()
    stage.run(0.5)
    stage.director.said, stage.director.since = spoken(*["a"] * 30), stage.clock.now()
    stage.run(0.5)
    weights = stage.face.weights.value
    assert weights is not None
    assert weights.values["jawOpen"] > 0.5
    stage.director.said = None
    stage.run(0.134)
    weights = stage.face.weights.value
    assert weights is not None
    assert abs(weights.values.get("jawOpen", 0.0)) < 0.05
    assert stage.face.caption.value is None


def test_captions_can_be_switched_at_any_time() -> None:
    stage = Stage()
    stage.director.said = Speech("Hello there", np.zeros(16000, np.int16), 16000)
    stage.run(0.2)
    plain = stage.screen.image
    stage.renderer.captions_on = True
    stage.run(0.2)
    written = stage.screen.image
    assert written[100:].mean() < plain[100:].mean() - 20, "a dark band"


def test_weights_of_another_face_leave_the_picture_and_are_told_once() -> None:
    stage = Stage(is_face_wired=False)
    stage.director.forced = FaceWeights({"jawOpen": 0.5})
    stage.run(0.3)
    before = stage.screen.image
    for bad in ({"trunkUp": 1.0}, {"jawOpen": float("nan")}):
        stage.director.forced = FaceWeights(bad)
        stage.run(0.3)
    assert np.array_equal(stage.screen.image, before)
    assert [event.name for event in stage.events] == ["face.refused", "face.refused"]
