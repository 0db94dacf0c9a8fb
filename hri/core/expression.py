"""Numbers written as expressions, `-5*pi/6`, worked out without `eval`."""

from __future__ import annotations

import ast
import math
import operator
import warnings
from collections.abc import Callable

NAMES = {"pi": math.pi, "e": math.e}

_BINARY: dict[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}
_LONGEST = 200


def evaluate(text: str) -> float:
    """The value of sums, products, quotients and signs over numbers, `pi` and `e`.

    Raises ValueError with one sentence when it is anything else, or not finite.
    """
    if len(text) > _LONGEST:
        raise ValueError(f"an expression of {len(text)} characters is too long")
    try:
        value = _value(parsed(text))
    except (SyntaxError, RecursionError, MemoryError) as error:
        raise ValueError(f'"{text}" is not a number') from error
    except ZeroDivisionError as error:
        raise ValueError(f'"{text}" divides by zero') from error
    except OverflowError as error:
        raise ValueError(f'"{text}" is too large') from error
    if not math.isfinite(value):
        raise ValueError(f'"{text}" is not finite')
    return value


def parsed(text: str) -> ast.expr:
    """The tree of one expression of Python, without the warnings that are for programmers.

    Raises SyntaxError, ValueError, RecursionError or MemoryError for any other text.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of `1or 2`, which is refused by who looks at the tree
        return ast.parse(text.strip(), mode="eval").body


def _value(node: ast.expr) -> float:
    match node:
        case ast.Constant(value=bool()):
            raise ValueError("true and false are not numbers")
        case ast.Constant(value=int() | float() as number):
            return float(number)
        case ast.Name(id=name) if name in NAMES:
            return NAMES[name]
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return -_value(operand)
        case ast.UnaryOp(op=ast.UAdd(), operand=operand):
            return _value(operand)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _BINARY:
            return _BINARY[type(op)](_value(left), _value(right))
    raise ValueError(f'"{ast.unparse(node)}" is not a number')
