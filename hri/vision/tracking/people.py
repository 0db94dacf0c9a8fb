"""Everyone in the pictures of a camera: found, followed, told apart, and described.

Each face is followed by itself. The search for others looks at a few squares of a picture, and at
all of them within some pictures: now and then for newcomers, more often while someone is missing,
and first where they should be. Faces that come close to each other may be taken for each other, or
cover each other; who is who is settled again by looks as soon as they are apart again.
"""

from __future__ import annotations

import itertools
import logging
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from hri.core.signals import Frame, Landmarks, People
from hri.vision.attention import Attending
from hri.vision.camera_view import CameraView
from hri.vision.detectors.body import find_body_at
from hri.vision.detectors.detector_choice import Detectors, load_detectors
from hri.vision.detectors.face import FoundFace, overlap
from hri.vision.detectors.mesh import disagreement, region_of, region_of_landmarks
from hri.vision.detectors.preprocessing import gray_picture
from hri.vision.detectors.search_squares import BUDGET, SearchPlan
from hri.vision.engagement import Zones
from hri.vision.hands.hand_tracker import HandTracker, load_hand_tracker
from hri.vision.tracking.appearance import Look, look_of
from hri.vision.tracking.assignment import assigned
from hri.vision.tracking.body_track import BESIDE, FOUND_AGAIN, MOMENT, Surroundings
from hri.vision.tracking.clothes import Colors
from hri.vision.tracking.face_track import MAX_GAP, FaceTrack, Sight, is_face
from hri.vision.tracking.identity import RETURN_MEMORY, STRANGER, STRANGER_IN_CROWD
from hri.vision.tracking.person_track import PersonTrack, number_of
from hri.vision.tracking.place import Place

log = logging.getLogger("hri.vision")

MEMORY = 3.0
"""Seconds after which someone who is out of sight has left."""
KNOWN_FOR = 5.0
"""Seconds for which they are known again when they come back."""
KNOWN_BY_CLOTHES = 20.0
"""The same of who went away from behind: they are known by their clothes."""
MOST = 8
"""Faces that are followed at once."""
MOST_FITS = 4
"""Meshes that are fitted in one picture; of more faces, those of the others take turns."""
SEARCH_ALONE = 0.1
"""Seconds between two searches of the largest squares while nobody is seen."""
SEARCH_MISSING = 0.2
"""The same while someone is out of sight."""
SEARCH_NEWCOMERS = 0.4
"""The same else."""
SEARCH_BOXES = 0.3
"""The same at most when there is no mesh to say where the faces are."""
COLORS_COST, NEAR_COST, WIDE_COST = 0.001, 0.002, 0.006
"""Seconds of modeled work: to tell the colors of a picture, to follow a body, and to look for one
in all of it."""
OUTLINE_COST = 0.008
"""The same to look for the outline of a body."""
OUTLINE_EVERY, OUTLINE_MISSING = 1.0, 0.2
"""Seconds between two such looks for someone who is followed, and for who was lost just now."""
WIDE_EVERY = 0.1
"""Seconds between two looks for the same body in the whole picture."""
SURELY_FACED = 0.4
"""Seconds for which a face must stay to be that of who was followed from behind: else they are
looked for where their body was."""
JUST = 0.1
"""Seconds for which someone is where they were seen."""
SECOND_LOOK = 0.5
"""Seconds within which a face must be found again when there is no mesh to confirm it."""
CLOSE, APART = 1.1, 1.4
"""Sizes of the face between two faces that may be mixed up, and that no longer can."""
SAME_FACE = 0.4
"""Sizes of the face; nearer to each other, two faces are one."""
DOUBT, NO_FACE = 0.4, 0.5
"""Sizes of the face by which finder and mesh may disagree, for each point of the score above that
of what is as likely no face. Of faces in photographs 95 % stay below half of that."""
SAME_BOX = 0.4
"""Overlap of two boxes, found one after the other, that are of one face."""
STAYING = 0.03
"""Discount for a face that keeps its person."""
LATENESS = 0.1
"""What a face costs more for who was never seen away from the others: likely one of them."""
LEARN_EVERY = 0.2
"""Seconds between two looks at how someone looks, and at what they wear."""
OTHER_CLOTHES, CLOTHES_COST = 0.35, 0.2
"""Likeness of clothes below which a face costs more, and how much where nothing is alike."""


