"""`hri grammar pronounce`: shows and corrects pronunciations."""

from __future__ import annotations

import argparse
import json

from hri.cli.terminal.messages import legible
from hri.core.errors import HriError
from hri.core.quoting import escaped, report
from hri.speech.pronunciation.lexicon import (
    Lexicon,
    add_to_lexicon,
    load_lexicon,
    read_phones,
    user_lexicon,
)
from hri.speech.pronunciation.phones import in_ipa

EXAMPLES = """\
examples:
  hri grammar pronounce robot schrodinger        phones, and their source
  hri grammar pronounce schrodinger --add "SH R OW1 D IH0 NG ER0"
                                                 from now on it is heard and spoken this way
  hri grammar pronounce schrodinger --say        speak it
The phones are those of the CMU Pronouncing Dictionary; 1 after a vowel is the stress, which the
voice uses and which may be left out."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("words", type=legible, nargs="+", metavar="WORD")
    parser.add_argument(
        "--add",
        action="append",
        metavar="PHONES",
        help="write these into your lexicon, replacing the word's entries; may be repeated",
    )
    parser.add_argument("--say", action="store_true", help="speak the words")
    parser.add_argument("--json", action="store_true", help="print one JSON object per word")


def run(options: argparse.Namespace) -> int:
    words = [part for word in options.words for part in word.split()]
    if options.add is not None:
        _add(words, options.add)
    lexicon = load_lexicon()
    status = 0
    for word in words:
        try:
            print(_as_json(word, lexicon) if options.json else _told(word, lexicon))
        except HriError as error:
            print(json.dumps({"word": word, "error": str(error)}) if options.json else error)
            status = 1
    return _say(words) or status if options.say else status


def _add(words: list[str], spelt: list[str]) -> None:
    if len(words) != 1:
        each = " and ".join(f'"{word}"' for word in words)
        raise HriError(f"--add is for one word - add {each} one by one")
    path = user_lexicon()
    before = add_to_lexicon(path, words[0], *map(read_phones, spelt))
    for phones in before:
        report(f"no longer {' '.join(phones)}")
    report(f'added to {path} - to undo it, delete the line of "{words[0]}"')


def _told(word: str, lexicon: Lexicon) -> str:
    origin = {"user": f"your lexicon, {user_lexicon()}", "dictionary": "CMU dictionary"}
    variants = lexicon.pronunciations(word)
    lines = [f"{escaped(word)}  {' '.join(phones)}  /{in_ipa(phones)}/" for phones in variants]
    lines[0] += f"  ({origin.get(lexicon.origin(word), 'guessed')})"
    return "\n".join(lines)


def _as_json(word: str, lexicon: Lexicon) -> str:
    variants = lexicon.pronunciations(word)
    told = {
        "word": word,
        "origin": lexicon.origin(word),
        "phones": [" ".join(phones) for phones in variants],
        "ipa": [in_ipa(phones) for phones in variants],
    }
    return json.dumps(told, ensure_ascii=False)


def _say(words: list[str]) -> int:
    """As `hri say` does."""
    from hri.cli.main import main

    return main(["say", ", ".join(words)])
