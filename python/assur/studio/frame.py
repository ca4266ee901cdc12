"""Answers as frames: the length of a header, the header as JSON, then the arrays that it names."""

from __future__ import annotations

import json
import math
import struct
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.errors import InputError
from assur.studio.limits import MIB, MOST_DOWN

if TYPE_CHECKING:
    import numpy.typing as npt

# Where each array begins, so that a page can lay a Float64Array over it.
ALIGNED = 8
# Arrays of other types become Float64.
AS_THEY_ARE = (np.uint8, np.float32)
COMPACT = (",", ":")


def encode(header: Mapping[str, Any], arrays: Mapping[str, npt.NDArray[Any]]) -> bytes:
    """Return a frame.

    Parameters
    ----------
    header : mapping
        What the frame says; ``arrays`` is added: name, type and shape of each, in order.
    arrays : mapping of str to ndarray
        Numbers as Float64, bytes as Uint8.

    Returns
    -------
    bytes
        Uint32 (little-endian) length of the JSON, the JSON, zeros up to a multiple of 8, and every
        array followed by zeros up to a multiple of 8.
    """
    packed = {name: _packed(array) for name, array in arrays.items()}
    listed = [
        {"name": name, "type": array.dtype.name, "shape": array.shape}
        for name, array in packed.items()
    ]
    text = _json({**header, "arrays": listed})
    parts = [struct.pack("<I", len(text)), text, _zeros(4 + len(text))]
    for array in packed.values():
        raw = array.tobytes()
        parts += [raw, _zeros(len(raw))]
    size = sum(map(len, parts))
    if size > MOST_DOWN:
        message = (
            f"the answer would have {size / MIB:.1f} MiB, of {MOST_DOWN // MIB}: ask for fewer rows"
        )
        raise InputError(message, kind="too_large")
    return b"".join(parts)


def decode(frame: bytes) -> tuple[dict[str, Any], dict[str, npt.NDArray[Any]]]:
    """Return the header and the arrays of a frame, as a page reads them."""
    (length,) = struct.unpack_from("<I", frame)
    header = json.loads(frame[4 : 4 + length])
    at = 4 + length + len(_zeros(4 + length))
    arrays = {}
    for entry in header["arrays"]:
        kind: Any = np.dtype(entry["type"]).newbyteorder("<")
        count = math.prod(entry["shape"])
        arrays[entry["name"]] = np.frombuffer(frame, kind, count, at).reshape(entry["shape"])
        at += count * kind.itemsize
        at += len(_zeros(at))
    return header, arrays


def _json(header: Mapping[str, Any]) -> bytes:
    try:
        text = json.dumps(
            header, ensure_ascii=False, allow_nan=False, default=plain, separators=COMPACT
        )
    except ValueError:
        # Numbers that are not finite are rare, and looking for them takes time.
        text = json.dumps(plain(header), ensure_ascii=False, separators=COMPACT)
    # A page may send half a letter as the name of a joint.
    return text.encode(errors="replace")


def plain(value: Any) -> Any:
    """Return a value as JSON has it: numbers that are not finite become null."""
    if isinstance(value, float | np.floating):
        return float(value) if math.isfinite(value) else None
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, Mapping):
        return {str(key): plain(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [plain(entry) for entry in value]
    if isinstance(value, np.integer | np.bool_):
        return value.item()
    return value


def _packed(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    kind = array.dtype.newbyteorder("<") if array.dtype in AS_THEY_ARE else "<f8"
    return np.ascontiguousarray(array, dtype=kind)


def _zeros(size: int) -> bytes:
    return bytes(-size % ALIGNED)
