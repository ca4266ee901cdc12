"""Names of earlier versions and of other tools: each error gives the name here."""

from __future__ import annotations

import pickle
import re
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur.dynamics.equations.dynamics import Dynamics

if TYPE_CHECKING:
    from collections.abc import Callable

MOTION: Any = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve([0.5, 1.0, 1.5], order=3)
PIN: Any = MOTION.joint("C")
KEYWORDS: dict[str, tuple[Callable[..., object], str, str]] = {
    "velocity": (PIN.velocity, "omega", "speed"),
    "acceleration": (PIN.acceleration, "alpha", "acceleration"),
    "jerk": (PIN.jerk, "beta", "jerk"),
    "table": (MOTION.to_dataframe, "omega", "speed"),
    "diagram": (MOTION.diagram, "beta", "jerk"),
    "paths": (MOTION.plot, "alpha", "acceleration"),
    "plan": (MOTION.polygon, "omega", "speed"),
    "page": (MOTION.mechanism.to_html, "omega", "speed"),
}


@pytest.mark.parametrize("name", KEYWORDS)
def test_an_old_keyword_is_refused_by_the_new_one(name: str) -> None:
    call, old, new = KEYWORDS[name]
    with pytest.raises(TypeError, match=rf"\(\) has no argument '{old}': it is {new}=$"):
        call(**{old: 1.0})


TURN = np.linspace(0.0, 2.0 * np.pi, 25)
MACHINE = assur.Machine(
    assur.SliderCrank(0.1, 0.4), loads=[assur.Force("B", (-1000.0, 0.0), on="piston")]
)
FORCES: Any = MACHINE.reactions(TURN, 10.0)
SWEPT: Any = assur.sweep(
    MOTION.mechanism,
    {"coupler.length": [2.9, 3.0]},
    TURN,
    metrics={"swing": assur.metric.span("rocker")},
)
ATTRIBUTES: dict[str, tuple[Any, str, str]] = {
    "extremes": (MOTION.mechanism.extremes("rocker"), "least", "min"),
    "an extreme": (MOTION.mechanism.extremes("rocker").max, "at", "q"),
    "duty": (MACHINE.duty(TURN, 10.0), "greatest_power", "max_power"),
    "bearing": (FORCES.bearing("B", on="piston"), "greatest", "max"),
    "loads of a link": (MACHINE.internal_loads("rod", 1.0).extremes("axial"), "least_x", "min_x"),
    "flywheel": (
        assur.flywheel.from_table(TURN, np.sin(TURN), fluctuation=0.1, mean_speed=5.0),
        "greatest",
        "max",
    ),
    "measures": (SWEPT, "best", "nsmallest"),
    "metric": (assur.metric, "least_transmission", "metric.min_transmission_angle"),
    "metric of a place": (assur.metric, "place_of_greatest", "metric.argmax"),
}


@pytest.mark.parametrize("name", ATTRIBUTES)
def test_an_old_attribute_is_refused_by_the_new_one(name: str) -> None:
    owner, old, new = ATTRIBUTES[name]
    assert not hasattr(owner, old)
    with pytest.raises(AttributeError, match=rf"no attribute '{old}': .*\b{new}\b"):
        getattr(owner, old)
    with pytest.raises(AttributeError, match=r"no attribute 'unheard_of'$"):
        _ = owner.unheard_of
    again = pickle.loads(pickle.dumps(owner)) if not isinstance(owner, ModuleType) else owner
    assert type(again) is type(owner)


OWNERS: dict[str, Any] = {
    "mechanism": assur.SliderCrank(1.0, 3.0),
    "motion": MOTION,
    "machine": MACHINE,
}
# What hints may call.
CALLS = {
    name
    for place in (
        assur,
        assur.crank_rocker,
        assur.pictures,
        Dynamics,
        assur.Mechanism,
        assur.Motion,
        assur.Machine,
        assur.Analogues,
        assur.Run,
    )
    for name in dir(place)
} | {"to_csv"}


@pytest.mark.parametrize("owner", OWNERS)
def test_a_name_of_another_tool_says_what_there_is(owner: str) -> None:
    one = OWNERS[owner]
    hints = type(one)._other_names
    assert len(hints) > 5
    for name, hint in hints.items():
        assert not hasattr(one, name)
        with pytest.raises(AttributeError, match=re.escape(f"no attribute '{name}': {hint}")):
            getattr(one, name)
        called = set(re.findall(r"([A-Za-z_]+)\(", hint))
        assert called <= CALLS, (name, called - CALLS)
