"""The companion takes a printed card that it is shown, as the simulated camera sees it."""

from hri.core import FakeClock, paths
from hri.hal.resource import Description
from hri.robot import Robot
from hri.speech.behaviors import Listener
from hri.speech.grammar import load_grammar, parse
from hri.testing import live_for
from hri.vision.markers.card_table import load_cards

FOLDER = paths.house() / "apps" / "companion" / "skills" / "printed_cards"
ROOM = '[robot]\nstart = [0, 0]\n[[object]]\nname = "card"\nat = [0.8, 0.0]\nmarker = {}\n'


def told(tmp_path, marker):
    """What is heard and said after someone asks it to look at a card of the room."""
    path = tmp_path / "room.toml"
    path.write_text(ROOM.format(marker))
    size = {"width": "640", "height": "480"}
    devices = (
        Description("world", "Hri.SimulatedWorld", {"file": str(path)}),
        Description("screen", "Hri.BlankScreen"),
        Description("recognizer", "Hri.Typed"),
        Description("microphone", "Hri.MemoryMicrophone"),
        Description("camera", "Hri.SimulatedCamera", size, bus="world"),
    )
    robot = Robot("companion", "simulated", clock=FakeClock(), devices=devices, seed=1)

    async def ask(context):
        await context.clock.sleep(1.0)
        context.behavior(Listener).type_line("look at my card")

    events = live_for(robot, 12.0, *robot.app.load_tasks(), ask)
    return [
        event.properties["text"]
        for event in events
        if event.name in ("speech.heard", "speech.said")
    ]


def test_a_card_that_is_shown_starts_its_sentence_once(tmp_path):
    words = told(tmp_path, 4)
    assert words[:2] == ["look at my card", "Show me your card."]
    assert words.count("roll two dice") == 1
    assert any("rolled" in text for text in words[3:])


def test_a_card_without_a_row_starts_nothing(tmp_path):
    words = told(tmp_path, 99)
    assert words[2] == "I don't know that card."
    assert "roll two dice" not in words


def test_every_sentence_of_the_table_is_a_command():
    known = [load_grammar(path) for path in (paths.house() / "grammars").glob("[cs]*.jsgf")]
    known += [load_grammar(path) for path in FOLDER.parent.glob("*/grammar.jsgf")]
    for sentence in load_cards(FOLDER / "cards.toml").values():
        assert any(parse(grammar, sentence) for grammar in known), sentence
