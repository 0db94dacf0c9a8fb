"""The hands of the people who are seen: found now and then, and followed from look to look.

A search for hands costs as much as seeing a face, and a look at one hand nearly half of that. So
each picture brings some milliseconds, and what has been saved up pays for the next looks. Where
something moves in reach of someone, hands are searched for at once, and again until it has rested
for a while; never in a picture in which faces are searched for. The costs are modeled, not
measured, so that the same pictures give the same hands on every machine.
"""

from __future__ import annotations

import itertools
import logging
import math
from collections.abc import Sequence
from dataclasses import astuple, dataclass, replace

import numpy as np

from hri.core.errors import HriError
from hri.core.signals import FaceBox, Frame, Hand, Image, Landmarks, People, Person
from hri.vision.camera_view import CameraView
from hri.vision.detectors.hand_mesh import FittedHand, HandMesh, region_of_hand
from hri.vision.detectors.mesh import Region
from hri.vision.detectors.palm import PalmDetector, hand_region
from hri.vision.detectors.preprocessing import Picture, gray_picture
from hri.vision.face_models import HAND, PALM, find_hand_models
from hri.vision.hands.hand_flow import PALM as FOLLOWED, moved_by
from hri.vision.hands.hand_shape import FIST, hand_shape, shows_palm
from hri.vision.hands.reach import Movement, owner_of, part_to_search

log = logging.getLogger("hri.vision")

SEARCH_COST, LOOK_COST = 12.0, 5.0
"""Milliseconds of a search for palms, and of a look at one hand, on one core of 2.5 GHz."""
INCOME = 110.0
"""Milliseconds a second that may be spent: some 4 searches and 12 looks."""
SAVED = 17.0
"""Milliseconds that can be saved up at most, and spent in one picture: a search and a look."""
SEARCH_MOVING, SEARCH_STILL = 0.2, 1.2
"""Seconds between two searches while something moves in reach of someone, and else."""
SEARCH_MORE = 0.8
"""Seconds after a search for the hands of someone, of whom one is followed: its arm moves, too."""
PRESENT = 0.5
"""Least presence of a hand."""
MISSES = 2
"""Looks in a row that find no hand, after which it is gone."""
WIDER = 1.25
"""Of the region of a palm that was just found, or of a hand that was missed: until it is looked at
it moves, and a hand that is cut by the edge is taken for none, while in a region twice as large it
still fits."""
FORGOTTEN = 1.5
"""Seconds after which a hand that was not looked at is gone."""
SAME = 0.35
"""Sides of their regions; nearer to each other, two hands are one."""
MOST_EACH = 2
MOST_CANDIDATES = 4
HELD, RESTING = 0.12, 0.2
"""Seconds between two looks at a hand that is held still, and at one that shows nothing; one that
moves is looked at in each picture."""
MOVED = 0.05
"""Sides of its region by which a hand is not still."""
IN_VAIN = 0.6
"""Part of a movement that stays where hands were searched for in vain, to be searched again."""
SIDES_KEPT = 0.7
"""Part of what was known of the side that counts at the next look."""


@dataclass(slots=True)
class HandTrack:
    """A hand that is followed, or may be one."""

    number: int
    region: Region
    person: str
    looked: float
    """Seconds, when it was looked at last."""
    found: float
    """Seconds, when it was seen last."""
    places: Landmarks
    """Points of the palm, shape [n, 2], pixels; as they have moved since the last look."""
    hand: Hand | None = None
    """None until the first look."""
    left: float = 0.5
    misses: int = 0

    @property
    def pause(self) -> float:
        """Seconds that it need not be looked at."""
        if self.hand is None:
            return 0.0
        moved = self.places - self.hand.landmarks[list(FOLLOWED), :2]
        if np.abs(moved.mean(axis=0)).max() > MOVED * self.region.side:
            return 0.0
        return RESTING if self.hand.shape in ("", FIST) else HELD


