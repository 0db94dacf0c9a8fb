import json
import sys
import tomllib

import pytest

from benchmarks.conversation import __main__ as command, judging, transcript
from benchmarks.conversation.judging import VERDICTS
from benchmarks.conversation.transcript import Words
from hri.core.errors import HriError
from tests.benchmarks.conversation.talks import line

LINES = [
    line(1, 'She said "hi".', showed=("happy",), rule="greet"),
    line(2, "Turning left.", moved=("turned left 90 degrees",), expects="turns right"),
    line(3),
    line(4, "I like you, too."),
]
SENSIBLE, OTHER, SILENT, BESIDE = VERDICTS


def verdicts(*told: str) -> dict[str, str]:
    return {one.id: verdict for one, verdict in zip(LINES, told, strict=True)}


def test_readers_see_situation_words_and_deeds_and_nothing_else():
    form = "\n".join(transcript.for_readers(LINES))
    turns = tomllib.loads(form)
    assert form.startswith("# a woman in the kitchen\n")
    assert turns["open/ann/1/1"] == {
        "said": "hello",
        "answered": 'She said "hi". (showed happy)',
        "verdict": "",
    }
    assert turns["open/ann/1/3"]["answered"] == "(nothing)"
    assert "greet" not in form
    assert "turns right" not in form


def test_what_cut_it_short_is_seen():
    assert line(1, said=(Words(0.2, "I can sing.", "I can"),)).answered() == "I can..."


def test_a_form_that_is_filled_in_and_json_lines_are_read(tmp_path):
    told = verdicts(SENSIBLE, OTHER, SILENT, SENSIBLE)
    form = "\n".join(transcript.for_readers(LINES))
    for verdict in told.values():
        form = form.replace('verdict = ""', f'verdict = "{verdict}"', 1)
    (tmp_path / "one.toml").write_text(form)
    rows = (json.dumps({"id": id, "verdict": verdict}) for id, verdict in told.items())
    (tmp_path / "other.jsonl").write_text("\n".join(rows))
    for name in ("one.toml", "other.jsonl"):
        assert judging.read_verdicts(tmp_path / name, LINES) == told


FIRST = "open/ann/1/1"


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.toml", f'["{FIRST}"]\nverdict = "fine"\n', 'a.toml:2:1: verdict is "fine"'),
        (
            "a.jsonl",
            f'{{"id": "{FIRST}", "verdict": "fine"}}',
            'a.jsonl:1:1: the verdict is "fine"',
        ),
        ("b.jsonl", "\nnonsense", "b.jsonl:2:1: no verdict"),
        ("c.jsonl", f'{{"id": "{FIRST}", "verdict": "silent"}}', "lacks 3 turns, such as open/ann"),
    ],
)
def test_wrong_verdicts_are_refused_with_their_place(tmp_path, name, text, message):
    (tmp_path / name).write_text(text)
    with pytest.raises(HriError) as refused:
        judging.read_verdicts(tmp_path / name, LINES)
    assert message in str(refused.value)


def test_kappa_is_agreement_beyond_chance():
    one = verdicts(SENSIBLE, SENSIBLE, SILENT, SILENT)
    other = verdicts(SENSIBLE, SENSIBLE, SILENT, SENSIBLE)
    assert judging.agreement(one, other) == 0.75
    assert judging.kappa(one, other) == pytest.approx(0.5)
    assert judging.kappa(one, one) == 1.0
    assert judging.kappa(*[dict.fromkeys(one, SILENT)] * 2) == 1.0
    assert judging.kappa(one, verdicts(SILENT, SILENT, SENSIBLE, SENSIBLE)) == -1.0


def test_the_report_lists_what_both_took_for_another_meaning():
    one = verdicts(SENSIBLE, OTHER, SILENT, OTHER)
    other = verdicts(SENSIBLE, OTHER, SILENT, BESIDE)
    text = "\n".join(judging.report(LINES, [one, other]))
    assert "1 turns of which both readers" in text
    assert '  open/ann/1/2: "hello" - Turning left. (turned left 90 degrees)' in text
    assert "75.0 %" in text


def test_the_command_prints_the_form_and_refuses_what_is_no_transcript(
    tmp_path, monkeypatch, capsys
):
    transcript.write(LINES, tmp_path / "open.jsonl")
    monkeypatch.setattr(sys, "argv", ["x", "judge", str(tmp_path / "open.jsonl"), "--for-readers"])
    command.main()
    assert len(tomllib.loads(capsys.readouterr().out)) == len(LINES)
    monkeypatch.setattr(sys, "argv", ["x", "judge", str(tmp_path / "no.jsonl"), "--for-readers"])
    with pytest.raises(SystemExit, match=r"no\.jsonl"):
        command.main()
