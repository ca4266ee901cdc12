"""`assur.pareto`: fronts in closed form; designs were measured, and none is dominated."""

from __future__ import annotations

import builtins
import copy
import pickle
import signal
import threading
import time
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
import pytest

import assur
from assur import metric
from assur.fitting.pareto import archive
from assur.fitting.pareto.objectives import undominated
from oracles.fitting.four_bar import moved, transmission, turns

if TYPE_CHECKING:
    from pathlib import Path

mpl.use("Agg")
# With 0, a quarter and half a turn, where a slider-crank has its extremes.
Q = np.linspace(0.0, 2.0 * np.pi, 72, endpoint=False)
GOALS: dict[str, Any] = {
    "maximize": {"stroke": metric.span("bore"), "angle": metric.min_transmission_angle("B")},
    "bounds": {"crank.length": (0.05, 0.2), "rod.length": (0.3, 0.5)},
}
FEW: dict[str, Any] = {"population": 12, "generations": 6}


def slider_crank() -> assur.SliderCrank:
    return assur.SliderCrank(0.1, 0.4)


def lengths(front: assur.ParetoFront) -> Any:
    return (front.designs.dimensions[name] for name in ("crank.length", "rod.length"))


def dominated(costs: Any) -> list[int]:
    """Rows that another is at least as good as, and better in one: by comparing all pairs."""
    rows = [tuple(row) for row in np.asarray(costs).tolist()]
    return [
        i
        for i, row in enumerate(rows)
        if any(
            all(a <= b for a, b in zip(other, row, strict=True)) and other != row for other in rows
        )
    ]


def assert_near(costs: Any, true: Any, gap: float, behind: float) -> None:
    """Compare with a fine true front by the additive epsilon indicator of Zitzler et al. (2003).

    Over the range of each goal: by how much every point of the true front is missed at most, and by
    how much a design can at most be better in all goals.
    """
    away = (np.asarray(costs)[:, np.newaxis] - true) / np.ptp(true, axis=0)
    assert away.max(axis=2).min(axis=0).max() < gap
    assert away.min(axis=2).max() < behind


@pytest.mark.parametrize("seed", [0, 1])
def test_a_front_in_closed_form(seed: int) -> None:
    # Stroke 2r; the rod is steepest at a quarter turn, asin(r / l): the longest rod is best.
    front = assur.pareto(slider_crank(), Q, **GOALS, population=60, generations=40, seed=seed)
    crank, rod = lengths(front)
    stroke, angle = front.values["stroke"], front.values["angle"]
    np.testing.assert_allclose(stroke, 2.0 * crank, rtol=1e-13)
    np.testing.assert_allclose(angle, np.arccos(crank / rod), rtol=1e-13)
    assert (angle <= np.arccos(stroke / (2.0 * 0.5)) + 1e-12).all()
    assert len(front) == 60
    assert (np.diff(stroke) < 0.0).all()
    r = np.linspace(0.05, 0.2, 2001)
    true = np.column_stack([-2.0 * r, -np.arccos(r / 0.5)])
    # On ten seeds at most 0.0175 and 0.0021; half of an even gap is 0.0085.
    assert_near(np.column_stack([-stroke, -angle]), true, gap=0.025, behind=0.005)


def test_a_front_along_a_condition() -> None:
    # The longest reach r + l is least with the shortest rod that transmits: l = r / cos 40°.
    least = np.deg2rad(40.0)
    front = assur.pareto(
        slider_crank(),
        Q,
        minimize={"reach": metric.max("bore")},
        maximize={"stroke": metric.span("bore")},
        where=[metric.min_transmission_angle("B") > least],
        bounds={"crank.length": (0.05, 0.2), "rod.length": (0.06, 0.5)},
        population=60,
        generations=40,
    )
    crank, rod = lengths(front)
    reach, stroke = front.values["reach"], front.values["stroke"]
    np.testing.assert_allclose(reach, crank + rod, rtol=1e-13)
    assert (np.arccos(crank / rod) > least - 1e-12).all()
    assert (np.diff(reach) > 0.0).all()
    r = np.linspace(0.05, 0.2, 2001)
    true = np.column_stack([r * (1.0 + 1.0 / np.cos(least)), -2.0 * r])
    # On ten seeds at most 0.0278 and 0.0173.
    assert_near(np.column_stack([reach, -stroke]), true, gap=0.035, behind=0.03)


