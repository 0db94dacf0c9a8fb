import csv
import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hri.bench.speech import accuracy, clips, flite, speed, text
from hri.bench.speech.accuracy import MEASURES, ORDERS, ROBOT, Outcome
from hri.bench.speech.babble import RATE, above, active_power
from hri.bench.speech.clips import DATA, Clip, Recordings
from hri.bench.speech.listening import Heard, Hearing, listen
from hri.cli.main import main
from hri.core.errors import HriError
from hri.core.statistics import wilson
from hri.speech.grammar import load_grammar, read_grammar
from hri.speech.grammar.matching import parse
from hri.speech.synthesizers.flite import is_there


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


def test_no_sentence_from_outside_is_in_the_grammar(robot):
    assert len(clips.outside()) == 42
    assert [sentence for sentence in clips.outside() if parse(robot, sentence)] == []


def test_an_order_gives_the_slots_that_the_labels_name():
    said = "could i get a small dark roast iced mocha with lots of soy milk and sugar please"
    found = parse(load_grammar(ORDERS), said)
    assert accuracy.slots(piece(said, found.tags)) == {
        "size": "small",
        "roast": "dark roast",
        "coffeeDrink": "iced mocha",
        "milkAmount": "lots of soy milk",
        "sugarAmount": "sugar",
    }


def test_names_are_different_and_always_the_same():
    names = clips.names(10_000)
    assert len(set(names)) == 10_000
    assert names[:1000] == clips.names(1000)


@given(st.floats(-5, 30), st.floats(0.05, 1.0), st.integers(0, 100))
def test_speech_stands_above_babble_by_the_ratio_that_was_asked_for(ratio, loudness, seed):
    chance = np.random.default_rng(seed)
    speech = np.zeros(RATE, np.int16)
    speech[3200:12800] = chance.normal(0, 3000 * loudness, 9600)
    noise = chance.normal(0, 1, RATE)
    mixture = above(speech, noise, ratio).astype(np.float64)
    assert np.abs(mixture).max() <= 32000
    heard_noise = np.mean(mixture[:3200] ** 2) / np.mean(noise[:3200] ** 2)
    heard_speech = active_power(mixture[3200:12800]) - heard_noise
    gain = heard_speech / active_power(speech.astype(np.float64))
    assert 10 * np.log10(heard_speech / heard_noise) == pytest.approx(ratio, abs=2.0)
    assert gain <= 1.2


def test_each_draw_of_the_babble_is_another_one_and_always_the_same(people):
    said = [clips.padded(clip) for clip in people.orders]

    def heard(draw):
        mixed = clips.in_babble(said, people.orders, "12 dB", draw)
        return np.concatenate([clip.samples for clip in mixed])

    assert np.array_equal(heard(1), heard(1))
    assert not np.array_equal(heard(0), heard(1))
    assert not np.array_equal(heard(1), heard(2))


def test_silence_has_no_active_power():
    assert active_power(np.zeros(RATE)) == 0.0


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


def piece(words, tags=(), is_accepted=True, rule="", latency_s=0.01):
    return Heard(is_accepted, words, rule, dict(tags), 0.9, "", latency_s)


def noise(name, sentence="", slots=(), seconds=0.2):
    chance = np.random.default_rng(len(name))
    samples = chance.normal(0, 1000, round(seconds * RATE)).astype(np.int16)
    return Clip(name, samples, sentence, dict(slots), "slt" if sentence else "")


@pytest.fixture
def people():
    """Recordings of nobody."""
    orders = tuple(noise(f"orders/{n}", slots={"coffeeDrink": "latte"}) for n in range(8))
    return Recordings(orders, (noise("read/1", "he might"),))


@pytest.fixture
def _silent_flite(monkeypatch):
    monkeypatch.setattr(flite, "say", lambda sentence, voice: noise(sentence, sentence).samples)


def perfect(grammar, said, engine=""):
    """Hears what is of the grammar, and nothing else."""
    heard = []
    for clip in said:
        is_order = bool(clip.slots) and grammar == ORDERS
        is_command = clip.sentence in clips.commands()
        words = piece(clip.sentence, {"coffeeDrink": "latte"} if is_order else {})
        heard.append([words] if is_order or is_command else [])
    return Hearing(heard, 0.0)


def credulous(grammar, said, engine=""):
    """Hears the same command in everything."""
    return Hearing([[piece("stop")] for _ in said], 0.0)


@pytest.mark.usefixtures("_silent_flite")
def test_who_hears_right_passes_every_row(people):
    told = list(accuracy.rows(people, perfect, step=9, progress=str))
    assert [row["what"] for row in told] == [measure.name for measure in MEASURES]
    assert all(row["passed"] for row in told)
    assert {row["rate"] for row in told} == {0.0, 1.0}


