"""Which language a grammar is in, and that recognizers of English take no other.

Its header may name one. Where it does not, words tell: those that are frequent in a language and
not English, and those with letters of it. A sentence votes for the language that most of its words
speak for, so that foreign names in English sentences make no foreign grammar.
"""

from __future__ import annotations

import unicodedata
from collections import Counter
from collections.abc import Callable, Collection
from functools import cache
from pathlib import Path
from typing import NamedTuple

from hri.core.errors import HriError
from hri.hal.recognizer import Grammar
from hri.speech.engine_models import DOWNLOADS
from hri.speech.pronunciation.spelling import vocabulary
from hri.speech.recognizers.ctc.rival_words import common_words

ENGLISH = '"#JSGF V1.0 UTF-8 en;"'
MOST_SENTENCES = 200
"""Sentences of a grammar that vote."""

SCRIPTS = {
    "CJK": "Chinese", "HIRAGANA": "Japanese", "KATAKANA": "Japanese", "HANGUL": "Korean",
    "CYRILLIC": "Russian", "GREEK": "Greek", "ARABIC": "Arabic", "HEBREW": "Hebrew",
    "DEVANAGARI": "Hindi", "THAI": "Thai", "GEORGIAN": "Georgian", "ARMENIAN": "Armenian",
    "BENGALI": "Bengali", "GUJARATI": "Gujarati", "TAMIL": "Tamil", "TELUGU": "Telugu",
}  # fmt: skip
"""The language that a script most often means, by how Unicode names its letters."""


_ALSO = {"CYRILLIC": ("Ukrainian",), "CJK": ("Japanese",)}
"""Languages that share a script; their own letters tell them apart."""
_UKRAINIAN = frozenset("іїєґ")


class Language(NamedTuple):
    """A language that is written in Latin letters."""

    name: str
    letters: str
    """Those beyond a to z."""
    words: frozenset[str]
    """Frequent ones, and some that robots are told."""


def _read(path: Path) -> dict[str, Language]:
    """The languages of a file, by their ISO 639-1 codes."""
    found: dict[str, Language] = {}
    code = ""
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith(" "):
            known = found[code]
            found[code] = known._replace(words=known.words.union(line.split()))
        elif not line.startswith("#"):
            code, name, letters = line.split()
            found[code] = Language(name, letters, frozenset())
    return found


LATIN = _read(Path(__file__).with_name("languages.txt"))
"""Languages in Latin letters, by their ISO 639-1 codes."""
NAMES = {
    **{code: language.name for code, language in LATIN.items()},
    "zh": "Chinese", "ja": "Japanese", "ko": "Korean", "ru": "Russian", "uk": "Ukrainian",
    "bg": "Bulgarian", "el": "Greek", "ar": "Arabic", "he": "Hebrew", "fa": "Persian",
    "hi": "Hindi", "th": "Thai", "sk": "Slovak", "sl": "Slovenian", "et": "Estonian",
    "lv": "Latvian", "lt": "Lithuanian", "id": "Indonesian", "kk": "Kazakh", "uz": "Uzbek",
    "fra": "French", "fre": "French", "deu": "German", "ger": "German", "spa": "Spanish",
    "ita": "Italian", "por": "Portuguese", "nld": "Dutch", "dan": "Danish", "nor": "Norwegian",
    "swe": "Swedish", "fin": "Finnish", "pol": "Polish", "ces": "Czech", "tur": "Turkish",
    "rus": "Russian", "ukr": "Ukrainian", "zho": "Chinese", "cmn": "Chinese", "jpn": "Japanese",
    "kor": "Korean", "ell": "Greek", "ara": "Arabic", "heb": "Hebrew", "hin": "Hindi",
    "ka": "Georgian", "nb": "Norwegian", "nn": "Norwegian", "ga": "Irish", "cy": "Welsh",
}  # fmt: skip
_ENGLISH_CODES = ("", "en", "eng", "english", "us", "gb", "und", "c", "posix")
"""What headers say for English, or for nothing."""
OTHER = "another language"
_EVERYWHERE = frozenset(("robot", "stop", "ok", "okay", "hotel", "radio", "taxi", "pizza", "tv"))
"""Words of many languages, which say nothing."""


