"""What programs say about input: log and wrong options, in lines that command no terminal."""

from __future__ import annotations

import argparse
import logging
from pathlib import Path
from typing import Any, NoReturn

from hri.core.quoting import escaped, message_line


class LineFormatter(logging.Formatter):
    """A record as one line of `message_line`; only a traceback has more lines, each escaped."""

    def formatMessage(self, record: logging.LogRecord) -> str:
        return message_line(super().formatMessage(record))

    def formatException(self, ei: logging._SysExcInfoType) -> str:
        return "\n".join(map(escaped, super().formatException(ei).split("\n")))


class OptionParser(argparse.ArgumentParser):
    """Reads the words of a command line; one that is wrong is quoted in one line."""

    def error(self, message: str) -> NoReturn:
        super().error(message_line(message))

    def _get_value(self, action: argparse.Action, arg_string: str) -> Any:
        if action.type is Path and not arg_string:  # to Python, the current folder
            raise argparse.ArgumentError(action, "an empty name - name a file or a folder")
        return super()._get_value(action, arg_string)
