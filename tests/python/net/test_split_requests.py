"""The same bits at every level, for every number of coordinates, on any number of threads."""

from __future__ import annotations

import json
import os
from contextlib import ExitStack

from net import bits, split_requests

# Numbers of coordinates: the last blocks of all lengths.
COUNT = 80
LEVELS = ("baseline", "avx2")


def test_levels_sizes_threads_and_splits() -> None:
    assert "ASSUR_SIMD" not in os.environ, "there would be nothing to compare with"
    with ExitStack() as stack:
        program = split_requests.__file__
        started = [bits.elsewhere(program, COUNT, ASSUR_SIMD=level) for level in LEVELS]
        processes = [stack.enter_context(process) for process in started]
        own = dict(split_requests.digests(COUNT))
        found = [json.loads(process.communicate()[0]) for process in processes]
    assert all(own.keys() == other.keys() for other in found)
    assert [
        (name, level)
        for level, other in zip(LEVELS, found, strict=True)
        for name in own
        if own[name] != other[name]
    ] == []
