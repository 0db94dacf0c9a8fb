import io
import json
import subprocess
import zipfile
from pathlib import Path
from random import Random

import pytest
from hypothesis import given, strategies as st

from benchmarks import inputs
from benchmarks.inputs import good
from benchmarks.inputs.mutation import LARGEST, mutated
from benchmarks.inputs.readers import READERS, bad_input
from hri.bench.workers import running
from hri.core.errors import HriError

pytestmark = pytest.mark.slow

SEEDS = [b'[a]\nb = 1.5 # "c"\n', b"<a><b c='d'/></a>"]


@given(st.booleans(), st.integers(0, 10**6))
def test_an_input_is_the_same_for_the_same_numbers_and_bounded(is_text: bool, number: int) -> None:
    made = mutated(SEEDS, is_text, Random(f"1/a/{number}"))
    assert made == mutated(SEEDS, is_text, Random(f"1/a/{number}"))
    assert len(made) <= LARGEST


def test_inputs_that_differ_are_made() -> None:
    made = {mutated(SEEDS, True, Random(f"1/a/{number}")) for number in range(100)}
    assert len(made) > 90


def test_the_good_inputs_are_the_same_in_every_run() -> None:
    assert good.sounds() == good.sounds()  # an Ogg stream has a number of its own
    drawings = good.shipped(["faces/*/targets/*.svg"])
    assert drawings == sorted(drawings, key=lambda data: (len(data), data))
    with zipfile.ZipFile(io.BytesIO(good.archives()[1])) as archive:
        assert {member.date_time for member in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}


def test_a_run_in_several_processes_finds_what_one_finds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    few = {name: READERS[name] for name in ("expression", "formula", "event query")}
    monkeypatch.setattr(inputs, "READERS", few)
    alone, beside = (inputs.measure(tries=61, seed=1, jobs=jobs)["readers"] for jobs in (1, 3))
    for reader in (*alone.values(), *beside.values()):
        for measured in ("slowest_s", "slowest", "largest_mb", "largest"):
            del reader[measured]
    assert alone == beside
    assert sorted(reader["tries"] for reader in beside.values()) == [20, 20, 21]


def test_the_input_that_failed_is_the_one_that_is_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(inputs, "MOST_SECONDS", -1.0)  # each one is too slow
    inputs.measure(tries=30, seed=1, only="expression", keep=tmp_path)
    for number in (0, 17, 29):
        kept = (tmp_path / f"expression-{number}.txt").read_bytes()
        assert kept == bad_input("expression", 1, number)


def test_a_reader_is_tried_and_a_second_call_goes_on(tmp_path: Path) -> None:
    first = inputs.measure(tries=20, seed=1, only="expression", keep=tmp_path)
    assert first["passed"]
    tally = first["readers"]["expression"]
    assert tally["taken"] + tally["refused"] == tally["tries"] == 20
    more = inputs.measure(tries=30, only="expression", keep=tmp_path)
    assert more["tries"] == 30
    assert (
        json.loads((tmp_path / inputs.PROGRESS).read_text())["readers"]["expression"]["tries"] == 30
    )
    with pytest.raises(HriError, match="has inputs of seed 1"):
        inputs.measure(tries=30, seed=2, keep=tmp_path)


@pytest.mark.parametrize(
    ("report", "what"),
    [
        ({"what": "traceback", "why": "ValueError"}, "traceback"),
        ({"what": "refused", "seconds": 6.0}, "slow"),
        ({"what": "taken", "bytes": 400_000_000}, "large"),
        ({"what": "refused"}, ""),
    ],
)
def test_what_breaks_a_limit_is_counted(report: dict[str, object], what: str) -> None:
    tally = inputs.Tally()
    usual = {"number": 7, "seconds": 0.1, "bytes": 0, "why": ""}
    assert tally.count({**usual, **report}) == what
    assert tally.tries == 8
    assert [failure["what"] for failure in tally.failures] == ([what] if what else [])


def test_each_run_draws_other_inputs_and_says_by_which_seed() -> None:
    seeds = {inputs.measure(tries=2, only="expression")["seed"] for _ in range(4)}
    assert len(seeds) > 1


def test_an_unknown_reader_is_one_line() -> None:
    with pytest.raises(HriError, match='did you mean "grammar"'):
        inputs.measure(only="gramar")


def test_every_reader_takes_its_good_inputs() -> None:
    for name, reader in READERS.items():
        assert all(reader.seeds()), name


@pytest.mark.parametrize(
    ("code", "told"),
    [
        ("while time.process_time() < 1.0: pass\nprint('done')", [b"done"]),
        ("time.sleep(600)", None),
    ],
)
def test_a_child_that_works_is_waited_for_and_one_that_hangs_is_not(
    code: str, told: list[bytes] | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(inputs, "PATIENCE", 1.0)
    with running(f"import time\n{code}", subprocess.PIPE) as child:
        assert child.stdout is not None
        lines = inputs._lines(child.stdout.fileno(), child.pid)
        if told is None:
            with pytest.raises(TimeoutError):
                list(lines)
        else:
            assert list(lines) == told


def test_replies_are_read_by_the_companion_wherever_the_input_lies() -> None:
    tally = inputs.measure(tries=5, only="replies", jobs=1)["readers"]["replies"]
    assert tally["failures"] == []
    assert tally["taken"] + tally["refused"] == 5
