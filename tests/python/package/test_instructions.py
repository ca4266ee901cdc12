"""Vector instructions are inlined in the kernels: a called intrinsic makes a sweep slow."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys

import pytest

from assur import _core

# The only function that may call them: it reduces angles above three million one by one.
COLD = "reduce_far"
# An extension built without optimisation calls them from thousands of functions.
UNOPTIMISED = 300


def calls() -> list[str]:
    """Names of the functions that call an intrinsic, once for every call."""
    disassemble = ["objdump", "--disassemble", "--no-show-raw-insn", "--demangle", _core.__file__]
    found, function = [], ""
    with subprocess.Popen(disassemble, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        for line in process.stdout:
            if start := re.fullmatch(r"[0-9a-f]+ <(.*)>:\n", line):
                function = start[1]
            elif "call" in line and "::_mm" in line:
                found.append(function)
    return found


@pytest.mark.skipif(sys.platform != "linux", reason="objdump reads this system's files")
@pytest.mark.skipif(shutil.which("objdump") is None, reason="objdump is not installed")
def test_no_intrinsic_is_called() -> None:
    found = calls()
    if len(set(found)) > UNOPTIMISED:
        pytest.skip("the extension was built without optimisation")
    assert [name for name in found if COLD not in name] == []