class PeopleTracker:
    """Sees frames one by one, in the order they were taken; the same frames give the same people.

    People keep their id, "p1", "p2" ..., while they are seen and for `MEMORY` seconds after, and
    have it again when they come back within `KNOWN_FOR`; nobody else ever gets it. Invalid
    pictures are ignored. When time goes back, there was no picture for `MEMORY` seconds, or
    pictures change their size, everyone is new.
    """

    def __init__(
        self,
        detectors: Detectors,
        view: CameraView | None = None,
        zones: Zones | None = None,
        first: int = 1,
    ) -> None:
        """`first` is the number of the first person who comes."""
        self._finder, self._mesh = detectors.finder, detectors.mesh
        self._view, self._zones = view or CameraView(), zones or Zones()
        self._numbers = itertools.count(first)
        self._last = People(-math.inf)
        self._is_searching = False
        self._size = (0, 0)
        self._forget()

    def see(self, frame: Frame) -> People:
        """Everyone who is there at the time of the frame."""
        picture = gray_picture(frame.image)
        if picture is None or not math.isfinite(frame.time) or frame.time == self._last.time:
            return self._last
        elapsed = frame.time - self._last.time
        sight = Sight(frame.image, picture.gray, picture.scale, frame.time, elapsed)
        if not 0 < elapsed <= MEMORY or sight.size != self._size:
            self._forget()
            self._size = sight.size
            self._plan = SearchPlan(self._finder.squares(*sight.size))
        elif elapsed > MAX_GAP:
            self._lose_all()
        self._follow(sight)
        self._follow_bodies(sight)
        self._mix(sight.time)
        self._search(sight)
        self._mix(sight.time)
        self._settle(sight)
        self._note(sight)
        return self._described(sight)

    @property
    def is_searching(self) -> bool:
        """Whether faces were searched for in the last picture, which takes as long as all else."""
        return self._is_searching

    def _forget(self) -> None:
        self._known: list[PersonTrack] = []
        self._departed: list[PersonTrack] = []
        """Who has left a moment ago."""
        self._mixed: set[frozenset[int]] = set()
        """Numbers of each two whose faces may have been mixed up."""
        self._candidates: list[tuple[float, FoundFace]] = []
        """Faces that were found and not confirmed yet, and when."""
        self._plan = SearchPlan(())
        self._body_work = 0.0
        """Seconds of modeled work for bodies in the last picture."""
        self._attending = Attending()

    def _lose_all(self) -> None:
        """Look for everyone again: people may have changed places."""
        for somebody in self._known:
            somebody.face = None
        self._plan = SearchPlan(self._finder.squares(*self._size))

    def _seen(self) -> Iterator[tuple[PersonTrack, FaceTrack]]:
        """Who is in sight, with their faces."""
        for somebody in self._known:
            if somebody.face is not None:
                yield somebody, somebody.face

    def _follow(self, sight: Sight) -> None:
        for _, face in self._seen():
            face.follow(sight)
        if self._mesh is not None:
            for somebody, face in sorted(self._seen(), key=self._urgency)[:MOST_FITS]:
                face.fit(sight, self._mesh)
                somebody.fitted = sight.time
        for somebody, face in self._seen():
            if face.is_lost(sight.time) or not _is_inside(face.middle, sight.size):
                somebody.face = None

    def _follow_bodies(self, sight: Sight) -> None:
        """Follow by their clothes those whose faces are not seen; one of the lost is looked for."""
        self._body_work = 0.0
        bodies = [
            somebody
            for somebody in (*self._known, *self._departed)
            if somebody.face is None and somebody.clothes.are_known
        ]
        if not bodies:
            return
        near = [somebody for somebody in bodies if somebody.body.is_near(sight.time)]
        lost = [
            somebody
            for somebody in bodies
            if somebody not in near and sight.time - somebody.body.looked >= WIDE_EVERY
        ]
        lost = sorted(lost, key=lambda somebody: somebody.body.looked)[:1]
        self._body_work = COLORS_COST + len(near) * NEAR_COST + len(lost) * WIDE_COST
        colors = Colors.of(sight.image)
        for somebody in (*near, *lost):
            around = self._around(sight, somebody)
            place = somebody.body.follow(colors, somebody.clothes, around)
            place = self._outlined(sight, somebody, colors, around) or place
            if place is None:
                continue
            somebody.identity.place(sight.time, place)
            somebody.seen = sight.time
            if somebody in self._departed:
                self._rejoin(somebody)

    def _outlined(
        self, sight: Sight, somebody: PersonTrack, colors: Colors, around: Surroundings
    ) -> Place | None:
        """Where someone is by the outline of the body; it is looked for now and then."""
        body = somebody.body
        every = OUTLINE_EVERY if body.seen == sight.time else OUTLINE_MISSING
        is_due = sight.time - body.outlined >= every and self._body_work + OUTLINE_COST <= BUDGET
        if not is_due or not body.is_near(sight.time):
            return None
        expected = body.expected(sight.time).body
        if expected.y < 0 or expected.y + expected.height > sight.size[1]:
            return None
        body.outlined = sight.time
        self._body_work += OUTLINE_COST
        found = find_body_at(sight.image, expected)
        if found is None:
            return None
        return body.take(colors, somebody.clothes, Place.on_body(found), around)

    def _around(self, sight: Sight, somebody: PersonTrack) -> Surroundings:
        """What there is beside someone, and before them."""
        others = [face.place for other, face in self._seen() if other is not somebody]
        for other in self._known:
            place, age = other.body.place, sight.time - other.body.seen
            if other is somebody or other.face is not None or place is None:
                continue
            # Of those who are looked for after them, only who stands before them counts.
            if age == 0 or (age <= JUST and somebody.body.is_behind(place)):
                others.append(place)
        return Surroundings(sight.time, self._view.horizon(sight.size), others)

    def _urgency(self, seen: tuple[PersonTrack, FaceTrack]) -> tuple[bool, float, int]:
        """Order of fitting meshes: the attended person first, then who has waited longest."""
        somebody = seen[0]
        return somebody.id != self._attending.chosen, somebody.fitted, somebody.number

    # --- finding ---

    def _interval(self, time: float) -> float:
        """Seconds from one search to the next."""
        missing = [s for s in self._known if s.face is None and not s.body.is_near(time)]
        if len(missing) == len(self._known):
            return SEARCH_ALONE
        interval = SEARCH_MISSING if missing else SEARCH_NEWCOMERS
        return interval if self._mesh is not None else min(interval, SEARCH_BOXES)

    def _search(self, sight: Sight) -> None:
        interval = self._interval(sight.time)
        missing = [s.identity.expected_face(sight.time) for s in self._known if s.face is None]
        fits = 0 if self._mesh is None else min(MOST_FITS, sum(1 for _ in self._seen()))
        squares = self._plan.due(sight.time, interval, fits, missing, self._body_work)
        self._is_searching = bool(squares)
        if not squares:
            return
        strangers = []
        for found in self._finder.find(sight.image, squares):
            owner = self._owner(found)
            if owner is None:
                strangers.append(found)
            elif self._mesh is None:
                owner.find_again(found, sight)
        room = MOST - sum(1 for _ in self._seen())
        before = [
            (time, found) for time, found in self._candidates if sight.time - time < SECOND_LOOK
        ]
        self._candidates = before + [(sight.time, found) for found in strangers]
        faces = self._confirmed(sight, strangers, [found for _, found in before])
        self._welcome(sight, faces[: max(0, room)])

    def _owner(self, found: FoundFace) -> FaceTrack | None:
        """The face that is followed already where one was found."""
        region = region_of(found)
        for _, face in self._seen():
            away = math.hypot(region.x - face.region.x, region.y - face.region.y)
            if away < SAME_FACE * max(face.breadth, found.box.width):
                return face
        return None

    def _confirmed(
        self, sight: Sight, strangers: list[FoundFace], before: list[FoundFace]
    ) -> list[FaceTrack]:
        """Those that are faces: a mesh fits, or without one, found before at the same place."""
        faces: list[FaceTrack] = []
        for found in strangers[:MOST]:
            known = [*faces, *(other for _, other in self._seen())]
            if any(other.hides(found) for other in known):
                continue
            landmarks = None
            if self._mesh is not None:
                landmarks = self._fitted(sight, found)
                if landmarks is None:
                    continue
            elif not any(overlap(found.box, other.box) > SAME_BOX for other in before):
                continue
            face = FaceTrack(sight, found, landmarks)
            if all(_between(face, other) > SAME_FACE for other in known):
                faces.append(face)
        return faces

    def _fitted(self, sight: Sight, found: FoundFace) -> Landmarks | None:
        """The mesh of what was found, if it is a face.

        It must fit twice, with eyes, nose and mouth where the finder has them: in a pattern that
        looks like a face each sees them elsewhere, and the finder is not sure.
        """
        assert self._mesh is not None
        region, landmarks = region_of(found), None
        for _ in range(2):
            fitted = self._mesh.fit(sight.image, region)
            if fitted is None or not is_face(fitted, region):
                return None
            landmarks = fitted.landmarks
            region = region_of_landmarks(landmarks)
        assert landmarks is not None
        is_doubtful = disagreement(found, landmarks) > DOUBT * (found.score - NO_FACE)
        return None if is_doubtful else landmarks

    def _welcome(self, sight: Sight, faces: list[FaceTrack]) -> None:
        """Give each new face to whoever of the missing it fits, else to a new person."""
        missing = [somebody for somebody in self._known if somebody.face is None] + self._departed
        looks = [look_of(sight.image, face.region) for face in faces]
        costs = [
            [self._cost(sight, somebody, face, look) for somebody in missing]
            for face, look in zip(faces, looks, strict=True)
        ]
        for face, look, index in zip(faces, looks, assigned(costs), strict=True):
            if index is None:
                somebody = PersonTrack(next(self._numbers), sight.time, self._zones)
                somebody.identity.learn(look)
                self._known.append(somebody)
            else:
                somebody = missing[index]
                if somebody in self._departed:
                    self._rejoin(somebody)
            somebody.face, somebody.fitted, somebody.faced = face, sight.time, sight.time

    def _rejoin(self, somebody: PersonTrack) -> None:
        """Let someone be there again."""
        self._departed.remove(somebody)
        self._known = sorted([*self._known, somebody], key=lambda one: one.number)

    def _cost(self, sight: Sight, somebody: PersonTrack, face: FaceTrack, look: Look) -> float:
        """How unlikely it is that a new face is that of someone missing; infinite for no.

        Of those who are mixed up, each may be taken for another: a face that fits any of them will
        do, and so will one that is half covered still. Who is who is settled when they are apart.
        """
        misfit = self._misfit_of_clothes(sight, somebody, face)
        if somebody.walked_away and math.isinf(misfit):
            return math.inf
        group = next((group for group in self._groups() if somebody in group), [])
        if group and any(_between(face, other) < APART for _, other in self._seen()):
            return somebody.identity.cost(sight.time, face, look)
        if group:
            cost = min(other.identity.cost(sight.time, face, look) for other in group)
            return cost if cost < STRANGER_IN_CROWD else math.inf
        cost = somebody.identity.cost(sight.time, face, look, RETURN_MEMORY) + misfit
        return cost if cost < STRANGER else math.inf

    def _misfit_of_clothes(self, sight: Sight, somebody: PersonTrack, face: FaceTrack) -> float:
        """What it costs that someone wears other clothes than there are below a face.

        Infinite for who was seen from behind, where body or clothes say that it is not them.
        """
        if not somebody.clothes.are_known:
            return 0.0
        alike = somebody.clothes.likeness(Colors.of(sight.image), face.place)
        if somebody.went_away:
            if somebody.body.contradicts(sight.time, face.place):
                return math.inf
            is_there = sight.time - somebody.body.seen <= MOMENT
            least = OTHER_CLOTHES if is_there else FOUND_AGAIN
            if alike.mean < least if alike is not None else not is_there:
                return math.inf
        if alike is None:
            return 0.0
        return CLOTHES_COST * max(0.0, 1 - alike.mean / OTHER_CLOTHES)

    # --- telling apart ---

    def _mix(self, time: float) -> None:
        """Note pairs of people so close that their faces may be mixed up."""
        for one, other in itertools.combinations(self._known, 2):
            if one.face is None and other.face is None:
                continue
            if _gap(time, one, other) < CLOSE:
                self._mixed.add(frozenset((one.number, other.number)))
            if one.face and other.face and _between(one.face, other.face) < SAME_FACE:
                self._part(time, one, other)

    def _part(self, time: float, one: PersonTrack, other: PersonTrack) -> None:
        """Of two people with the same face, take it from the one whose place and size fit less."""
        face = one.face
        assert face is not None
        max((one, other), key=lambda somebody: somebody.identity.misfit(time, face)).face = None

    def _settle(self, sight: Sight) -> None:
        """Find out who is who of those that were close, when they are apart again."""
        for group in self._groups():
            leaving = [s for s in group if sight.time - s.seen > MEMORY - SEARCH_MISSING]
            pairs = [
                pair
                for pair in itertools.combinations(group, 2)
                if any(somebody.face is not None for somebody in pair)
            ]
            if leaving or all(_gap(sight.time, *pair) > APART for pair in pairs):
                self._sort_out(sight, group)
                numbers = {somebody.number for somebody in group}
                self._mixed = {pair for pair in self._mixed if not pair & numbers}

    def _groups(self) -> list[list[PersonTrack]]:
        """Those who are mixed up with each other."""
        groups: list[set[int]] = []
        for pair in sorted(self._mixed, key=sorted):
            touching = [group for group in groups if group & pair]
            groups = [group for group in groups if not group & pair]
            groups.append(set(pair).union(*touching))
        return [[s for s in self._known if s.number in group] for group in groups]

    def _sort_out(self, sight: Sight, group: list[PersonTrack]) -> None:
        """Give each face of a group to the person it fits best."""
        faces = [somebody.face for somebody in group if somebody.face is not None]
        looks = [look_of(sight.image, face.region) for face in faces]
        costs = [
            [
                somebody.identity.cost(sight.time, face, look)
                - STAYING * (face is somebody.face)
                + LATENESS * (not somebody.identity.is_established)
                for face, look in zip(faces, looks, strict=True)
            ]
            for somebody in group
        ]
        for somebody, index in zip(group, assigned(costs), strict=True):
            somebody.face = None if index is None else faces[index]
        # A track that began within the group and has no face was one of the others.
        self._known = [
            somebody
            for somebody in self._known
            if somebody not in group or somebody.face or somebody.identity.is_established
        ]

    def _note(self, sight: Sight) -> None:
        """Learn place and look of who is in sight and not mixed up with anyone."""
        mixed = set().union(*self._mixed)
        for somebody, face in self._seen():
            somebody.seen = sight.time
            if not somebody.went_away or sight.time - somebody.faced >= SURELY_FACED:
                somebody.body.rest_on(face.place, self._around(sight, somebody))
            if somebody.number in mixed:
                continue
            somebody.identity.place(sight.time, face.place)
            if face.is_frontal and sight.time - somebody.learned >= LEARN_EVERY:
                somebody.learned = sight.time
                somebody.identity.learn(look_of(sight.image, face.region))
        self._dress(sight, mixed)
        self._forget_absent(sight)

    def _dress(self, sight: Sight, mixed: set[int]) -> None:
        """Learn what someone wears who has waited longest, where it is seen that it is theirs."""
        for somebody, face in sorted(self._seen(), key=lambda pair: pair[0].dressed):
            place, around = face.place, self._around(sight, somebody)
            if sight.time - somebody.dressed < LEARN_EVERY:
                return
            is_alone = all(place.away(other) > BESIDE for other in around.others)
            if is_alone and somebody.number not in mixed:
                somebody.dressed = sight.time
                colors = Colors.of(sight.image)
                somebody.clothes.learn(colors, place)
                somebody.clothes.look_around(colors, place)
                if face.is_frontal:
                    somebody.body.measure(colors, somebody.clothes, around)
                return

    def _forget_absent(self, sight: Sight) -> None:
        gone = [s for s in self._known if sight.time - s.seen > MEMORY]
        self._known = [s for s in self._known if s not in gone]
        departed = [
            s
            for s in (*self._departed, *gone)
            if sight.time - s.seen <= (KNOWN_BY_CLOTHES if s.went_away else KNOWN_FOR)
        ]
        self._departed = departed[-MOST:]
        left = {somebody.number for somebody in self._known}
        self._mixed = {pair for pair in self._mixed if pair <= left}

    def _described(self, sight: Sight) -> People:
        persons = tuple(
            somebody.describe(sight.time, sight.size, self._view) for somebody in self._known
        )
        attended = self._attending.choose(sight.time, persons)
        self._last = People(sight.time, persons, attended)
        return self._last


