import pytest

from benchmarks.conversation.talks import TOY, Turn, load_intents, load_talks
from hri.core.errors import AuthoringError, HriError

FILE = """\
writer = "ann"

[[talk]]
situation = "a kitchen"
turns = [
  { say = "hello", expects = "greets" },
  { say = "again", expects = "greets again", kind = "follow-up" },
]

[[talk]]
situation = "a hall"
turns = [{ say = "bye", expects = "says goodbye" }]
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "open").mkdir()
    (tmp_path / "open" / "ann.toml").write_text(FILE)
    (tmp_path / "open" / "bob.toml").write_text(FILE.replace('"ann"', '"bob"'))
    return tmp_path


def test_talks_are_named_by_set_writer_and_number(folder):
    talks = load_talks("open", folder)
    assert [talk.id for talk in talks] == ["open/ann/1", "open/ann/2", "open/bob/1", "open/bob/2"]
    assert talks[0].turns == (
        Turn("hello", "greets"),
        Turn("again", "greets again", "follow-up"),
    )
    assert [talk.writer for talk in load_talks("open", folder, "bob")] == ["bob", "bob"]


def test_what_is_not_there_is_refused_with_what_to_do(folder):
    with pytest.raises(HriError, match="copy files of talks there"):
        load_talks("aside", folder)
    with pytest.raises(HriError, match='no writer is "bib" - did you mean "bob"'):
        load_talks("open", folder, "bib")


def test_a_misspelled_key_of_a_turn_is_refused(folder):
    (folder / "open" / "ann.toml").write_text(FILE.replace("kind", "knid"))
    with pytest.raises(AuthoringError, match='unknown key "knid"'):
        load_talks("open", folder)


def test_a_toy_robot_has_46_intents_of_two_sentences():
    talks = load_intents(TOY)
    assert len({talk.turns[0].kind for talk in talks}) == 46
    assert len({talk.turns[0].say for talk in talks}) == len(talks) == 92
