"""How strong a stimulus is, written as a formula over what its event brings: `clip(value, 0, 1)`.

    numbers       0.5, 1, 2e-3
    fields        the names of the event's properties; `value` of a port
    arithmetic    + - * / and brackets
    comparisons   < <= > >= == !=, which are 1 where they hold, else 0; texts in quotes with == !=
    functions     min(a, b, ...)  max(a, b, ...)  abs(a)  clip(a, low, high)

Nothing else is understood: no attributes, no indices, no other functions, so a file can neither
reach into the program nor keep it busy.
"""

from __future__ import annotations

import ast
import math
import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from hri.core.errors import did_you_mean
from hri.core.expression import parsed

Value = float | str
Part = Callable[[Mapping[str, Any]], Value]
"""What a piece of a formula is worth for an event's properties."""

LONGEST = 200
"""Characters of a formula."""
DEEPEST = 30
"""Brackets, signs and functions within each other; a sum or product in a row counts as one."""

_ARITHMETIC: dict[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}
_ORDER: dict[type[ast.cmpop], Callable[[float, float], bool]] = {
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
}
_EQUALITY: dict[type[ast.cmpop], Callable[[Value, Value], bool]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
}


def _clip(value: float, low: float, high: float) -> float:
    return min(max(value, low), high)


_FUNCTIONS: dict[str, tuple[Callable[..., float], int, int]] = {
    # name: (function, fewest and most arguments)
    "min": (min, 2, 8),
    "max": (max, 2, 8),
    "abs": (abs, 1, 1),
    "clip": (_clip, 3, 3),
}


@dataclass(frozen=True, slots=True)
class Formula:
    """A formula that has been understood."""

    text: str
    fields: frozenset[str]
    """The properties it asks for."""
    _part: Part = field(repr=False, compare=False)

    def value(self, properties: Mapping[str, Any]) -> float:
        """Its value for an event. Numbers and truths (1 and 0) count as fields, texts compare.

        Raises ValueError with one sentence for a missing field, one of another kind, a division by
        zero, and a value that is not finite.
        """
        try:
            value = _number(self._part(properties), self.text)
        except ZeroDivisionError as error:
            raise ValueError(f'"{self.text}" divides by zero') from error
        if not math.isfinite(value):
            raise ValueError(f'"{self.text}" is {value}')
        return value

    def intensity(self, properties: Mapping[str, Any]) -> float:
        """Its value within 0 to 1: what is beyond counts as the end. Raises as `value` does."""
        return _clip(self.value(properties), 0.0, 1.0)


def parse_formula(text: str) -> Formula:
    """Understand a formula. Raises ValueError with one sentence that says what is wrong."""
    if len(text) > LONGEST:
        raise ValueError(f"a formula of {len(text)} characters - keep it within {LONGEST}")
    try:
        tree = parsed(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        raise ValueError(f'"{text}" is not a formula - write such as clip(value, 0, 1)') from error
    fields: set[str] = set()
    part = _part_of(tree, fields, DEEPEST)
    return Formula(text, frozenset(fields), part)


def _part_of(node: ast.expr, fields: set[str], depth: int) -> Part:
    if depth == 0:
        raise ValueError(f"more than {DEEPEST} brackets within each other - write it simpler")
    if isinstance(node, ast.Compare):
        return _comparison(node, fields, depth - 1)

    def below(child: ast.expr) -> Callable[[Mapping[str, Any]], float]:
        return _numeric(_part_of(child, fields, depth - 1), child)

    match node:
        case ast.Constant(value=bool()):
            pass
        case ast.Constant(value=int() | float() as number):
            return _constant(number)
        case ast.Name(id=name):
            fields.add(name)
            return lambda properties: _field(properties, name)
        case ast.UnaryOp(op=ast.USub(), operand=child):
            negated = below(child)
            return lambda properties: -negated(properties)
        case ast.UnaryOp(op=ast.UAdd(), operand=child):
            return below(child)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _ARITHMETIC:
            # a + b + c is (a + b) + c, which nobody calls deep; LONGEST keeps it short enough.
            one = _numeric(_part_of(left, fields, depth), left)
            combine, other = _ARITHMETIC[type(op)], below(right)
            return lambda properties: combine(one(properties), other(properties))
        case ast.Call(func=ast.Name(id=name), args=arguments, keywords=[]):
            function = _function(name, len(arguments))
            parts = [below(argument) for argument in arguments]
            return lambda properties: function(*(part(properties) for part in parts))
    raise ValueError(f'"{ast.unparse(node)}" has no place in a formula - {_ALLOWED}')


_ALLOWED = f"use numbers, fields, + - * /, comparisons, {', '.join(_FUNCTIONS)}"


def _comparison(node: ast.Compare, fields: set[str], depth: int) -> Part:
    if len(node.ops) > 1:
        raise ValueError(f'"{ast.unparse(node)}" compares twice - multiply two comparisons')
    kind, (left, right) = type(node.ops[0]), (node.left, node.comparators[0])
    if kind in _EQUALITY:
        equal = _EQUALITY[kind]
        one, other = (_text_or_part(side, fields, depth) for side in (left, right))
        return lambda properties: float(equal(one(properties), other(properties)))
    if kind not in _ORDER:
        raise ValueError(f'"{ast.unparse(node)}" has no place in a formula - {_ALLOWED}')
    ordered = _ORDER[kind]
    low, high = (_numeric(_part_of(side, fields, depth), side) for side in (left, right))
    return lambda properties: float(ordered(low(properties), high(properties)))


def _text_or_part(node: ast.expr, fields: set[str], depth: int) -> Part:
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        text = node.value
        return lambda properties: text
    return _part_of(node, fields, depth)


def _constant(number: int | float) -> Part:
    try:
        value = float(number)
    except OverflowError as error:
        raise ValueError("a number that is too large - write a smaller one") from error
    if not math.isfinite(value):
        raise ValueError("a number that is too large - write a smaller one")
    return lambda properties: value


def _function(name: str, count: int) -> Callable[..., float]:
    if name not in _FUNCTIONS:
        raise ValueError(f'no function "{name}" - {did_you_mean(name, _FUNCTIONS)}')
    function, fewest, most = _FUNCTIONS[name]
    if not fewest <= count <= most:
        wanted = str(fewest) if fewest == most else f"{fewest} to {most}"
        raise ValueError(f"{name} of {count} - give it {wanted}")
    return function


def _numeric(part: Part, node: ast.expr) -> Callable[[Mapping[str, Any]], float]:
    """A part whose value must be a number."""
    if not isinstance(node, ast.Name):
        return part  # type: ignore[return-value]  # all others are numbers already
    name = node.id
    return lambda properties: _number(part(properties), name)


def _field(properties: Mapping[str, Any], name: str) -> Value:
    """A property as a number, or as the text it is."""
    if name not in properties:
        raise ValueError(f'no field "{name}" - {did_you_mean(name, properties)}')
    value = properties[name]
    if isinstance(value, str):
        return value
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f'the field "{name}" is not a number - compare another one') from error


def _number(value: Value, name: str) -> float:
    if isinstance(value, str):
        raise ValueError(f'"{name}" is a text - compare it with == or !=')
    return value
