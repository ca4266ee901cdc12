"""Tables of runs, steady states, flywheels and reactions: the arrays they are of, with units."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from openpyxl import load_workbook

import assur

if TYPE_CHECKING:
    from pathlib import Path


def press() -> assur.Machine:
    return assur.Machine(
        assur.SliderCrank(0.05, 0.2),
        bodies={"piston": assur.Body(mass=2.0), "crank": assur.Body(inertia=0.1)},
        loads=[assur.Force("B", (-100.0, 0.0))],
        motor=assur.LinearMotor(50.0, 40.0),
    )


def test_a_run(tmp_path: Path) -> None:
    run = press().run(0.3, 0.1, 5.0)
    table = run.to_dataframe(degrees=True)
    np.testing.assert_array_equal(table["t"], run.t)
    np.testing.assert_array_equal(table["q"], np.degrees(run.q))
    np.testing.assert_array_equal(table["speed"], run.speed)
    np.testing.assert_array_equal(table["kinetic"], run.energy.kinetic)
    assert table.attrs["units"]["acceleration"] == "rad/s2"
    run.to_excel(tmp_path / "run.xlsx")
    assert load_workbook(tmp_path / "run.xlsx").sheetnames == ["motion", "energy"]
    data = run.to_xarray()
    assert list(data.coords) == ["t", "q"]
    assert data["work"].attrs["units"] == "J"


def test_a_run_of_two_drivers() -> None:
    at = {"A": (0.0, 0.0), "B": (1.0, 0.0), "C": (1.5, 0.8)}
    arm = assur.Mechanism(at, {"ground": "A", "upper": "AB", "lower": "BC"}, ["upper", "lower"])
    bodies = {
        "upper": assur.Body(mass=1.0, inertia=0.1, at="B"),
        "lower": assur.Body(mass=1.0, inertia=0.1, at="C"),
    }
    run = assur.Machine(arm, bodies=bodies, loads=[assur.Gravity((0.0, -9.81))]).run(
        0.1, arm.q0, np.zeros(2)
    )
    table = run.to_dataframe()
    np.testing.assert_array_equal(table[["q0", "q1"]], run.q)
    np.testing.assert_array_equal(table[["speed0", "speed1"]], run.speed)


def test_a_steady_state_and_a_flywheel() -> None:
    steady = press().steady_state()
    np.testing.assert_array_equal(steady.to_dataframe()["speed"], steady.speed)
    plain = assur.Machine(
        assur.SliderCrank(0.05, 0.2), bodies={"piston": assur.Body(mass=2.0)}
    ).flywheel(1 / 8, mean_speed=20.0)
    table = plain.to_dataframe(degrees=True)
    assert table["q"].iloc[-1] == 360.0
    q = np.radians(table["q"].to_numpy())
    np.testing.assert_allclose(table["speed"], plain.speed(q), rtol=1e-12)
    assert table.attrs["units"]["reduced_inertia"] == "kg m2"
    phi = np.linspace(0.0, 2.0 * np.pi, 25)
    moments = np.stack([300.0 * np.sin(phi), 400.0 * np.sin(phi)])
    batch = assur.flywheel.from_table(
        phi, moments, np.full(25, 2.0), fluctuation=1 / 8, mean_speed=15.0
    )
    several = batch.to_dataframe(degrees=True)
    assert several["design"].tolist() == [0, 1]
    for name in ("inertia", "speed0", "delta", "mean_speed", "motor_moment", "power", "period"):
        np.testing.assert_array_equal(several[name], np.broadcast_to(getattr(batch, name), 2))
    np.testing.assert_array_equal(several["max"], batch.max.value)
    np.testing.assert_allclose(np.radians(several["max.q"]), batch.max.q, rtol=1e-13)
    assert several.attrs["units"]["min.q"] == "deg"


def test_reactions() -> None:
    q = np.linspace(0.1, 6.0, 5)
    found = press().reactions(q, 10.0, 2.0)
    table = found.to_dataframe()
    np.testing.assert_array_equal(table["driver"], found.driver)
    np.testing.assert_array_equal(table["A.x on rod"], found.joint("A", on="rod")[:, 0])
    np.testing.assert_array_equal(table["bore.normal"], found.slide("bore").normal)
    np.testing.assert_array_equal(table["shaking_moment"], found.shaking_moment)
    assert table.attrs["units"]["bore.along"] == "m"
    driven = assur.SliderCrank(0.05, 0.2).with_driver("bore", assembly={"A": 1})
    machine = assur.Machine(driven, bodies={"piston": assur.Body(mass=2.0)})
    table = machine.reactions(0.2, 1.0, 0.0).to_dataframe(degrees=True)
    assert (table["q"][0], table.attrs["units"]["driver"]) == (0.2, "N")
