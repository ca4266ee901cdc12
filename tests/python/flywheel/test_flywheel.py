"""Flywheels from tables: P3, Khurmi & Gupta's examples, random tables at 50 digits."""

from __future__ import annotations

import pickle
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import flywheel
from assur.cli import main
from oracles.dynamics import oracle_flywheel as oracle
from oracles.dynamics.oracle_flywheel import mp

if TYPE_CHECKING:
    from pathlib import Path

TURN = 2.0 * np.pi
PHI = np.linspace(0.0, TURN, 9)
MOMENT = np.array([-0.23, -274.4, -950.5, 19.9, 1.26, -300.0, -23.9, -15.9, -0.23])
SECOND = np.where(MOMENT == -300.0, -300.9, MOMENT)
INERTIA = np.array([4.93, 5.07, 5.1, 5.1, 4.93, 5.05, 5.1, 5.14, 4.93])
# What is asked of a solution: sums of a few dozen rounded terms.
CLOSE = 1e-12
# A place where the speed is greatest is known to the root of what the speed is known to, but its
# derivative's zero is solved for: that is a difference of terms of the size of the moments.
PLACE = 1e-9


def p3(**keywords: Any) -> flywheel.Flywheel:
    arguments = {"fluctuation": 1 / 8, "mean_speed": 15.0} | keywords
    return flywheel.from_table(PHI, MOMENT, INERTIA, **arguments)


def test_the_numbers_of_p3() -> None:
    f = p3()
    assert f.motor_moment == pytest.approx(184.03475962, abs=5e-9)
    assert f.inertia == pytest.approx(19.9181505147, abs=5e-11)
    assert f.speed0 == pytest.approx(15.516642, abs=5e-7)
    assert (f.max.value, f.min.value) == pytest.approx((15.9375, 14.0625), abs=1e-13)
    assert f.max.q == pytest.approx(0.709330, abs=5e-7)
    assert f.min.q == pytest.approx(2.182865, abs=5e-7)
    assert f.period == pytest.approx(0.41989702, abs=5e-9)
    # As printed, to its digits.
    printed = (round(f.motor_moment), round(f.inertia, 2), round(f.speed0, 2), round(f.period, 2))
    assert printed == (184, 19.92, 15.52, 0.42)


def test_p3_by_the_period() -> None:
    f = p3(mean="period")
    assert f.inertia == pytest.approx(19.858781, abs=5e-7)
    assert f.speed0 == pytest.approx(15.553135, abs=5e-7)
    assert f.max.value == pytest.approx(15.973827, abs=5e-7)
    assert f.min.value == pytest.approx(14.098827, abs=5e-7)
    assert f.period == pytest.approx(TURN / 15.0, rel=1e-14)
    assert f.delta == pytest.approx(1 / 8, rel=1e-13)
    # Equation 6, which the paper asks for: the speed over the time of a turn is a turn.
    t = np.linspace(0.0, f.period, 4001)
    assert np.trapezoid(f.speed_at(t), t) == pytest.approx(TURN, rel=1e-6)


def test_p3_without_a_flywheel() -> None:
    f = flywheel.evaluate(PHI, MOMENT, INERTIA, speed0=17.971089)
    assert f.inertia == 0.0
    assert f.max.q == pytest.approx(0.705044, abs=5e-7)
    assert f.max.value == pytest.approx(19.649, abs=5e-4)
    assert f.min.q == pytest.approx(2.184668, abs=5e-7)
    assert f.min.value == pytest.approx(10.4665, abs=5e-5)
    assert f.delta == pytest.approx(0.60982, abs=5e-6)
    assert f.period == pytest.approx(0.421026, abs=5e-7)
    # What is printed there: 0.705, 19.649, 2.185, 10.465 (10.4665 here), 0.61, 0.42.
    assert (round(f.max.q, 3), round(f.min.q, 3)) == (0.705, 2.185)
    assert round(f.delta, 2) == 0.61


