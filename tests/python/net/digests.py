"""Digests of results of all kinds: the net under changes that must not change a bit.

``python -m net.digests`` (see CONTRIBUTING.md) compares with ``digests.json``; ``--write`` writes
it anew, for a commit that changes results on purpose. The level of vector instructions is read from
ASSUR_SIMD.

Inputs are rounded to ten decimals: sines and logarithms of the platform's library, of which they
are made, differ in their last bits from one processor to another.
"""

from __future__ import annotations

import hashlib
import json
import pathlib
import struct
import sys
from typing import TYPE_CHECKING, Any

import numpy as np

from assur import _core
from net import digest_dynamics, digest_kinematics, digest_papers, digest_refusals, digest_sweeps

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

PINNED = pathlib.Path(__file__).with_name("digests.json")
SECTIONS: dict[str, Callable[[], Iterator[tuple[str, Any]]]] = {
    "kinematics": digest_kinematics.results,
    "dynamics": digest_dynamics.results,
    "papers": digest_papers.results,
    "refusals": digest_refusals.results,
    "sweeps": digest_sweeps.results,
}


def feed(hasher: Any, value: Any) -> None:
    """Numbers by their bits, text and names as they are, in the order given."""
    if isinstance(value, bytes):
        hasher.update(value)
    elif isinstance(value, str) or value is None:
        hasher.update(repr(str(value) if value is not None else None).encode())
    elif isinstance(value, dict):
        feed(hasher, list(value.items()))
    elif isinstance(value, (list, tuple)):
        hasher.update(struct.pack("<q", len(value)))
        for part in value:
            feed(hasher, part)
    else:
        array = np.array(value, order="C")
        if array.dtype.kind not in "biuf":
            message = f"{value!r} has no digest"
            raise TypeError(message)
        if array.dtype.kind == "f":
            # The sign of "not a number" says nothing, and processors differ in it.
            array[np.isnan(array)] = np.nan
        hasher.update(repr((array.dtype.str, array.shape)).encode() + array.tobytes())


def digest(value: Any) -> str:
    hasher = hashlib.blake2b(digest_size=8)
    feed(hasher, value)
    return hasher.hexdigest()


def section(name: str) -> dict[str, str]:
    found: dict[str, str] = {}
    for case, value in SECTIONS[name]():
        if case in found:
            message = f"two cases are called {case!r}"
            raise ValueError(message)
        found[case] = digest(value)
    return found


def pinned() -> dict[str, dict[str, str]]:
    found: dict[str, dict[str, str]] = json.loads(PINNED.read_text())
    return found


def differences(name: str, found: dict[str, str]) -> list[str]:
    """Cases that are not as pinned, or missing, or new."""
    expected = pinned()[name]
    return [case for case in {**expected, **found} if expected.get(case) != found.get(case)]


def main(arguments: list[str]) -> int:
    names = [a for a in arguments if not a.startswith("--")] or list(SECTIONS)
    found = {name: section(name) for name in names}
    if "--write" in arguments:
        whole = {**(pinned() if PINNED.exists() else {}), **found}
        PINNED.write_text(json.dumps(whole, indent=0) + "\n")
    changed = {name: differences(name, found[name]) for name in names}
    json.dump({"level": _core.simd_level(), "changed": changed}, sys.stdout)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
