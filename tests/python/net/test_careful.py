"""Kernels and short cuts against the careful path: every position by itself, to the bit."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import design_spaces

# Random mechanisms, each with a space of 24 designs at 40 coordinates.
COUNT = 60


def test_careful_path_gives_the_same_bits() -> None:
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "ASSUR_CARE": "always"}
    command = [sys.executable, design_spaces.__file__, str(COUNT)]
    with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True) as careful:
        own = dict(design_spaces.digests(COUNT))
        found = json.loads(careful.communicate()[0])
    assert found.keys() == own.keys()
    assert [name for name in own if found[name] != own[name]] == []
