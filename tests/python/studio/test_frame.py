"""Frames: what is packed is read again, by Python and by the page."""

from __future__ import annotations

import json
import math
import struct
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur.studio.frame import decode, encode
from support.node import run_node

if TYPE_CHECKING:
    import numpy.typing as npt

HEADERS: list[dict[str, Any]] = [
    {},
    {"a": "é"},
    {"a": "x" * 5},
    {"a": [1, None, {"b": "\u2028</script>"}]},
]


@pytest.mark.parametrize("header", HEADERS)
def test_round_trip(header: dict[str, Any]) -> None:
    rng = np.random.default_rng(1)
    arrays: dict[str, npt.NDArray[Any]] = {
        "values": rng.standard_normal((3, 5, 2)),
        "reason": np.arange(7, dtype=np.uint8),
        "none": np.zeros((0, 2)),
        "after": np.array([np.nan, np.inf, -0.0]),
        "flags": np.array([True, False]),
        "passing": np.array([0.1, np.nan, -2.0], dtype=np.float32),
    }
    frame = encode(header, arrays)
    assert len(frame) % 8 == 0
    found, read = decode(frame)
    listed = found.pop("arrays")
    assert found == header
    assert [one["name"] for one in listed] == list(arrays)
    for name, array in arrays.items():
        assert np.array_equal(read[name], array, equal_nan=True)
    # Each begins where a Float64Array may.
    (length,) = struct.unpack_from("<I", frame)
    assert frame[4 + length : 4 + length + (-(4 + length) % 8)].strip(b"\0") == b""


def test_numbers_that_are_not_finite() -> None:
    header = {"a": math.inf, "b": [np.float64("nan"), np.array([1.0, -np.inf])], "c": np.int64(3)}
    assert decode(encode(header, {}))[0] == {
        "a": None,
        "b": [None, [1.0, None]],
        "c": 3,
        "arrays": [],
    }
    assert decode(encode({"a": np.bool_(True), "b": (1, 2)}, {}))[0]["a"] is True


def test_halves_of_letters() -> None:
    assert decode(encode({"a": "\ud800"}, {}))[0]["a"] == "?"


def test_too_large() -> None:
    with pytest.raises(assur.InputError, match="ask for fewer rows") as refused:
        encode({}, {"a": np.zeros(2**20 + 1)})
    assert refused.value.kind == "too_large"


def test_the_page_reads_the_same() -> None:
    arrays: dict[str, npt.NDArray[Any]] = {
        "v": np.array([[1.5, -2.0], [np.nan, 1e-300]]),
        "r": np.array([1, 2, 255], np.uint8),
    }
    frame = encode({"é": "ü"}, {**arrays, "w": np.array([7.25])})
    text = run_node(
        "--input-type=module",
        "-e",
        """
        import { decode } from "./python/assur/studio/page/model/link.js";
        const bytes = Uint8Array.from(JSON.parse(process.argv[1]));
        const { header, arrays } = decode(bytes.buffer);
        const listed = Object.entries(arrays).map(([name, one]) => [name, [...one].map(String)]);
        console.log(JSON.stringify([header["é"], Object.fromEntries(listed)]));
        """,
        json.dumps([*frame]),
    )
    assert json.loads(text) == [
        "ü",
        {"v": ["1.5", "-2", "NaN", "1e-300"], "r": ["1", "2", "255"], "w": ["7.25"]},
    ]
