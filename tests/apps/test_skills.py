"""Skills of the companion: their pages hold, and a broken one does not take it with it."""

import pytest

from hri.core import FakeClock, paths
from hri.robot import Robot
from hri.speech.behaviors import Listener
from hri.testing.dialogues import TYPED, played, read_dialogues
from tests.apps.test_manners import questions, typed
from tests.robot.skills import skill, with_rule

SKILLS = paths.house() / "apps" / "companion" / "skills"
PAGES = sorted(SKILLS.glob("*/README.md"))
WAVE = "#JSGF V1.0;\ngrammar g;\npublic <{0}> = wave {0};\n"


def robot(devices=TYPED, **more):
    return Robot("companion", "simulated", clock=FakeClock(), devices=devices, seed=1, **more)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.parent.name)
def test_the_dialogues_of_each_page_go_as_shown(page):
    dialogues = read_dialogues(page)
    assert dialogues
    for dialogue in dialogues:
        assert dialogue.mistake(played(robot(), dialogue)) == ""


def test_a_skill_answers_before_small_talk_and_behind_commands(tmp_path, monkeypatch):
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    with_rule(tmp_path, "coin", "own_coin", "flip a coin", 'say = "Heads, said the skill."')
    with_rule(tmp_path, "halt", "own_stop", "stop", 'say = "I go on!"')
    visit = typed(8, {1.0: "please flip a coin", 4.0: "stop"})
    assert visit.said()[0] == "Heads, said the skill."
    assert "I go on!" not in visit.said()
    assert [event.properties["rule"] for event in visit.named("speech.heard")] == [
        "own_coin",
        "stop",
    ]


def test_what_a_skill_says_may_be_asked_for_alone_by_its_own_grammar(tmp_path, monkeypatch):
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    ask = (
        "from hri.robot.verbs import ask_value\n"
        "async def cook(context, dish=''):\n"
        "    answer = await ask_value(context, 'cook_it', 'dish')\n"
        "    return f\"I cook {answer.tags['dish']}.\"\n"
    )
    words = "cook (soup {dish=soup} | rice {dish=rice})"
    with_rule(tmp_path, "cook", "cook_it", words, 'action = "cook"', tasks=ask)
    visit = typed(9, {1.0: "cook soup", 5.0: "rice please"})
    assert visit.said() == ["Which dish?", "I cook rice."]


