"""A grammar of another language is recognized; English with foreign names is English."""

import pytest

from hri.core.errors import HriError
from hri.speech.grammar import load_grammar
from hri.speech.language import foreign, require_english

FOREIGN = {
    "French": ["éteins la lumière du salon", "bonjour robot", "allume la lampe | ouvre la porte"],
    "German": ["schalte das licht ein | mach das licht an", "geh nach links", "öffne die tür"],
    "Spanish": ["enciende la luz de la cocina", "gira a la izquierda", "hola robot"],
    "Italian": ["accendi la luce | gira a sinistra", "vai avanti"],
    "Portuguese": ["acende a luz da sala", "vira à esquerda"],
    "Dutch": ["doe het licht aan", "ga naar links"],
    "Danish": ["tænd lyset i stuen", "drej til højre | stop"],
    "Norwegian": ["slå på lyset"],
    "Swedish": ["tänd lampan", "gå fram"],
    "Finnish": ["sytytä valot"],
    "Polish": ["włącz światło"],
    "Czech": ["zapni světlo v kuchyni"],
    "Turkish": ["ışığı aç"],
    "Vietnamese": ["bật đèn lên"],
    "Russian": ["включи свет", "поезжай вперёд | стоп"],
    "Ukrainian": ["увімкни світло"],
    "Greek": ["άναψε το φως"],
    "Chinese": ["打开 灯", "停止"],
    "Japanese": ["電気 を つけて"],
    "Korean": ["불 켜"],
    "Hindi": ["बत्ती जलाओ"],
    "Arabic": ["أضئ المصباح"],
}
ENGLISH = [
    "call (José | Zoë | Renée García | Oscar de la Renta | Grzegorz Brzęczyszczykiewicz)",
    "one café please",
    "jalapeño | crème brûlée | tea | coffee",
    "play (la vie en rose | für elise | despacito)",
    "say (bonjour | guten tag | hola)",
    "die hard | main street | pour me a pint",
    "zorblax",
    "stop",
    "hello zürich",
]


@pytest.fixture
def grammar(tmp_path):
    def grammar(words, header="#JSGF V1.0;"):
        path = tmp_path / "t.jsgf"
        path.write_text(f"{header}\ngrammar t;\npublic <a> = {words};\n", encoding="utf-8")
        return load_grammar(path)

    return grammar


@pytest.mark.parametrize(("name", "words"), [(n, w) for n, all in FOREIGN.items() for w in all])
def test_a_language_is_known_by_its_words(grammar, name, words):
    assert foreign(grammar(words)) == name


@pytest.mark.parametrize("words", ENGLISH)
def test_english_is_english_with_names_and_words_of_others(grammar, words):
    assert foreign(grammar(words)) == ""


@pytest.mark.parametrize(
    ("header", "name"),
    [
        ("#JSGF V1.0 UTF-8 fr;", "French"),
        ("#JSGF V1.0 UTF-8 fr_CA;", "French"),
        ("#JSGF V1.0 de;", "German"),
        ("#JSGF V1.0 UTF-8 xh;", 'the language "xh"'),
        ("#JSGF V1.0 UTF-8 fra;", "French"),
        ("#JSGF V1.0 UTF-8 German;", "German"),
        ("#JSGF V1.0 UTF-8 en-GB;", ""),
        ("#JSGF V1.0 UTF-8 us;", ""),
    ],
)
def test_a_language_is_known_by_the_header(grammar, header, name):
    assert foreign(grammar("stop now", header)) == name


def test_the_shipped_grammars_are_english():
    assert foreign(load_grammar("companion")) == ""
    assert foreign(load_grammar("thing")) == ""


def test_an_engine_of_english_takes_no_other_language(grammar):
    told = []
    require_english(grammar("stop now"), told.append)
    with pytest.raises(HriError, match=r"t: this grammar is in French, and only Vosk .* - get a"):
        require_english(grammar("stop", "#JSGF V1.0 UTF-8 fr;"), told.append)
    with pytest.raises(HriError, match=r"in Korean.* - `hri models fetch vosk-model-small-ko"):
        require_english(grammar("불 켜"), told.append)
    assert told == []


def test_who_says_that_it_is_english_is_believed_and_told(grammar):
    told = []
    require_english(grammar("éteins la lumière", "#JSGF V1.0 UTF-8 en;"), told.append)
    (line,) = told
    assert "this grammar is in French" in line
