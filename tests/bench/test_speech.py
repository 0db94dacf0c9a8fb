import csv
import json

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.bench.speech import flite_voices, latency, samples, scoring, text
from hri.bench.speech.flite_voices import RATE
from hri.bench.speech.listening import Hearing, listen
from hri.bench.speech.samples import DATA, ORDERS, ROBOT
from hri.bench.speech.scoring import Outcome
from hri.cli.main import main
from hri.core.errors import HriError
from hri.core.statistics import wilson
from hri.speech.grammar import load_grammar, read_grammar
from hri.speech.grammar.matching import parse
from hri.speech.synthesizers.flite import is_there
from tests.bench.heard import noise, piece


@pytest.fixture(scope="module")
def robot():
    return load_grammar(ROBOT)


def same(tags, others):
    return tags.keys() == others.keys() and all(
        value == (pytest.approx(others[name]) if isinstance(value, float) else others[name])
        for name, value in tags.items()
    )


def test_every_command_means_what_its_row_says(robot):
    with (DATA / "commands.tsv").open() as lines:
        commands = list(csv.DictReader(lines, delimiter="\t"))
    assert len(commands) == 65
    for row in commands:
        found = parse(robot, row["sentence"])
        assert found is not None, row["sentence"]
        assert found.rule == row["rule"]
        assert same(found.tags, json.loads(row["tags"])), row["sentence"]


def test_an_order_gives_the_slots_that_the_labels_name():
    said = "could i get a small dark roast iced mocha with lots of soy milk and sugar please"
    found = parse(load_grammar(ORDERS), said)
    assert scoring.slots(found.tags) == {
        "size": "small",
        "roast": "dark roast",
        "coffeeDrink": "iced mocha",
        "milkAmount": "lots of soy milk",
        "sugarAmount": "sugar",
    }


def test_names_are_different_and_always_the_same():
    names = samples.names(10_000)
    assert len(set(names)) == 10_000
    assert names[:1000] == samples.names(1000)


@pytest.mark.parametrize(
    ("count", "total", "low", "high"),
    # Values of the formula, computed by hand with z = 1.96.
    [(0, 10, 0.0, 0.2775), (8, 10, 0.4902, 0.9433), (50, 50, 0.9286, 1.0), (1, 2, 0.0945, 0.9055)],
)
def test_a_share_comes_with_its_interval(count, total, low, high):
    assert wilson(count, total) == pytest.approx((low, high), abs=1e-4)


@given(st.integers(1, 10_000).flatmap(lambda n: st.tuples(st.integers(0, n), st.just(n))))
def test_the_interval_holds_the_share_and_stays_within_0_and_1(counted):
    low, high = wilson(*counted)
    assert 0.0 <= low <= counted[0] / counted[1] + 1e-12
    assert counted[0] / counted[1] - 1e-12 <= high <= 1.0


def test_two_things_understood_in_one_clip_are_a_mistake():
    outcome = Outcome(noise("slt/stop", "stop"), [piece("stop"), piece("go forward")])
    assert not outcome.is_right
    assert outcome.is_mistaken


def test_what_was_rejected_is_neither_right_nor_a_mistake():
    outcome = Outcome(noise("slt/stop", "stop"), [piece("stop", is_accepted=False)])
    assert not outcome.is_right
    assert not outcome.is_mistaken


def test_other_words_of_the_same_meaning_are_a_mistake_that_is_told_apart(robot):
    said = noise("slt/bring", "bring me the red box")
    same = Outcome(said, [piece("get me a red box", {"thing": "red_box"}, rule="bring")])
    other = Outcome(said, [piece("get me a blue box", {"thing": "blue_box"}, rule="bring")])
    assert (same.is_mistaken, same.means_the_same(robot)) == (True, True)
    assert (other.is_mistaken, other.means_the_same(robot)) == (True, False)


def test_latency_counts_the_recordings_of_its_length():
    taken = [[piece("a", latency_s=0.030)]] * 19 + [[piece("a", latency_s=0.050)]]
    said = [noise("a", seconds=2.5)] * 20
    other = noise("b", seconds=9.0)
    asked = latency.Latency("commands", (2.0, 4.0), 0.040)
    row = latency.latency(
        asked, [*said, other], Hearing([*taken, [piece("b", latency_s=9.0)]], 0.0)
    )
    assert (row["pieces"], row["median"], row["passed"]) == (20, 0.03, True)
    assert "skipped" in latency.latency(asked, [other], Hearing([[piece("b")]], 0.0))


def test_the_start_of_the_program_does_not_count_for_the_real_time_factor():
    def slow(grammar, said, engine=""):
        return Hearing([[] for _ in said], 0.5 + 0.02 * sum(clip.seconds for clip in said))

    factor, _ = latency.real_time_factor(ROBOT, [noise("a", seconds=10.0)], slow)
    assert factor == pytest.approx(0.02, rel=0.02)


def test_the_list_of_names_is_a_grammar_of_them(monkeypatch):
    monkeypatch.setattr(latency, "NAMES", 50)
    with latency.names_grammar() as (path, _):
        grammar = load_grammar(path)
    assert all(parse(grammar, f"call {name}") for name in samples.names(50))


def test_the_grammar_of_many_rules_is_right(tmp_path):
    path = tmp_path / "many.jsgf"
    path.write_text(text.many_rules(20))
    grammar, errors = read_grammar(path)
    assert not errors
    assert len(grammar.rules) == 20


@pytest.mark.skipif(not is_there(), reason="flite is not installed")
def test_what_flite_said_once_is_read_from_the_disk(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    first = flite_voices.say("stop", "kal16")
    monkeypatch.setenv("PATH", str(tmp_path))
    assert np.array_equal(flite_voices.say("stop", "kal16"), first)
    assert first[: round(flite_voices.LEAD * RATE)].any() is np.False_
    [kept] = (tmp_path / "hri" / "flite").iterdir()
    kept.write_bytes(b"RIFF")
    with pytest.raises(HriError, match="flite is not installed"):
        flite_voices.say("stop", "kal16")


def test_the_program_that_listens_hears_no_speech_in_silence():
    hearing = listen(ROBOT, [latency.SHORTEST])
    assert [heard.reason for heard in hearing.heard[0]] == ["no speech"]
    assert hearing.cpu_s > 0


def test_a_program_that_fails_is_told_of(tmp_path):
    with pytest.raises(HriError, match=r"grammar listen .* failed: .*: no such file"):
        listen(tmp_path / "none.jsgf", [latency.SHORTEST])


def test_options_of_one_bench_are_refused_by_another(capsys):
    assert main(["bench", "net", "--quick"]) == 2
    assert "takes no --quick" in capsys.readouterr().err
    assert main(["bench", "net", "--draw", "1"]) == 2
    assert "takes no --draw" in capsys.readouterr().err
