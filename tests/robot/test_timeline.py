"""The plot of a visit: its words can be read, and they are those of the other plot."""

from itertools import combinations

from hypothesis import given, strategies as st

from hri.robot.feeling_plot import MOOD_COLORS
from hri.robot.labels import placed
from hri.robot.timeline import TITLE, figure_of

times = st.floats(0, 100)
words = st.lists(st.tuples(times, st.text("abc ", min_size=1, max_size=40)), max_size=30).map(
    sorted
)


@given(words)
def test_labels_neither_cover_each_other_nor_leave_the_frame(words):
    letter = 0.01
    labels = list(placed(words, 0.0, 100.0, letter, 3))

    spans = [(label.level, label.at, label.at + letter * (len(label.text) + 1)) for label in labels]
    assert all(begin >= 0 and end <= 1 + 1e-9 for _, begin, end in spans)
    for (one, begin, end), (other, starts, stops) in combinations(spans, 2):
        assert one != other or end <= starts + 1e-9 or stops <= begin + 1e-9
    assert len(labels) >= min(3, len(words))


def event(name, time, **properties):
    return {"t": time, "event": name, **properties}


def feeling(time, label, valence):
    return event("emotion.changed", time, label=label, valence=valence, arousal=0.1, dominance=0.0)


VISIT = [
    feeling(0.0, "calm", 0.0),
    event("speech.heard", 58.0, text="go forward ten meters at once if you please"),
    event("bumper.pressed", 59.0),
    event("head.nodded", 59.2),
    event("drive.stopped", 59.5, reason="bump"),
    feeling(60.0, "joy", 0.5),
]


def texts(axes):
    return [text.get_text() for text in axes.texts]


def test_all_words_of_a_visit_are_within_its_frames():
    figure = figure_of(VISIT)
    figure.canvas.draw()

    assert figure.get_suptitle() == TITLE
    for axes in figure.axes:
        frame = axes.get_window_extent()
        boxes = [text.get_window_extent() for text in axes.texts]
        assert all(frame.x0 <= box.x0 and box.x1 <= frame.x1 + 2 for box in boxes)
        assert not any(one.overlaps(other) for one, other in combinations(boxes, 2))


def test_it_speaks_as_the_other_plots_and_the_terminal_do():
    talk, mood, motion = figure_of(VISIT).axes

    assert {"bumped", "nod"} <= set(texts(talk))
    assert [text.get_text() for text in mood.get_legend().get_texts()] == list(MOOD_COLORS)
    assert "joy" in texts(mood)
    assert texts(motion) == ["stopped: bump"]


def test_the_mood_moves_on_between_two_events():
    pleasure = figure_of(VISIT).axes[1].lines[0]

    times, values = pleasure.get_data()
    assert pleasure.get_drawstyle() == "default"
    assert (list(times), list(values)) == ([0.0, 60.0, 60.0], [0.0, 0.5, 0.5])


def test_a_visit_without_events_is_drawn():
    assert len(figure_of([]).axes) == 3