def test_errata_of_p3() -> None:
    """The motor's sign, the fifth knot of two printings, the ends of the spline."""
    first, second = (
        flywheel.from_table(PHI, moment, INERTIA, fluctuation=1 / 8, mean_speed=15.0)
        for moment in (MOMENT, SECOND)
    )
    # The motor is printed without its minus: it is against the mean of the loads.
    assert first.motor_moment > 0 > np.mean(MOMENT)
    assert second.motor_moment == pytest.approx(184.15591346, abs=5e-9)
    assert second.inertia == pytest.approx(19.912093, abs=5e-7)
    # The printed 19.92 is that of -300.0.
    assert (round(first.inertia, 2), round(second.inertia, 2)) == (19.92, 19.91)
    # Printed 15.003 with the printed flywheel and speed; 15.0035 with the numbers as printed.
    printed = flywheel.evaluate(PHI, MOMENT, INERTIA, flywheel=19.92, speed0=15.52)
    assert printed.mean_speed == pytest.approx(15.0035057, abs=5e-8)
    ends = {"natural": 193.79536727, "clamped": 192.97125, "periodic": 192.97125}
    for spline, motor in ends.items():
        assert p3(spline=spline).motor_moment == pytest.approx(motor, abs=5e-9)


def exact(values: Any) -> list[Any]:
    return [mp.mpf(float(v)) for v in values]


def table(seed: int, rows: int) -> tuple[Any, Any, Any]:
    rng = np.random.default_rng(seed)
    phi = np.concatenate(([0.0], np.sort(rng.uniform(0.05, 0.95, rows - 2)), [1.0])) * TURN
    moment, inertia = rng.uniform(-100.0, 100.0, rows), rng.uniform(1.0, 3.0, rows)
    moment[-1], inertia[-1] = moment[0], inertia[0]
    return phi, moment, inertia


# Every spline with every table, each with one mean: in turn.
AT_FIFTY_DIGITS = [
    (*table, spline, flywheel.MEANS[(i + j) % 2])
    for i, table in enumerate([(0, 9, 0.125), (2, 14, 0.02), (3, 6, 0.1)])
    for j, spline in enumerate(flywheel.SPLINES[:4])
]


@pytest.mark.parametrize(("seed", "rows", "delta", "spline", "mean"), AT_FIFTY_DIGITS)
def test_random_tables_at_fifty_digits(
    seed: int, rows: int, delta: float, spline: Any, mean: Any
) -> None:
    phi, moment, inertia = (PHI, MOMENT, INERTIA) if seed == 0 else table(seed, rows)
    f = flywheel.from_table(
        phi, moment, inertia, fluctuation=delta, mean_speed=15.0, mean=mean, spline=spline
    )
    machine = oracle.from_table(exact(phi), exact(moment), exact(inertia), spline)
    assert f.motor_moment == pytest.approx(float(machine.motor), rel=CLOSE)
    # What was found has, at 50 digits, the fluctuation and the mean asked for.
    true = oracle.motion(machine, mp.mpf(f.inertia), mp.mpf(f.speed0))
    width = mp.mpf(float(phi[-1]))
    of = {"extremes": (true.top + true.low) / 2, "period": width / true.turn}[mean]
    assert abs(of / 15 - 1) < CLOSE
    assert abs((true.top - true.low) / of / mp.mpf(delta) - 1) < CLOSE / delta
    assert f.max.value == pytest.approx(float(true.top), rel=CLOSE)
    assert f.min.value == pytest.approx(float(true.low), rel=CLOSE)
    assert f.max.q == pytest.approx(float(true.top_at), abs=PLACE)
    assert f.min.q == pytest.approx(float(true.low_at), abs=PLACE)
    assert f.period == pytest.approx(float(true.turn), rel=CLOSE)
    for q in (0.1, 1.0, 3.3, 6.2):
        speed = oracle.omega(machine, mp.mpf(f.inertia), mp.mpf(f.speed0), mp.mpf(q))
        assert f.speed(q) == pytest.approx(float(speed), rel=CLOSE)
        assert f.work(q) == pytest.approx(float(machine.work(mp.mpf(q))), abs=CLOSE * 1e3)


