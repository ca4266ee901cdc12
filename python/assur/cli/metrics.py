"""Metrics and conditions as text, ``span(B.x) - 0.1 * rms(rocker, order=2)``.

    condition = sum ("<" | "<=" | ">" | ">=") sum
    sum       = product (("+" | "-") product)*
    product   = factor (("*" | "/") factor)*
    factor    = ["-"] (number | "(" sum ")" | function "(" arguments ")")

Functions are those of `assur.metric`. Nothing else is called or looked up.
"""

from __future__ import annotations

import inspect
import re
from typing import TYPE_CHECKING, Any, NamedTuple

from assur import metric
from assur.cli.metric_arguments import argument_of, parts
from assur.cli.units import numbers
from assur.errors import InputError
from assur.sweeps.terms import Condition, Metric

if TYPE_CHECKING:
    from collections.abc import Callable

FUNCTIONS = tuple(name for name in metric.__all__ if name.islower() and name != "function")
MOST_LETTERS, MOST_BRACKETS = 2000, 20
TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)(?P<unit>rad/s|deg/s|mm/s|m/s|[a-z]+)?"
    r"|(?P<name>[^\W\d]\w*)|(?P<sign><=|>=|[-+*/()<>]))",
    re.UNICODE,
)
NAMED = re.compile(r"\s*([^\W\d][\w.-]*)\s*=(?!=)\s*(.*)", re.DOTALL)


class _Token(NamedTuple):
    kind: str
    text: str
    start: int
    end: int


def named_metric(text: str) -> tuple[str, Metric]:
    """Return ``gamma=span(C.x)`` as a name and a metric; the text itself is a name."""
    match = NAMED.fullmatch(text)
    name, body = (match[1], match[2]) if match else (text.strip(), text)
    what = _Reader(body).whole()
    if not isinstance(what, Metric):
        message = f"{text!r} is not a metric: write a function, such as {name[:20]}=span(B.x)"
        raise InputError(message)
    return name, what


def condition(text: str) -> Condition:
    """Return ``min_transmission_angle(C) > 40deg``."""
    parsed = _Reader(text).whole()
    if not isinstance(parsed, Condition):
        message = f"{text!r} is not a condition, such as min_transmission_angle(C) > 40deg"
        raise InputError(message)
    return parsed


class _Reader:
    """Reads one text, a token after another."""

    def __init__(self, text: str) -> None:
        if len(text) > MOST_LETTERS:
            message = f"a metric has {len(text)} letters, of {MOST_LETTERS} at most"
            raise InputError(message)
        self.text, self.at, self.depth = text, 0, 0

    def error(self, problem: str, at: int | None = None) -> InputError:
        place = self.at if at is None else at
        return InputError(f"{self.text!r}, character {place + 1}: {problem}")

    def peek(self) -> _Token | None:
        """Return the next token, None at the end."""
        match = TOKEN.match(self.text, self.at)
        if match is None:
            rest = self.text[self.at :].strip()
            if rest:
                raise self.error(f"{rest[:20]!r} is not understood")
            return None
        kind = "number" if match["number"] else "name" if match["name"] else "sign"
        start = match.start(kind)
        return _Token(kind, self.text[start : match.end()], start, match.end())

    def take(self, *signs: str) -> str | None:
        """Take the next token if it is one of these signs."""
        token = self.peek()
        if token is None or token.kind != "sign" or token.text not in signs:
            return None
        self.at = token.end
        return token.text

    def whole(self) -> Any:
        left = self.sum()
        sign = self.take("<", "<=", ">", ">=")
        if sign is not None:
            left = self.compared(left, sign, self.sum())
        rest = self.peek()
        if rest is not None:
            raise self.error(f"{rest.text!r} is left over", rest.start)
        return left

    def compared(self, left: Any, sign: str, right: Any) -> Any:
        if not isinstance(left, Metric) and not isinstance(right, Metric):
            raise self.error("a condition compares a metric", 0)
        compare: dict[str, Callable[[], Any]] = {
            "<": lambda: left < right,
            "<=": lambda: left <= right,
            ">": lambda: left > right,
            ">=": lambda: left >= right,
        }
        return compare[sign]()

    def sum(self) -> Any:
        value = self.product()
        while sign := self.take("+", "-"):
            right = self.product()
            value = value + right if sign == "+" else value - right
        return value

    def product(self) -> Any:
        value = self.factor()
        while sign := self.take("*", "/"):
            right = self.factor()
            if sign == "/" and right == 0.0:
                raise self.error("a division by zero")
            value = value * right if sign == "*" else value / right
        return value

    def factor(self) -> Any:
        negative = False
        while self.take("-"):
            negative = not negative
        value = self.operand()
        return -value if negative else value

    def operand(self) -> Any:
        if self.take("("):
            self.depth += 1
            if self.depth > MOST_BRACKETS:
                raise self.error(f"brackets are nested deeper than {MOST_BRACKETS}")
            value = self.sum()
            if not self.take(")"):
                raise self.error("')' is missing")
            self.depth -= 1
            return value
        token = self.peek()
        if token is None:
            raise self.error("a number or a metric is missing")
        if token.kind == "number":
            self.at = token.end
            try:
                return float(numbers(token.text).values)
            except InputError as error:
                raise self.error(str(error), token.start) from error
        if token.kind == "name":
            return self.call(token)
        raise self.error(f"{token.text!r} is not expected here", token.start)

    def call(self, token: _Token) -> Any:
        if token.text not in FUNCTIONS:
            known = ", ".join(FUNCTIONS)
            raise self.error(f"there is no metric {token.text!r}; there are {known}", token.start)
        self.at = token.end
        if not self.take("("):
            raise self.error(f"'(' is missing after {token.text}")
        # Arguments are names of joints, which may begin with a digit: no tokens.
        end = self.closing()
        inside, self.at = self.text[self.at : end], end + 1
        function = getattr(metric, token.text)
        positional, named = [], {}
        for part in parts(inside):
            name, equals, value = part.partition("=")
            if equals:
                named[name.strip()] = value.strip()
            else:
                positional.append(part.strip())
        try:
            bound = inspect.signature(function).bind(*positional, **named).arguments
        except TypeError as error:
            raise self.error(f"{token.text}: {error}", token.start) from error
        try:
            return function(**{name: argument_of(name, text) for name, text in bound.items()})
        except InputError as error:
            raise self.error(f"{token.text}: {error}", token.start) from error

    def closing(self) -> int:
        """Return where the bracket of a function closes."""
        depth = 1
        for place in range(self.at, len(self.text)):
            depth += {"(": 1, ")": -1}.get(self.text[place], 0)
            if depth == 0:
                return place
        raise self.error("')' is missing")
