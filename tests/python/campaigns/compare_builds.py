"""Two builds of assur on the same random mechanisms: where do statuses, values or turns differ?

    PYTHONPATH=NEW:tests/python python -m campaigns.compare_builds OLD NEW --count 20000

OLD and NEW are the folders `python` of two checkouts that are built. Every count is a mechanism of
class II: half are drawn, a tenth of those with change points; of the others every
twelve are designs of one space, most of which do not turn fully.
"""

from __future__ import annotations

import argparse
import os
import pickle
import subprocess
import sys
import tempfile
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

import assur
from campaigns import campaign_cases
from models.mechanisms.mechanism_data import arguments
from net import bits, design_spaces
from oracles.kinematics import gap_steps
from oracles.kinematics.agreement import POSITION

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

DESIGNS, POSITIONS = 12, 40
PORTION = 240  # mechanisms solved by both builds at a time
SHOWN = 200  # differences of a kind that are listed


class Solved(NamedTuple):
    """A motion in arrays, designs first."""

    q: NDArray[np.float64]
    status: NDArray[np.uint8]
    condition: NDArray[np.float64]
    joints: NDArray[np.float64]
    links: dict[str, NDArray[np.float64]]


def cases(first: int, last: int, higher: bool) -> Iterator[tuple[str, assur.Mechanism]]:
    for seed in range(first, last):
        if higher:
            case = campaign_cases.MAKE["higher"](seed)
            yield f"higher {seed}", assur.Mechanism(**arguments(case.description))
        elif seed % (2 * DESIGNS) >= DESIGNS:
            if seed % DESIGNS == 0:  # stands for all twelve
                yield f"space {seed}", space(seed)
        elif seed % 10:
            yield f"drawn {seed}", bits.random(seed)
        else:
            case = campaign_cases.changing_case(seed)
            yield f"changing {seed}", assur.Mechanism(**arguments(case.description))


def space(seed: int) -> assur.Mechanism:
    kind = seed // (2 * DESIGNS) % 3
    if kind == 0:
        return design_spaces.crank_space(seed, DESIGNS)
    if kind == 1:
        return design_spaces.slide_space(seed, DESIGNS)
    return design_spaces.space(bits.random(seed), np.random.default_rng(seed), DESIGNS)


def solved(first: int, last: int, higher: bool) -> Iterator[tuple[str, Solved]]:
    for name, m in cases(first, last, higher):
        rng = np.random.default_rng(first)
        drivers = m.driver if isinstance(m.driver, tuple) else (m.driver,)
        slides = [driver in m.slides for driver in drivers]
        reach = np.where(slides, 1.0, 7.0).reshape(np.shape(m.q0))
        q = m.q0 + reach * rng.uniform(-1.0, 1.0, (POSITIONS, *np.shape(m.q0)))
        motion = m.solve(q, order=1, on_error="nan", threads=1)
        joints = np.stack([motion.joint(n).value for n in m.joints])
        links = {n: motion.link(n).value for n in m.links}
        yield name, Solved(q, motion.status, motion.condition, joints, links)


