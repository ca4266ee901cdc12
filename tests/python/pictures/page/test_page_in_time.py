"""Pages of runs and of motions by input laws: the frames are those of the motion in time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur.pictures.page.turn_in_time import turn_of_run, turn_of_timed

if TYPE_CHECKING:
    from pathlib import Path

WHEEL = assur.FourBar(1.0, 3.0, 3.0, 3.0)
MACHINE = assur.Machine(
    WHEEL, bodies={"crank": assur.Body(inertia=0.3), "rocker": assur.Body(inertia=2.0)}
)


def derivative(values: Any, step: float) -> Any:
    """Differences of fourth order."""
    return (8.0 * (values[3:-1] - values[1:-3]) - (values[4:] - values[:-4])) / (12.0 * step)


def test_frames_of_a_run_are_those_of_its_states() -> None:
    run = MACHINE.run(t_end=4.0, q0=0.3, speed0=2.0)
    turn = turn_of_run(run)
    rows = len(turn.frames.values[0])
    t = np.linspace(0.0, 4.0, rows)
    motion = WHEEL.solve(run.at(t).q)
    for joint in ("B", "C"):
        assert np.abs(turn.frames.joints()[joint] - motion.joint(joint).value).max() < 1e-12
    value, first, second = turn.frames.values
    state, rocker = run.at(t), turn.frames.links.index("rocker")
    angle = motion.link("rocker")
    assert np.abs(first[:, rocker, 2] - angle.velocity(state.speed)).max() < 1e-12
    exact = angle.acceleration(state.speed, state.acceleration)
    assert np.abs(second[:, rocker, 2] - exact).max() < 1e-11
    # They are derivatives by time: differences of the values, to the steps' fourth power.
    step = t[1] - t[0]
    assert np.abs(derivative(value, step) - first[2:-2]).max() < 1e-3
    assert np.abs(derivative(first, step) - second[2:-2]).max() < 1e-2


def test_a_run_over_q_is_played_in_its_time() -> None:
    run = MACHINE.run(q_end=2.0 * np.pi, q0=0.0, speed0=3.0)
    turn = turn_of_run(run)
    t = np.linspace(run.t[0], run.t[-1], len(turn.frames.values[0]))
    index = turn.frames.links.index("crank")
    q = turn.frames.values[0][:, index, 2]
    assert np.abs(run.at(q=q).t - t).max() < 1e-5 * run.t[-1]
    assert turn.unit == "time"


def test_frames_of_an_input_law_are_those_of_the_motion() -> None:
    law = assur.laws.Cycloidal(0.0, np.pi, duration=0.5)
    timed = assur.SliderCrank(0.05, 0.2).follow(law, np.linspace(0.0, 0.5, 101))
    turn = turn_of_timed(timed)
    assert np.array_equal(turn.frames.joints()["B"][:, 0], timed.joint("B").value[:, 0])
    piston = turn.frames.links.index("piston")
    assert np.abs(turn.frames.values[1][:, piston, :2] - timed.joint("B").velocity()).max() < 1e-12
    assert (
        np.abs(turn.frames.values[2][:, piston, :2] - timed.joint("B").acceleration()).max() < 1e-10
    )


def test_notebooks_show_runs_and_motions_in_time() -> None:
    run = MACHINE.run(t_end=1.0, q0=0.3, speed0=2.0)
    assert (run._repr_html_() or "").startswith("<div id=")
    law = assur.laws.Uniform(0.0, 1.0, duration=1.0)
    assert WHEEL.follow(law, np.linspace(0.0, 1.0, 11))._repr_html_()
    assert WHEEL.follow(law, [0.0, 0.1, 1.0])._repr_html_() is None


def test_what_cannot_be_played_in_time_is_refused(tmp_path: Path) -> None:
    out = tmp_path / "page.html"
    law = assur.laws.Uniform(0.0, 1.0, duration=1.0)
    with pytest.raises(assur.InputError, match="evenly spaced times"):
        WHEEL.follow(law, [0.0, 0.1, 1.0]).to_html(out)
    with pytest.raises(assur.InputError, match="at least 2"):
        WHEEL.follow(law, [0.5]).to_html(out)
    batch = WHEEL.with_dimensions({"rocker.length": [2.5, 3.0]})
    with pytest.raises(assur.InputError, match=r"batch \(2,\)"):
        batch.follow(law, np.linspace(0.0, 1.0, 11)).to_html(out)
    run = MACHINE.run(t_end=1.0, q0=0.3, speed0=2.0)
    with pytest.raises(assur.InputError, match="goes back, from t = 0 s to -1 s"):
        MACHINE.run(t_end=-1.0, q0=0.3, speed0=2.0).to_html(out)
    with pytest.raises(assur.InputError, match="cannot be written"):
        run.to_html(tmp_path / "missing" / "run.html")
    assert not out.exists()
