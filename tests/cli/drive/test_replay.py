import json
import math
from pathlib import Path

import cv2
import pytest
from hypothesis import given, strategies as st

from hri.cli.drive.plan import PAPER, ROW, Moment, Plan, Run, legend
from hri.cli.drive.recorded import read_run
from hri.cli.main import main
from hri.core.errors import HriError
from hri.core.signals import Pose2D
from hri.simulation.navigation_trips import Journey
from hri.simulation.room import Circle
from hri.simulation.seeded_rooms import furnished


def run_file(folder: Path, count: int = 30) -> Path:
    """A run that goes a meter ahead past a box."""
    world = (
        "[robot]\nstart = [0, 0]\n[person]\nat = [2, 1]\n"
        "[[box]]\ncenter = [0.5, 0.8]\nlength = 0.5\nwidth = 0.5\n"
    )
    lines: list[object] = [{"world": world, "goal": [1.2, 0.0], "radius": 0.2, "title": "a run"}]
    for number in range(count):
        x = number / count
        lines.append({"t": number * 0.1, "robot": [x, 0, 0], "people": [[2, 1]], "seen": [[x, 1]]})
    path = folder / "run.jsonl"
    path.write_text("\n".join(map(json.dumps, lines)))
    return path


def test_a_run_is_drawn_with_its_room(tmp_path: Path) -> None:
    out = tmp_path / "run.png"
    assert main(["drive", "replay", str(run_file(tmp_path)), "--out", str(out)]) == 0
    picture = cv2.imread(str(out))
    assert picture is not None
    colors = {tuple(int(c) for c in color) for color in picture.reshape(-1, 3)[:, ::-1]}
    assert {(32, 104, 176), (212, 112, 62), (205, 200, 190)} <= colors, "robot, person, box"


def test_the_legend_explains_what_is_there_and_nothing_else() -> None:
    def pose(x: float) -> Pose2D:
        return Pose2D(x, 0.0, 0.0)

    alone = Run([Moment(0.0, pose(0.0)), Moment(1.0, pose(1.0))])
    met = Run(
        [Moment(0.0, pose(0.0), ((2.0, 1.0),), ((1.0, 1.0),)), Moment(1.0, pose(1.0))],
        obstacles=[Circle(3.0, 0.0, 0.2)],
        goal=(1.0, 0.0),
    )
    own = ["robot", "robot's way", "start"]
    assert [name for name, _, _ in legend(alone, 900)] == own
    names = [*own, "goal", "person", "person's way", "seen", "thing"]
    assert [name for name, _, _ in legend(met, 900)] == names

    assert max(row for _, _, row in legend(met, 300)) > 0, "it is wrapped"
    picture = Plan(alone).whole()
    assert all(side % 2 == 0 for side in picture.shape[:2]), "films need even sides"
    below = picture[-ROW * 2 :]
    assert (below != PAPER).any()


def test_a_film_shows_the_robot_move(tmp_path: Path) -> None:
    out = tmp_path / "run.mp4"
    words = ["drive", "replay", str(run_file(tmp_path)), "--out", str(out), "--speed", "2"]
    assert main(words) == 0
    film = cv2.VideoCapture(str(out))
    assert film.get(cv2.CAP_PROP_FRAME_COUNT) == pytest.approx(30, abs=2)


def test_a_policy_for_what_is_driven_already_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run, out = run_file(tmp_path), tmp_path / "run.png"
    assert main(["drive", "replay", str(run), "--policy", "none", "--out", str(out)]) != 0
    assert "is a recorded run - leave it out" in capsys.readouterr().err
    assert not out.exists()


def test_a_trip_that_was_written_is_read_again(tmp_path: Path) -> None:
    room = furnished(2)
    trip = Journey(room, "full", keeps_track=True).run()
    path = tmp_path / "trip.jsonl"
    trip.write(path, room)
    run = read_run(str(path), "full")
    assert len(run.moments) == len(trip.track)
    assert run.goal == pytest.approx(room.goal)
    assert len(run.obstacles) == len(room.obstacles)