def test_the_flywheel_itself_at_fifty_digits() -> None:
    """Newton's iteration in two unknowns knows nothing of tangents."""
    machine = oracle.from_table(exact(PHI), exact(MOMENT), exact(INERTIA), "not-a-knot")
    for mean in ("extremes", "period"):
        true = oracle.solve(machine, mp.mpf("0.125"), mp.mpf(15), mean)
        f = p3(mean=mean)
        assert f.inertia == pytest.approx(float(true.flywheel), rel=CLOSE)
        assert f.speed0 == pytest.approx(float(true.speed0), rel=CLOSE)


def test_khurmi_and_gupta() -> None:
    """Examples 16.11 and 16.12: constant inertia, where I = ΔE / (δ ω²) is exact."""
    q = np.linspace(0.0, TURN, 1441)
    omega = 180 * TURN / 60
    torque = 20000 + 9500 * np.sin(2 * q) - 5700 * np.cos(2 * q)
    f = flywheel.from_table(
        q, torque - 20000, np.full_like(q, 100.0), fluctuation=0.01, mean_speed=omega
    )
    assert f.inertia + 100.0 == pytest.approx(3118.1055575550, rel=1e-9)
    work = f.work(q)
    assert np.ptp(work) == pytest.approx(11078.8086, abs=5e-2)
    torque, load = 5000 + 600 * np.sin(2 * q), 5000 + 500 * np.sin(q)
    own = np.full_like(q, 500 * 0.4**2)
    f = flywheel.evaluate(q, torque - load, own, mean_speed=150 * TURN / 60)
    assert 100.0 * f.delta == pytest.approx(6.1003795985, rel=1e-8)
    assert np.ptp(f.work(q)) == pytest.approx(1204.1667, abs=1e-2)
    by_period = flywheel.evaluate(q, torque - load, own, mean_speed=150 * TURN / 60, mean="period")
    assert 100.0 * by_period.delta == pytest.approx(6.1612334793, rel=1e-8)


def test_curves_belong_together() -> None:
    f = p3()
    q = np.linspace(-20.0, 20.0, 401)
    # Times and angles are each other's inverse, any number of turns on.
    assert np.abs(f.coordinate(f.time(q)) - q).max() < 1e-13
    assert f.time(TURN) == pytest.approx(f.period, rel=1e-15)
    assert f.time(0.0) == 0.0
    # The speed is the derivative of the angle by the time.
    t = f.time(q)
    step = 1e-5
    speed = (f.coordinate(t + step) - f.coordinate(t - step)) / (2 * step)
    assert np.abs(speed / f.speed(q) - 1).max() < 1e-6
    # Energy: the work of a turn is none, and goes into speed.
    energy = np.asarray(0.5 * (f.reduced_inertia(q) + f.inertia) * f.speed(q) ** 2)
    assert np.abs(energy - f.work(q) - energy[0] + f.work(q[0])).max() < 1e-9
    inertia, diagram = f.energy_mass()
    start = f.inertia * f.speed0**2 / 2
    for place, sign in ((f.max, 1), (f.min, -1)):
        # Wittenbauer's tangents touch the diagram and leave it on one side.
        line = place.value**2 / 2 * (inertia + f.inertia) - start
        assert (sign * (line - diagram)).min() > -1e-9
        assert abs(sign * (line - diagram)).min() < 1.0


def test_tables_whose_period_is_not_a_turn() -> None:
    """An engine of four strokes repeats after two turns; beginnings may be anywhere."""
    q = np.linspace(1.0, 1.0 + 2 * TURN, 97)
    f = flywheel.from_table(
        q, 50 * np.cos((q - 1) / 2), 2 + 0.1 * np.cos(q - 1), fluctuation=0.02, mean_speed=100.0
    )
    assert f.period == pytest.approx(2 * TURN / 100.0, rel=2e-2)
    assert f.time(1.0) == 0.0
    assert f.speed(1.0 + 2 * TURN) == pytest.approx(f.speed0, rel=1e-14)


