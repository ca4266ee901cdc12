"""Kinematics and dynamics of planar linkages, solved one Assur group after another."""

from assur import events, flywheel
from assur._core import version
from assur.description.structure import Group, Structure
from assur.description.words import Assembly, Drive, Slide, Status
from assur.dynamics.loads import (
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
from assur.dynamics.machine import Machine
from assur.dynamics.motors import ConstantTorque, InductionMotor, LinearMotor
from assur.dynamics.run import Run
from assur.dynamics.steady import SteadyState
from assur.errors import (
    AssurError,
    AssurWarning,
    DimensionError,
    InputError,
    PositionError,
    StructureError,
)
from assur.kinematics.mechanism import Mechanism
from assur.kinematics.motion import Motion
from assur.kinematics.quantity import Analogues
from assur.kinematics.sensitivity import Sensitivity
from assur.mechanisms.class_iv import ClassIV
from assur.mechanisms.named import FourBar, SliderCrank
from assur.papers import crank_rocker, slider_crank

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
