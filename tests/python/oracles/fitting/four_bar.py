"""A four-bar in complex numbers: shares no code with the package."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt


def moved(dimensions: Mapping[str, Any], sign: int, q: Any) -> dict[str, npt.NDArray[Any]]:
    """Return joints B, C, P and the rocker's angle; C is left of the ray D → B for sign -1."""
    a = complex(dimensions["ground.A.x"], dimensions["ground.A.y"])
    d = complex(dimensions["ground.D.x"], dimensions["ground.D.y"])
    b = a + dimensions["crank.length"] * np.exp(1j * np.asarray(q))
    chord = b - d
    size = np.abs(chord)
    coupler, rocker = dimensions["coupler.length"], dimensions["rocker.length"]
    along = (size**2 + rocker**2 - coupler**2) / (2.0 * size)
    with np.errstate(invalid="ignore"):
        across = np.sqrt(rocker**2 - along**2)
    c = d + (along - 1j * sign * across) * chord / size
    axis = (c - b) / coupler
    p = b + axis * complex(dimensions.get("coupler.P.x", 0.0), dimensions.get("coupler.P.y", 0.0))
    return {"B": b, "C": c, "P": p, "axis": axis, "rocker": np.angle(c - d)}


def transmission(dimensions: Mapping[str, Any], sign: int, q: Any) -> npt.NDArray[Any]:
    """Return the acute angle between coupler and rocker."""
    at = moved(dimensions, sign, q)
    d = complex(dimensions["ground.D.x"], dimensions["ground.D.y"])
    cosine = np.real(at["axis"] * np.conj((at["C"] - d) / dimensions["rocker.length"]))
    return np.asarray(np.arccos(np.abs(cosine)))


def turns(dimensions: Mapping[str, Any]) -> bool:
    """Whether the crank goes round, by Grashof's rule."""
    ground = np.hypot(
        dimensions["ground.D.x"] - dimensions["ground.A.x"],
        dimensions["ground.D.y"] - dimensions["ground.A.y"],
    )
    crank, coupler, rocker = (dimensions[f"{n}.length"] for n in ("crank", "coupler", "rocker"))
    lengths = sorted([ground, crank, coupler, rocker])
    is_grashof = lengths[0] + lengths[3] < lengths[1] + lengths[2]
    return bool(is_grashof and min(crank, ground) == lengths[0])
