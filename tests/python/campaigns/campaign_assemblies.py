"""Counts the assemblies of random groups of class III to V, and follows them along q."""

from __future__ import annotations

import sys
import time

import numpy as np

from models.mechanisms.assembly_models import CASES
from oracles.kinematics.assembly_checks import Followed, expected, follow, random_cases

FOLLOWED = 10_000


def main(seed: int) -> int:
    """Count every kind; return the number of disagreements."""
    wrong = 0
    for number, (kind, (make, count)) in enumerate(CASES.items()):
        rng = np.random.default_rng([seed, number])
        start, most, doubtful = time.perf_counter(), 0, 0
        for index in range(count):
            case = make(rng)
            found = case.mechanism.assemblies(case.mechanism.q0)
            most = max(most, len(found))
            doubtful += not found.is_complete
            wanted = expected(case)
            if len(found) != wanted or found.complex_count != (case.complex_count,):
                wrong += 1
                print(f"{kind} {index}: {len(found)} of {found.complex_count}, scanned {wanted}")
        seconds = time.perf_counter() - start
        print(f"{kind}: {count}, at most {most} real, {doubtful} doubtful, {seconds:.0f} s")
    followed = Followed()
    start = time.perf_counter()
    for mechanism, q, other in random_cases(seed):
        follow(mechanism, q, other, followed)
        if followed.cases - followed.lost >= FOLLOWED:
            break
    print(f"{followed}, {time.perf_counter() - start:.0f} s")
    return wrong + followed.wrong + followed.refused


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 1) > 0)