def broken(folder):
    """Skills that are wrong in many ways, each of which the companion must survive."""
    ways = {
        "toml": {"skill": "about ="},
        "key": {"skill": "abuot = 'A'"},
        "task": {"skill": "tasks = ['nothing']"},
        "task_needs": {"skill": "tasks = ['go']", "tasks": "async def go(context, where): ...\n"},
        "reaction": {"skill": "[on]\n'a.b' = 'nothing'"},
        "reaction_needs": {
            "skill": "[on]\n'a.b' = 'go'",
            "tasks": "async def go(context, x): ...\n",
        },
        "network": {"skill": "networks = ['nowhere.xml']"},
        "python": {"tasks": "def\n"},
        "imports": {"tasks": "import no_such_module\n"},
        "raises": {"tasks": "1 / 0\n"},
        "exits": {"tasks": "raise SystemExit\n"},
        "empty": {"grammar": ""},
        "not_jsgf": {"grammar": "hello"},
        "open_bracket": {"grammar": "#JSGF V1.0;\ngrammar g;\npublic <open_it> = (wave;\n"},
        "no_rule": {"grammar": "#JSGF V1.0;\ngrammar g;\npublic <no_rule> = <nothing>;\n"},
        "no_import": {
            "grammar": "#JSGF V1.0;\ngrammar g;\nimport <no.way>;\npublic <no_way> = a b;\n"
        },
        "endless": {"grammar": "#JSGF V1.0;\ngrammar g;\npublic <endless> = wave <endless>;\n"},
        "twice": {
            "grammar": "#JSGF V1.0;\ngrammar g;\npublic <twice> = a b;\npublic <twice> = b a;\n"
        },
        "taken_rule": {"grammar": WAVE.format("greet"), "replies": "[reply.greet]\n"},
        "taken_stop": {"grammar": WAVE.format("stop"), "replies": "[reply.stop]\n"},
        "no_replies": {"grammar": WAVE.format("no_replies")},
        "gap": {"grammar": WAVE.format("gap"), "replies": "[reply.other]\n"},
        "replies_toml": {"grammar": WAVE.format("replies_toml"), "replies": "[reply"},
        "reply_key": {"grammar": WAVE.format("rk"), "replies": "[reply.rk]\nsya = 'A'\n"},
        "reply_type": {"grammar": WAVE.format("rt"), "replies": "[reply.rt]\nsay = 3\n"},
        "brace": {"grammar": WAVE.format("br"), "replies": "[reply.br]\nsay = '{nothing}'\n"},
        "open_brace": {"grammar": WAVE.format("ob"), "replies": "[reply.ob]\nsay = '{'\n"},
        "face": {"grammar": WAVE.format("fa"), "replies": "[reply.fa]\nshow = 'grin'\n"},
        "gesture": {"grammar": WAVE.format("ge"), "replies": "[reply.ge]\ngesture = 'fly'\n"},
        "feeling": {"grammar": WAVE.format("fe"), "replies": "[reply.fe]\nfeel = 'x'\n"},
        "action": {"grammar": WAVE.format("ac"), "replies": "[reply.ac]\naction = 'x'\n"},
        "event": {"grammar": WAVE.format("ev"), "replies": "[reply.ev]\nevent = 'x'\n"},
        "tag": {
            "grammar": "#JSGF V1.0;\ngrammar g;\npublic <ta> = wave twice {n=2};\n",
            "replies": "[reply.ta]\naction = 'go'\n",
            "tasks": "async def go(context, m=1): ...\n",
        },
        "lacking_tag": {
            "grammar": "#JSGF V1.0;\ngrammar g;\npublic <la> = wave long;\n",
            "replies": "[reply.la]\naction = 'go'\n",
            "tasks": "async def go(context, m): ...\n",
        },
        "also": {"grammar": WAVE.format("al"), "replies": "also = ['x.toml']\n[reply.al]\n"},
        "outside": {"grammar": WAVE.format("ou"), "replies": "also = ['../x.toml']\n[reply.ou]\n"},
        "form": {"grammar": WAVE.format("fo"), "replies": "[reply.fo]\nform = 'x'\n"},
        "form_toml": {"forms": "[form"},
        "form_without_slot": {"grammar": WAVE.format("fs"), "forms": "[form.grammar]\n"},
        "form_without_grammar": {"forms": "[form.x]\n[[form.x.slot]]\nname = 'a'\nask = 'A?'\n"},
        "form_key": {"forms": "[forms.x]\n"},
        "companion": {},  # the name of the app
        "deep": {"skill": "a." * 50 + "b = 1"},
        "unasked": {"replies": "[unasked]\nnothing_like_it = 'A'\n"},
        "question": {"replies": "[[question]]\nask = 3\n"},
    }
    for name, files in ways.items():
        skill(folder, name, **files)
    (skill(folder, "not_text") / "skill.toml").write_bytes(b"\xff\xfe\x00")
    (skill(folder, "binary_grammar") / "grammar.jsgf").write_bytes(bytes(range(256)) * 40)
    (skill(folder, "huge") / "skill.toml").write_bytes(b"#" * 2_000_000)
    place = skill(folder, "grammar_folder")
    (place / "tasks.py").write_text("raise KeyError('x' * 100_000)\n")
    loop = skill(folder, "imports_itself")
    (loop / "grammar.jsgf").write_text(
        "#JSGF V1.0;\ngrammar g;\nimport <g.*>;\npublic <x> = <y>;\n"
    )
    return {*ways, "not_text", "binary_grammar", "huge", "grammar_folder", "imports_itself"}


@pytest.mark.slow
def test_skills_that_are_broken_in_all_ways_are_off_with_a_line_and_the_companion_goes_on(
    tmp_path, monkeypatch
):
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    names, lines = broken(tmp_path), []
    with_rule(tmp_path, "whole", "wave_well", "wave well", 'say = "Like this."')
    started = robot(notice=lines.append)
    assert {one.name for one in started.app.off} == names
    assert "whole" in {one.name for one in started.app.all_skills()}
    told = [line for line in lines if line.startswith("the skill ")]
    assert len(told) == len(names)
    assert not [line for line in told if "\n" in line or len(line) > 1000]
    assert "wave_well" in started.context.behavior(Listener).read_grammar().public_rules
    visit = typed(8, {1.0: "wave well", 4.0: "hello"})
    assert visit.said()[0] == "Like this."
    assert len(visit.said()) == 2


def test_what_skills_draw_by_lot_is_repeated_by_the_seed():
    def drawn(seed):
        robot = Robot("companion", "simulated", clock=FakeClock(), devices=TYPED, seed=seed)
        return [robot.context.chance.randint(1, 6) for _ in range(20)]

    assert drawn(1) == drawn(1) != drawn(2)


@pytest.mark.parametrize("line", ["tell me a story about a dragon", "look at my card"])
def test_stop_ends_what_a_skill_does_in_several_steps(line):
    visit = typed(20.0, {1.0: line, 4.0: "stop"})
    late = [event.properties["text"] for event in visit.named("speech.said") if event.time > 4.0]
    assert [text for text in late if text not in questions(visit)] == ["I stopped."]
