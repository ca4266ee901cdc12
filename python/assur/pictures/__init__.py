"""Pictures of mechanisms, their motion and forces: matplotlib, one HTML file, drawings.

`Mechanism.plot`, `Motion.plot` and the like draw with good defaults and return the axes; artists
carry names (`get_gid`): ``link coupler``, ``joint B``, ``slide bore``.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from assur.pictures.centres.centrodes import centrodes
    from assur.pictures.centres.inflection import inflection_circle
    from assur.pictures.centres.instant_centres import instant_centres
    from assur.pictures.plans.hodograph import hodograph

__all__ = ["centrodes", "hodograph", "inflection_circle", "instant_centres"]

# Imported at first use: they need matplotlib, and explain it (PEP 562).
_LATER = {
    "centrodes": "centres.centrodes",
    "hodograph": "plans.hodograph",
    "inflection_circle": "centres.inflection",
    "instant_centres": "centres.instant_centres",
}


def __getattr__(name: str) -> object:
    if name not in _LATER:
        message = f"module {__name__!r} has no attribute {name!r}"
        raise AttributeError(message)
    return getattr(import_module(f"{__name__}.{_LATER[name]}"), name)


def __dir__() -> list[str]:
    return __all__
