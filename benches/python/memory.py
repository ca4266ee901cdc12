"""What memory allows: the time to write the same number of values by two threads, no more."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

import numpy as np

from subject import Contender

if TYPE_CHECKING:
    from collections.abc import Sequence

    from subject import Float

OLD, NEW = "writing, old pages", "writing, new pages"


def cores() -> int:
    """Threads that can run at once."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def ceilings(arrays: Sequence[Float]) -> dict[str, Contender]:
    """Contenders that write one number into arrays like these, there already or new."""
    ours = [np.zeros_like(array) for array in arrays]
    pool = ThreadPoolExecutor(cores())
    return {
        OLD: Contender(lambda: write(pool, ours)),
        NEW: Contender(lambda: write(pool, [np.empty_like(array) for array in arrays])),
    }


def write(pool: ThreadPoolExecutor, arrays: Sequence[Float]) -> None:
    """Each thread writes its part of the rows of every array."""
    rows = len(arrays[0])
    ends = [rows * i // cores() for i in range(cores() + 1)]

    def part(start: int, end: int) -> None:
        for array in arrays:
            np.copyto(array[start:end], 1.5)

    list(pool.map(part, ends[:-1], ends[1:]))
