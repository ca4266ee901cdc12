"""Results are those pinned in digests.json, to the bit, at every level of vector instructions."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest

from net import digests

LEVELS = ("baseline", "avx2", "avx512")


@pytest.mark.parametrize("level", LEVELS)
def test_no_result_changes(level: str) -> None:
    """The level is read once a process: each runs in one of its own."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "ASSUR_SIMD": level}
    command = [sys.executable, digests.__file__]
    found = json.loads(subprocess.check_output(command, env=environment, text=True))
    if found["level"] != level:
        pytest.skip(f"this processor has no {level}: {found['level']} at the most")
    assert found["changed"] == {name: [] for name in digests.SECTIONS}


@pytest.mark.parametrize("section", digests.SECTIONS)
def test_a_changed_case_is_named(section: str) -> None:
    """The comparison can fail: by a digest that is another, missing or new."""
    found = dict(digests.pinned()[section])
    assert digests.differences(section, found) == []
    first, second, *_ = found
    found[first] = digests.digest(0.1 + 0.2)
    del found[second]
    found["new"] = digests.digest("x")
    assert digests.differences(section, found) == [first, second, "new"]


def test_a_digest_is_of_every_bit() -> None:
    assert digests.digest([0.3]) != digests.digest([0.1 + 0.2])
    assert digests.digest(0.0) != digests.digest(-0.0)
    assert digests.digest([1.0, [2.0]]) != digests.digest([[1.0], 2.0])
    assert digests.digest(float("nan")) == digests.digest(-float("nan"))
    with pytest.raises(TypeError):
        digests.digest(object())
