"""The mechanisms whose bits are compared, their bits, and (as a program) digests of these.

Which vector instructions the core uses is read from ASSUR_SIMD once in a process: others are had
by running this module in a process of its own, ``ASSUR_SIMD=baseline python bits.py 500``.
"""

from __future__ import annotations

import hashlib
import json
import math
import os
import subprocess
import sys
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import numpy.typing as npt

import assur
from models.mechanisms import dyad_models, mechanism_data, named_drawings, named_models

if TYPE_CHECKING:
    from collections.abc import Iterator

Float: TypeAlias = npt.NDArray[np.float64]
Bits: TypeAlias = npt.NDArray[np.uint8]


def elsewhere(program: str, count: int, **variables: str) -> subprocess.Popen[str]:
    """Start a program in a process of its own, where the core reads these from the environment."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), **variables}
    command = [sys.executable, program, str(count)]
    return subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True)


def named(name: str) -> assur.Mechanism:
    kind, _, own = name.partition(" ")
    if kind == "library":
        return named_drawings.CLASS_II[own]()
    return assur.Mechanism(**mechanism_data.arguments(named_models.NAMED[own]()))


def random(seed: int) -> assur.Mechanism:
    case = dyad_models.random_case(seed, max_dyads=4)
    return assur.Mechanism(**mechanism_data.arguments(case.description))


NAMES = [f"library {n}" for n in named_drawings.CLASS_II]
NAMES += [f"model {n}" for n in named_models.NAMED]


def few(m: assur.Mechanism) -> int:
    """Coordinates to compare; fewer with several drivers, which trace a path to each."""
    return 9 if np.ndim(m.q0) else 61


def coordinates(m: assur.Mechanism, rng: np.random.Generator, count: int, name: str = "") -> Float:
    """Within the range of use (else half a turn or a metre to either side), and far beyond.

    Beyond is 50 turns to either side, with several drivers one.
    """
    q0 = np.asarray(m.q0)
    drivers = m.driver if isinstance(m.driver, tuple) else (m.driver,)
    reach = np.reshape([1.0 if d in m.slides else math.pi for d in drivers], q0.shape)
    used = named_drawings.RANGES.get(name.removeprefix("library "), (q0 - reach, q0 + reach))
    low, high = (np.asarray(end) for end in used)
    inside = (high - low) / 2 * rng.uniform(-1.0, 1.0, (count, *q0.shape))
    beyond = rng.choice([1.0, 1.2, 2.0 if q0.ndim else 100.0], (count, *[1] * q0.ndim))
    return np.asarray((low + high) / 2 + inside * beyond)


def designs(m: assur.Mechanism, rng: np.random.Generator, count: int) -> assur.Mechanism:
    """A batch, every dimension up to 3 % longer or shorter; some cannot be assembled everywhere."""
    scaled = {n: v * rng.uniform(0.97, 1.03, count) for n, v in m.dimensions.items()}
    return m.with_dimensions(scaled)


def bits(motion: assur.Motion) -> Bits:
    """Everything that the motion holds, a row of bytes a position."""
    held, status = motion._results, motion.status
    kinds = (held.joints, held.links, held.slides)
    arrays = [array for kind in kinds for name in sorted(kind) for array in kind[name]]
    widths = [math.prod(array.shape[status.ndim :]) for array in arrays]
    values = [a.reshape(status.size, w) for a, w in zip(arrays, widths, strict=True)]
    together = np.concatenate(values, axis=1)
    # The sign of "not a number" says nothing, and machines differ in it.
    together[np.isnan(together)] = np.nan
    rows = together.view(np.uint8)
    return np.concatenate([rows, status.reshape(-1, 1)], axis=1)


def solve(m: assur.Mechanism, q: npt.ArrayLike, threads: int | None = None) -> Bits:
    return bits(m.solve(q, order=3, on_error="nan", threads=threads))


def digest(m: assur.Mechanism, name: str = "") -> str:
    """Of one design and of three."""
    rng = np.random.default_rng(1)
    q = coordinates(m, rng, few(m), name)
    both = (solve(m, q), solve(designs(m, rng, 3), q[:9]))
    return hashlib.blake2b(b"".join(b.tobytes() for b in both)).hexdigest()


def digests(seeds: int) -> Iterator[tuple[str, str]]:
    for name in NAMES:
        yield name, digest(named(name), name)
    for seed in range(seeds):
        yield f"seed {seed}", digest(random(seed))
    yield "overflow", digest(assur.SliderCrank(5e36, 7e-73))


if __name__ == "__main__":
    json.dump(dict(digests(int(sys.argv[1]))), sys.stdout)
