"""What the studio's page gets of who is in view."""

from __future__ import annotations

import pytest

from hri.core.signals import FaceBox, HeadPose, Person
from hri.studio import live

FACE, BODY = FaceBox(10, 20, 30, 40), FaceBox(5, 15, 60, 200)


@pytest.mark.parametrize(
    ("box", "has_face", "shown"), [(FACE, True, [10, 20, 30, 40]), (None, False, [5, 15, 60, 200])]
)
def test_the_box_is_of_the_face_or_of_the_body_of_who_is_seen_from_behind(box, has_face, shown):
    pose = HeadPose(1.0, 0.0, 0.0, 0.0, box)
    person = Person("p1", pose, since=0.25, has_face=has_face, body=None if has_face else BODY)
    told = live._person(person, "p1")
    assert (told["box"], told["has_face"], told["since"]) == (shown, has_face, 0.25)
    assert told["is_attended"]
