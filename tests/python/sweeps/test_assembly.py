"""What a sweep or a motion hands back is in the assembly that was measured."""

from __future__ import annotations

import copy
import pickle
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import metric
from models.mechanisms.mechanism_data import arguments
from models.mechanisms.mixed_models import mixed_case

if TYPE_CHECKING:
    from pathlib import Path

Q = np.linspace(0.0, 2.0 * np.pi, 72, endpoint=False)
SPACE = {"coupler.length": [3.0, 3.1]}
CROSSED = {"C": -1}
# Random mechanisms of dyads beside a group above class II, with one driver.
MIXED = (4, 5, 7, 8, 10, 13, 17, 18)


def four_bar() -> assur.Mechanism:
    return assur.FourBar(1.0, 3.0, 2.5, 3.0)


def height(motion: assur.Motion) -> Any:
    return motion.joint("C").value[..., 1].mean(axis=-1)


def same(one: assur.Motion, other: assur.Motion) -> bool:
    """Whether both have the same bits."""
    links = [name for name in one.mechanism.links if name != "ground"]
    arrays = ((one.link(name).value, other.link(name).value) for name in links)
    return all(a.tobytes() == b.tobytes() for a, b in arrays)


@pytest.mark.parametrize("index", [0, (1,), [1, 0], np.array([True, False])])
def test_designs_have_the_assembly_measured(index: Any) -> None:
    found = assur.sweep(four_bar(), SPACE, Q, assembly=CROSSED, metrics={"y": metric.mean("C.y")})
    designs = found.designs(index)
    assert dict(designs.assembly) == CROSSED
    wanted = found["y"][index]
    assert height(designs.solve(Q)) == pytest.approx(wanted, rel=1e-5)
    assert (wanted < -2.0).all()


def test_the_best_design_has_its_value_with_an_engine_too() -> None:
    asked = {"y": metric.mean("C.y"), "own": metric.function(height, outputs=["C"])}
    with ThreadPoolExecutor(2) as engine:
        found = assur.sweep(four_bar(), SPACE, Q, assembly=CROSSED, metrics=asked, engine=engine)
    best = found.designs(found.nsmallest(1, by="own"))
    assert height(best.solve(Q)) == np.nanmin(found["own"])
    assert found["own"] == pytest.approx(found["y"], rel=1e-5)


@pytest.mark.parametrize("on_error", ["nan", "drop"])
def test_a_motion_has_the_mechanism_that_was_solved(on_error: str) -> None:
    space = {"coupler.length": [9.0, 3.0, 3.1]}
    swept = assur.sweep(four_bar(), space, Q, assembly=CROSSED, on_error=on_error)  # type: ignore[call-overload]
    one = four_bar().solve(Q, assembly=CROSSED)
    part = four_bar().with_dimensions(SPACE).solve(Q, assembly=CROSSED)[1]
    for motion in (swept, one, part, copy.copy(one), pickle.loads(pickle.dumps(one))):
        assert dict(motion.mechanism.assembly) == CROSSED
        again = motion.mechanism.solve(Q, on_error="nan")
        assert np.array_equal(again["C"].value, motion["C"].value, equal_nan=True)


def test_the_drawn_assembly_gives_the_same_mechanism() -> None:
    own = four_bar()
    assert own.solve(Q, assembly={"C": 1}).mechanism is own
    assert own.with_assembly(own.assembly) == own
    found = assur.sweep(own, {}, Q, assembly={"C": 1}, metrics={"y": metric.mean("C.y")})
    assert found.designs(0) == own


def test_metrics_of_a_found_assembly_above_class_two() -> None:
    own = assur.examples.triad()
    asked = {name: metric.mean(f"{name}.x") for name in own.joints}
    found_at = []
    for assembly in own.assemblies(own.q0):
        found = assur.sweep(own, {}, [float(own.q0)], assembly=assembly, metrics=asked)
        x = [float(found[name]) for name in own.joints]
        assert assembly.joints
        assert x == pytest.approx([at[0] for at in assembly.joints.values()], abs=1e-12)
        assert same(found.designs(0).solve(Q), own.solve(Q, assembly=assembly))
        found_at.append(x)
    assert np.ptp(found_at, axis=0).max() > 0.1


def test_a_machine_is_measured_in_the_assembly() -> None:
    own = four_bar()
    bodies = {"coupler": assur.Body(mass=2.0, inertia=0.3, at=(1.0, 0.4))}
    machine = assur.Machine(own, bodies=bodies, loads=[assur.Gravity()])
    asked = {"torque": metric.peak_effort()}
    found = assur.sweep(machine, SPACE, Q, assembly=CROSSED, metrics=asked)
    drawn = assur.sweep(machine, SPACE, Q, metrics=asked)
    crossed = machine.of(own.with_assembly(assur.Assembly(CROSSED)))
    wanted = assur.sweep(crossed, SPACE, Q, metrics=asked)
    assert found["torque"].tolist() == wanted["torque"].tolist()
    assert (found["torque"] != drawn["torque"]).all()
    again = machine.of(found.designs([0, 1]))
    assert assur.sweep(again, {}, Q, metrics=asked)["torque"].tolist() == wanted["torque"].tolist()


@pytest.mark.parametrize("seed", MIXED)
def test_signs_of_a_mechanism_drawn_at_a_found_place(seed: int, tmp_path: Path) -> None:
    """`with_assembly` keeps the place where the group above class II was found."""
    own = assur.Mechanism(**arguments(mixed_case(seed).description))
    q = own.q0 + np.linspace(-0.2, 0.2, 5)
    found = own.assemblies(own.q0 + 0.05)
    assert len(found) > 3
    for assembly in found[:3]:
        placed = own.with_assembly(assembly)
        for name, sign in placed.assembly.items():
            signs = {name: -sign}
            solved = placed.solve(q, assembly=signs, on_error="nan")
            other = placed.with_assembly(assur.Assembly(signs))
            assert same(other.solve(q, on_error="nan"), solved)
            assert other == pickle.loads(pickle.dumps(other))
            assert solved.mechanism == other
            if np.isfinite(list(other.joints.values())).all():
                other.save(tmp_path / "own.toml")
                assert assur.load(tmp_path / "own.toml") == other
            else:
                with pytest.raises(assur.InputError, match="cannot be saved: with its signs it"):
                    other.save(tmp_path / "own.toml")