def four_bars(**options: Any) -> assur.ParetoFront:
    given: dict[str, Any] = {
        "minimize": {"size": metric.max("P.y")},
        "maximize": {
            "gamma": metric.min_transmission_angle("C"),
            "swing": metric.span("rocker"),
        },
        "bounds": {"*.length": (0.5, 4.0), "coupler.P.*": (-1.0, 2.0)},
        "ties": [("rocker.length", "coupler.length", 0.8)],
        "where": [
            metric.full_rotation(),
            metric.min_transmission_angle("C") > 0.5,
            metric.span("rocker") < np.pi,
        ],
        "population": 24,
        "generations": 12,
        **options,
    }
    return assur.pareto(assur.FourBar(1.0, 3.0, 2.4, 3.0, point=(1.5, 1.0)), Q, **given)


def test_what_is_returned_was_measured_and_nothing_is_dominated() -> None:
    front = four_bars()
    assert len(front) > 5
    values = front.values
    again = assur.sweep(
        front.designs,
        {},
        Q,
        metrics={
            "size": metric.max("P.y"),
            "gamma": metric.min_transmission_angle("C"),
            "swing": metric.span("rocker"),
        },
    )
    for name, value in values.items():
        np.testing.assert_array_equal(value, again[name])
    assert dominated(np.column_stack([values["size"], -values["gamma"], -values["swing"]])) == []
    assert (np.diff(values["size"]) >= 0.0).all()
    for index, design in enumerate(front):
        dimensions = {name: float(value) for name, value in design.dimensions.items()}
        assert turns(dimensions)
        assert dimensions["rocker.length"] == 0.8 * dimensions["coupler.length"]
        for name in ("crank", "coupler", "rocker"):
            assert 0.5 <= dimensions[f"{name}.length"] <= 4.0
        for name in ("coupler.P.x", "coupler.P.y"):
            assert -1.0 <= dimensions[name] <= 2.0
        assert dimensions["ground.D.x"] == 3.0
        # By another method.
        sign = design.assembly["C"]
        at = moved(dimensions, sign, Q)
        rocker = np.unwrap(at["rocker"])
        assert np.ptp(rocker) == pytest.approx(values["swing"][index], rel=1e-9)
        assert at["P"].imag.max() == pytest.approx(values["size"][index], rel=1e-9)
        least = transmission(dimensions, sign, Q).min()
        assert least == pytest.approx(values["gamma"][index], rel=1e-9)
        assert least > 0.5


def test_same_bits_on_any_number_of_threads() -> None:
    one, two = (four_bars(seed=3, threads=threads) for threads in (1, 2))
    np.testing.assert_array_equal(one.designs.values, two.designs.values)
    other = four_bars(seed=4)
    assert dict(other[0].dimensions) != dict(one[0].dimensions)


def test_forces_are_goals_of_a_machine() -> None:
    machine = assur.Machine(
        slider_crank(),
        bodies={"piston": assur.Body(mass=2.0)},
        loads=[assur.Force("B", (-100.0, 0.0))],
    )
    goals: dict[str, Any] = {
        "minimize": {"torque": metric.peak_effort(speed=0.0)},
        "maximize": {"stroke": metric.span("bore")},
        "bounds": {"crank.length": (0.05, 0.2)},
    }
    front = assur.pareto(machine, Q, **goals, **FEW)
    for index, design in enumerate(front):
        effort = machine.of(design).reactions(Q, speed=0.0).driver
        assert np.abs(effort).max() == pytest.approx(front.values["torque"][index], rel=1e-12)
    with pytest.raises(assur.InputError, match="is of a machine"):
        assur.pareto(slider_crank(), Q, **goals, **FEW)