@pytest.mark.usefixtures("_silent_flite")
def test_who_accepts_everything_fails_every_row(people):
    told = list(accuracy.rows(people, credulous, step=9, progress=str))
    assert not any(row["passed"] for row in told)
    made_up = next(row for row in told if row["what"].startswith("sentences outside"))
    assert made_up["count"] == made_up["of"]
    assert '"stop" accepted' in made_up["clips"][0]


@pytest.mark.usefixtures("_silent_flite")
def test_rows_without_recordings_say_why_they_are_skipped():
    told = list(accuracy.rows(None, perfect, step=9, progress=str))
    measured = [row["what"] for row in told if "skipped" not in row]
    assert measured == [m.name for m in MEASURES if m.condition == "clean"][:3]
    assert all("--recordings" in row["skipped"] for row in told if "skipped" in row)


def test_rows_without_flite_say_how_to_install_it(people, monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    told = list(accuracy.rows(people, perfect, step=9, progress=str))
    assert all("apt install flite" in row["skipped"] for row in told[:7])
    assert all("skipped" not in row for row in told[7:])


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


def test_every_clip_keeps_its_own_pieces_though_they_are_heard_in_batches():
    said = [noise(str(n), str(n), seconds=0.01) for n in range(3 * accuracy.BATCH + 1)]

    def echo(grammar, batch, engine=""):
        return Hearing([[piece(clip.sentence)] for clip in batch], 0.0)

    assert all(outcome.is_right for outcome in accuracy.hear(ROBOT, said, echo))


def test_latency_counts_the_recordings_of_its_length():
    taken = [[piece("a", latency_s=0.030)]] * 19 + [[piece("a", latency_s=0.050)]]
    said = [noise("a", seconds=2.5)] * 20
    other = noise("b", seconds=9.0)
    asked = speed.Latency("commands", (2.0, 4.0), 0.040)
    row = speed.latency(asked, [*said, other], Hearing([*taken, [piece("b", latency_s=9.0)]], 0.0))
    assert (row["pieces"], row["median"], row["passed"]) == (20, 0.03, True)
    assert "skipped" in speed.latency(asked, [other], Hearing([[piece("b")]], 0.0))


def test_the_start_of_the_program_does_not_count_for_the_real_time_factor():
    def slow(grammar, said, engine=""):
        return Hearing([[] for _ in said], 0.5 + 0.02 * sum(clip.seconds for clip in said))

    factor, _ = speed.real_time_factor(ROBOT, [noise("a", seconds=10.0)], slow)
    assert factor == pytest.approx(0.02, rel=0.02)


def test_the_list_of_names_is_a_grammar_of_them(monkeypatch):
    monkeypatch.setattr(speed, "NAMES", 50)
    with speed.names_grammar() as (path, _):
        grammar = load_grammar(path)
    assert all(parse(grammar, f"call {name}") for name in clips.names(50))


def test_the_grammar_of_many_rules_is_right(tmp_path):
    path = tmp_path / "many.jsgf"
    path.write_text(text.many_rules(20))
    grammar, errors = read_grammar(path)
    assert not errors
    assert len(grammar.rules) == 20


@pytest.mark.skipif(not is_there(), reason="flite is not installed")
def test_what_flite_said_once_is_read_from_the_disk(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    first = flite.say("stop", "kal16")
    monkeypatch.setenv("PATH", str(tmp_path))
    assert np.array_equal(flite.say("stop", "kal16"), first)
    assert first[: round(flite.LEAD * RATE)].any() is np.False_
    [kept] = (tmp_path / "hri" / "flite").iterdir()
    kept.write_bytes(b"RIFF")
    with pytest.raises(HriError, match="flite is not installed"):
        flite.say("stop", "kal16")


def test_the_program_that_listens_hears_no_speech_in_silence():
    hearing = listen(ROBOT, [speed.SHORTEST])
    assert [heard.reason for heard in hearing.heard[0]] == ["no speech"]
    assert hearing.cpu_s > 0


def test_a_program_that_fails_is_told_of(tmp_path):
    with pytest.raises(HriError, match=r"grammar listen .* failed: .*: no such file"):
        listen(tmp_path / "none.jsgf", [speed.SHORTEST])


def test_options_of_one_bench_are_refused_by_another(capsys):
    assert main(["bench", "net", "--quick"]) == 2
    assert "takes no --quick" in capsys.readouterr().err
    assert main(["bench", "net", "--draw", "1"]) == 2
    assert "takes no --draw" in capsys.readouterr().err
