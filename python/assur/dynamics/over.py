"""Coordinates that loads are over."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.dynamics.table import Table
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from assur.kinematics.mechanism import Mechanism

__all__ = ["require_turning"]

# Coordinates beside the drawing's, rad or m, at which a link that never turns has the same angle.
BESIDE = (-1e-3, 0.0, 1e-3)


def require_turning(mechanism: Mechanism, loads: Sequence[Any]) -> None:
    """Refuse loads over the angle of a link that never turns: it would never act, or always."""
    for load in loads:
        for name in _named(load):
            if name in mechanism.links and not _turns(mechanism, name):
                raise InputError(_message(mechanism, load, name), link=name)


def _named(load: Any) -> Iterator[str]:
    if getattr(load, "over", None) is not None:
        yield load.over
    values = (getattr(load, part, None) for part in ("force", "torque", "pressure"))
    for value in values:
        for one in value if isinstance(value, tuple) else (value,):
            if isinstance(one, Table) and one.over is not None:
                yield one.over


def _turns(mechanism: Mechanism, link: str) -> bool:
    drawn = mechanism._with_values(np.array(mechanism._core.drawing))
    q = drawn._q0_array() + np.multiply.outer(BESIDE, np.ones(drawn._driver_count))
    places = q if drawn._driver_count > 1 else q[:, 0]
    angles = drawn.solve(places, order=0, outputs=[link], on_error="nan").link(link).value
    return not (np.isfinite(angles).all() and bool((angles == angles[0]).all()))


def _message(mechanism: Mechanism, load: Any, link: str) -> str:
    slides = [name for name, slide in mechanism.slides.items() if slide.link == link]
    hint = f': its travel is the slide "{slides[0]}"' if slides else ""
    return f'{type(load).__name__}: over="{link}": this link does not turn{hint}'
