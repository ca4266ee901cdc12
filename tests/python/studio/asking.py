"""Requests to the studio without a server between, and the documents of its tests."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from assur.studio.answers import answered
from assur.studio.frame import decode
from assur.studio.request import parse
from assur.studio.session import Deadline, Given, Session

if TYPE_CHECKING:
    import numpy.typing as npt

    Arrays = dict[str, npt.NDArray[Any]]

FOUR_BAR: dict[str, Any] = {
    "driver": "crank",
    "joints": {"A": [0, 0], "B": [1, 0], "C": [4.1, 3.2], "D": [4.8, 0], "P": [3, 4]},
    "links": {
        "ground": ["A", "D"],
        "crank": ["A", "B"],
        "coupler": ["B", "C", "P"],
        "rocker": ["D", "C"],
    },
}
PRESS: dict[str, Any] = {
    "driver": "crank",
    "joints": {"O": [0, 0], "A": [0, 0.1], "B": [0.39, 0]},
    "links": {"ground": ["O"], "crank": ["O", "A"], "rod": ["A", "B"], "ram": ["B"]},
    "slides": {"guide": {"link": "ram", "on": "ground", "angle": 0, "origin": "O"}},
    "bodies": {"crank": {"mass": 12, "inertia": 0.5, "at": "O"}, "ram": {"mass": 20}},
    "loads": [
        {"type": "Force", "at": "B", "force": [-900, 0]},
        {"type": "TorsionDamper", "link": "crank", "damping": 2},
    ],
    "motor": {"type": "LinearMotor", "stall": 900, "no_load": 30},
}


@dataclass(frozen=True)
class Reply:
    """An answer, read."""

    header: dict[str, Any]
    arrays: Arrays

    def __getitem__(self, key: str) -> Any:
        return self.header[key]


def ask(kind: str, given: Given | None = None, seconds: float = 30.0, **fields: Any) -> Reply:
    """Return an answer that is no error."""
    reply = reply_to(kind, given, seconds, **fields)
    assert "error" not in reply.header, reply["error"]
    return reply


def refused(kind: str, given: Given | None = None, seconds: float = 30.0, **fields: Any) -> Any:
    """Return the error of a request."""
    return reply_to(kind, given, seconds, **fields)["error"]


def reply_to(kind: str, given: Given | None, seconds: float, **fields: Any) -> Reply:
    message = json.dumps({"id": 5, "rev": 3, "kind": kind, **fields})
    reply = Reply(*decode(answered(parse(message), Session(given, Deadline(seconds)))))
    assert [reply[key] for key in ("id", "rev", "kind")] == [5, 3, kind]
    return reply
