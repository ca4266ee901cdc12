"""Public functions with any arguments: a result or an AssurError, never anything else.

The bytes come from hypothesis in `test_fuzz_entries.py` and from atheris in `fuzz/entries.py`.
"""

from __future__ import annotations

import signal
import warnings
from typing import TYPE_CHECKING, Any
from unittest import mock

import assur
from assur import crank_rocker, slider_crank
from assur.dynamics.flywheel import size as size_flywheel
from fuzzing.fuzz_kinematics import assemblies, change, construct, describe, move
from fuzzing.fuzz_machines import balanced, harmonics, inside, reduce, run, runs, steady, wheel
from fuzzing.fuzz_values import Choices

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FrameType

# No input takes longer, s. Runs have a limit of their own, searches for flywheels one of a minute.
LONGEST = 5.0
LONGEST_SEARCH = 1.0
LONGEST_MESSAGE = 4000


class HangError(BaseException):
    """An input took longer than `LONGEST`."""


def papers(c: Choices) -> object:
    n, p = c.numbers, c.positive
    lengths = {"l1": p, "l2": p, "l3": p, "l4": p}
    calls: tuple[tuple[Callable[..., Any], dict[str, Callable[[], Any]]], ...] = (
        (slider_crank.fourier, {"k": p, "harmonics": c.small, "terms": c.small}),
        (slider_crank.stroke, {"phi": n, "crank": p, "rod": p, "n": c.small, "terms": c.small}),
        (slider_crank.rod_point, {"phi": n, "crank": p, "rod": p, "along": n, "across": n}),
        (slider_crank.deviation, {"lam": p, "n": c.small, "quantity": lambda: "d1"}),
        (slider_crank.greatest_speed, {"k": p, "method": lambda: "series"}),
        (slider_crank.greatest_acceleration, {"k": p}),
        (slider_crank.contour, {"phi": c.number, "crank": p, "rod": p}),
        (slider_crank.coordinate, {"phi": n, "crank": p, "rod": p}),
        (slider_crank.rod_angle, {"phi": n, "crank": p, "rod": p}),
        (crank_rocker.grashof, {**lengths, "tolerance": p}),
        (crank_rocker.solve, {"phi1": n, **lengths, "speed": n, "ground_speed": n}),
        (crank_rocker.ground_range, {"coupler": p, "rocker": p, "margin": p, "gamma_min": n}),
        (
            crank_rocker.least_transmission_angle,
            {"f_c": n, "r_c": n, "f_d": n, "r_d": n, "rocker": p},
        ),
        (crank_rocker.transmission_extremes, dict(lengths)),
        (crank_rocker.crank_turns, dict(lengths)),
        (crank_rocker.blocked, {**lengths, "gamma_min": n}),
        (
            crank_rocker.run,
            {"l1": p, "l2": p, "l3": p, "ground": p, "gamma_min": c.number, "turns": p},
        ),
    )
    function, named = c.among(calls)
    return c.call(function, **named)


ENTRIES: tuple[Callable[[Choices], object], ...] = (
    describe,
    construct,
    change,
    assemblies,
    move,
    reduce,
    run,
    runs,
    steady,
    wheel,
    papers,
    balanced,
    harmonics,
    inside,
)


def give_up(_number: int, _frame: FrameType | None) -> None:
    message = f"longer than {LONGEST} s"
    raise HangError(message)


def one_input(data: bytes) -> None:
    """Run the entry that the bytes name; anything but a result or an AssurError goes through."""
    choices = Choices(data)
    before = signal.signal(signal.SIGALRM, give_up)
    signal.setitimer(signal.ITIMER_REAL, LONGEST)
    try:
        limit = mock.patch.dict(size_flywheel.STEADY_OPTIONS, max_seconds=LONGEST_SEARCH)
        with warnings.catch_warnings(), limit:
            warnings.simplefilter("error")
            warnings.simplefilter("ignore", assur.AssurWarning)
            choices.among(ENTRIES)(choices)
    except assur.AssurError as error:
        message = str(error)
        assert message.strip(), "an error without a sentence"
        assert len(message) <= LONGEST_MESSAGE, f"{len(message)} characters: {message[:200]}"
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
