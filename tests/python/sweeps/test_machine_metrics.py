"""Metrics of machines: each design by itself, by `Machine.reactions` and its sisters."""

from __future__ import annotations

import pickle
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, Force, Gravity, InputError, metric

Q = np.linspace(0.0, 2.0 * np.pi, 48, endpoint=False)
BODIES = {
    "coupler": Body(mass=2.0, inertia=0.05, at=(1.0, 0.3)),
    "rocker": Body(mass=3.0, inertia=0.1, at=(0.9, 0.0)),
}
LOADS: list[Any] = [Gravity(), Force("C", (4.0, -7.0))]
FOUR_BAR = assur.FourBar(1.0, 3.0, 2.5, 3.2)
MACHINE = assur.Machine(FOUR_BAR, bodies=BODIES, loads=LOADS)
# The last but one does not turn fully, the last has no such length.
COUPLERS = np.array([2.8, 3.0, 3.3, 9.0, -1.0])
MOTION: Any = {"speed": 6.0, "acceleration": 1.5}
ASKED = {
    "peak C": metric.peak_reaction("C", **MOTION),
    "rms C": metric.rms_reaction("C", on="rocker", **MOTION),
    "peak A": metric.peak_reaction("A", **MOTION),
    "peak": metric.peak_effort(**MOTION),
    "rms": metric.rms_effort(**MOTION),
    "inertia": metric.max_inertia(),
    "flywheel": metric.flywheel_inertia(0.02, mean_speed=6.0),
}


PLACES = {"C": ("C", "rocker"), "A": ("A", "crank")}


def one_by_one(coupler: float) -> dict[str, float]:
    design = assur.FourBar(1.0, coupler, 2.5, 3.2)
    machine = assur.Machine(design, bodies=BODIES, loads=LOADS)
    found = machine.reactions(Q, **MOTION)
    sizes = {name: np.linalg.norm(found.joint(*at), axis=-1) for name, at in PLACES.items()}
    return {
        "peak C": sizes["C"].max(),
        "rms C": np.sqrt((sizes["C"] ** 2).mean()),
        "peak A": sizes["A"].max(),
        "peak": np.abs(found.driver).max(),
        "rms": np.sqrt((found.driver**2).mean()),
        "inertia": machine.reduced_inertia(Q).value.max(),
        "flywheel": machine.flywheel(0.02, mean_speed=6.0).inertia,
    }


def test_designs_by_themselves() -> None:
    found = assur.sweep(MACHINE, {"coupler.length": COUPLERS}, Q, metrics=ASKED)
    assert found.kept.tolist() == [0, 1, 2]
    for index, coupler in enumerate(COUPLERS[:3]):
        for name, value in one_by_one(float(coupler)).items():
            assert found[name][index] == pytest.approx(value, rel=1e-10), name
    for name in ASKED:
        assert np.isnan(found[name][3:]).all()


def test_conditions_and_sums() -> None:
    whole = assur.sweep(MACHINE, {"coupler.length": COUPLERS}, Q, metrics=ASKED)
    limit = float(np.sort(whole["peak C"][:3])[1])
    some = assur.sweep(
        MACHINE,
        {"coupler.length": COUPLERS},
        Q,
        metrics={"sum": metric.peak_effort(**MOTION) + 2.0 * metric.span("rocker")},
        where=[metric.peak_reaction("C", **MOTION) <= limit],
    )
    kept = [i for i in range(3) if whole["peak C"][i] <= limit]
    assert some.kept.tolist() == kept
    span = assur.sweep(
        FOUR_BAR, {"coupler.length": COUPLERS}, Q, metrics={"a": metric.span("rocker")}
    )
    assert np.array_equal(some["sum"][kept], (whole["peak"] + 2.0 * span["a"])[kept])


