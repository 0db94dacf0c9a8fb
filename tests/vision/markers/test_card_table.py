"""Tables of cards: what each starts, and mistakes with their places."""

import pytest

from hri.cli.main import main
from hri.core.errors import AuthoringError
from hri.vision.markers.card_table import load_cards


@pytest.fixture
def table(tmp_path):
    def write(text):
        path = tmp_path / "cards.toml"
        path.write_text(text)
        return path

    return write


def test_each_card_has_its_sentence(table):
    first = '[[card]]\nmarker = 1\nsay = "quiz me"\n'
    more = '[[card]]\nfamily = "aruco_4x4_50"\nmarker = 1\nsay = "stop"\n'
    code = '[[card]]\ntext = "go"\nsay = "tell me a joke"\n'
    assert load_cards(table(first + more + code)) == {
        "apriltag_36h11:1": "quiz me",
        "aruco_4x4_50:1": "stop",
        "qr:go": "tell me a joke",
    }


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "there are 0 cards"),
        ('[[card]]\nmarker = 1\nsay = ""\n', r":3:1: this card has a sentence of 0"),
        ('[[card]]\nmarker = 587\nsay = "a"\n', r":2:1: marker is 587 - write .* 0 to 586"),
        ('[[card]]\nmarker = 1.5\nsay = "a"\n', r":2:1: marker is 1.5"),
        ('[[card]]\nfamily = "aruco"\nmarker = 1\nsay = "a"\n', r":2:1: family is .*apriltag"),
        ('[[card]]\nmarker = 1\nsay = "a"\n' * 2, r':5:1: another card is "apriltag_36h11:1"'),
        ('[[card]]\ntext = " a"\nsay = "a"\n', r":2:1: no QR code is read as this text"),
        ('[[card]]\nmarker = 1\nsays = "a"\n', r"say"),
        ('[[card]]\ntext = "a"\nmarker = 1\nsay = "a"\n', r":3:1: .*marker"),
    ],
)
def test_a_mistake_has_its_place_and_remedy(table, text, message):
    with pytest.raises(AuthoringError, match=message):
        load_cards(table(text))


def test_the_command_lists_what_cards_start(table, capsys):
    path = table('[[card]]\nmarker = 1\nsay = "quiz me"\n')
    assert main(["marker", "check", str(path)]) == 0
    assert capsys.readouterr().out == "apriltag_36h11:1: quiz me\n"
    path = table('[[card]]\nmarker = 999\nsay = "quiz me"\n')
    assert main(["marker", "check", str(path)]) != 0
    assert "cards.toml:2:1: marker is 999" in capsys.readouterr().err
