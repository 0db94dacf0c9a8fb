"""Tasks with objects: wait for one, learn one that is held up, forget one."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial

from hri.core.clock import Worker
from hri.core.errors import HriError, NotAvailable, did_you_mean
from hri.core.service import Service
from hri.core.signals import FaceBox, FoundObject, Image
from hri.hal.camera import Camera
from hri.task.context import TaskContext, TaskFailed
from hri.task.task import task
from hri.vision.behaviors import PersonTracker
from hri.vision.camera_view import CameraView
from hri.vision.objects.held_up import HeldUpFinder
from hri.vision.objects.learning import ObjectLearner, scale_from_distance
from hri.vision.objects.model_file import (
    NAME_REMEDY,
    is_name,
    load_or_new,
    own_models,
    save_models,
)
from hri.vision.objects.object_behaviors import ObjRecRecognizer

LOOK_EVERY = 0.05
"""Seconds between looks at what is there."""
VIEW_EVERY = 0.4
"""Seconds between two pictures of an object that is being shown."""
ARM = 0.35
"""Meters before the face at which someone holds up what they show."""
THINKING_S = 0.05
"""What looking at a picture takes on a fake clock."""


class NothingShown(TaskFailed):
    """The pictures show no object, but someone's face or the room: nothing of them is kept."""


class NoCamera(TaskFailed):
    """A simulated camera stands in for one that is missing: what it sees is nothing to keep."""


@task("Hri.WaitForObject")
async def wait_for_object(
    context: TaskContext, name: str = "", timeout: float = float("inf")
) -> str | None:
    """Wait until an object is there, any without a name; its name, or None after `timeout` seconds.

    Raises HriError when no network has an ObjRecRecognizer.
    """
    end = context.clock.now() + timeout
    while True:
        names = [one.name for one in objects_of(context) if name in ("", one.name)]
        if names:
            return names[0]
        if context.clock.now() >= end:
            return None
        await context.clock.sleep(LOOK_EVERY)


def objects_of(context: TaskContext) -> tuple[FoundObject, ...]:
    """The objects that are there. Raises HriError when no network has an ObjRecRecognizer."""
    return recognizer_of(context).present


def recognizer_of(context: TaskContext) -> ObjRecRecognizer:
    """What recognizes objects. Raises HriError when no network has it."""
    recognizer = context.find_behavior(ObjRecRecognizer)
    if recognizer is None:
        remedy = "add an Hri.ObjRecRecognizer to a network"
        raise HriError(f"nothing looks out for objects - {remedy}")
    return recognizer


@task("Hri.LearnObject")
async def learn_object(
    context: TaskContext, name: str, seconds: float = 5.0, camera_id: str = "camera"
) -> int:
    """Learn an object that is held up in the middle of the picture and turned; the views of it.

    It goes to the own set of the user and replaces one of the same name. Raises `object.learning`
    (`object`, `views`, `is_new`, `reason`, `mistaken`) for each picture that is looked at. Fails
    when no picture shows enough of it, or the camera gives none; with NothingShown when pictures
    show someone's face or the room instead; with NoCamera when, in real time, a simulated camera
    stands in for one that is missing.
    """
    if not is_name(name):
        context.fail(f'"{name}" is not a valid name for an object - {NAME_REMEDY}')
    camera = await context.blocking(context.resources.obtain, camera_id, Camera)
    if context.resources.stand_in_of(camera_id) is not None and not context.clock.is_fake:
        context.resources.release(camera)
        raise NoCamera(f"{camera_id}: a simulated one stands in for it - plug one in")
    lesson: Service[_Picture | str, _Progress] = context.clock.service(
        partial(_Lesson, name), THINKING_S
    )
    try:
        with context.clock.move_on_after(seconds):
            await _show(context, camera, lesson, name)
        learned = await _answer(context, lesson, f"{context.clock.wall():%Y-%m-%d}")
    except NotAvailable as error:
        context.fail(str(error))
    finally:
        lesson.close()
        context.resources.release(camera)
    if learned.is_nothing_shown:
        raise NothingShown(learned.problem)
    if learned.problem:
        context.fail(learned.problem)
    return learned.views


