"""After someone was forgotten, the bytes of their name and of what they told are in no file."""

from datetime import datetime
from pathlib import Path

import pytest

from hri.cli.main import main
from hri.conversation.memory import Memory
from hri.conversation.memory_file import Contents, keep, people_file
from hri.conversation.memory_keeper import MemoryKeeper
from hri.conversation.relations import Relation
from hri.conversation.remains import remains
from hri.core import paths
from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.core.stored_data_index import note
from hri.emotion.model_spec import load_emotions
from hri.emotion.persistence import Memory as Feelings, keep as keep_feelings, memory_file
from hri.speech.pronunciation.guesses import Guesses

NOW = datetime(2026, 5, 4, 9, 30)
RELATIONS = {"likes": Relation("likes", "You like {value}.", several=True)}
ANNA, BEN = "Quillobrand", "Wexlafert"


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A user whose own folder has a name that people have, too."""
    home = tmp_path / "anna"
    home.mkdir()
    for name in ("CONFIG", "CACHE", "STATE", "DATA"):
        monkeypatch.delenv(f"XDG_{name}_HOME", raising=False)
    monkeypatch.setenv("HOME", str(home))
    monkeypatch.chdir(home)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    return home


def remember(told: dict[str, list[str]], file: Path | None = None) -> None:
    memory = Memory(RELATIONS)
    for name, values in told.items():
        id = memory.introduce(name, NOW).id
        memory.allow(id, NOW, "word")
        for value in values:
            memory.learn(id, "likes", value, NOW)
            memory.note_asked(id, "likes", value, f"How was your {value} evening, {name}?")
    keep(file or people_file(), Contents(memory.remembered, memory.last_id))


def holding(folder: Path, *words: str) -> set[str]:
    """The names of all files below a folder that hold one of the words."""
    found = set()
    for file in folder.rglob("*"):
        held = file.name.encode() + (file.read_bytes() if file.is_file() else b"")
        if any(word.encode().lower() in held.lower() for word in words):
            found.add(file.name)
    return found


def live(home: Path) -> None:
    """Some days of a robot: it met people, felt, broke, and its user looked and took along."""
    people_file().parent.mkdir(parents=True, mode=0o700)
    people_file().write_text(f"broken: {ANNA} likes klezmer")
    clock = FakeClock()
    keeper = MemoryKeeper(people_file(), RELATIONS, clock, EventBus(clock))
    for name, values in {ANNA: ["klezmer", "jazz"], BEN: ["jazz", f"{ANNA}'s cake"]}.items():
        id = keeper.memory.introduce(name, NOW).id
        keeper.memory.allow(id, NOW, "nod")
        for value in values:
            keeper.memory.learn(id, "likes", value, NOW)
            clock.advance(0.2)
            keeper.poll(clock.now())
    keeper.close()
    remember({ANNA: ["klezmer"]}, home / "elsewhere.db")
    note("people", home / "elsewhere.db")
    for name in ("people.db-wal", "people.db-journal", ".people.db.new-01234567.new"):
        (people_file().parent / name).write_text(f"{ANNA}klezmer")
    dynamics = load_emotions("neutral").dynamics()
    affect = dynamics.feel(dynamics.rest(0.0), "praise", 1.0, 0.0, ANNA)
    keep_feelings(memory_file(), Feelings(affect.imprint, 0.0, 1e9))
    for word in (ANNA.lower(), "klezmer"):
        Guesses()[word]
    assert main(["memory", "export", "mine.json"]) == 0


def test_nothing_of_who_was_forgotten_is_in_any_file_that_the_program_wrote(home: Path) -> None:
    live(home)
    assert holding(home, ANNA) >= {"people.db", "elsewhere.db", "feelings.json", "mine.json"}
    assert holding(home, "klezmer") >= {"people.unusable-1.db", "guessed-words-2.txt"}
    assert main(["forget", ANNA.upper(), "--yes"]) == 0
    assert holding(home, ANNA, "klezmer") == set()
    assert holding(home, "jazz") == {"people.db"}
    assert main(["forget", "--yes"]) == 0
    assert holding(home, BEN, "jazz") == set()


def test_what_is_left_in_any_file_is_said_and_the_status_is_1(
    home: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    remember({ANNA: ["klezmer"], BEN: ["jazz"]})
    journal = paths.state_folder() / "journal.txt"
    journal.write_text("They talked about klezmer.\n")
    assert main(["forget", ANNA]) == 1
    told = capsys.readouterr()
    assert told.err == (
        f'{journal}: it still has "klezmer" - look at it, and delete it if it is about them\n'
    )
    journal.unlink()
    assert main(["forget", BEN]) == 0


FOUND = {
    "a text": b"met quillobrand.\n",
    "a log": b'{"t": 1, "text": "Hello, \\u0051uillobrand"}\n',
    "bytes": b"\0\1QUILLOBRAND\2" + bytes(range(99)),
    "another database": b"SQLite format 3\0 and Quillobrand",
}


@pytest.mark.parametrize("kind", FOUND)
def test_a_name_is_found_in_files_of_any_kind(kind: str) -> None:
    file = paths.state_folder() / "notes"
    file.parent.mkdir(parents=True)
    file.write_bytes(FOUND[kind])
    assert remains([ANNA]) == [(file, ANNA)]
    assert remains([ANNA], spared=[file.parent]) == []
    assert remains([BEN]) == []


def test_a_name_in_the_name_of_a_file_is_found() -> None:
    file = paths.data_folder() / "colors" / "Quillobrand_shirt.color"
    file.parent.mkdir(parents=True)
    file.write_text("color")
    assert remains([ANNA]) == [(file, ANNA)]


NOT_FOUND = {
    "part of a word": ("Ann", "annual channel", {}),
    "another name": ("Ann", "Ann Lee said so", {"Ann Lee": ["jazz"]}),
    "the folder of the user": ("Anna", "{home}/notes.txt", {}),
    "a word of two letters": ("Zed", "so it is", {}),
    "what someone else told, too": ("Zed", "jazz", {"Ben": ["jazz"]}),
}


@pytest.mark.parametrize("kind", NOT_FOUND)
def test_what_is_not_about_them_does_not_count(home: Path, kind: str) -> None:
    name, text, others = NOT_FOUND[kind]
    remember(others)
    (paths.state_folder() / "notes").write_text(text.format(home=home))
    assert remains([name], ["it", "jazz"]) == []


def test_fetched_models_and_settings_are_not_about_what_was_told(home: Path) -> None:
    settings = paths.settings_folder() / "lexicon.txt"
    model = paths.data_folder() / "models" / "words.txt"
    for file in (settings, model):
        file.parent.mkdir(parents=True)
        file.write_text("klezmer K L EH Z M ER\n")
    assert remains([ANNA], ["klezmer"]) == []
    settings.write_text(f"{ANNA} K\n")
    assert remains([ANNA]) == [(settings, ANNA)]


def test_the_search_takes_the_memory_at_its_bytes(home: Path) -> None:
    remember({BEN: ["jazz"]})
    assert remains([ANNA], ["klezmer"]) == []
    assert remains([BEN]) == []  # who is remembered, by what is read
    with people_file().open("ab") as file:
        file.write(b"Quillobrand")
    assert remains([ANNA]) == [(people_file(), ANNA)]
