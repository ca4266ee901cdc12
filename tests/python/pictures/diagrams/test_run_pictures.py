"""Pictures of runs: curves, events and energies."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from pictures.diagrams.chart_overlaps import overlapping

TURN = 2.0 * math.pi


def pendulum() -> assur.Run:
    """A rod of 1 m hung at its end, let go level: it swings through q = −π/2."""
    rod = assur.Mechanism({"O": (0, 0), "E": (1, 0)}, {"ground": ["O"], "rod": ["O", "E"]}, "rod")
    machine = assur.Machine(
        rod,
        bodies={"rod": assur.Body(mass=3.0, inertia=0.25, at=(0.5, 0.0))},
        loads=[assur.Gravity((0.0, -9.81))],
    )
    events: list[Any] = [
        assur.events.Position(-math.pi / 2, stop=False),
        assur.events.Rest(stop=False),
    ]
    return machine.run(3.0, q0=0.0, speed0=-1e-9, events=events)


def line(ax: Any, gid: str) -> Any:
    return next(one for one in ax.lines if one.get_gid() == gid).get_data()


def said(ax: Any, gid: str) -> list[str]:
    return [text.get_text() for text in ax.texts if text.get_gid() == gid]


def test_events_are_named_where_they_are() -> None:
    run = pendulum()
    ax = run.plot("speed")
    assert ax.get_title(loc="left") == "Speed, rad/s"
    places = [np.asarray(x.get_xdata())[0] for x in ax.lines if "event" in str(x.get_gid())]
    assert places == [event.t for event in run.events]
    names = said(ax, "event text")
    assert len(names) == 2
    assert names[0].startswith("q = −1.571")
    assert names[1].startswith("rest")
    # Its greatest speed is √(3 g / l), at the lowest point.
    greatest = math.sqrt(3.0 * 9.81)
    marks = [float(np.asarray(x.get_ydata())[0]) for x in ax.lines if x.get_gid() == "mark"]
    assert marks == pytest.approx([greatest, -greatest], rel=1e-6)


def test_energies_and_their_sum() -> None:
    run = pendulum()
    ax = run.plot("energy")
    names = {text.get_text() for text in ax.texts if str(text.get_gid()).startswith("name")}
    assert names == {"kinetic", "potential", "sum"}  # nothing works on it
    t, kinetic = line(ax, "curve kinetic")
    np.testing.assert_array_equal(t, run.t)
    # ½ J ω² with J = m l²/3; weight m g l/2 sin q.
    np.testing.assert_allclose(kinetic, 0.5 * run.speed**2, atol=1e-9)
    weight = 3.0 * 9.81 * 0.5 * np.sin(run.q)
    np.testing.assert_allclose(line(ax, "curve potential")[1], weight, atol=1e-9)
    assert np.ptp(line(ax, "curve sum")[1]) < 1e-7
    (sentence,) = said(ax, "sentence")
    assert sentence.startswith("sum = kinetic + potential − work, constant to ")
    error = sentence.split("constant to ")[1]
    assert error.split("·")[0] == f"{run.energy.error:.0e}"[0]


def test_several_drivers_have_their_names() -> None:
    made = assur.examples.five_bar()
    bodies = {k: assur.Body(mass=1.0, inertia=0.1) for k in made.links if k != "ground"}
    run = assur.Machine(made, bodies=bodies).run(0.3, q0=made.q0, speed0=[1.0, -0.5])
    ax = run.plot("q")
    assert ax.get_title(loc="left") == "Coordinate, rad"
    t, left = line(ax, "curve left")
    np.testing.assert_array_equal(left, run.at(t).q[:, 0])
    np.testing.assert_array_equal(line(ax, "curve right")[1], run.at(t).q[:, 1])
    names = [text.get_text() for text in ax.texts if str(text.get_gid()).startswith("name")]
    assert sorted(names) == ["left", "right"]


def test_a_slide_is_in_metres_and_runs_over_q_are_drawn_over_time() -> None:
    drop = assur.SliderCrank(0.1, 0.4).with_driver("bore", q=1.0)
    machine = assur.Machine(
        drop, bodies={"piston": assur.Body(mass=2.0), "crank": assur.Body(inertia=0.1)}
    )
    run = machine.run(0.1, q0=0.45, speed0=-0.2)
    assert run.plot("speed").get_title(loc="left") == "Speed, m/s"
    crank = assur.SliderCrank(0.1, 0.4)
    run = assur.Machine(crank, bodies={"crank": assur.Body(inertia=0.5)}).run(
        q_end=3.0, q0=0.0, speed0=2.0
    )
    t, q = line(run.plot("q", dark=True), "curve crank")
    np.testing.assert_array_equal(t, run.t)
    np.testing.assert_array_equal(q, run.q)


def test_a_period() -> None:
    steady = assur.Machine(
        assur.SliderCrank(0.1, 0.4),
        bodies={"piston": assur.Body(mass=20.0), "crank": assur.Body(inertia=0.5)},
        loads=[assur.Torque("crank", -20.0)],
        motor=assur.LinearMotor(stall=50.0, no_load=15.0),
    ).steady_state()
    t, speed = line(steady.plot("time"), "curve speed")
    assert (t[0], t[-1]) == (0.0, pytest.approx(steady.period))
    # The area below is a turn.
    assert np.trapezoid(speed, t) == pytest.approx(TURN, rel=1e-5)
    marks = [x.get_data() for x in steady.plot("speed").lines if x.get_gid() == "mark"]
    assert [float(np.asarray(y)[0]) for _, y in marks] == [steady.max.value, steady.min.value]
    ax = steady.plot("energy")
    assert said(ax, "event text") == []
    assert np.ptp(line(ax, "curve sum")[1]) < 1e-6 * line(ax, "curve kinetic")[1].max()
    with pytest.raises(assur.InputError, match="what is 'x'"):
        steady.plot("x")  # type: ignore[arg-type]


def test_texts_are_clear() -> None:
    run = pendulum()
    count = 0
    bad: list[str] = []
    for what in ("speed", "q", "acceleration", "energy"):
        written, wrong = overlapping(run.plot(what).figure)
        count += written
        bad += [f"{what}: {one}" for one in wrong]
    assert count >= 14
    assert not bad