def test_metrics_of_one_motion_share_its_reactions() -> None:
    """Alone, together and beside those of another motion each has the same bits."""
    other = {"other": metric.peak_reaction("C", speed=1.0), "rest": metric.peak_effort()}
    whole = assur.sweep(MACHINE, {"coupler.length": COUPLERS}, Q, metrics={**ASKED, **other})
    for name, one in {**ASKED, **other}.items():
        alone = assur.sweep(MACHINE, {"coupler.length": COUPLERS}, Q, metrics={name: one})
        assert np.array_equal(alone[name], whole[name], equal_nan=True), name
    assert (whole["other"][:3] != whole["peak C"][:3]).all()


def test_an_effort_at_a_change_point_has_a_value() -> None:
    """A parallelogram's drive is m g r cos q; its forces have no value where it is flat."""
    turn = np.linspace(0.0, np.pi, 5)
    pairs = assur.Machine(
        assur.FourBar(1.0, 3.0, 1.0, 3.0),
        bodies={"coupler": Body(mass=2.0, inertia=1.5, at=(1.5, 0.0))},
        loads=[Gravity()],
    )
    asked = {"effort": metric.peak_effort(speed=3.0), "pin": metric.peak_reaction("C", speed=3.0)}
    found = assur.sweep(pairs, {}, turn, metrics=asked)
    # Through a change point analogues are interpolated, to 1e-10 (test_change_point_machines).
    assert found["effort"] == pytest.approx(2.0 * 9.81, rel=1e-10)
    assert np.isnan(found["pin"]).all()


def test_an_effort_does_not_depend_on_the_designs_beside_it() -> None:
    """One of them has change points, where the effort is found by power."""
    turn = np.linspace(0.0, 2.0 * np.pi, 48)
    pairs = assur.Machine(
        assur.FourBar(1.0, 3.0, 1.0, 3.0),
        bodies={"coupler": Body(mass=2.0, inertia=1.5, at=(1.5, 0.0))},
        loads=[Gravity()],
    )
    rockers = np.array([1.0, 1.3, 1.4])
    for asked in (metric.peak_effort(speed=3.0), metric.rms_effort(speed=3.0)):
        whole = assur.sweep(pairs, {"rocker.length": rockers}, turn, metrics={"a": asked})
        for index in range(3):
            own = {"rocker.length": rockers[index : index + 1]}
            alone = assur.sweep(pairs, own, turn, metrics={"a": asked})
            assert alone["a"][0] == whole["a"][index], index


def test_speeds_over_the_positions() -> None:
    """As many as a turn in degrees; two motions with equal speeds are one."""
    turn = np.radians(np.arange(360.0))
    rising = np.linspace(1.0, 6.0, 360)
    asked = {
        "a": metric.peak_effort(speed=rising),
        "b": metric.peak_effort(speed=rising, acceleration=np.zeros(360)),
    }
    found = assur.sweep(MACHINE, {}, turn, metrics={**asked, "pin": metric.peak_reaction("C")})
    exact = np.abs(MACHINE.reactions(turn, rising).driver).max()
    assert found["a"] == found["b"] == pytest.approx(exact, rel=1e-14)


@pytest.mark.parametrize("count", [1, 3, 8, 9, 47, 100])
def test_any_number_of_positions(count: int) -> None:
    """They are taken some at a time; those that a register has too many count once."""
    turn = np.linspace(0.1, 5.0, count)
    engine = assur.Machine(
        assur.SliderCrank(1.0, 3.0, 0.1),
        bodies={"rod": Body(mass=2.0, inertia=0.3, at=(1.2, 0.1)), "piston": Body(mass=1.5)},
        loads=[Gravity(), Force("B", (lambda _t, q, speed: 40.0 * np.sin(3.0 * q) + speed, 0.0))],
    )
    speed = np.linspace(2.0, 7.0, count)
    found = engine.reactions(turn, speed)
    asked = {
        "pin": metric.peak_reaction("A", speed=speed),
        "rms": metric.rms_reaction("B", speed=speed),
        "effort": metric.peak_effort(speed=speed),
        "mean": metric.rms_effort(speed=speed),
    }
    rod = {"rod.length": np.array([3.0, 3.0])}
    measured = assur.sweep(engine, rod, turn, metrics=asked)
    squares = {name: (found.joint(name, on="rod") ** 2).sum(axis=-1) for name in "AB"}
    exact = {
        "pin": squares["A"].max(),
        "rms": squares["B"].mean(),
        "effort": (found.driver**2).max(),
        "mean": (found.driver**2).mean(),
    }
    for name, square in exact.items():
        assert measured[name] == pytest.approx(np.sqrt(square), rel=1e-14), name


