"""Finds phrases that plain American English does not use: `python .ci/prose.py`, part of `make check`.

Reads docstrings, comments, messages and help texts of Python files, and Markdown without its code.
Prints `file:line:column: "phrase" - write ...` for each, and exits with 1 if there are any.
"""

import io
import re
import sys
import tokenize
from collections.abc import Iterator
from pathlib import Path

READ = ("README.md", "CONTRIBUTING.md", "docs", "hri", "apps", "benchmarks", ".ci")
GENERATED = {Path("docs/checklist.md")}

# What not to write, as a regular expression in which a space is any white space; what to write.
TICS = {
    r"anew": "again, or a verb: restart, redraw, reload",
    r"in place of": "instead of",
    r"mend(s|ed|ing)?": "fix",
    r"somebody(?! comes)": "someone, or a person",
    r"anybody|everybody": "anyone, everyone",
    r"(is|are|was|were) no(?! (longer|more|one\b))": "is not a, has no, there is no",
    r"(is|are|was|were) none": "is not one, or there is none",
    r"(tell|told|telling|tells) (of|by|from)": "report, distinguish",
    r"tells": "reports, says, shows",
    r"of (its|their|one's) own": "its own X, a separate X, or nothing",
    r"so (many|much) (?!that|as|more|better|less|longer|later|faster)": "the number of, this many",
    r"nothing but": "only",
    r"is (there|here) already|are (there|here) already": "already exists",
    r"the house|house's": "built-in",
    r"what (is|was) (heard|said|seen|felt|told|given|kept|shown|asked|written|read|there|wrong|played)": (
        "name the thing: the words, the picture, the value"
    ),
}
ROWS = [rf"(?P<row{i}>\b(?:{tic})\b)".replace(" ", r"\s+") for i, tic in enumerate(TICS)]
PHRASE = re.compile("|".join(ROWS), re.IGNORECASE)
ADVICE = {f"row{i}": advice for i, advice in enumerate(TICS.values())}
STRINGS = {tokenize.STRING, tokenize.COMMENT, getattr(tokenize, "FSTRING_MIDDLE", tokenize.STRING)}


def python_prose(text: str) -> Iterator[tuple[int, int, str]]:
    """Line, column and text of each comment and each string with a space in it."""
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type in STRINGS and " " in token.string:
            yield *token.start, token.string


def markdown_prose(text: str) -> Iterator[tuple[int, int, str]]:
    """The text with its code blanked."""
    code = r"^```.*?^```|^    .*?$|`[^`\n]*(?:\n[^`\n]+)?`"
    yield 1, 0, re.sub(code, lambda m: re.sub(r"[^\n]", "_", m[0]), text, flags=re.S | re.M)


def found(path: Path) -> Iterator[str]:
    """A line for each phrase of the file at `path`."""
    parts = markdown_prose if path.suffix == ".md" else python_prose
    for line, column, text in parts(path.read_text(encoding="utf-8")):
        for match in PHRASE.finditer(text):
            before = text[: match.start()]
            rows = before.count("\n")
            place = len(before) - before.rfind("\n") if rows else column + len(before) + 1
            phrase = " ".join(match[0].split())
            advice = ADVICE[match.lastgroup or ""]
            yield f'{path}:{line + rows}:{place}: "{phrase}" - write instead: {advice}'


def main() -> int:
    """Exit status 1 if a phrase was found."""
    named = [Path(name) for name in sys.argv[1:] or READ]
    files = [f for n in named for f in ([n] if n.is_file() else sorted(n.rglob("*.[pm][yd]")))]
    lines = [line for file in files if file not in GENERATED for line in found(file)]
    print(*lines, sep="\n", end="\n" if lines else "")
    return bool(lines)


if __name__ == "__main__":
    sys.exit(main())
