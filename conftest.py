"""Makes doctests print the same everywhere."""

import os

os.environ.setdefault("MPLBACKEND", "Agg")  # before anything imports matplotlib

import numpy as np
import pytest


@pytest.fixture(autouse=True)
def _stable_examples(doctest_namespace: dict[str, object]) -> None:
    doctest_namespace["np"] = np
    np.set_printoptions(precision=6, suppress=True, linewidth=88)
