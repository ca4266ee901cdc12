"""Commands called in this process."""

from __future__ import annotations

import contextlib
import csv
import io
from typing import NamedTuple
from unittest import mock

import numpy as np
import numpy.typing as npt

from assur.cli import main

Columns = dict[str, npt.NDArray[np.float64]]


class Done(NamedTuple):
    """What a command has left: its exit status and what it printed."""

    code: int
    out: str
    err: str


def assur_command(*words: object) -> Done:
    """Call a command, with pipes for its outputs; the studio ends when it has said its address."""
    out, err = io.StringIO(), io.StringIO()
    with (
        contextlib.redirect_stdout(out),
        contextlib.redirect_stderr(err),
        mock.patch("uvicorn.Server.run"),
        mock.patch("webbrowser.open"),
    ):
        code = main([str(word) for word in words])
    return Done(code, out.getvalue(), err.getvalue())


def table(*words: object, code: int = 0) -> Columns:
    """Return the columns that a command prints as CSV."""
    done = assur_command(*words)
    assert done.code == code, done.err
    return columns(done.out)


def columns(text: str) -> Columns:
    """Return the columns of a CSV text, as numbers."""
    header, *rows = csv.reader(text.splitlines())
    values = np.array([[number(cell) for cell in row] for row in rows]).reshape(-1, len(header))
    return dict(zip(header, values.T, strict=True))


def number(cell: str) -> float:
    words = {"True": 1.0, "False": 0.0}
    return words[cell] if cell in words else float(cell)


def refused(*words: object, code: int = 1) -> str:
    """Return the one line with which a command ends."""
    done = assur_command(*words)
    assert (done.code, done.out) == (code, ""), done
    assert done.err.startswith("assur: "), done.err
    assert done.err.count("\n") == 1, done.err
    return done.err.removeprefix("assur: ").rstrip("\n")


def same(left: object, right: object) -> bool:
    """Whether two arrays have the same bits."""
    one, other = (np.asarray(side, np.float64) for side in (left, right))
    return one.shape == other.shape and one.tobytes() == other.tobytes()