class HandTracker:
    """Adds hands to the people of each picture; the same pictures and people give the same hands.

    Only who is seen has hands. It starts from nothing when time goes back or leaps.
    """

    def __init__(self, palms: PalmDetector, mesh: HandMesh, view: CameraView | None = None) -> None:
        self._palms, self._mesh, self._view = palms, mesh, view or CameraView()
        self._time = -math.inf
        self._forget()

    def _forget(self) -> None:
        self._tracks: list[HandTrack] = []
        self._movement = Movement()
        self._before: Picture | None = None
        self._saved = SAVED
        self._searched = -math.inf
        self._numbers = itertools.count(1)
        self._searched_for: dict[str, tuple[float, int]] = {}
        """For whose hands was searched: seconds, when last, and how often."""

    def see(self, frame: Frame, people: People, is_late: bool = False) -> People:
        """The people with their hands. `is_late`: this picture has cost much already, and one look
        at one hand is all that there is time for.
        """
        picture = gray_picture(frame.image)
        if picture is None or not math.isfinite(frame.time):
            return people
        elapsed = frame.time - self._time
        if elapsed == 0:
            return self._with_hands(people)
        if not 0 < elapsed <= FORGOTTEN:
            self._forget()
            elapsed = 0.0
        self._time = frame.time
        self._saved = min(SAVED, self._saved + INCOME * elapsed)
        self._movement.see(frame.image, frame.time)
        here = [person for person in people.persons if person.is_visible and _has_box(person)]
        self._keep({person.id for person in people.persons})
        self._follow(picture)
        if here:
            self._spend(frame, here, people.attended, is_late)
        return self._with_hands(people)

    def _keep(self, ids: set[str]) -> None:
        """Give up the hands of who is gone, and those that were not seen for long."""
        self._tracks = [
            track
            for track in self._tracks
            if track.person in ids and self._time - track.found <= FORGOTTEN
        ]
        self._searched_for = {id: last for id, last in self._searched_for.items() if id in ids}

    def _follow(self, picture: Picture) -> None:
        """Move the regions along with the hands since the picture before."""
        before, self._before = self._before, picture
        if before is None or before.gray.shape != picture.gray.shape:
            return
        for track in self._tracks:
            moved = moved_by(before.gray, picture.gray, track.places / before.scale)
            across, down = (shift * picture.scale for shift in moved)
            track.places = track.places + np.array((across, down), np.float32)
            region = track.region
            track.region = replace(region, x=region.x + across, y=region.y + down)

    def _spend(self, frame: Frame, here: Sequence[Person], attended: str, is_late: bool) -> None:
        """A search, and looks, as far as they can be paid."""
        for face in (person.pose.box for person in here):
            if face is not None:
                self._movement.forget(face)
        if not is_late and self._saved >= SEARCH_COST:
            search = self._next_search(frame.image, here, attended)
            if search is not None:
                self._saved -= SEARCH_COST
                self._search(frame, here, *search)
        due = [track for track in self._tracks if self._time - track.looked >= track.pause]
        due.sort(key=self._urgency, reverse=True)
        for track in due[:1] if is_late else due:
            if self._saved >= LOOK_COST:
                self._saved -= LOOK_COST
                self._look(frame, track, here)

    def _next_search(
        self, image: Image, here: Sequence[Person], attended: str
    ) -> tuple[Person, Region] | None:
        """For whose hands to search now, and where; None while there is no need."""
        waited = self._time - self._searched
        if waited < SEARCH_MOVING:
            return None
        size = image.shape[1], image.shape[0]
        for track in self._tracks:
            self._movement.forget(_box(track.region))
        best: tuple[tuple[bool, float, bool], Person, Region] | None = None
        for person in here:
            known = sum(track.person == person.id for track in self._tracks)
            if person.pose.box is None or known >= MOST_EACH:
                continue
            last, times = self._searched_for.get(person.id, (-math.inf, 0))
            part, moved = part_to_search(person.pose.box, self._movement, size, times)
            since = self._time - last
            if known and since < SEARCH_MORE:
                continue
            if moved > 0 or waited >= SEARCH_STILL:
                order = (moved > 0, min(since, 60.0), person.id == attended)
                if best is None or order > best[0]:
                    best = order, person, part
        return None if best is None else best[1:]

    def _search(self, frame: Frame, here: Sequence[Person], person: Person, part: Region) -> None:
        self._searched = frame.time
        times = self._searched_for.get(person.id, (0.0, 0))[1]
        self._searched_for[person.id] = frame.time, times + 1
        self._movement.forget(_box(part), IN_VAIN)
        faces = [one.pose.box or FaceBox(0, 0, 0, 0) for one in here]
        for palm in self._palms.find(frame.image, part)[:MOST_CANDIDATES]:
            region = _wider(hand_region(palm))
            owner = owner_of(region, faces)
            if owner is None or any(_are_same(region, track.region) for track in self._tracks):
                continue
            id = here[owner].id
            if sum(track.person == id for track in self._tracks) < MOST_EACH:
                number = next(self._numbers)
                self._tracks.append(
                    HandTrack(number, region, id, -math.inf, frame.time, palm.points.copy())
                )

    def _urgency(self, track: HandTrack) -> tuple[bool, float]:
        """Of a look: at what may be a hand first, then at who has waited longest."""
        return track.hand is None, min(60.0, self._time - track.looked)

    def _look(self, frame: Frame, track: HandTrack, here: Sequence[Person]) -> None:
        is_new = track.hand is None
        track.looked = frame.time
        fitted = self._mesh.fit(frame.image, track.region)
        if fitted is None or fitted.presence < PRESENT:
            track.misses += 1
            if is_new or track.misses >= MISSES:
                self._tracks.remove(track)
                if not is_new:  # it moved away, and is near
                    self._searched = min(self._searched, frame.time - SEARCH_MOVING)
            else:
                track.region = _wider(track.region)
            return
        region = region_of_hand(fitted.landmarks)
        others = [other for other in self._tracks if other is not track]
        if any(_are_same(region, other.region) for other in others if other.hand is not None):
            self._tracks.remove(track)
            return
        track.region, track.misses, track.found = region, 0, frame.time
        track.places = fitted.landmarks[list(FOLLOWED), :2].copy()
        track.left = (
            fitted.left if is_new else (SIDES_KEPT * track.left + (1 - SIDES_KEPT) * fitted.left)
        )
        size = frame.image.shape[1], frame.image.shape[0]
        described = _described(fitted, track.left > 0.5, frame.time, self._view, size)
        track.hand = replace(described, number=track.number)
        owner = owner_of(region, [person.pose.box or FaceBox(0, 0, 0, 0) for person in here])
        known = {person.id for person in here}
        if track.person in known and owner is None:
            self._tracks.remove(track)

    def _with_hands(self, people: People) -> People:
        if not any(track.hand is not None for track in self._tracks):
            return people
        persons = tuple(replace(person, hands=self._hands_of(person)) for person in people.persons)
        return replace(people, persons=persons)

    def _hands_of(self, person: Person) -> tuple[Hand, ...]:
        return tuple(
            track.hand
            for track in self._tracks
            if track.person == person.id and track.hand is not None
        )


