"""Options, log lines and messages, escaped so that they cannot control a terminal."""

from __future__ import annotations

import argparse
import logging
import math
from pathlib import Path
from typing import Any, NoReturn

from hri.core.errors import did_you_mean
from hri.core.quoting import escaped, message_line


class LineFormatter(logging.Formatter):
    """Formats a record as one line of `message_line`; a traceback has more lines, each escaped."""

    def formatMessage(self, record: logging.LogRecord) -> str:
        return message_line(super().formatMessage(record))

    def formatException(self, ei: logging._SysExcInfoType) -> str:
        return "\n".join(map(escaped, super().formatException(ei).split("\n")))


class OptionParser(argparse.ArgumentParser):
    """Parses a command line; a wrong argument is reported in one line."""

    def error(self, message: str) -> NoReturn:
        super().error(message_line(message))

    def _get_value(self, action: argparse.Action, arg_string: str) -> Any:
        if action.type is Path and not arg_string:  # to Python, the current folder
            raise argparse.ArgumentError(action, "an empty name - name a file or a folder")
        return super()._get_value(action, arg_string)

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices is not None and value not in action.choices:
            remedy = did_you_mean(str(value), map(str, action.choices))
            raise argparse.ArgumentError(action, f'no "{value}" - {remedy}')


class Within:
    """Type of an option: a finite number within limits."""

    def __init__(self, kind: type[float], lowest: float, highest: float = math.inf) -> None:
        self.kind, self.lowest, self.highest = kind, lowest, highest

    def __call__(self, text: str) -> float:
        try:
            value = self.kind(text)
        except ValueError:
            value = math.nan
        if not self.lowest <= value <= self.highest or value == math.inf:
            is_open, least = self.highest == math.inf, f"{self.lowest:g}"
            limits = f", {least} or more" if is_open else f" from {least} to {self.highest:g}"
            raise argparse.ArgumentTypeError(f"{text} - write a number{limits}")
        return value


def legible(text: str) -> str:
    """A printable text: undecodable bytes become a replacement sign that no word contains."""
    return text.encode("utf-8", "surrogateescape").decode("utf-8", "replace")
