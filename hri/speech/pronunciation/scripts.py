"""Names in other scripts, spelled in Latin letters: "Анна" is "Anna", "さくら" is "Sakura".

Cyrillic as English newspapers do (BGN/PCGN, without marks), Greek after ELOT 743, kana after
Hepburn, Hangul by the names that Unicode has for its syllables. Chinese characters are not spelled
by letters.
"""

# ruff: noqa: RUF001 - letters of other scripts are meant.
from __future__ import annotations

import re
import unicodedata

_CYRILLIC = (
    "а:a б:b в:v г:g д:d е:e ё:yo ж:zh з:z и:i й:y к:k л:l м:m н:n о:o п:p р:r с:s т:t у:u ф:f "
    "х:kh ц:ts ч:ch ш:sh щ:shch ъ: ы:y ь: э:e ю:yu я:ya є:ye і:i ї:yi ґ:g ў:w ј:y љ:ly њ:ny "
)
_GREEK = (
    "α:a β:v γ:g δ:d ε:e ζ:z η:i θ:th ι:i κ:k λ:l μ:m ν:n ξ:x ο:o π:p ρ:r σ:s ς:s τ:t υ:y φ:f "
    "χ:ch ψ:ps ω:o"
)
_LETTERS = {pair[0]: pair[2:] for pair in (_CYRILLIC + _GREEK).split()}
_PAIRS = {
    "ου": "ou", "αυ": "av", "ευ": "ev", "μπ": "b", "ντ": "nt", "γγ": "ng", "γκ": "gk",
    "ий": "y", "ия": "ia",
}  # fmt: skip
_SYLLABLES = {"si": "shi", "ti": "chi", "tu": "tsu", "hu": "fu", "zi": "ji", "di": "ji", "du": "zu"}
"""Of kana: by their names in Unicode, as Hepburn spells them."""
_OF_SYLLABLES = ("HIRAGANA", "KATAKANA", "HANGUL SYLLABLE")
_SIGN = re.compile(r"[\u0370-\u03ff\u2126µ]|.*[a-zA-Z].*")
"""Signs such as π and units such as μm, which are not words of another script."""
_WORD = re.compile(r"[^\W\d_]+(?:[\u0300-\u036f]+[^\W\d_]+)*")


def in_latin(text: str) -> str:
    """The text with words of other scripts in Latin letters; those that have no letters stay."""
    return text if text.isascii() else _WORD.sub(lambda match: _spelled(match[0]), text)


def _spelled(word: str) -> str:
    word = unicodedata.normalize("NFC", word)
    if _SIGN.fullmatch(word):
        return word
    if word[0].lower() in _LETTERS or _plain(word[0].lower()) in _LETTERS:
        lower = "".join(c if c in _LETTERS else _plain(c) for c in word.lower())
        lower = re.sub("|".join(_PAIRS), lambda match: _PAIRS[match[0]], lower)
        latin = "".join(_LETTERS.get(letter, letter) for letter in lower)
    elif unicodedata.name(word[0], "").startswith(_OF_SYLLABLES):
        latin = _by_syllables(word)
    else:
        return word
    return latin.capitalize() if latin and latin.isascii() else word


def _plain(letter: str) -> str:
    """A letter without accents; nothing for an accent by itself."""
    split = unicodedata.normalize("NFD", letter)
    return "".join(part for part in split if not unicodedata.combining(part))


def _by_syllables(word: str) -> str:
    latin, is_double = "", False
    for letter in word:
        *kind, name = unicodedata.name(letter, "").lower().split() or [""]
        syllable = _SYLLABLES.get(name, name)
        if "small" in kind and name == "tu":
            is_double = True
        elif "small" in kind:  # "ki" and a small "ya" are "kya", "shi" and it "sha"
            begin = latin[:-1]
            latin = begin + (syllable[1:] if begin.endswith(("sh", "ch", "j")) else syllable)
        elif letter != "ー":  # which makes a vowel long
            latin += syllable[:1] * is_double + syllable
            is_double = False
    return latin
