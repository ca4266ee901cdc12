"""Fuzzes the Python entries with atheris: `python fuzz/entries.py [options of libFuzzer]`."""

import importlib
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parents[1] / "tests" / "python"))
atheris = importlib.import_module("atheris")  # not among the tools of `make test`
with atheris.instrument_imports(include=["assur"]):
    entries = importlib.import_module("fuzzing.fuzz_entries")

atheris.Setup(sys.argv, entries.one_input)
atheris.Fuzz()