def load_hand_tracker(view: CameraView) -> HandTracker | None:
    """A tracker with the fetched networks; None, and a line in the log, when they are not here."""
    try:
        folder = find_hand_models()
        return HandTracker(PalmDetector(folder / PALM.name), HandMesh(folder / HAND.name), view)
    except (HriError, RuntimeError) as error:  # the latter of a home folder that nobody has
        log.warning(error)
        return None


def _described(
    fitted: FittedHand, is_left: bool, time: float, view: CameraView, size: tuple[int, int]
) -> Hand:
    landmarks = fitted.landmarks
    shape = hand_shape(landmarks)
    x, y = landmarks[[0, 5, 17], :2].mean(axis=0).tolist()
    bearing, elevation = view.toward(x, y, size)
    finger = (landmarks[8] - landmarks[5]).astype(np.float64)
    across, down, away = (finger / (np.linalg.norm(finger) + 1e-9)).tolist()
    to_side, up = view.pointed((across, down, away), x, y, size)
    return Hand(
        "left" if is_left else "right",
        time,
        landmarks,
        shape.name,
        shape.straight,
        fitted.presence,
        shows_palm(landmarks, is_left),
        bearing,
        elevation,
        to_side,
        up,
    )


def _has_box(person: Person) -> bool:
    """Whether it is known where their face is."""
    box = person.pose.box
    return box is not None and all(map(math.isfinite, astuple(box)))


def _wider(region: Region) -> Region:
    return replace(region, side=WIDER * region.side)


def _are_same(first: Region, second: Region) -> bool:
    away = math.hypot(first.x - second.x, first.y - second.y)
    return away < SAME * max(first.side, second.side)


def _box(region: Region) -> FaceBox:
    return FaceBox(region.x - region.side / 2, region.y - region.side / 2, region.side, region.side)
