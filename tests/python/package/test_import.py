"""`import assur` takes NumPy and nothing else that has to be installed."""

from __future__ import annotations

import subprocess
import sys

# Every top-level module that is neither Python's own nor NumPy is refused, as where it is missing.
ALONE = """
import sys

class Missing:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] not in known:
            raise ModuleNotFoundError(f"No module named {name!r}")

known = {*sys.stdlib_module_names, "numpy", "assur"}
sys.meta_path.insert(0, Missing())
import assur

assert assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(1.0).joint("C").value.shape == (2,)
"""


def test_numpy_is_all_that_is_needed() -> None:
    done = subprocess.run(
        [sys.executable, "-c", ALONE], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


# What NumPy and dataclasses bring is there; what assur brings beyond them costs time at each start.
BEYOND = """
import sys
import dataclasses, numpy, numpy.typing

before = set(sys.modules)
import assur

print(*sorted({name.partition(".")[0] for name in set(sys.modules) - before}))
"""


def test_nothing_is_imported_beyond_numpy_and_dataclasses() -> None:
    """Modules that one function needs (csv, pathlib, argparse) are imported there."""
    done = subprocess.run(
        [sys.executable, "-c", BEYOND], capture_output=True, text=True, check=False
    )
    assert done.stdout.split() == ["__future__", "assur"], done.stderr