async def _show(
    context: TaskContext,
    camera: Camera,
    lesson: Service[_Picture | str, _Progress],
    name: str,
) -> None:
    """Show picture after picture until time is up."""
    view, shown = CameraView.of(camera), context.clock.now()
    recognizer = context.find_behavior(ObjRecRecognizer)
    while True:
        # A network that reads the camera has the pictures.
        frame = camera.read(context.clock.now()) if recognizer is None else recognizer.newest
        if frame is None or frame.time < shown:
            await context.clock.sleep(LOOK_EVERY)
            continue
        shown = math.nextafter(frame.time, math.inf)
        faces, distance = _faces(context)
        scale = scale_from_distance(distance, view.focal_length((frame.width, frame.height)))
        progress = await _answer(context, lesson, _Picture(frame.image, faces, scale))
        context.events.raise_event(
            "object.learning",
            object=name,
            views=progress.views,
            is_new=progress.is_new,
            reason=progress.reason,
            mistaken=progress.mistaken,
        )
        await context.clock.sleep(VIEW_EVERY)


def _faces(context: TaskContext) -> tuple[tuple[FaceBox, ...], float]:
    """The faces in the picture, and how far away the nearest person holds something; or NaN.

    What is held up may hide a face: then the person is where they were before.
    """
    tracker = context.find_behavior(PersonTracker)
    persons = tracker.last.persons if tracker is not None else ()
    nearest = min((p.distance for p in persons if math.isfinite(p.distance)), default=math.nan)
    boxes = tuple(p.pose.box for p in persons if p.is_visible and p.pose.box is not None)
    return boxes, max(ARM, nearest - ARM) if math.isfinite(nearest) else math.nan


async def _answer(
    context: TaskContext, lesson: Service[_Picture | str, _Progress], question: _Picture | str
) -> _Progress:
    while lesson.is_busy:
        await context.clock.sleep(LOOK_EVERY)
        lesson.poll()  # the answer to a question that time was up for
    lesson.ask(question)
    while not (answers := lesson.poll()):
        await context.clock.sleep(LOOK_EVERY)
    return answers[0]


@dataclass(frozen=True, slots=True)
class _Picture:
    """One that shows the object."""

    image: Image
    faces: tuple[FaceBox, ...]
    scale: float


@dataclass(frozen=True, slots=True)
class _Progress:
    """How the lesson goes."""

    views: int
    is_new: bool = False
    reason: str = ""
    mistaken: str = ""
    problem: str = ""
    is_nothing_shown: bool = False


class _Lesson:
    """Learns, in a separate process: pictures, and in the end the day, which saves the object."""

    def __init__(self, name: str) -> None:
        self._path = own_models()
        self._models = load_or_new(self._path)
        self._learner = ObjectLearner(name, self._models)
        self._finder = HeldUpFinder()

    def __call__(self, question: _Picture | str) -> _Progress:
        if isinstance(question, str):
            return self._save(question)
        held_up = self._finder.find(question.image, question.faces)
        if held_up.outline is None:
            self._learner.refuse(held_up.reason)
            return _Progress(self._learner.count, reason=held_up.reason)
        shown = self._learner.show(
            question.image,
            held_up.outline,
            question.scale,
            "held up",
            has_moved=held_up.has_moved,
        )
        return _Progress(self._learner.count, shown.is_new, shown.reason, shown.mistaken)

    def _save(self, day: str) -> _Progress:
        try:
            save_models(self._path, self._models.with_object(self._learner.model(day)))
        except HriError as error:
            refused = self._learner.was_refused
            return _Progress(self._learner.count, problem=str(error), is_nothing_shown=refused)
        return _Progress(self._learner.count)


@task("Hri.ForgetObject")
async def forget_object(context: TaskContext, name: str) -> None:
    """Erase an object from the user's own set. Fails when it is not in there."""
    worker: Worker[None] = context.clock.worker(THINKING_S)
    worker.submit(partial(_forget, name))
    try:
        while not worker.poll():
            await context.clock.sleep(LOOK_EVERY)
    except HriError as error:
        context.fail(str(error))
    finally:
        worker.close()


def _forget(name: str) -> None:
    path = own_models()
    models = load_or_new(path)
    if models.find(name) is None:
        remedy = did_you_mean(name, [one.name for one in models.objects])
        raise HriError(f'no object "{name}" was learned - {remedy}')
    save_models(path, models.without(name))