def test_how_long_it_goes_on() -> None:
    seen: list[Any] = []
    front = assur.pareto(
        slider_crank(), Q, **GOALS, **FEW, progress=lambda *told: seen.append(told)
    )
    assert front.generations == 6
    # Before the first there are ten times as many, and the drawing.
    assert front.evaluations == 121 + 6 * 12
    parts, counts = zip(*seen, strict=True)
    assert parts == pytest.approx(np.arange(1, 7) / 6)
    assert all(0 < count <= 12 for count in counts[1:])
    by_count = assur.pareto(slider_crank(), Q, **GOALS, population=12, evaluations=150)
    assert by_count.evaluations == 121 + 3 * 12
    at_once = assur.pareto(slider_crank(), Q, **GOALS, population=12, time_limit=1e-9)
    assert at_once.generations == 1
    with pytest.raises(assur.InputError, match="time_limit"):
        assur.pareto(slider_crank(), Q, **GOALS, time_limit=0.0)


def test_ctrl_c_keeps_the_front() -> None:
    def stop(part: float, _count: float) -> None:
        if part > 0.4:
            raise KeyboardInterrupt

    with pytest.warns(assur.AssurWarning, match=r"interrupted after .* in generation 4"):
        front = assur.pareto(slider_crank(), Q, **GOALS, **FEW, progress=stop)
    shorter = assur.pareto(slider_crank(), Q, **GOALS, population=12, generations=3)
    np.testing.assert_array_equal(front.designs.values, shorter.designs.values)


def test_ctrl_c_in_the_midst_of_a_generation() -> None:
    going_on = threading.Event()

    def ctrl_c() -> None:
        going_on.wait()
        time.sleep(0.02)
        signal.raise_signal(signal.SIGINT)

    thread = threading.Thread(target=ctrl_c)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        thread.start()
        with pytest.warns(assur.AssurWarning, match="pareto was interrupted after"):
            front = assur.pareto(
                slider_crank(), Q, **GOALS, generations=10**9, progress=lambda *_: going_on.set()
            )
    finally:
        going_on.set()
        thread.join()
        signal.signal(signal.SIGINT, before)
    assert len(front) > 1
    assert front.evaluations < 1_000_000


def test_ctrl_c_before_there_is_a_front(monkeypatch: pytest.MonkeyPatch) -> None:
    def stop(*_: Any) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("assur.fitting.pareto.candidates.Candidates.measure", stop)
    with pytest.raises(KeyboardInterrupt):
        assur.pareto(slider_crank(), Q, **GOALS, **FEW)


REFUSED: dict[str, tuple[dict[str, Any], str]] = {
    "no goal": ({"maximize": None}, "have 0 goals: a front is of two or more"),
    "one goal": ({"maximize": {"stroke": metric.span("bore")}}, "have 1 goal: a front is of"),
    "no mapping": ({"minimize": metric.span("bore")}, "a mapping is needed"),
    "no metric": ({"minimize": {"x": 3.0}}, r"minimize\['x'\] is 3.0: one of assur.metric"),
    "a condition": ({"minimize": {"x": metric.span("bore") < 1.0}}, "limits of metrics go into"),
    "twice": ({"minimize": {"stroke": metric.max("bore")}}, "'stroke' is in minimize and in"),
    "no joint": ({"minimize": {"x": metric.span("K.x")}}, "K"),
    "no bounds": ({"bounds": {}}, "a population is spread over them"),
    "bounds": ({"bounds": {"rod.length": (2.0, 1.0)}}, "the least comes first"),
    "unknown": ({"bounds": {"rot.length": (1.0, 2.0)}}, "'rot.length' is not a dimension"),
    "unbounded": ({"vary": "*"}, "bounds: 'ground.O.x' varies and has none"),
    "a tie": ({"ties": [("rod.length", "bore.offset")]}, "which does not vary"),
    "no ties": ({"ties": 0.5}, "ties is 0.5: a list"),
    "no names": ({"vary": 0.5}, "vary is 0.5: a name or a list of names"),
    "where": ({"where": [True]}, "is not a condition"),
    "population": ({"population": 3}, "from 4 to 2000"),
    "generations": ({"generations": 0}, "generations is 0"),
    "evaluations": ({"evaluations": 0}, "evaluations is 0"),
    "seed": ({"seed": -1}, "seed is -1"),
    "threads": ({"threads": 0}, "threads is 0"),
    "progress": ({"progress": 3}, "progress is 3"),
    "both": ({"deg": [1.0]}, "both q and deg"),
    "no q": ({"q": None}, "neither q nor deg"),
    "NaN": ({"q": [np.nan]}, "not finite"),
}


