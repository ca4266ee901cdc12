"""Makes doctests print the same everywhere, and each worker compute on one core."""

import os
import sys
from collections.abc import Iterator

os.environ.setdefault("MPLBACKEND", "Agg")  # before anything imports matplotlib
# Before anything imports NumPy: for the oracles' small matrices, threads only wait for each other.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
import pytest


@pytest.fixture(autouse=True)
def _stable_examples(doctest_namespace: dict[str, object]) -> Iterator[None]:
    doctest_namespace["np"] = np
    np.set_printoptions(precision=6, suppress=True, linewidth=88)
    yield
    # Figures that stay open are a warning beyond twenty.
    if "matplotlib.pyplot" in sys.modules:
        sys.modules["matplotlib.pyplot"].close("all")
