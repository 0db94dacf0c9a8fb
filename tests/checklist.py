"""Which test proves which row of docs/checklist.md; a plugin of pytest.

A test names its rows with the marker `proves`. `pytest --checklist` writes the document. A run of
the whole suite fails when a row has no test, or the document names other tests.
"""

from __future__ import annotations

import tomllib
from collections import defaultdict
from pathlib import Path

import pytest

ROWS = Path(__file__).with_name("checklist.toml")
DOCUMENT = Path(__file__).parents[1] / "docs" / "checklist.md"
HEAD = """\
# What is proven

The platform is the one of 2003, rebuilt. Each row is a thing that it could do; beside it are the
tests that show ours doing it. `make checklist` writes this page from the markers in the tests.
"""


PROVES = "proves"
"""The property of a report with the rows that its test proves."""

ALL_THAT_PROVE = "not slow"
"""What `make test` chooses: no slow test proves a row."""

TAKEN = {"passed", "skipped"}
"""Outcomes of a test that proves: one that a machine or a checkout skips is taken on trust."""


class Checklist:
    """Collects what the tests of a run prove."""

    def __init__(self, is_writing: bool) -> None:
        self.is_writing = is_writing
        self.tables = tomllib.loads(ROWS.read_text())
        self.rows = {id for table in self.tables.values() for id in table if id != "title"}
        self.claimed: dict[str, set[str]] = defaultdict(set)
        """Rows by test."""
        self.outcomes: dict[str, set[str]] = defaultdict(set)
        """What became of each test, over all its parameters."""
        self.is_whole = False
        self.complaints: list[str] = []

    def pytest_configure(self, config: pytest.Config) -> None:
        if hasattr(config, "workerinput"):
            return  # one of several processes; the one that started it adds them up
        option = config.option
        paths = [str(word).partition("::")[0] for word in config.invocation_params.args]
        is_chosen = (
            option.keyword
            or option.markexpr not in ("", ALL_THAT_PROVE)
            or getattr(option, "lf", False)
            or option.collectonly
        )
        self.is_whole = not is_chosen and not any(Path(path).exists() for path in paths)
        if self.is_writing and not self.is_whole:
            raise pytest.UsageError("--checklist needs the whole suite - leave the rest out")

    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        for item in items:
            rows = {row for mark in item.iter_markers("proves") for row in mark.args}
            if unknown := rows - self.rows:
                raise pytest.UsageError(f"{item.nodeid} proves unknown rows {sorted(unknown)}")
            # With the report it also comes out of the processes that run the tests in parallel.
            item.user_properties.append((PROVES, sorted(rows)))

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        self.claimed[_test_of(report.nodeid)] |= set(dict(report.user_properties)[PROVES])
        if report.when == "call" or not report.passed:
            self.outcomes[_test_of(report.nodeid)].add(report.outcome)

    def pytest_sessionfinish(self, session: pytest.Session, exitstatus: int) -> None:
        if not self.is_whole or exitstatus != pytest.ExitCode.OK:
            return  # what failed would be missing in the document
        if self.is_writing:
            DOCUMENT.write_text(self.document())
        else:
            self._complain()
            if self.complaints:
                session.exitstatus = pytest.ExitCode.TESTS_FAILED

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        for complaint in self.complaints:
            terminalreporter.write_line(f"docs/checklist.md: {complaint}", red=True)

    def _complain(self) -> None:
        due = [id for name, rows in self.tables.items() if name != "later" for id in rows]
        missing = [id for id in due if id != "title" and not self._proofs(id)]
        if missing:
            self.complaints.append(f"no test proves {', '.join(missing)}")
        if not DOCUMENT.is_file() or DOCUMENT.read_text() != self.document():
            self.complaints.append("not up to date - run `make checklist`")

    def document(self) -> str:
        """The page, in Markdown."""
        parts = [HEAD]
        for table in self.tables.values():
            lines = [f"## {table['title']}", "", "| row | what | proven by |", "|---|---|---|"]
            for id, what in table.items():
                if id != "title":
                    proof = _told(self._proofs(id))
                    lines.append(f"| {id} | {what} | {proof} |")
            parts.append("\n".join(lines) + "\n")
        return "\n".join(parts)

    def _proofs(self, id: str) -> list[str]:
        """The tests that prove a row, by their names below `tests/`."""
        tests = [test for test, rows in self.claimed.items() if id in rows]
        return sorted(
            test.removeprefix("tests/")
            for test in tests
            if self.outcomes[test] and self.outcomes[test] <= TAKEN
        )


def _told(tests: list[str]) -> str:
    """The tests by file; their names are sentences."""
    files: dict[str, list[str]] = defaultdict(list)
    for test in tests:
        file, _, name = test.partition("::")
        files[file].append(name.removeprefix("test_").replace("_", " "))
    links = [f"[{file}](../tests/{file}): {'; '.join(names)}" for file, names in files.items()]
    return "<br>".join(links) or "**nothing yet**"


def _test_of(nodeid: str) -> str:
    return nodeid.partition("[")[0]
