"""Kinematics and dynamics of planar linkages, solved one Assur group after another."""

from assur import crank_rocker, events, flywheel, slider_crank
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
from assur.loads import (
    Body,
    Damper,
    Force,
    Gravity,
    Spring,
    Table,
    Torque,
    TorsionDamper,
    TorsionSpring,
)
from assur.machine import Machine
from assur.mechanism import Mechanism
from assur.motion import Motion
from assur.motors import ConstantTorque, InductionMotor, LinearMotor
from assur.named import FourBar, SliderCrank
from assur.run import Run
from assur.sensitivity import Sensitivity
from assur.steady import SteadyState
from assur.structure import Group, Structure

__all__ = [
    "Analogues",
    "Assembly",
    "AssurError",
    "AssurWarning",
    "Body",
    "ClassIV",
    "ConstantTorque",
    "Damper",
    "DimensionError",
    "Drive",
    "Force",
    "FourBar",
    "Gravity",
    "Group",
    "InductionMotor",
    "InputError",
    "LinearMotor",
    "Machine",
    "Mechanism",
    "Motion",
    "PositionError",
    "Run",
    "Sensitivity",
    "Slide",
    "SliderCrank",
    "Spring",
    "Status",
    "SteadyState",
    "Structure",
    "StructureError",
    "Table",
    "Torque",
    "TorsionDamper",
    "TorsionSpring",
    "__version__",
    "crank_rocker",
    "events",
    "flywheel",
    "slider_crank",
]

__version__ = version()
