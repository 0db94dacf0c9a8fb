"""What a card starts when it is shown: a table of an app.

    [[card]]
    marker = 7
    say = "quiz me"

A card stands for a sentence, which counts as if it had been typed: the app understands, refuses and
answers it as always. The text of a QR code only names its row; it is never a sentence itself.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from hri.core.toml import Table, load_toml
from hri.vision.markers.families import DEFAULT, FAMILIES, QR
from hri.vision.markers.qr_codes import LONGEST, plain

MOST = 500
"""Cards of a table."""
LONGEST_SENTENCE = 200
"""Characters."""


def load_cards(path: Path) -> Mapping[str, str]:
    """The sentence of each card by the name of its marker, such as "apriltag_36h11:7".

    Raises AuthoringError with the place of what is wrong, HriError for a file that cannot be read.
    """
    root, cards = load_toml(path, "table of cards"), dict[str, str]()
    tables = root.array("card")
    root.finish()
    if not 1 <= len(tables) <= MOST:
        raise root.error(None, f"there are {len(tables)} cards", f"write 1 to {MOST}")
    for table in tables:
        name, key = _name(table)
        say = str(table.string("say")).strip()
        table.finish()
        if not (0 < len(say) <= LONGEST_SENTENCE and say.isprintable()):
            what = f"this card has a sentence of {len(say)} characters"
            raise table.error("say", what, f"write one line of 1 to {LONGEST_SENTENCE}")
        if name in cards:
            raise table.error(key, f'another card is "{name}"', "give each marker one row")
        cards[name] = say
    return cards


def _name(table: Table) -> tuple[str, str]:
    """The name of the marker of a row, and the key that has it."""
    if "text" in table:
        text = str(table.string("text"))
        if not text or plain(text) != text:
            remedy = f"write 1 to {LONGEST} printable characters, without spaces at the ends"
            raise table.error("text", "no QR code is read as this text", remedy)
        return f"{QR}:{text}", "text"
    family = str(table.string("family", DEFAULT, among=tuple(FAMILIES)))
    id, last = float(table.number("marker")), FAMILIES[family].count - 1
    if not (id.is_integer() and 0 <= id <= last):
        remedy = f"write a whole number from 0 to {last}"
        raise table.error("marker", f"marker is {id:g}", remedy)
    return f"{family}:{int(id)}", "marker"
