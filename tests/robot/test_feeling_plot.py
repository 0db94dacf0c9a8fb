from itertools import pairwise
from xml.etree import ElementTree

from hri.core.signals import EmotionState
from hri.robot.feeling_plot import (
    FELT,
    MOST_EMOTIONS,
    SPAN_S,
    TITLE,
    feeling_plot,
    write_feeling_plot,
)

SVG = "{http://www.w3.org/2000/svg}"


def state(label: str = "joy", valence: float = 0.2, **emotions: float) -> EmotionState:
    return EmotionState(label, 0.5, valence, 0.1, -0.1, emotions)


def curves(moments) -> list[list[tuple[float, float]]]:
    """The points of all curves: pleasure, arousal, dominance, then emotions."""
    root = ElementTree.fromstring(feeling_plot(moments))
    return [
        [tuple(map(float, point.split(","))) for point in line.get("points", "").split()]
        for line in root.iter(f"{SVG}polyline")
    ]


def texts(moments) -> list[str]:
    return [text.text for text in ElementTree.fromstring(feeling_plot(moments)).iter(f"{SVG}text")]


def test_without_a_moment_the_frames_are_empty():
    assert curves([]) == [[], [], []]


def test_time_runs_to_the_right_and_pleasure_up():
    moments = [(0.0, state(valence=-0.5)), (300.0, state(valence=0.0)), (600.0, state(valence=0.5))]
    pleasure = curves(moments)[0]
    steps = [(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(pleasure)]
    assert [dx for dx, _ in steps] == [400.0, 400.0]
    assert all(dy == -50.0 for _, dy in steps)


def test_a_run_that_has_just_begun_fills_the_drawing_after_a_minute():
    for seconds, left in ((30.0, 470.0), (60.0, 70.0), (200.0, 70.0)):
        first, last = curves([(0.0, state()), (seconds, state())])[0]
        assert (first[0], last[0]) == (left, 870.0)
    assert {"0 min", "3 min"} <= set(texts([(0.0, state()), (200.0, state())]))


def test_it_has_a_title_and_ticks_however_short_it_is():
    assert TITLE in texts([])
    minute = texts([(0.0, state()), (45.0, state())])
    assert [text for text in minute if text in ("0 min", "10 s", "40 s", "50 s")] == [
        "0 min",
        "10 s",
        "40 s",
    ]
    assert "1:30 min" in texts([(0.0, state()), (200.0, state())])
    long = [(10.0 * i, state()) for i in range(200)]
    assert len([text for text in texts(long) if text.endswith(" min")]) == 10


def test_what_is_older_than_ten_minutes_is_left_out():
    moments = [(10.0 * i, state()) for i in range(200)]
    first, *_, last = curves(moments)[0]
    assert last[0] - first[0] == 800
    assert len(curves(moments)[0]) == SPAN_S / 10 + 1


def test_the_strongest_emotions_have_curves_and_names():
    moments = [(0.0, state(joy=0.5, fear=FELT / 2)), (1.0, state(anger=0.9))]
    assert len(curves(moments)) == 3 + 2
    names = texts(moments)
    assert names.index("anger") < names.index("joy", names.index("emotions"))
    assert "fear" not in names
    crowd = [(0.0, state(**{f"e{i}": 0.5 for i in range(20)}))]
    assert len(curves(crowd)) == 3 + MOST_EMOTIONS


def test_a_label_is_written_where_it_changes():
    labels = ("joy", "joy", "a < b", "joy", "fear", "anger", "anger", "anger", "anger")
    moments = [(0.3 * i, state(label)) for i, label in enumerate(labels)]
    assert [text for text in texts(moments) if text in labels] == ["joy", "fear", "anger"]
    wide = [(2.0 * i, state(label)) for i, label in enumerate(labels[1:4])]
    assert [text for text in texts(wide) if text in labels] == ["joy", "a < b", "joy"]


def test_the_file_is_replaced_as_a_whole(tmp_path):
    path = tmp_path / "feelings.svg"
    write_feeling_plot([(0.0, state())], path)
    write_feeling_plot([(0.0, state()), (1.0, state())], path)
    assert ElementTree.parse(path).getroot().tag == f"{SVG}svg"
    assert [file.name for file in tmp_path.iterdir()] == ["feelings.svg"]