def test_degrees_are_doubted() -> None:
    with pytest.warns(assur.AssurWarning, match=r"phi covers 360 rad, 57\.2958 turns.*degrees"):
        flywheel.from_table(np.rad2deg(PHI), MOMENT, INERTIA, fluctuation=1 / 8, mean_speed=15.0)
    for turns in (0.25, 0.5, 1.0, 2.0, 6.283 / TURN):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            flywheel.from_table(PHI * turns, MOMENT, INERTIA, fluctuation=0.02, mean_speed=15.0)


def test_batches_have_the_bits_of_single_tables() -> None:
    rng = np.random.default_rng(5)
    factors = rng.uniform(0.5, 2.0, (40, 5, 1))
    deltas = rng.uniform(0.02, 0.2, 5)
    many = flywheel.from_table(
        PHI, factors * MOMENT, INERTIA, fluctuation=deltas, mean_speed=15.0, threads=2
    )
    assert many.shape == (40, 5)
    again = flywheel.from_table(
        PHI, factors * MOMENT, INERTIA, fluctuation=deltas, mean_speed=15.0, threads=1
    )
    q = np.array([0.3, 4.0])
    assert many.speed(q).shape == (40, 5, 2)
    assert np.array_equal(many.inertia, again.inertia)
    for i, j in ((0, 0), (17, 3), (39, 4)):
        one = flywheel.from_table(
            PHI, factors[i, j] * MOMENT, INERTIA, fluctuation=deltas[j], mean_speed=15.0
        )
        assert one.inertia == many.inertia[i, j]
        assert one.period == many.period[i, j]
        assert np.array_equal(one.speed(q), many.speed(q)[i, j])
    copy = pickle.loads(pickle.dumps(many))
    assert np.array_equal(copy.speed0, many.speed0)


def test_a_bad_table_of_a_batch_is_nan_in_its_place() -> None:
    moments = np.array([1.0, 0.01, np.nan])[:, np.newaxis] * MOMENT
    f = flywheel.from_table(PHI, moments, INERTIA, fluctuation=0.1, mean_speed=15.0, on_error="nan")
    assert np.isnan(f.inertia).tolist() == [False, True, True]
    assert np.isnan(f.speed(1.0)).tolist() == [False, True, True]
    assert "none is needed" in f.explain(1)
    assert "row 0 of the table: moment is NaN" in f.explain(2)
    assert "a flywheel of" in f.explain(0)
    with pytest.raises(assur.InputError, match=r"table \(1,\) \(and 1 more\)"):
        flywheel.from_table(PHI, moments, INERTIA, fluctuation=0.1, mean_speed=15.0)


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ({"phi": PHI[::-1]}, "row 1 of the table: phi goes from 6.28.* to 5.49"),
        ({"phi": np.ones((9, 2))}, r"phi has the shape \(9, 2\)"),
        ({"moment": MOMENT[:-1]}, r"moment has the shape \(8,\): its last axis must have the 9"),
        ({"moment": np.append(MOMENT[:-1], 3.0)}, "not periodic: moment is -0.23 .* 3 in its last"),
        ({"inertia": np.append(INERTIA[:-1], 5.0)}, "not periodic: inertia is 4.93"),
        ({"inertia": -INERTIA}, "the inertia is -4.93 kg·m² at phi = 0 rad"),
        (
            {"inertia": [1, 9, 1, 0.1, 9, 0.1, 1, 9, 1]},
            "inertia is -.* must not be negative",
        ),
        ({"inertia": np.full(9, np.inf)}, "row 0 of the table: inertia is inf"),
        ({"moment": "x"}, "moment is 'x'"),
        ({"fluctuation": 0.0}, "fluctuation = 0: it must be more than 0"),
        ({"fluctuation": 2.0}, "fluctuation = 2: it must be more than 0 and less than 2"),
        ({"fluctuation": 1.0}, "the fluctuation is 0.614.* without a flywheel"),
        ({"mean_speed": -1.0}, "mean_speed = -1 rad/s: it must be positive"),
        ({"mean": "median"}, "mean is 'median': one of 'extremes', 'period'"),
        ({"spline": "akima"}, "spline is 'akima'"),
        ({"threads": 0}, "threads is 0"),
        ({"fluctuation": np.ones((2, 3)), "mean_speed": np.ones(2)}, "do not fit"),
        ({"on_error": "warn"}, "on_error is 'warn'"),
    ],
)
def test_invalid_arguments_are_refused(change: dict[str, Any], expected: str) -> None:
    arguments: dict[str, Any] = {"phi": PHI, "moment": MOMENT, "inertia": INERTIA}
    arguments |= {"fluctuation": 1 / 8, "mean_speed": 15.0}
    with pytest.raises(assur.InputError, match=expected):
        flywheel.from_table(**(arguments | change))


