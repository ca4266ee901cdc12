"""Flywheels: speed over one turn from moment and inertia, and the flywheel that smooths it.

The machine is referred to its driver: a reduced moment M (N·m) of all loads and a reduced inertia I
(kg·m²) over one period. A constant motor balances the mean moment of the loads; the speed follows
from the energy integral, ω² = (2 ∫(M + M_motor) dφ + (I(0) + I_f) ω0²) / (I + I_f).

References
----------
I. M. Matsyuk, E. M. Shlyakhov, *Dynamic synthesis of a lever mechanism by the coefficient of speed
fluctuation in Mathcad*, equations 1 to 6. F. Wittenbauer, *Graphische Dynamik* (1923).
"""

from assur._extreme import Extreme
from assur._splines import SPLINES, Spline
from assur.flywheel.result import MEANS, Flywheel, Mean
from assur.flywheel.sizing import evaluate, from_table
from assur.flywheel.table_file import ReducedTable, read_table

__all__ = [
    "MEANS",
    "SPLINES",
    "Extreme",
    "Flywheel",
    "Mean",
    "ReducedTable",
    "Spline",
    "evaluate",
    "from_table",
    "read_table",
]