@pytest.mark.parametrize("which", REFUSED)
def test_what_is_refused(which: str) -> None:
    options, text = REFUSED[which]
    arguments: dict[str, Any] = {"q": Q, **GOALS, **FEW, **options}
    with pytest.raises(assur.InputError, match=text):
        assur.pareto(slider_crank(), arguments.pop("q"), **arguments)


def test_which_mechanisms_are_refused() -> None:
    batch: Any = slider_crank().with_dimensions({"crank.length": [0.1, 0.2]})
    with pytest.raises(assur.InputError, match=r"a batch of designs \(2,\)"):
        assur.pareto(batch, Q, **GOALS)
    nothing: Any = "press"
    with pytest.raises(assur.InputError, match=r"an assur\.Machine is needed"):
        assur.pareto(nothing, Q, **GOALS)


def test_impossible_goals_say_what_is_missed() -> None:
    flat = [metric.min_transmission_angle("B") > 1.5]
    with pytest.raises(assur.FitError, match=r"nearest misses .*\('B'\) > 1.5 by 0.02"):
        # The best of all has arccos(0.05 / 0.5) = 1.4706.
        assur.pareto(slider_crank(), Q, **GOALS, population=40, generations=30, where=flat)
    bounds = {"crank.length": (0.5, 0.6), "rod.length": (0.1, 0.2)}
    with pytest.raises(assur.FitError, match=r"no design within the bounds moves over all of q"):
        assur.pareto(slider_crank(), Q, **{**GOALS, "bounds": bounds}, **FEW)


def test_bounds_that_leave_one_design() -> None:
    bounds = {"crank.length": (0.1, 0.1)}
    front = assur.pareto(slider_crank(), Q, **{**GOALS, "bounds": bounds}, **FEW)
    assert len(front) == 1
    assert front[0].dimensions["crank.length"] == 0.1
    front.plot()


def test_it_is_a_sequence_that_copies() -> None:
    front = assur.pareto(slider_crank(), Q, **GOALS, **FEW)
    assert front.designs.shape == (len(front),)
    assert front[-1] == front[len(front) - 1] == list(front)[-1]
    assert front[1:3] == (front[1], front[2])
    with pytest.raises(IndexError):
        front[len(front)]
    for again in (pickle.loads(pickle.dumps(front)), copy.deepcopy(front)):
        assert again[0] == front[0]
        np.testing.assert_array_equal(again.values["angle"], front.values["angle"])
    with pytest.raises(ValueError, match="read-only"):
        front.values["angle"][0] = 0.0
    table = front.to_dataframe(degrees=True)
    assert list(table) == ["design", "crank.length", "rod.length", "stroke", "angle"]
    np.testing.assert_array_equal(table["angle"], np.degrees(front.values["angle"]))
    assert table.attrs["units"]["angle"] == "deg"
    assert repr(front).startswith(f"<assur.ParetoFront: {len(front)} designs; stroke 0.")


