"""The memory of dropped results is reused: no new pages, no mixed results."""

from __future__ import annotations

import ctypes
import os
import resource
import subprocess
import sys
import threading
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

import assur

if TYPE_CHECKING:
    import numpy.typing as npt

Q = np.linspace(0.0, 2 * np.pi, 360)
# Numbers of a call: 40 designs, two coordinates of C and an angle, to order 2; 1 MB.
DESIGNS = 40
PR_SET_THP_DISABLE = 41


def batch(designs: int = DESIGNS) -> assur.Mechanism:
    return assur.FourBar(1.0, np.linspace(2.8, 3.2, designs), 2.5, 3.0)


def solve(m: assur.Mechanism) -> assur.Motion:
    return m.solve(Q, outputs=["C", "rocker"], on_error="nan", threads=1)


def faults() -> int:
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt


def digest(motion: assur.Motion) -> bytes:
    held = motion.joint("C"), motion.link("rocker")
    return b"".join(np.ascontiguousarray(a).tobytes() for h in held for a in (h.value, h.d1, h.d2))


def without_huge_pages() -> None:
    """Make every 4 KiB of new memory one fault, as they are where memory is short."""
    prctl = getattr(ctypes.CDLL(None), "prctl", None)
    assert prctl is not None
    assert prctl(PR_SET_THP_DISABLE, 1, 0, 0, 0) == 0


@pytest.mark.skipif(sys.platform != "linux", reason="pages are counted as Linux does")
@pytest.mark.parametrize(("designs", "calls"), [(DESIGNS, 1000), (7000, 10)])
def test_calls_need_no_new_pages(designs: int, calls: int) -> None:
    """A call of 40 designs would need 250 new pages, one of 7000 designs 44 000."""
    program = f"""
import sys
sys.path[:0] = {sys.path!r}
from test_result_memory import batch, faults, solve, without_huge_pages

without_huge_pages()
m = batch({designs})
for _ in range(5):
    solve(m)
before = faults()
for _ in range({calls}):
    solve(m)
print(faults() - before)
"""
    found = subprocess.run(
        [sys.executable, "-c", program],
        check=True,
        timeout=120,
        cwd=Path(__file__).parent,
        capture_output=True,
        text=True,
    )
    assert int(found.stdout) < 5000


PROGRAM_OF_METRICS = """
import sys
sys.path[:0] = {path!r}
import numpy as np
import assur
from test_result_memory import batch, faults, resident, without_huge_pages

without_huge_pages()
m = batch({designs})
q = np.linspace(0.0, 2 * np.pi, {positions}, endpoint=False)
asked = {{"off": assur.metric.deviation("C"), "swing": assur.metric.span("rocker", order=2)}}
assur.sweep(batch(10), {{}}, q[:9], metrics=asked)
before = faults()
for _ in range({calls}):
    assur.sweep(m, {{}}, q, metrics=asked, threads=1)
print(faults() - before)
"""


def pages_of_metrics(designs: int, positions: int, calls: int = 1) -> int:
    program = PROGRAM_OF_METRICS.format(
        path=sys.path, designs=designs, positions=positions, calls=calls
    )
    found = subprocess.run(
        [sys.executable, "-c", program],
        check=True,
        timeout=120,
        cwd=Path(__file__).parent,
        capture_output=True,
        text=True,
    )
    return int(found.stdout)


@pytest.mark.skipif(sys.platform != "linux", reason="pages are counted as Linux does")
def test_memory_of_metrics_does_not_grow_with_positions() -> None:
    """Stored, the motions of 2000 designs at 1440 positions would need 65 000 pages."""
    few, many = pages_of_metrics(2000, 72), pages_of_metrics(2000, 1440)
    assert many - few < 2000
    # Two metrics, a status and 7 dimensions of 100 000 designs are 1800 pages. Solving them at one
    # position, to store all joints, would take 5000 more.
    assert pages_of_metrics(100_000, 8) < 3600
    assert pages_of_metrics(2000, 72, calls=50) < 5000


def test_results_that_are_held_stay() -> None:
    m = batch()
    expected = digest(solve(m))
    held = [solve(m) for _ in range(5)]
    views: list[npt.NDArray[np.float64]] = [motion.joint("C").value[3:5, ::2] for motion in held]
    copies = [view.copy() for view in views]
    addresses = {motion.joint("C").value.__array_interface__["data"][0] for motion in held}
    assert len(addresses) == 5
    del held
    for other in (batch(), batch(DESIGNS + 1), batch(2 * DESIGNS)):
        solve(other)
    for view, copied in zip(views, copies, strict=True):
        assert np.array_equal(view, copied)
    assert digest(solve(m)) == expected


def test_threads_do_not_share_memory() -> None:
    batches = [
        assur.FourBar(1.0, np.linspace(2.6 + 0.1 * i, 3.2, DESIGNS), 2.5, 3.0) for i in range(4)
    ]
    expected = [digest(solve(m)) for m in batches]
    wrong: list[int] = []

    def work(i: int) -> None:
        wrong.extend(i for _ in range(50) if digest(solve(batches[i])) != expected[i])

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
def test_a_fork_has_memory_of_its_own() -> None:
    program = f"""
import os, sys
sys.path[:0] = {sys.path!r}
import numpy as np
from test_result_memory import batch, digest, solve

m = batch()
expected = digest(solve(m))
solve(m)
child = os.fork()
good = all(digest(solve(m)) == expected for _ in range(20))
if child == 0:
    os._exit(0 if good else 1)
_, status = os.waitpid(child, 0)
assert good and status == 0
"""
    subprocess.run(
        [sys.executable, "-c", program], check=True, timeout=60, cwd=Path(__file__).parent
    )


def test_only_the_last_call_is_kept() -> None:
    """A call frees what it does not reuse."""
    large = batch(4000)
    size = 4000 * 360 * 9 * 8
    solve(large)
    solve(batch(1))
    before = resident()
    solve(large)
    solve(batch(1))
    assert resident() - before < size // 4


def resident() -> int:
    pages = Path("/proc/self/statm").read_text().split()[1]
    return int(pages) * resource.getpagesize()
