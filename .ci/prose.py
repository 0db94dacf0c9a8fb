"""Finds phrases that plain American English does without; `make check` runs it.

Reads comments, docstrings, messages and help texts of Python files, and Markdown outside of code.
Prints `file:line:column: "phrase" - write instead: ...`; exit status 1 if it found any.
"""

import io
import re
import sys
import tokenize
from collections.abc import Iterator
from pathlib import Path

PAGES = ("README.md", "CONTRIBUTING.md", "AGENTS.md", "SECURITY.md", "CHANGELOG.md")
FOLDERS = (*PAGES, "docs", "hri", "apps", "benchmarks")
LEFT_OUT = ("docs/checklist.md",)

# Regular expressions, in which a space is any white space, and what to write instead.
TICS = {
    r"anew": "again, or a verb such as restart, redraw, reload",
    r"in place of": "instead of",
    r"mend(s|ed|ing)?": "fix",
    r"(any|every|some)body(?! (comes|pass|pressed)\b)": "anyone, everyone, someone, a person",
    r"(?<!there\s)(is|are|was|were) no (?!longer|more|such)\w": "is not a, has no, there is no",
    r"nothing but": "only",
    r"(?<!there\s)(is|are|was|were) none\b(?! of)": "is not a, is invalid",
    r"tells\b": "reports, says, shows, distinguishes",
    r"of (its|their|one's) own\b": "its own X, a separate X",
    r"what (is|was) felt\b": "feelings",
    r"so (many|much) (?!that|as|more|better|less|longer)": "this many, a number of",
    r"told (by|from)\b": "reported by, distinguished from",
    r"(is|are) t?here already": "already exists",
    r"(of |in |from |by )the house\b|the house's": "built-in",
}

# In the code two such clauses in a sentence are a riddle: there nouns must do.
RIDDLE = r"(what|whatever|whoever) (?:[^.;:!?\"|]|[.:](?! ))*? (what|whatever|whoever)"
NOUNS = "nouns, such as: the mistake and its remedy"
OF_CODE = ("hri", "apps")

ROWS = [rf"(?P<row{number}>\b(?:{tic}))" for number, tic in enumerate(TICS)]
PHRASE = re.compile("|".join(ROWS).replace(" ", r"\s+"), re.IGNORECASE)
REMEDIES = {f"row{number}": remedy for number, remedy in enumerate(TICS.values())}
HEADLESS = re.compile(rf"\b(?:{RIDDLE})\b".replace(" ", r"\s+"), re.IGNORECASE)
PROSE = {"STRING", "FSTRING_MIDDLE", "COMMENT"}
CODE = re.compile(r"^```.*?^```|^    .*?$|`[^`]+`", re.DOTALL | re.MULTILINE)


def passages(path: Path) -> Iterator[tuple[int, int, str]]:
    """Line, column and text of each passage of prose."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".md":
        yield 1, 0, CODE.sub(lambda code: re.sub(r"[^\n]", "_", code[0]), text)
        return
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if tokenize.tok_name[token.type] in PROSE and " " in token.string:
            yield *token.start, token.string


def findings(path: Path) -> Iterator[str]:
    """A line for each phrase in a file."""
    for line, column, text in passages(path):
        for match in PHRASE.finditer(text):
            yield _finding(path, line, column, text, match, REMEDIES[match.lastgroup or ""])
        if path.suffix == ".py" and path.parts[0] in OF_CODE:
            for match in HEADLESS.finditer(text):
                yield _finding(path, line, column, text, match, NOUNS)


def _finding(
    path: Path, line: int, column: int, text: str, match: re.Match[str], remedy: str
) -> str:
    *above, before = text[: match.start()].split("\n")
    place = f"{path}:{line + len(above)}:{len(before) + 1 + (0 if above else column)}"
    return f'{place}: "{" ".join(match[0].split())}" - write instead: {remedy}'


def main() -> int:
    """Exit status 1 if there are findings in the given files and folders, or in all."""
    given = [Path(name) for name in sys.argv[1:] or FOLDERS]
    files = [file for root in given for file in ([root], sorted(root.rglob("*")))[root.is_dir()]]
    texts = [file for file in files if file.suffix in {".py", ".md"}]
    texts = [file for file in texts if "node_modules" not in file.parts]
    found = [
        line for file in texts if not str(file).startswith(LEFT_OUT) for line in findings(file)
    ]
    print("\n".join(found), end="\n" * bool(found))
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
