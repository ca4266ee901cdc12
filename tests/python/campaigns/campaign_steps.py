"""Makes 10⁹ steps of many environments: memory stays as it is, and energy is kept."""

from __future__ import annotations

import resource
import sys
import time

import numpy as np

import assur
from models.machines.stepping_machines import engine

ENVIRONMENTS, STEPS, STEPS_A_CALL = 10_000, 100_000, 1000
DT = 1e-3
# Greatest growth of the memory in use, and change of the energy as a part of it.
MEGABYTES, LOST = 8.0, 1e-6


def peak() -> float:
    """The most memory that the process has had, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def main() -> int:
    """Step machines without loads, which keep their energy; return the number of failures."""
    machine = engine()
    q = np.linspace(0.0, 2.0 * np.pi, ENVIRONMENTS)
    speed = np.linspace(1.0, 8.0, ENVIRONMENTS)

    def energy() -> np.ndarray[tuple[int], np.dtype[np.float64]]:
        return np.asarray(0.5 * machine.reduced_inertia(q).value * speed**2)

    first = energy()
    start, memory = time.perf_counter(), 0.0
    for call in range(STEPS // STEPS_A_CALL):
        q, speed, status = machine.step(q, speed, 0.0, DT, n=STEPS_A_CALL)
        assert status.max() <= assur.Status.NEAR_SINGULAR
        # The first calls make what all others use again.
        if call == 2:
            memory = peak()
    seconds, grown = time.perf_counter() - start, peak() - memory
    lost = float(np.abs(energy() / first - 1.0).max())
    each = seconds / ENVIRONMENTS / STEPS
    sys.stdout.write(
        f"{ENVIRONMENTS * STEPS:.0e} steps of {ENVIRONMENTS} environments: {seconds:.0f} s, "
        f"{1e9 * each:.0f} ns each; memory {memory:.0f} MB, then {grown:.1f} MB more; "
        f"energy off by {lost:.1e} of it\n"
    )
    return int(grown > MEGABYTES) + int(lost > LOST)


if __name__ == "__main__":
    sys.exit(main())