def test_a_recording_of_a_robot_is_drawn_by_its_odometry(tmp_path: Path) -> None:
    lines = [
        {"t": 0.5 * n, "event": "odometry", "x_cm": 10 * n, "y_cm": 0, "heading_rad": 0}
        for n in range(5)
    ]
    (tmp_path / "events.jsonl").write_text("\n".join(map(json.dumps, lines)))
    run = read_run(str(tmp_path), "full")
    assert run.moments[-1].robot == Pose2D(0.4, 0.0, 0.0)
    assert Plan(run).whole().ndim == 3


def test_a_recording_is_drawn_up_to_where_its_program_was_killed(tmp_path: Path) -> None:
    whole = b'{"t": %d, "event": "odometry", "x_cm": 10, "y_cm": 0, "heading_rad": 0}\n'
    said = '{"t": 2, "event": "speech.said", "text": "é"}\n'.encode()
    for cut in range(len(said)):
        (tmp_path / "events.jsonl").write_bytes(whole % 0 + whole % 1 + said[:cut])
        assert len(read_run(str(tmp_path), "full").moments) == 2


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("", "empty"),
        ("nonsense", "not JSON"),
        ("[1]", "not a JSON object"),
        ('{"goal": 3}', "bad description"),
        ("{}", "the robot did not move"),
        ('{}\n{"t": 0}', ":2: bad moment"),
        ('{}\n{"t": 0, "robot": [1e999, 0, 0]}', ":2: bad moment"),
    ],
)
def test_a_file_that_is_no_run_says_what_is_wrong(tmp_path: Path, text: str, what: str) -> None:
    path = tmp_path / "run.jsonl"
    path.write_text(text)
    with pytest.raises(HriError, match=what):
        read_run(str(path), "full")


def test_a_run_that_is_not_there_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["drive", "replay", "/nowhere/run.jsonl"]) != 0
    assert "cannot read this run" in capsys.readouterr().err


@given(st.binary(max_size=200))
def test_no_file_crashes_the_reader(tmp_path_factory: pytest.TempPathFactory, data: bytes) -> None:
    path = tmp_path_factory.mktemp("run") / "run.jsonl"
    path.write_bytes(data)
    with pytest.raises(HriError):
        read_run(str(path), "full")


def test_a_picture_of_a_robot_far_away_stays_small() -> None:
    moments = [Moment(0.0, Pose2D()), Moment(1.0, Pose2D(900.0, 0.0))]
    assert max(Plan(Run(moments)).whole().shape) <= 1402


def written(folder: Path, *lines: object) -> str:
    path = folder / "run.jsonl"
    path.write_text("\n".join(map(json.dumps, lines)))
    return str(path)


@pytest.mark.parametrize("x", [math.nan, math.inf, 1e300, 10**400, None, "far"])
def test_a_recorded_pose_that_is_nowhere_is_named(tmp_path: Path, x: object) -> None:
    pose = {"event": "odometry", "t": 0, "x_cm": x, "y_cm": 0, "heading_rad": 0}
    with pytest.raises(HriError, match=r"run\.jsonl:1: (bad pose|not JSON: an integer)"):
        read_run(written(tmp_path, pose), "full")


@pytest.mark.parametrize("radius", [math.nan, -1, 0, 1e9])
def test_a_radius_that_no_robot_has_is_named(tmp_path: Path, radius: float) -> None:
    path = written(tmp_path, {"radius": radius}, {"t": 0, "robot": [0, 0, 0]})
    with pytest.raises(HriError, match="radius"):
        read_run(path, "full")


@pytest.mark.parametrize(("last", "why"), [(-1.0, "order of time"), (1e15, "hours")])
def test_time_goes_on_and_ends(tmp_path: Path, last: float, why: str) -> None:
    moments = ({"t": time, "robot": [0, 0, 0]} for time in (0.0, last))
    with pytest.raises(HriError, match=why):
        read_run(written(tmp_path, {}, *moments), "full")


def test_a_world_that_is_none_is_named_by_its_run(tmp_path: Path) -> None:
    path = written(tmp_path, {"world": "[["}, {"t": 0, "robot": [0, 0, 0]})
    with pytest.raises(HriError, match=r"run\.jsonl:1: in its world: world\.toml:1"):
        read_run(path, "full")