def test_the_picture() -> None:
    front = four_bars()
    axes = front.plot("swing", "gamma", degrees=True)
    assert axes.get_xlabel() == "swing, ° (maximize)"
    (points,) = (line for line in axes.lines if line.get_gid() == "designs")
    drawn = np.column_stack([front.values["swing"], front.values["gamma"]])
    np.testing.assert_array_equal(points.get_xydata(), drawn)
    named: list[Any] = [text for text in axes.texts if text.get_gid() == "index"]
    assert named
    for text in named:
        np.testing.assert_array_equal(text.xy, drawn[int(text.get_text())])
    assert front.plot().get_ylabel() == "gamma, rad (maximize)"
    mpl.pyplot.close("all")
    wrong: Any
    for wrong in ({"x": "speed"}, {"y": "size"}):
        with pytest.raises(assur.InputError, match=r"'speed': one of 'size'|both 'size'"):
            front.plot(**wrong)


def test_the_page(tmp_path: Path) -> None:
    front = four_bars(generations=3)
    page = tmp_path / "front.html"
    front.to_html(page, title="a < b", degrees=True)
    text = page.read_text(encoding="utf-8")
    assert "<title>a &lt; b</title>" in text
    assert "http" not in text.replace("http-equiv", "").replace("http://www.w3.org", "")
    for index in range(len(front)):
        # A point and a row.
        assert text.count(f'href="#{index}"') == 2
    with pytest.raises(assur.InputError, match="title is 3"):
        front.to_html(page, title=3)  # type: ignore[arg-type]


def test_undominated_rows_by_all_pairs() -> None:
    rng = np.random.default_rng(5)
    for columns in (2, 3, 4):
        for _ in range(20):
            costs = rng.integers(0, 6, (40, columns)).astype(float)
            front = undominated(costs)
            chosen = [tuple(row) for row in costs[front].tolist()]
            assert chosen == sorted(set(chosen))
            rows = {tuple(row) for row in costs.tolist()}
            assert set(chosen) == rows - {tuple(costs[i].tolist()) for i in dominated(costs)}


@pytest.mark.parametrize("most", [20_000, 300])
def test_the_archive_keeps_what_is_best(most: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(archive, "MOST", most)
    rng = np.random.default_rng(2)
    kept = archive.Archive(12)
    added = []
    for _ in range(20):
        # A quarter of a circle, and what is behind it.
        turn, behind = 0.5 * np.pi * rng.random(50), 1.0 + 0.1 * rng.random(50) ** 2
        costs = np.column_stack([-np.cos(turn), -np.sin(turn)]) / behind[:, np.newaxis]
        kept.add(np.column_stack([turn, behind]), costs)
        added.append(costs)
    turn, behind = kept.front().T
    costs = np.column_stack([-np.cos(turn), -np.sin(turn)]) / behind[:, np.newaxis]
    every = np.concatenate(added)
    assert len(costs) == 12
    assert dominated(costs) == []
    # The ends are there, and the rest is even: 12 on 90° are 8.2° apart.
    np.testing.assert_array_equal(costs.min(axis=0), every.min(axis=0))
    assert np.diff(np.sort(turn)).max() < np.deg2rad(15.0)
    if most > len(every):
        best = {tuple(every[i]) for i in range(len(every))} - {
            tuple(every[i]) for i in dominated(every)
        }
        assert {tuple(row) for row in costs} <= best


def test_without_pymoo_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    real = builtins.__import__

    def missing(name: str, *args: Any, **options: Any) -> Any:
        if name.startswith("pymoo"):
            raise ImportError(name)
        return real(name, *args, **options)

    monkeypatch.setattr(builtins, "__import__", missing)
    with pytest.raises(ImportError, match=r'pip install "assur\[pareto\]"'):
        assur.pareto(slider_crank(), Q, **GOALS, **FEW)