def test_an_undetermined_force_has_no_peak() -> None:
    """Two parallel rockers too many share a load that no balance divides."""
    joints = {"A": (0, 0), "B": (0, 1), "C": (3, 1), "D": (3, 0), "E": (1.5, 0), "F": (1.5, 1)}
    links = {"ground": "ADE", "crank": "AB", "rod": "BCF", "rocker": "CD", "third": "EF"}
    three = assur.Mechanism(joints, {name: list(of) for name, of in links.items()}, "crank")
    machine = assur.Machine(
        three, bodies={"rod": Body(mass=2.0, inertia=0.5, at=(1.0, 0.0))}, loads=[Gravity()]
    )
    q = three.q0 + np.linspace(-0.5, 0.5, 11)
    asked = {"F": metric.peak_reaction("F", on="third"), "effort": metric.peak_effort()}
    found = assur.sweep(machine, {}, q, metrics=asked)
    stored = machine.reactions(q)
    assert np.isnan(stored.joint("F", on="third")).any()
    assert np.isnan(found["F"])
    assert found["effort"] == pytest.approx(np.abs(stored.driver).max(), rel=1e-12)


def test_other_processes_find_the_same() -> None:
    here = assur.sweep(MACHINE, {"coupler.length": COUPLERS}, Q, metrics=ASKED)
    with ProcessPoolExecutor(1, get_context("spawn")) as pool:
        there = assur.sweep(MACHINE, {"coupler.length": COUPLERS}, Q, metrics=ASKED, engine=pool)
    for name in ASKED:
        assert np.array_equal(here[name], there[name], equal_nan=True), name
    assert repr(pickle.loads(pickle.dumps(ASKED["rms C"]))) == "rms_reaction('C', on='rocker')"


def test_what_has_no_meaning_is_refused() -> None:
    def sweep(over: Any, asked: Any, **options: Any) -> Any:
        return assur.sweep(over, {}, Q, metrics={"a": asked}, **options)

    with pytest.raises(InputError, match=r"peak_effort\(\) is of a machine"):
        sweep(FOUR_BAR, metric.peak_effort())
    with pytest.raises(InputError, match=r"motions need machine\.mechanism"):
        assur.sweep(MACHINE, {}, Q)  # type: ignore[call-overload]
    with pytest.raises(InputError, match="X"):
        sweep(MACHINE, metric.peak_reaction("X"))
    with pytest.raises(InputError, match='link "crank" has no joint "C"'):
        sweep(MACHINE, metric.peak_reaction("C", on="crank"))
    with pytest.raises(InputError, match="speed is nan"):
        metric.peak_effort(speed=np.nan)
    with pytest.raises(InputError, match="joint"):
        metric.peak_reaction(3)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="mean"):
        metric.flywheel_inertia(0.1, mean_speed=5.0, mean="median")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="on which link"):
        sweep(three_at_a_pin(), metric.peak_reaction("P"))


def three_at_a_pin() -> assur.Machine:
    m = assur.Mechanism(
        joints={"A": (0, 0), "B": (1, 0), "P": (3, 2), "D": (4.8, 0), "E": (3, -2)},
        links={
            "ground": ["A", "D", "E"],
            "crank": ["A", "B"],
            "rod": ["B", "P"],
            "left": ["P", "D"],
            "arm": ["P"],
            "guide": ["E"],
        },
        slides={"s": assur.Slide("arm", "guide", angle=np.pi / 2, origin="E")},
        driver="crank",
    )
    return assur.Machine(m, loads=[Gravity()])
