"""`hri grammar parse`: what a sentence means."""

from __future__ import annotations

import argparse
import json

from hri.cli.grammar.check import FILE_HELP
from hri.core import paths
from hri.speech.grammar import load_grammar
from hri.speech.grammar.matching import parse


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE", help=FILE_HELP)
    parser.add_argument("text", help="the sentence, in quotes")
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def run(options: argparse.Namespace) -> int:
    found = parse(load_grammar(paths.find("grammars", options.file)), options.text)
    if options.json:
        answer: dict[str, object] = {"accepted": found is not None}
        if found is not None:
            answer |= {"text": found.text, "rule": found.rule, "tags": dict(found.tags)}
        print(json.dumps(answer))
    elif found is None:
        print(f'"{options.text}" is not in the grammar - see `hri grammar expand`')
    else:
        tags = " ".join(f"{name}={value}" for name, value in found.tags.items())
        print(f"{found.rule}: {found.text}" + (f" {{{tags}}}" if tags else ""))
    return 0 if found is not None else 1
