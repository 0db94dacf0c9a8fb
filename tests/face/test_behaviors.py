from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

from hri.behavior.behavior import Behavior, Context
from hri.behavior.network import Network
from hri.behavior.ports import Output
from hri.behavior.runner import Runner
from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.core.signals import Event, Expression, FaceWeights, Gaze, Image, Speech
from hri.face.behaviors import Face, FaceRecorder, FaceRenderer
from hri.face.live_link import read_weights
from hri.face.model import load_face
from hri.face.still import render_face
from hri.hal.drivers.blank import BlankScreen
from hri.hal.drivers.memory import OffscreenScreen
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from tests.face.pixels import MODEL
from tests.face.test_motion import TICK, spoken


class Director(Behavior):
    """Sends what a test wants."""

    speech = Output[Speech]("speech", "said")
    position = Output[float]("double", "heard")
    is_speaking = Output[bool]("boolean", "speaks")
    expression = Output[Expression]("expression", "shown")
    weights = Output[FaceWeights]("weights", "for the renderer alone")
    gesture = Output[str]("string", "made")
    state = Output[str]("string", "been in")
    override = Output[FaceWeights]("weights", "wins")
    gaze = Output[Gaze]("gaze", "looked at")
    is_listening = Output[bool]("boolean", "somebody speaks")

    said: Speech | None = None
    sent: Mapping[str, object] = {}
    """What to send at every tick, by port."""
    since = 0.0
    shown: Expression | None = None
    forced: FaceWeights | None = None

    def compute(self, now: float, dt: float) -> None:
        if self.shown is not None:
            self.expression.send(self.shown)
        for port, value in self.sent.items():
            getattr(self, port).send(value)
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


class Unseen(Recorder):
    """A screen that nobody sees."""

    is_seen = BlankScreen.is_seen


class Stage:
    """A director, a face, a renderer and a screen on a fake clock."""

    def __init__(
        self,
        *,
        is_face_wired: bool = True,
        captions: bool = False,
        is_drawn: bool = True,
        screen: type[Recorder] = Recorder,
    ) -> None:
        self.clock = FakeClock()
        self.resources = ResourceManager([], self.clock)
        size = {"width": "160", "height": "120"}
        self.screen = screen(Description("screen", "Hri.OffscreenScreen", size), self.resources)
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
        ports = ("speech", "position", "is_speaking", "expression", "gesture", "state", "override")
        for port in (*ports, "gaze", "is_listening"):
            network.connect(f"director.{port}", f"face.{port}")
        source = "face" if is_face_wired else "director"
        if is_drawn:
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


def test_nothing_is_drawn_for_a_screen_that_nobody_sees() -> None:
    stage = Stage(screen=Unseen)
    stage.run(1.0)
    assert stage.screen.pictures == []
    assert stage.face.output_port("weights").value is not None


class OneBit(Recorder):
    is_one_bit = True


def test_for_a_screen_of_one_bit_the_face_is_drawn_in_one() -> None:
    stage = Stage(screen=OneBit)
    stage.run(0.5)
    _, picture = stage.screen.pictures[-1]
    assert set(np.unique(picture)) == {0, 255}
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


@pytest.mark.proves("R05")
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


def shown(stage: Stage, channel: str) -> float:
    """The newest weight of a channel."""
    weights = stage.face.weights.value
    assert weights is not None
    return weights.values.get(channel, 0.0)


def test_a_gesture_is_made_by_name_by_event_and_by_call() -> None:
    stage = Stage(is_drawn=False)
    stage.director.sent = {"gesture": "wink"}
    stage.run(0.3)
    assert shown(stage, "eyeBlinkLeft") > 0.8
    stage.run(2.0)
    assert shown(stage, "eyeBlinkLeft") < 0.5, "a name that stays is one gesture"
    stage.runner.context.events.raise_event("gesture.asked", name="yawn", seconds=2.0)
    stage.run(1.0)
    assert shown(stage, "jawOpen") > 0.8
    stage.face.make("nod", strength=0.5).cancel()
    stage.run(0.1)
    told = [(event.name, event.properties["name"]) for event in stage.events]
    assert told == [
        ("gesture.started", "wink"),
        ("gesture.ended", "wink"),
        ("gesture.asked", "yawn"),
        ("gesture.started", "yawn"),
        ("gesture.ended", "yawn"),
        ("gesture.started", "nod"),
        ("gesture.ended", "nod"),
    ]