def test_evaluate_refuses_invalid_arguments() -> None:
    cases: tuple[tuple[dict[str, Any], str], ...] = (
        ({}, "one of speed0 and mean_speed is needed"),
        ({"speed0": 1.0, "mean_speed": 1.0}, "not both"),
        ({"speed0": 0.0}, "speed0 = 0 rad/s"),
        ({"flywheel": -1.0, "speed0": 15.0}, "flywheel = -1 kg·m²"),
    )
    for given, expected in cases:
        with pytest.raises(assur.InputError, match=expected):
            flywheel.evaluate(PHI, MOMENT, INERTIA, **given)
    with pytest.raises(assur.MotionError, match=r"stalls at phi = 2.18.* rad: it lacks 454.1.* J"):
        flywheel.evaluate(PHI, MOMENT, INERTIA, speed0=5.0)
    with pytest.raises(assur.MotionError, match="no motion with a mean speed of 1 rad/s was found"):
        flywheel.evaluate(PHI, MOMENT, INERTIA, mean_speed=1.0)
    f = p3()
    with pytest.raises(assur.InputError, match="q has nan"):
        f.speed([1.0, np.nan])
    with pytest.raises(assur.InputError, match="what is 'x'"):
        f.plot("x")  # type: ignore[call-overload]
    with pytest.raises(assur.InputError, match="explain 3"):
        f.explain(3)


def test_on_the_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "table.csv"
    rows = zip(np.rad2deg(PHI), INERTIA, MOMENT, strict=True)
    path.write_text(
        "# of a press\ninertia,phi,moment\n" + "".join(f"{i},{p},{m}\n" for p, i, m in rows)
    )
    asked = ["flywheel", str(path), "--mean-speed", "15", "--degrees"]
    picture = tmp_path / "speed.png"
    assert main([*asked, "--fluctuation", "0.125", "--plot", str(picture)]) == 0
    printed = capsys.readouterr().out
    assert "flywheel      19.9181505 kg·m²" in printed
    assert "motor         184.03476 N·m" in printed
    assert picture.stat().st_size > 1000
    assert main([*asked, "--flywheel", "0", "--mean", "period"]) == 0
    assert "mean speed    15 rad/s (period)" in capsys.readouterr().out
    assert main([*asked, "--fluctuation", "1"]) == 1
    assert "assur: the fluctuation is 0.614" in capsys.readouterr().err
    assert main(["flywheel", str(tmp_path / "none.csv"), *asked[2:], "--fluctuation", "0.1"]) == 1
    assert "cannot be read" in capsys.readouterr().err
    for text, words in (("phi,moment\n0,1\n", "no column 'inertia'"), ("0,1,2\n1,x,2\n", "line 2")):
        path.write_text(text)
        assert main([*asked, "--fluctuation", "0.1"]) == 1
        assert words in capsys.readouterr().err
    path.write_text("")
    assert main([*asked, "--fluctuation", "0.1"]) == 1
    assert "0 rows" in capsys.readouterr().err
    assert main(["flywheel", str(path), "--mean-speed", "15"]) == 2
    assert "a table needs --fluctuation" in capsys.readouterr().err
