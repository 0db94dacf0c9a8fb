import math
from pathlib import Path

import pytest

from hri.core.errors import AuthoringError
from hri.emotion.drives import DRIVES, STILLED
from hri.emotion.dynamics import Dynamics
from hri.emotion.ledger import Origin
from hri.emotion.personality import Personality, load_personality
from tests.emotion.streams import NEUTRAL, STIMULI


def test_company_stills_the_need_for_it_and_the_need_comes_back() -> None:
    rest = NEUTRAL.drives(NEUTRAL.rest())["company"]
    petted = NEUTRAL.feel(NEUTRAL.rest(), "petted", 1.0, 0.0)
    assert NEUTRAL.drives(petted)["company"] == pytest.approx(0.6 * rest)
    later = [
        NEUTRAL.drives(NEUTRAL.advance(petted, 60.0 * minutes))["company"]
        for minutes in (0, 10, 60, 600)
    ]
    assert later == sorted(later)
    assert later[-1] == pytest.approx(rest, abs=1e-6)


def test_a_stilled_need_leaves_content_for_a_while() -> None:
    petted = NEUTRAL.feel(NEUTRAL.rest(), "petted", 1.0, 0.0)
    pulls = [
        NEUTRAL.ledger(NEUTRAL.advance(petted, seconds))[Origin("drive.company")].mood[0]
        for seconds in (0.0, 600.0, 20000.0)
    ]
    assert pulls[0] == 0.0
    assert pulls[1] > 0.02
    assert pulls[2] < 0.1 * pulls[1]


def test_an_empty_battery_makes_tired_until_it_is_charged() -> None:
    empty = NEUTRAL.report(NEUTRAL.rest(), "energy", 1.0, 0.0)
    tired = NEUTRAL.read(NEUTRAL.advance(empty, 3600.0))
    assert tired.drives["energy"] == 1.0
    assert tired.arousal < -0.2
    assert NEUTRAL.why(NEUTRAL.advance(empty, 3600.0))[0].name == "drive.energy"
    full = NEUTRAL.report(empty, "energy", 0.0, 3600.0)
    assert abs(NEUTRAL.read(NEUTRAL.advance(full, 7200.0)).arousal) < 1e-6


def test_what_the_battery_says_is_not_stilled_by_a_stimulus() -> None:
    assert "energy" not in STILLED
    assert [drive.name for drive in DRIVES] == ["company", "play", "rest", "energy"]


def test_a_personality_has_its_own_drives(tmp_path: Path) -> None:
    path = tmp_path / "clingy.toml"
    path.write_text("[drive.company]\nrate = 4.0\nresting = 0.9\n", encoding="utf-8")
    clingy = Dynamics(load_personality(str(path)), STIMULI)
    affect = clingy.feel(clingy.rest(), "petted", 1.0, 0.0)
    later = clingy.advance(affect, DRIVES[0].tau_s / 4.0)
    assert clingy.drives(later)["company"] == pytest.approx(0.9 - 0.36 * math.exp(-1))


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("[drive.compny]\nrate = 1\n", 'did you mean "company"'),
        ("[drive.energy]\nrate = 1\n", "energy"),
        ("[drive.company]\nrate = 0\n", "from 0.05 to 20"),
        ("[drive.company]\nrtae = 1\n", 'did you mean "rate"'),
        ("[ocean]\nopeness = 1\n", 'did you mean "openness"'),
        ("[ocean]\nopenness = 2\n", "from -1 to 1"),
        ("[ocean]\n[baseline]\n", "both ocean and baseline"),
    ],
)
def test_wrong_drives_and_factors_are_refused(tmp_path: Path, text: str, what: str) -> None:
    path = tmp_path / "wrong.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(AuthoringError, match=what):
        load_personality(str(path))


def test_a_state_of_another_set_of_drives_is_taken_over_as_far_as_it_goes() -> None:
    lonely = Dynamics(Personality("lonely", drives=DRIVES[:1]), STIMULI)
    affect = lonely.feel(lonely.rest(), "petted", 1.0, 0.0)
    resumed = NEUTRAL.resume(affect.imprint, 0.0)
    assert NEUTRAL.drives(resumed)["company"] == lonely.drives(affect)["company"]
    assert NEUTRAL.drives(resumed)["play"] == NEUTRAL.drives(NEUTRAL.rest())["play"]
