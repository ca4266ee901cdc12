"""Kinematics and dynamics of planar linkages, solved one Assur group after another."""

from assur import crank_rocker, flywheel, slider_crank
from assur._core import version
from assur.analogues import Analogues
from assur.class_iv import ClassIV
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
from assur.sensitivity import Sensitivity
from assur.structure import Group, Structure

__all__ = [
    "Analogues",
    "Assembly",
    "AssurError",
    "AssurWarning",
    "ClassIV",
    "DimensionError",
    "Drive",
    "FourBar",
    "Group",
    "InputError",
    "Mechanism",
    "Motion",
    "PositionError",
    "Sensitivity",
    "Slide",
    "SliderCrank",
    "Status",
    "Structure",
    "StructureError",
    "__version__",
    "crank_rocker",
    "flywheel",
    "slider_crank",
]

__version__ = version()
