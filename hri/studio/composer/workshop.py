"""The process in which networks are checked and behaviors looked up: it imports what users write.

A line of JSON is a question, `[name, arguments]`, and another is the answer, `{"result"}` or
`{"error"}`. A workshop that hangs is ended, and started again when it is asked next; so is one
whose schemas or Python files have changed, since what is imported stays as it was.
"""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import trio

from hri.core import child
from hri.core.errors import HriError
from hri.studio.composer import inspection

MODULE = "hri.studio.composer.workshop"
PATIENCE = 10.0
"""Seconds for an answer."""
PATIENCE_AT_START = 30.0
"""The same for the first: libraries are loaded on a slow machine."""
LOOK_EVERY = 1.0
"""Seconds between two looks at the files of behaviors."""
NICE = 10
"""Steps by which the robot goes before, when the processor is busy."""
LONGEST_ANSWER = 8_000_000
"""Bytes."""
QUESTIONS: dict[str, Callable[..., Any]] = {
    "palette": inspection.palette,
    "schema": inspection.schema,
    "check": inspection.check,
}


class Workshop:
    """The process from outside; it begins with the first question."""

    def __init__(self) -> None:
        self._process: trio.Process | None = None
        self._rest = b""
        self._turn = trio.Lock()
        self._files = ""
        self._looked = -LOOK_EVERY

    async def ask(self, name: str, *arguments: object) -> Any:
        """The answer. Raises HriError for a refusal, or when none comes."""
        async with self._turn:
            await self.look()
            patience = PATIENCE if self._process is not None else PATIENCE_AT_START
            try:
                with trio.fail_after(patience):
                    answer = await self._exchange(json.dumps([name, arguments]))
            except trio.TooSlowError:
                await self.close()
                raise HriError("a behavior keeps its check waiting - see what it imports") from None
            except (trio.BrokenResourceError, OSError, ValueError):
                await self.close()
                raise HriError("the check ended too early - see what a behavior imports") from None
            except trio.Cancelled:
                with trio.CancelScope(shield=True):
                    await self.close()
                raise
        if "error" in answer:
            raise HriError(answer["error"])
        return answer["result"]

    async def mark(self) -> str:
        """Changes when a file of a behavior does."""
        async with self._turn:
            await self.look()
            return self._files

    async def look(self) -> None:
        """End a process that has imported what is not so any more."""
        if trio.current_time() - self._looked < LOOK_EVERY:
            return
        self._looked = trio.current_time()
        files = await trio.to_thread.run_sync(files_mark)
        if files != self._files:
            self._files = files
            await self.close()

    async def _exchange(self, question: str) -> dict[str, Any]:
        if self._process is None:
            self._process = await trio.lowlevel.open_process(
                child.command("-m", MODULE),
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                env=child.environment(),
            )
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        await self._process.stdin.send_all(question.encode() + b"\n")
        while b"\n" not in self._rest:
            data = await self._process.stdout.receive_some()
            if not data or len(self._rest) > LONGEST_ANSWER:
                raise ValueError("no answer")
            self._rest += data
        line, _, self._rest = self._rest.partition(b"\n")
        answer: dict[str, Any] = json.loads(line)
        return answer

    async def close(self) -> None:
        """End the process; the next question starts another."""
        process, self._process, self._rest = self._process, None, b""
        if process is not None:
            process.kill()
            await process.wait()
            for pipe in (process.stdin, process.stdout):
                if pipe is not None:
                    await pipe.aclose()


def files_mark() -> str:
    """A text that changes with the schemas of behaviors, and with the Python beside them."""
    marks = []
    for path in inspection.schema_files():
        for file in (path, *path.parent.glob("*.py")):
            with suppress(OSError):
                status = file.stat()
                marks.append(f"{file} {status.st_mtime_ns} {status.st_size}")
    return hashlib.sha256("\n".join(sorted(set(marks))).encode(errors="replace")).hexdigest()[:16]


def main() -> int:
    """Answer until the server closes the pipe."""
    with suppress(OSError):
        os.nice(NICE)
    # What a behavior prints while it is imported must not become an answer.
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    for line in sys.stdin:
        name, arguments = json.loads(line)
        print(json.dumps(_answered(name, arguments)), file=answers, flush=True)
    return 0


def _answered(name: str, arguments: list[Any]) -> dict[str, Any]:
    try:
        return {"result": QUESTIONS[name](*arguments)}
    except HriError as error:
        return {"error": str(error)}
    except Exception as error:  # of a behavior that someone writes just now
        return {"error": f"a behavior failed: {type(error).__name__}: {error}"}


if __name__ == "__main__":
    sys.exit(main())
