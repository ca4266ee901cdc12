"""`import assur` needs NumPy and nothing else that must be installed."""

from __future__ import annotations

import subprocess
import sys

import pytest

import assur

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
    """The standard library also takes time at each start (argparse, csv, pathlib)."""
    done = subprocess.run(
        [sys.executable, "-c", BEYOND], capture_output=True, text=True, check=False
    )
    assert done.stdout.split() == ["__future__", "assur"], done.stderr


def test_every_public_name_is_there_when_asked_for() -> None:
    """Modules imported late are listed from the start, with their names."""
    named = set(assur.__all__)
    assert named == {name for name in dir(assur) if name in named}
    for name in named - {"__version__"}:
        thing = getattr(assur, name)
        assert thing.__name__.rpartition(".")[2] == name
    with pytest.raises(AttributeError, match="module 'assur' has no attribute 'Machina'"):
        _ = assur.Machina  # type: ignore[attr-defined]


LATE = """
import sys
import assur

late = ("assur.dynamics", "assur.events", "assur.examples", "assur.flywheel", "assur.papers")
assert not [name for name in sys.modules if name.startswith(late)]
assert not [name for name in set(assur.__all__) - set(dir(assur))]
assert assur.Machine is sys.modules["assur.dynamics.machine"].Machine
"""


def test_machines_and_papers_are_imported_when_asked_for() -> None:
    done = subprocess.run([sys.executable, "-c", LATE], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
