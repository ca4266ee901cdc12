"""The public interface keeps its rules: names, order and defaults of arguments."""

from __future__ import annotations

import inspect
from collections import defaultdict
from typing import Any

import pytest

from interface.public_interface import TABLE, callables, table

POSITIONAL = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
# What users read, and do not make.
RESULTS = {
    *(
        "Analogues",
        "Assemblies",
        "Assembly",
        "ConfigurationCurve",
        "DeadPoint",
        "DesignMap",
        "Fit",
        "Fits",
        "Group",
    ),
    *(
        "Limits",
        "Measures",
        "Motion",
        "ParetoFront",
        "Remedy",
        "Run",
        "Sensitivity",
        "SingularLocus",
        "SteadyState",
    ),
    *("Structure", "Workspace", "balance.Harmonics", "balance.RotatingParts", "files.Contents"),
    *("crank_rocker.JammingEvent", "crank_rocker.JammingRun", "crank_rocker.Solution"),
    *("crank_rocker.Table1", "flywheel.Extreme", "flywheel.Flywheel", "flywheel.ReducedTable"),
    *("importers.Imported", "slider_crank.Deviation", "metric.Condition", "laws.Sequence"),
}
# Arguments that may be left out and still stand in their place, as they are read there.
READ_IN_PLACE = {
    "Analogues.acceleration": 1,
    "Analogues.jerk": 2,
    "ClassIV": 1,
    "adapters.jax.step": 1,
    "adapters.scipy.Residuals": 1,
    "adapters.scipy.StateEquations": 1,
    "ConfigurationCurve.motion": 1,
    "ConfigurationCurve.plot": 1,
    "Gravity": 1,
    "Grid": 1,
    "Machine.acceleration": 3,
    "Machine.d_acceleration": 3,
    "Machine.d_effort": 3,
    "Machine.duty": 3,
    "Machine.dynamics": 2,
    "Machine.effort": 3,
    "Machine.impact": 2,
    "Machine.internal_loads": 3,
    "Machine.from_table": 1,
    "Machine.linearize": 3,
    "Machine.potential": 1,
    "Machine.reactions": 3,
    "Machine.reduced_inertia": 1,
    "Machine.reduced_moment": 2,
    "Machine.run": 3,
    "Machine.steady_state": 1,
    "Machine.step": 1,
    "Measures.get": 1,
    "Mechanism.assemblies": 1,
    "Mechanism.find": 1,
    "Mechanism.follow": 2,
    "Mechanism.plot": 1,
    "Mechanism.singular_loci": 1,
    "Mechanism.solve": 1,
    "Mechanism.with_dimensions": 1,
    "Motion.explain": 1,
    "Motion.instant_centre": 1,
    "Motion.plot": 1,
    "ParetoFront.plot": 2,
    "Run.at": 1,
    "Run.plot": 1,
    "Runs.at": 1,
    "SingularLocus.plot": 1,
    "SliderCrank": 1,
    "SteadyState.at": 1,
    "SteadyState.plot": 1,
    "balance.fit": 2,
    "dynamics.forces.reactions.Reactions.bearing": 1,
    "dynamics.forces.reactions.Reactions.joint": 1,
    "dynamics.forces.reactions.Reactions.joint_moment": 1,
    "dynamics.forces.reactions.Reactions.plot": 1,
    "crank_rocker.JammingRun.plot": 1,
    "flywheel.Flywheel.explain": 1,
    "flywheel.Flywheel.plot": 1,
    "flywheel.Flywheel.reduced_inertia": 1,
    "flywheel.Flywheel.reduced_moment": 1,
    "flywheel.Flywheel.speed": 1,
    "flywheel.Flywheel.time": 1,
    "flywheel.Flywheel.work": 1,
    "flywheel.from_table": 1,
    "metric.deviation": 1,
    "pareto": 1,
    "pictures.centrodes": 1,
    "slider_crank.plot_convergence": 1,
    "slider_crank.plot_deviation": 2,
    "slider_crank.rod_point": 1,
    "sweep": 1,
}
# The papers' own symbols.
OF_PAPERS = ("crank_rocker.", "slider_crank.")
OLD = {"omega", "alpha", "beta", "best", "greatest", "least"}
# One default everywhere; figures of the papers show degrees, as these do.
DEFAULTS: dict[str, Any] = {
    "ax": None, "dark": False, "degrees": False, "moving": False, "threads": None, "title": None,
    "joint": None, "diagrams": None, "between": None, "groups": False, "over": None, "jerk": 0.0,
    "acceleration": 0.0, "order": 0, "on_error": "raise", "ratio": 1.0, "rotor_inertia": 0.0,
    "outputs": None, "slides": None, "labels": "first",
}  # fmt: skip
# Where a default says something else, and why.
OTHER_DEFAULTS: dict[tuple[str, str], Any] = {
    ("Gravity", "acceleration"): (0.0, -9.81),  # another thing
    ("Machine.step", "on_error"): "nan",  # of many environments some fail
    ("Mechanism.solve", "order"): 2,  # what most users ask for
    ("Mechanism.to_html", "dark"): None,  # as the reader's browser has it
    ("Motion.to_html", "dark"): None,
    ("ParetoFront.to_html", "dark"): None,
    ("Run.to_html", "dark"): None,
    ("kinematics.timed.TimedMotion.to_html", "dark"): None,
    ("pictures.hodograph", "order"): 1,  # of velocities
    ("sweep", "on_error"): "nan",  # of many designs some fail
    ("sweep", "order"): None,  # 2, or what metrics need
}


def parameters() -> list[tuple[str, inspect.Parameter]]:
    return [
        (name, parameter)
        for name, signature in callables().items()
        if name not in RESULTS
        for parameter in signature.parameters.values()
        if parameter.name != "self" and not parameter.name.startswith("_")
    ]


def test_the_table_is_the_interface() -> None:
    """After a change: ``python -m interface.public_interface --write``, and read what changed."""
    assert table() == TABLE.read_text(encoding="utf-8")


def test_options_are_given_by_name() -> None:
    optional: defaultdict[str, int] = defaultdict(int)
    for name, parameter in parameters():
        if parameter.kind in POSITIONAL and parameter.default is not inspect.Parameter.empty:
            optional[name] += 1
    assert dict(optional) == READ_IN_PLACE


def test_old_names_do_not_come_back() -> None:
    known = [
        (name, parameter.name)
        for name, parameter in parameters()
        if parameter.name in OLD and not name.startswith(OF_PAPERS)
    ]
    assert known == [("Measures.plot", "best")]


@pytest.mark.parametrize("argument", DEFAULTS)
def test_an_argument_has_one_default(argument: str) -> None:
    for name, parameter in parameters():
        has_default = parameter.default is not inspect.Parameter.empty
        if parameter.name != argument or not has_default or name.startswith(OF_PAPERS):
            continue
        wanted = OTHER_DEFAULTS.get((name, argument), DEFAULTS[argument])
        assert parameter.default == wanted, name


def test_every_exception_is_needed() -> None:
    known = {(name, parameter.name): parameter.default for name, parameter in parameters()}
    for place, default in OTHER_DEFAULTS.items():
        assert known[place] == default != DEFAULTS[place[1]]