@dataclass(slots=True)
class Seeing:
    """Makes a tracker with the detectors of a setting, where the work is done.

    Detectors that are missing are logged; it then sees with the others.
    """

    setting: str
    view: CameraView
    zones: Zones
    first: int = 1
    """Number of the first person whom the next tracker sees."""
    hands: bool = False
    """Whether hands are looked at too."""

    def __call__(self) -> Callable[[Frame], People]:
        detectors = load_detectors(self.setting)
        for problem in detectors.problems:
            log.warning(problem)
        tracker = PeopleTracker(detectors, self.view, self.zones, self.first)
        return seen_with(load_hand_tracker(self.view), tracker) if self.hands else tracker.see

    def note(self, people: People) -> None:
        """Let no tracker made from now on give the ids of these people again."""
        for person in people.persons:
            self.first = max(self.first, number_of(person.id) + 1)


def seen_with(hands: HandTracker | None, tracker: PeopleTracker) -> Callable[[Frame], People]:
    """What sees people with their hands, or without where those cannot be seen."""
    if hands is None:
        return tracker.see

    def see(frame: Frame) -> People:
        people = tracker.see(frame)
        return hands.see(frame, people, is_late=tracker.is_searching)

    return see


def _gap(time: float, one: PersonTrack, other: PersonTrack) -> float:
    """Between two, in sizes of the face; of who is out of sight, from where they should be."""
    places = [s.face.middle if s.face else s.identity.expected(time) for s in (one, other)]
    sizes = [s.face.breadth for s in (one, other) if s.face is not None]
    (x, y), (other_x, other_y) = places
    gap = math.hypot(x - other_x, y - other_y) / (sum(sizes) / len(sizes))
    return gap if math.isfinite(gap) else math.inf


def _between(one: FaceTrack, other: FaceTrack) -> float:
    """From one face to another, in sizes of the smaller."""
    away = math.hypot(one.region.x - other.region.x, one.region.y - other.region.y)
    return away / min(one.breadth, other.breadth)


def _is_inside(place: tuple[float, float], size: tuple[int, int]) -> bool:
    return 0 <= place[0] < size[0] and 0 <= place[1] < size[1]
