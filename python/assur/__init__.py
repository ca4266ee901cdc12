"""Kinematics and dynamics of planar linkages, solved one Assur group after another."""

from assur._core import version
from assur.analogues import Analogues
from assur.description import Assembly, Drive, Slide, Status
from assur.errors import (
    AssurError,
    AssurWarning,
    DimensionError,
    InputError,
    PositionError,
    StructureError,
)
from assur.mechanism import Mechanism
from assur.motion import Motion
from assur.named import FourBar, SliderCrank
from assur.structure import Group, Structure

__all__ = [
    "Analogues",
    "Assembly",
    "AssurError",
    "AssurWarning",
    "DimensionError",
    "Drive",
    "FourBar",
    "Group",
    "InputError",
    "Mechanism",
    "Motion",
    "PositionError",
    "Slide",
    "SliderCrank",
    "Status",
    "Structure",
    "StructureError",
    "__version__",
]

__version__ = version()