@dataclass
class Comparison:
    """Counts, worst figures and lists of differences."""

    counts: Counter[str] = field(default_factory=Counter)
    worst: float = 0.0
    statuses: list[str] = field(default_factory=list)
    turns: list[str] = field(default_factory=list)

    def compare(self, name: str, old: Solved, new: Solved) -> None:
        designs = new.status.shape[0] if new.status.ndim > 1 else 1
        self.counts["mechanisms"] += designs
        self.counts["positions"] += new.status.size
        for at in np.argwhere(old.status != new.status):
            i = tuple(at)
            self.statuses.append(
                f"{name}, {i}: status {old.status[i]} → {new.status[i]}, "
                f"κ {old.condition[i]:.3e} → {new.condition[i]:.3e}"
            )
        good = (old.status <= assur.Status.NEAR_SINGULAR) & (old.status == new.status)
        size = np.abs(new.joints).max(axis=(0, -1))
        bound = POSITION * (old.condition + new.condition) * np.maximum(size, 1.0)
        apart = np.abs(old.joints - new.joints).max(axis=(0, -1))[good] / bound[good]
        self.worst = max(self.worst, float(np.max(apart, initial=0.0)))
        for link, angles in new.links.items():
            turned = np.rint((angles - old.links[link]) / (2 * np.pi))
            some = (good & (turned != 0.0)).reshape(designs, -1)
            for design in np.flatnonzero(some.any(axis=1)):
                self.turns.append(f"{name}, design {design}: {link} {some[design].sum()} positions")
                self.judge(name, int(design), self.turns)

    def judge(self, name: str, design: int, found: list[str]) -> None:
        """Adds to the last difference which build goes the shorter way across all gaps."""
        ((_, m),) = (case for case in cases_of(name) if case[0] == name)
        one = m.design(design) if m.shape else m
        if np.ndim(one.q0):
            found[-1] += ": several drivers"
            return
        is_slide = isinstance(one.driver, str) and one.driver in one.slides
        ends = (3.0, -3.0) if is_slide else (7.0,)
        ways = [float(one.q0) + np.linspace(0.0, end, 7001) for end in ends]
        texts = [text for way in ways for text in gap_steps.far(one, way)]
        found[-1] += f": new goes {texts[0]}" if texts else ": new goes the shorter way"
        self.counts["turns, not the shorter way" if texts else "turns, the shorter way"] += 1


def cases_of(name: str) -> Iterator[tuple[str, assur.Mechanism]]:
    kind, seed = name.split()
    return cases(int(seed), int(seed) + 1, kind == "higher")


def elsewhere(package: str, first: int, last: int, higher: bool) -> dict[str, Solved]:
    """What another build finds."""
    with tempfile.NamedTemporaryFile() as file:
        path = os.pathsep.join([package, *sys.path])
        dump = [sys.executable, __file__, "--dump", file.name, str(first), str(last), str(higher)]
        subprocess.run(dump, env={**os.environ, "PYTHONPATH": path}, check=True)
        found: dict[str, Solved] = pickle.loads(Path(file.name).read_bytes())
        return found


def text(result: Comparison) -> str:
    """Figures, then what differs."""
    lines = [f"{what}: {number}" for what, number in sorted(result.counts.items())]
    lines.append(f"joints apart, in the sum of both bounds: {result.worst:.3f}")
    for title, found in (("statuses", result.statuses), ("turns", result.turns)):
        lines += [f"\n{title} that differ: {len(found)}", *(f"- {one}" for one in found[:SHOWN])]
    return "\n".join(lines) + "\n"


def main() -> int:
    if sys.argv[1] == "--dump":
        out, start, stop, kind = sys.argv[2:]
        found = dict(solved(int(start), int(stop), kind == "True"))
        Path(out).write_bytes(pickle.dumps({name: tuple(s) for name, s in found.items()}))
        return 0
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("old", help="folder `python` of a checkout that is built")
    parser.add_argument("new", help="the same, which runs this program")
    parser.add_argument("--count", type=int, default=20_000, help="of class II")
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    parser.add_argument("--higher", type=int, default=2_000, help="of classes III and IV")
    parser.add_argument("--keep", type=Path, help="file for what is found so far")
    given = parser.parse_args()
    if not Path(assur.__file__).resolve().is_relative_to(Path(given.new).resolve()):
        parser.error(f"run this with PYTHONPATH={given.new}:tests/python")
    result = Comparison()
    for count, higher in ((given.count, False), (given.higher, True)):
        end = given.first + count
        for first in range(given.first, end, PORTION):
            last = min(first + PORTION, end)
            old = elsewhere(given.old, first, last, higher)
            for name, new in solved(first, last, higher):
                result.compare(name, Solved(*old[name]), new)
            note = f"\r{last} of {end}: {dict(result.counts)}, joints {result.worst:.3f}, "
            sys.stderr.write(f"{note}{len(result.statuses)} statuses, {len(result.turns)} turns ")
            if given.keep:  # what is found so far
                given.keep.write_text(text(result), encoding="utf-8")
    sys.stdout.write(text(result))
    return 0


if __name__ == "__main__":
    sys.exit(main())
