"""What the companion says while it follows someone."""

import tomllib

import pytest

from hri.core import paths
from tests.apps.test_companion import SEEING, Visit


@pytest.mark.slow
def test_it_says_that_it_has_lost_someone_and_later_that_it_stays() -> None:
    texts = tomllib.loads((paths.house() / "apps/companion/replies.toml").read_text())["unasked"]
    visit = Visit(
        24,
        {1.0: "follow me"},
        devices=SEEING,
        prepare=lambda robot: robot.visitor.leave(after=8.0),
    )
    lost, given_up = visit.named("target.lost")
    assert not lost.properties["given_up"]
    assert given_up.properties["given_up"]
    of_loss, of_end = visit.named("speech.said")[-2:]
    assert of_loss.properties["text"] in texts["lost"]
    assert of_loss.time - lost.time < 0.5
    assert of_end.properties["text"] == texts["nobody"]
    assert of_end.time > given_up.time
    (ending,) = visit.named("target.left")
    assert ending.properties["reason"] == "lost"
