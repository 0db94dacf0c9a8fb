"""Files of other programs are named as what they are, and files of JSGF never are."""

import time
from pathlib import Path

import pytest

from hri.core.errors import AuthoringError
from hri.speech.grammar import load_grammar, read_grammar
from hri.speech.grammar.formats import LOOKED_AT, format_of

HOUSE = Path(__file__).parents[3]

OTHERS = [
    ("SRGS, a grammar in XML", '<?xml version="1.0"?>\n<!-- lamp -->\n<grammar root="lamp"/>'),
    ("SRGS, a grammar in XML", '<grammar xmlns="http://www.w3.org/2001/06/grammar">\n</grammar>'),
    (
        "SRGS, a grammar in XML",
        '<!DOCTYPE grammar PUBLIC "-//W3C//DTD GRAMMAR 1.0//EN" "a.dtd">\n<grammar version="1.0">',
    ),
    ("SRGS, a grammar in ABNF", "#ABNF 1.0 UTF-8;\nlanguage en;\n$lamp = on | off;\n"),
    ("VoiceXML", '<?xml version="1.0"?>\n<vxml version="2.0"><form/></vxml>'),
    ("XML", '<?xml version="1.0"?>\n<aiml><category/></aiml>'),
    ("Home Assistant", 'language: "en"\nintents:\n  TurnOn:\n    data:\n      - sentences:\n'),
    ("Home Assistant", "# slots\nlists:\n  color:\n    values:\n      - red\n"),
    ("Rasa", 'version: "3.1"\n\nnlu:\n- intent: greet\n  examples: |\n    - hey\n'),
    ("Rasa", "---\ntype: intent\nname: turnOn\nutterances:\n  - lights on\n"),
    ("Rhasspy", "[LightOn]\nturn on the (light | lamp)\n\n[LightOff]\nturn off the light\n"),
    ("Rhasspy", "# Lamps.\n[LightState]\nstates = (on | off)\nturn <states> the light\n"),
    ("GBNF", 'root ::= ("on" | "off")? ws\nws ::= [ \\t]*\n'),
    ("GBNF", '# A lamp.\nroot ::= "on"\n'),
    ("BNF", '<command> ::= turn <state>\n<state> ::= "on" | "off"\n'),
    ("YAML", "trigger:\n  platform: conversation\n"),
    ("EBNF", '(* a lamp *)\nlamp = "on" | "off" ;\n'),
    ("Kaldi", "<eps> 0\n!SIL 1\non 2\n"),
    ("Home Assistant", "conversation:\n  intents:\n    TurnOn:\n      - turn on\n"),
    ("Rasa", "## intent:greet\n- hey\n"),
    ("FSG", "FSG_BEGIN lamp\nNUM_STATES 2\nSTART_STATE 0\nTRANSITION 0 1 1.0 on\nFSG_END\n"),
    ("ARPA", "comment\n\n\\data\\\nngram 1=3\n\n\\1-grams:\n"),
    ("Nuance", ";GSL2.0;\n.Lamp [on off]\n"),
    ("Vosk", '["turn on the light", "turn off", "[unk]"]'),
    ("Vosk", '[\n  "oh one",\n  "two"\n]\n'),
    ("JSON", '{"interactionModel": {"languageModel": {}}}'),
    ("JSON", '[{"intent": "on"}]'),
    ("Python", "from dragonfly import Grammar\n\nclass Lamp:\n    pass\n"),
    ("a list of words", "turn on\nturn off\n\nturn left\n"),
]


@pytest.mark.parametrize(("name", "text"), OTHERS)
def test_a_file_of_another_program_is_named(tmp_path, name, text):
    path = tmp_path / "other.txt"
    path.write_text(f"\n{text}", encoding="utf-8")

    _, errors = read_grammar(path)

    assert len(errors) == 1
    assert str(errors[0]).startswith(f"{path}:2:1: this is ")
    assert name in errors[0].what
    assert errors[0].what.endswith(", not JSGF")
    assert errors[0].remedy
    with pytest.raises(AuthoringError, match="not JSGF"):
        load_grammar(path)


@pytest.mark.parametrize("encoding", ["latin-1", "utf-16", "utf-16-le", "utf-16-be"])
def test_a_file_of_another_program_is_named_in_any_encoding(tmp_path, encoding):
    path = tmp_path / "lamp.grxml"
    path.write_text('<?xml version="1.0"?>\n<grammar><item>éteins</item></grammar>', encoding)

    with pytest.raises(AuthoringError, match="this is SRGS, a grammar in XML, not JSGF"):
        load_grammar(path)


@pytest.mark.parametrize(
    "text",
    [
        "public a = stop;",
        "grammar lamp;\npublic <a> = [please] stop;",
        "// A lamp: on ::= off\ngrammar lamp;\npublic <a> = stop;",
        "<a> = stop | <b>;",
        "public <a> = stop;",
        "import <a.b>;\npublic <a> = <b>;",
        "#JSGF V3.0;\n[a]\n",
        "",
        " \n",
    ],
)
def test_what_may_be_jsgf_is_not_named(text):
    assert format_of(text) is None


def test_files_of_jsgf_are_not_named_without_their_header():
    for path in sorted((HOUSE / "grammars").glob("*.jsgf")):
        assert format_of(path.read_text().partition(";")[2]) is None, path


@pytest.mark.parametrize(
    "piece", ["<!-- ", "<!-- --> ", '"a" ', "# # ", "\n", "[a", "a ", "a\n", "\\"]
)
def test_no_file_keeps_it_looking(piece):
    text = (piece * LOOKED_AT)[:LOOKED_AT] + "\x00"
    begin = time.process_time()
    format_of(text)
    format_of("<?xml" + text)
    format_of("[" + text)
    assert time.process_time() - begin < 1.0
