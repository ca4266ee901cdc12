"""Errors of the papers' series and of the crank-rocker that jams: a case for each kind."""

from __future__ import annotations

import math

import assur
from assur import InputError, PositionError
from models.errors.error_case import Case

SERIES: dict[str, Case] = {
    "does_not_end": Case(
        InputError,
        lambda: assur.slider_crank.fourier(1.0 + 1e-12),
        {"value": 1.0 + 1e-12},
    ),
}

JAMMING: dict[str, Case] = {
    "blocked": Case(
        PositionError,
        lambda: assur.crank_rocker.run(1, 4.5, 1.5, 4.995, gamma_min=0.2, phi0=0.0),
        # BD is 5.995 m: the law of cosines.
        {"q": 0.0, "value": math.acos((5.995**2 - 4.5**2 - 1.5**2) / (2.0 * 4.5 * 1.5))},
    ),
    "out_of_reach": Case(
        PositionError,
        lambda: assur.crank_rocker.run(1, 4.5, 1.5, 8.0, gamma_min=0.2, phi0=0.5 * math.pi),
        {"q": 0.5 * math.pi, "value": math.sqrt(65.0)},
    ),
}