def test_the_face_listens_while_somebody_speaks_to_it() -> None:
    stage = Stage(is_drawn=False)
    stage.run(1.0)
    calm = shown(stage, "antennaPerk")
    stage.director.sent = {"is_listening": True}
    stage.run(1.5)
    assert shown(stage, "antennaPerk") > calm + 0.15
    stage.director.sent = {"is_listening": True, "state": "asleep"}
    stage.run(2.0)
    assert shown(stage, "eyeBlinkLeft") > 0.6


def test_what_the_face_cannot_do_is_told_once_and_it_lives_on() -> None:
    stage = Stage(is_drawn=False)
    stage.run(1.0)
    stage.director.sent = {"gaze": Gaze(float("nan"), 0.0)}
    stage.run(0.5)
    stage.director.sent = {"gesture": "nodd"}
    stage.run(0.5)
    stage.director.sent = {"override": FaceWeights({"trunkUp": 1.0})}
    stage.run(0.5)
    stage.director.sent, stage.director.shown = {}, Expression("hapy")
    stage.run(0.5)
    reasons = [event.properties["reason"] for event in stage.events]
    assert [event.name for event in stage.events] == ["face.refused"] * 4
    for reason, part in zip(reasons, ("finite", "nodd", "trunkUp", "hapy"), strict=True):
        assert part in reason
    stage.director.shown = Expression("surprised")
    stage.run(1.0)
    assert shown(stage, "jawOpen") > 0.3


def test_a_face_is_recorded_and_replayed(tmp_path: Path) -> None:
    stage = Stage(is_drawn=False)
    recorder = FaceRecorder("recorder", file=str(tmp_path / "face.csv"))
    recorder.start(stage.runner.context)
    recorder.weights.sources.append(stage.face.weights)
    stage.director.shown = Expression("surprised")
    for _ in range(40):
        stage.run(TICK)
        recorder.compute(stage.clock.now(), TICK)
    recorder.stop()
    assert read_weights(tmp_path / "face.csv", MODEL).duration == pytest.approx(39 * TICK, abs=1e-3)
    surprised = shown(stage, "jawOpen")
    stage.director.shown = Expression("sad")
    stage.run(2.0)
    assert shown(stage, "jawOpen") < 0.1
    playing = stage.face.replay(tmp_path / "face.csv")
    stage.run(1.2)
    assert shown(stage, "jawOpen") == pytest.approx(surprised, abs=0.05)
    stage.run(1.0)
    assert playing.is_over
    assert shown(stage, "jawOpen") < 0.1


def test_a_closed_mouth_is_seen_within_100_ms_of_a_cancel() -> None:
    """From the pixels: the first picture shown more than 100 ms after the cut has no open mouth."""
    stage = Stage()
    stage.run(0.5)
    calm = stage.screen.image.astype(int)
    stage.director.said, stage.director.since = spoken(*["a"] * 30), stage.clock.now()
    stage.run(0.6)
    talking = stage.screen.image.astype(int)
    stage.director.said = None
    cut = stage.clock.now()
    stage.run(0.3)
    shut = next(picture for time, picture in stage.screen.pictures if time - cut > 0.1).astype(int)
    mouth = slice(84, 112), slice(62, 98)

    def height(picture: np.ndarray) -> int:
        return int((picture[mouth].sum(axis=2) < 165).any(axis=1).sum())

    assert height(talking) > height(calm) + 5
    assert height(shut) <= height(calm) + 1


def test_another_face_is_put_on_while_it_lives() -> None:
    stage = Stage()
    stage.director.shown = Expression("happy")
    stage.run(1.0)
    stage.face.make("nod", seconds=10.0)
    stage.run(0.2)
    person = load_face("person")
    stage.face.change("person", person)
    stage.renderer.change("person", stage.renderer.brush_of(person))
    stage.run(2.0)
    seen = stage.screen.image.astype(float)
    apart = {
        name: np.abs(seen - render_face(name, "happy", size=(160, 120))).mean()
        for name in ("robot", "person")
    }
    assert apart["person"] < apart["robot"] / 3
    assert stage.face.face == stage.renderer.face == "person"
    names = [event.name for event in stage.events]
    assert names == ["gesture.started", "gesture.ended", "face.changed"]
    assert len(stage.screen.pictures) == stage.ticks - 1
