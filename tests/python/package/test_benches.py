"""The benches: contenders agree on small cases, and one that does not is found."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from subject import Contender, Subject

BENCHES = Path(__file__).resolve().parents[3] / "benches" / "python"


def test_contenders_agree() -> None:
    """Every case; numba, JAX, CasADi and pylinkage only where installed."""
    command = [sys.executable, "-B", str(BENCHES / "run.py"), "--quick"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def contender(values: list[float]) -> Contender:
    return Contender(lambda: np.array(values), lambda found: [found])


@pytest.mark.parametrize(
    ("values", "complaint"),
    [
        ([0.0, 1.0 + 1e-6, np.nan], "differs by 1.00e-06"),
        ([0.0, 1.0, 2.0], "others are missing"),
        ([0.0, np.nan, np.nan], "others are missing"),
        ([0.0, 1.0], "not \\(3,\\)"),
    ],
)
def test_one_that_disagrees_is_found(values: list[float], complaint: str) -> None:
    right = contender([0.0, 1.0, np.nan])
    Subject(1, 3, {"assur": right, "other": right}).check()
    with pytest.raises(AssertionError, match=complaint):
        Subject(1, 3, {"assur": right, "other": contender(values)}).check()


def test_turns_of_angles_are_not_compared() -> None:
    two = {"assur": contender([0.5]), "other": contender([0.5 - 2 * np.pi])}
    Subject(1, 1, two, angles=(0,)).check()
    with pytest.raises(AssertionError, match="differs"):
        Subject(1, 1, two).check()
