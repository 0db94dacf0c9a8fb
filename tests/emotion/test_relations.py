import pytest

from hri.emotion import relations
from hri.emotion.affect import Affect
from tests.emotion.streams import NEUTRAL


def known(stimulus: str, times: int, person: str = "Anna") -> Affect:
    affect = NEUTRAL.rest()
    for number in range(times):
        affect = NEUTRAL.feel(affect, stimulus, 1.0, 600.0 * number, person)
    return affect


def test_who_praises_is_liked_and_who_insults_is_not() -> None:
    assert NEUTRAL.relations(NEUTRAL.rest()) == {}
    assert 0.0 < NEUTRAL.relations(known("praise", 3))["Anna"] < 0.2
    assert -1.0 < NEUTRAL.relations(known("insulted", 20))["Anna"] < -0.9


def test_a_relation_fades_over_a_month() -> None:
    affect = known("insulted", 2)
    later = NEUTRAL.advance(affect, affect.time + relations.FADES_S)
    assert NEUTRAL.relations(later)["Anna"] == pytest.approx(
        NEUTRAL.relations(affect)["Anna"] / 2.718, rel=0.1
    )


def test_a_friend_pleases_more_and_hurts_less_than_a_stranger() -> None:
    friend = known("praise", 20)
    foe = known("insulted", 20)
    for stimulus, emotion, order in (("petted", "love", 1), ("scold", "shame", -1)):
        felt = [
            NEUTRAL.charges(NEUTRAL.feel(affect, stimulus, 1.0, 1e5, person))[emotion]
            for affect, person in ((foe, "Anna"), (friend, None), (friend, "Anna"))
        ]
        assert felt == sorted(felt)[::order]
        assert len(set(felt)) == 3


def test_what_nobody_did_changes_no_relation() -> None:
    affect = NEUTRAL.feel(NEUTRAL.rest(), "praise", 1.0, 0.0)
    assert NEUTRAL.relations(affect) == {}