def foreign(grammar: Grammar) -> str:
    """The name of the language that a grammar is in; empty for English."""
    return of_header(grammar.locale) or of_words(grammar)


def complaint(grammar: Grammar, language: str) -> tuple[str, str]:
    """The problem with hearing a grammar of a language as English, and its remedy."""
    model = next((one.name for one in DOWNLOADS if one.about == f"Vosk, {language}"), "")
    of_it = "it" if language == OTHER else language
    get = f"`hri models fetch {model}`" if model else f"get a Vosk model of {of_it}"
    remedy = f"{get} and name it with --model DIR or HRI_VOSK_MODEL (docs/speech.md)"
    if not says_english(grammar):
        remedy += f", or write {ENGLISH} if it is English"
    return (
        f"this grammar is in {language}, and only Vosk hears other languages than English",
        remedy,
    )


def require_english(grammar: Grammar, notice: Callable[[str], object]) -> None:
    """Refuse a grammar of another language, for an engine that knows English sounds.

    Where its header says that it is English and its words do not, that is only a notice. Raises
    HriError.
    """
    if language := foreign(grammar):
        told = f"{grammar.name}: {' - '.join(complaint(grammar, language))}"
        if not says_english(grammar):
            raise HriError(told)
        notice(told)


def is_other_language(grammar: Grammar) -> bool:
    """Whether a grammar is in another language than English, and does not say that it is not."""
    return not says_english(grammar) and bool(foreign(grammar))


def says_english(grammar: Grammar) -> bool:
    """Whether its header names English, whatever its words are."""
    return bool(grammar.locale) and not of_header(grammar.locale)


def of_header(locale: str) -> str:
    """The name of the language of a locale such as "fr-CA"; empty for English, or none."""
    code = locale.replace("_", "-").partition("-")[0].lower()
    if code in _ENGLISH_CODES:
        return ""
    named = code.capitalize() if code.capitalize() in NAMES.values() else ""
    return NAMES.get(code) or named or f'the language "{locale}"'


def of_words(grammar: Grammar) -> str:
    """The language other than English that most sentences are in; empty when there is none."""
    if not any(map(_languages_of, grammar.words())):
        return ""
    votes = Counter(map(_voted, grammar.sample(MOST_SENTENCES)))
    english = votes.pop("English", 0)
    del votes[""]
    return votes.most_common(1)[0][0] if votes.total() > english else ""


def _voted(sentence: str) -> str:
    """The language of a sentence; empty when its words do not say."""
    words = [word for word in sentence.split() if word not in _EVERYWHERE]
    spoken = Counter(name for word in words for name in _languages_of(word))
    language = max(spoken, key=lambda name: spoken[name], default="")
    both = next((known.words for known in LATIN.values() if known.name == language), frozenset())
    english = sum(word in _english() and word not in both for word in words)
    if spoken[language] > english:
        return language
    return "English" if english else ""


@cache
def _english() -> frozenset[str]:
    """Ordinary words of English, short ones too."""
    return vocabulary().union(common_words())


def _languages_of(word: str) -> Collection[str]:
    """The languages that a word speaks for; none for one that is English as well."""
    if word.isascii():
        if word in _english():
            return ()
        return [known.name for known in LATIN.values() if word in known.words]
    letters = {letter for letter in word if letter.isalpha() and not letter.isascii()}
    if letters & _UKRAINIAN:
        return ("Ukrainian",)
    scripts = {unicodedata.name(letter, "").partition(" ")[0] for letter in letters}
    if known_scripts := scripts & SCRIPTS.keys():
        script = min(known_scripts - {"CJK"} or known_scripts)  # Japanese has signs of Chinese
        return (SCRIPTS[script], *_ALSO.get(script, ()))
    fitting = [known for known in LATIN.values() if letters and letters.issubset(known.letters)]
    sure = [known.name for known in fitting if word in known.words]
    return sure or [known.name for known in fitting] or ((OTHER,) if letters else ())
