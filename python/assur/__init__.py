"""Kinematics and dynamics of planar linkages, solved one Assur group after another.

Describe a linkage, solve it, make a batch of designs, add masses and loads (SI units, rad):

>>> import assur
>>> fourbar = assur.FourBar(crank=1.0, coupler=3.0, rocker=2.5, ground=3.0)   # or assur.Mechanism
>>> motion = fourbar.solve([0.0, 1.0, 2.0], order=2)                          # crank angles, rad
>>> motion.link("rocker").velocity(speed=10.0).round(4)                       # rad/s
array([-5.    ,  1.9536,  4.0563])
>>> batch = fourbar.with_dimensions({"coupler.length": [2.8, 3.0, 3.2]})      # three designs
>>> batch.solve([0.0, 1.0, 2.0]).joint("C").value.shape                       # (design, q, x and y)
(3, 3, 2)
>>> machine = assur.Machine(
...     fourbar, bodies={"rocker": assur.Body(inertia=0.5)}, loads=[assur.Gravity()]
... )
>>> machine.reduced_inertia(1.0).value.round(4)                               # kg·m²
np.float64(0.0191)
"""

from importlib import import_module
from typing import TYPE_CHECKING

from assur import _later
from assur._core import version
from assur._remedy import Remedy
from assur._units import rpm
from assur.description.structure import Group, Structure
from assur.description.words import Cylinder, Drive, Slide, Status
from assur.errors import (
    AssurError,
    AssurWarning,
    DimensionError,
    FitError,
    InputError,
    MotionError,
    PositionError,
    StructureError,
)
from assur.kinematics.assembly import Assemblies, Assembly
from assur.kinematics.curve.curve import ConfigurationCurve
from assur.kinematics.derivatives.sensitivity import Sensitivity
from assur.kinematics.limits import DeadPoint, Limits
from assur.kinematics.mechanism import Mechanism
from assur.kinematics.motion import Motion
from assur.kinematics.quantity import Analogues
from assur.mechanisms.class_iv import ClassIV
from assur.mechanisms.named import FourBar, SliderCrank

if TYPE_CHECKING:
    from assur import (
        adapters,
        balance,
        events,
        examples,
        files,
        flywheel,
        importers,
        laws,
        metric,
        pictures,
        target,
    )
    from assur.dynamics.loads.friction import JointFriction, SlideFriction
    from assur.dynamics.loads.loads import (
        Body,
        Damper,
        Force,
        Gas,
        Gravity,
        Pressure,
        Spring,
        Table,
        Torque,
        TorsionDamper,
        TorsionSpring,
    )
    from assur.dynamics.loads.motors import ConstantTorque, InductionMotor, LinearMotor
    from assur.dynamics.machine import Machine
    from assur.dynamics.motion.run import Run
    from assur.dynamics.motion.runs import Runs
    from assur.dynamics.motion.steady import SteadyState
    from assur.files.contents import load
    from assur.fitting.design import DesignFit
    from assur.fitting.fit import fit
    from assur.fitting.fits import Fits
    from assur.fitting.found import Fit
    from assur.fitting.linkage import LinkageFit
    from assur.fitting.pareto.front import ParetoFront
    from assur.fitting.pareto.pareto import pareto
    from assur.fitting.search import search
    from assur.kinematics.curve.design_defects import Defect
    from assur.kinematics.loci.maps import DesignMap
    from assur.kinematics.loci.singular import SingularLocus, Workspace
    from assur.papers import crank_rocker, slider_crank
    from assur.sweeps.grid import Grid
    from assur.sweeps.measures import Measures
    from assur.sweeps.sweep import sweep

__all__ = [
    "Analogues",
    "Assemblies",
    "Assembly",
    "AssurError",
    "AssurWarning",
    "Body",
    "ClassIV",
    "ConfigurationCurve",
    "ConstantTorque",
    "Cylinder",
    "Damper",
    "DeadPoint",
    "Defect",
    "DesignFit",
    "DesignMap",
    "DimensionError",
    "Drive",
    "Fit",
    "FitError",
    "Fits",
    "Force",
    "FourBar",
    "Gas",
    "Gravity",
    "Grid",
    "Group",
    "InductionMotor",
    "InputError",
    "JointFriction",
    "Limits",
    "LinearMotor",
    "LinkageFit",
    "Machine",
    "Measures",
    "Mechanism",
    "Motion",
    "MotionError",
    "ParetoFront",
    "PositionError",
    "Pressure",
    "Remedy",
    "Run",
    "Runs",
    "Sensitivity",
    "SingularLocus",
    "Slide",
    "SlideFriction",
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
    "Workspace",
    "__version__",
    "adapters",
    "balance",
    "crank_rocker",
    "events",
    "examples",
    "files",
    "fit",
    "flywheel",
    "importers",
    "laws",
    "load",
    "metric",
    "pareto",
    "pictures",
    "rpm",
    "search",
    "slider_crank",
    "sweep",
    "target",
]

__version__ = version()

# Imported at first use: more than half of what `import assur` would take (PEP 562).
_LATER = {
    "assur": (
        "adapters",
        "balance",
        "events",
        "examples",
        "files",
        "flywheel",
        "importers",
        "laws",
        "metric",
        "pictures",
        "target",
    ),
    "assur.dynamics.loads.friction": ("JointFriction", "SlideFriction"),
    "assur.dynamics.loads.loads": (
        "Body",
        "Damper",
        "Force",
        "Gas",
        "Gravity",
        "Pressure",
        "Spring",
        "Table",
        "Torque",
        "TorsionDamper",
        "TorsionSpring",
    ),
    "assur.dynamics.machine": ("Machine",),
    "assur.dynamics.loads.motors": ("ConstantTorque", "InductionMotor", "LinearMotor"),
    "assur.dynamics.motion.run": ("Run",),
    "assur.dynamics.motion.runs": ("Runs",),
    "assur.dynamics.motion.steady": ("SteadyState",),
    "assur.files.contents": ("load",),
    "assur.fitting.design": ("DesignFit",),
    "assur.fitting.fit": ("fit",),
    "assur.fitting.fits": ("Fits",),
    "assur.fitting.found": ("Fit",),
    "assur.fitting.linkage": ("LinkageFit",),
    "assur.fitting.pareto.front": ("ParetoFront",),
    "assur.fitting.pareto.pareto": ("pareto",),
    "assur.fitting.search": ("search",),
    "assur.kinematics.curve.design_defects": ("Defect",),
    "assur.kinematics.loci.maps": ("DesignMap",),
    "assur.kinematics.loci.singular": ("SingularLocus", "Workspace"),
    "assur.papers": ("crank_rocker", "slider_crank"),
    "assur.sweeps.grid": ("Grid",),
    "assur.sweeps.measures": ("Measures",),
    "assur.sweeps.sweep": ("sweep",),
}
# What methods of lower floors call by these names.
_later.register("save", "assur.files.write", "save")
_later.register("explore", "assur.studio.notebook", "Explorer")

_HOME = {name: home for home, names in _LATER.items() for name in names}

if not TYPE_CHECKING:  # a type checker would take any name for one of the package

    def __getattr__(name):
        if name not in _HOME:
            message = f"module 'assur' has no attribute {name!r}"
            raise AttributeError(message, name=name, obj=import_module(__name__))
        home = _HOME[name]
        if home in ("assur", "assur.papers"):
            value = import_module(f"{home}.{name}")
        else:
            value = getattr(import_module(home), name)
        globals()[name] = value
        return value

    def __dir__():
        return sorted({*globals(), *_HOME})
