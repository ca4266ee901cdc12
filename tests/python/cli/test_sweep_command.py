"""`assur sweep` prints what `assur.sweep` measures, to the bit."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

import assur
from assur import metric
from cli.command_line import Done, assur_command, columns, refused, same, table

PRESS = Path(__file__).parents[3] / "examples" / "press.toml"
TURN = np.linspace(0.0, 2 * np.pi, 72, endpoint=False)
GRID = ("--vary", "coupler.length=90:150mm:6", "--vary", "rocker.length=60,80,500mm")
GAMMA = ("--metric", "gamma=min_transmission_angle(C)")
ROCKER = ("sweep", "example:crank_rocker")


def measured(where: object = None) -> assur.Measures:
    axes: dict[str, npt.ArrayLike] = {
        "coupler.length": np.linspace(0.09, 0.15, 6),
        "rocker.length": [0.06, 0.08, 0.5],
    }
    gamma = metric.min_transmission_angle("C")
    conditions = [gamma > where] if isinstance(where, float) else None
    return assur.sweep(
        assur.examples.crank_rocker(),
        assur.Grid(axes),
        TURN,
        metrics={"gamma": gamma, "span(P.x)": metric.span("P.x")},
        where=conditions,
    )


def test_a_grid() -> None:
    found = table(*ROCKER, *GRID, *GAMMA, "--metric", "span(P.x)")
    own = measured().to_dataframe()
    assert list(found) == list(own)
    for name in own:
        assert same(found[str(name)], own[name])
    assert np.isnan(found["gamma"]).any()
    assert not np.isnan(found["gamma"]).all()


def test_the_best_and_conditions() -> None:
    limit = 30 * (np.pi / 180)
    own = measured(limit)
    words = (*ROCKER, *GRID, *GAMMA, "--metric", "span(P.x)")
    where = "--where", "min_transmission_angle(C) > 30deg"
    for flags, by, method in (
        (("--nlargest", 3), "gamma", own.nlargest),
        (("--nsmallest", 3, "--by", "span(P.x)"), "span(P.x)", own.nsmallest),
    ):
        found = table(*words, *where, *flags)
        best = method(3, by)
        assert len(best) == 3
        assert same(found[by], own[by].ravel()[best])
        assert same(found["design0"] * 3 + found["design1"], best)
    assert same(table(*ROCKER, *GRID, *GAMMA, *where)["kept"].nonzero()[0], own.kept)


def test_designs_of_a_table(tmp_path: Path) -> None:
    rng = np.random.default_rng(3)
    pairs = {name: rng.uniform(0.07, 0.15, 40) for name in ("coupler.length", "rocker.length")}
    path = tmp_path / "designs.csv"
    rows = zip(*(values.tolist() for values in pairs.values()), strict=True)
    path.write_text(
        f"{','.join(pairs)}\n\n" + "".join(f"{a!r},{b!r}\n" for a, b in rows), encoding="utf-8-sig"
    )
    gamma = {"gamma": metric.min_transmission_angle("C")}
    q = np.arange(0.0, 351.0, 10.0) * (np.pi / 180)
    own = assur.sweep(assur.examples.crank_rocker(), pairs, q, metrics=gamma)
    found = table(*ROCKER, "--designs", path, *GAMMA, "--q", "0:350:10deg")
    assert same(found["gamma"], own["gamma"])
    assert same(found["rocker.length"], pairs["rocker.length"])


def test_designs_of_a_sweeps_own_table(tmp_path: Path) -> None:
    path = tmp_path / "best.csv"
    words = (*ROCKER, *GRID, *GAMMA, "--nsmallest", 4, "--out", path)
    assert assur_command(*words).code == 0
    assert "True" in path.read_text(encoding="utf-8")
    first = columns(path.read_text(encoding="utf-8"))
    again = table(*ROCKER, "--designs", path, *GAMMA, "--metric", "span(P.x)")
    assert list(again)[:3] == ["design", "coupler.length", "rocker.length"]
    for name in ("coupler.length", "rocker.length", "gamma"):
        assert same(again[name], first[name])


def test_metrics_of_a_machine() -> None:
    machine = assur.load(PRESS)
    lengths = {"rod.length": np.linspace(0.35, 0.45, 3)}
    speed = 200 * (np.pi / 30)
    peak = {"peak": metric.peak_reaction("B", speed=speed)}
    q = np.linspace(0.0, 2 * np.pi, 36, endpoint=False)
    own = assur.sweep(machine, lengths, q, metrics=peak)
    words = "--vary", "rod.length=35:45cm:3", "--metric", "peak=peak_reaction(B, speed=200rpm)"
    assert same(table("sweep", PRESS, *words, "--positions", 36)["peak"], own["peak"])


def test_angles_and_several_drivers() -> None:
    m = assur.examples.engine()
    angles = np.linspace(0.0, 10.0, 3) * (np.pi / 180)
    own = assur.sweep(m, {"bore.angle": angles}, TURN, metrics={"a": metric.span("bore")})
    words = "sweep", "example:engine", "--vary", "bore.angle=0:10deg:3", "--metric", "a=span(bore)"
    np.testing.assert_allclose(table(*words)["a"], own["a"], rtol=1e-14)
    found = table(
        "sweep", "example:five_bar", "--vary", "ground.E.x=0.2:0.22:3", "--metric", "span(P.x)"
    )
    five, q = assur.examples.five_bar(), np.linspace(*assur.examples.RANGES["five_bar"], 91)
    over = {"ground.E.x": np.linspace(0.2, 0.22, 3)}
    mine = assur.sweep(five, over, q, metrics={"a": metric.span("P.x")})
    assert same(found["span(P.x)"], mine["a"])  # fmt: skip


def test_no_design_is_left() -> None:
    words = "sweep", "example:engine", "--vary", "rod.length=10:20mm:5", "--metric", "span(bore)"
    done = assur_command(*words, "--nsmallest", 2)
    assert done.code == 3
    assert done.err == (
        "assur: no design is left: of 5 designs 5 do not move, 0 miss a condition, 0 are kept\n"
    )
    assert np.isnan(columns(done.out)["span(bore)"]).all()
    missed = assur_command(*ROCKER, *GRID, *GAMMA, "--where", "span(P.x) < 0")
    assert isinstance(missed, Done)
    assert missed.code == 3


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--vary", "x=1:2:3"), "coupler.length"),
        (("--vary", "coupler.lenght=1:2:3"), "coupler.length"),
        (("--vary", "coupler.length=1:2deg:3"), "--vary coupler.length is a length"),
        (("--vary", "coupler.length=1", "--vary", "coupler.length=2"), "is given twice"),
        (
            ("--vary", "coupler.length=1", "--by", "x", "--nsmallest", "2"),
            "there is no such --metric",
        ),
        (("--vary", "coupler.length=1", "--metric", "gamma=span(P.x)"), "two have the same name"),
        (("--vary", "coupler.length=1", "--metric", "span(X.x)"), "X"),
        (("--vary", "coupler.length=1", "--where", "span(P.x)"), "is not a condition"),
        (("--vary", "coupler.length=1", "--threads", "0"), "threads is 0"),
        (("--vary", "coupler.length=1", "--positions", "0"), "--positions is 0"),
        (("--designs", "missing.csv"), "missing.csv: the designs cannot be read"),
        (
            ("--vary", "coupler.length=1:2:5000000", "--vary", "rocker.length=1:2:50"),
            "these are 250000000 designs, of 20000000 at most",
        ),
    ],
)
def test_wrong_sweeps(words: tuple[str, ...], said: str) -> None:
    assert said in refused(*ROCKER, *words, *GAMMA)


@pytest.mark.parametrize(
    "words",
    [
        ("--metric", "span(P.x)"),
        ("--vary", "coupler.length=1"),
        ("--vary", "coupler.length", *GAMMA),
        ("--vary", "coupler.length=1:2", *GAMMA),
        ("--vary", "coupler.length=1", "--designs", "x.csv", *GAMMA),
        ("--vary", "coupler.length=1", "--by", "gamma", *GAMMA),
        ("--vary", "coupler.length=1", "--nsmallest", "0", *GAMMA),
        ("--vary", "coupler.length=1", "--q", "1", "--positions", "2", *GAMMA),
    ],
)
def test_wrong_command_lines(words: tuple[str, ...]) -> None:
    assert "--help" in refused(*ROCKER, *words, code=2)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "a header with names"),
        ("coupler.length\n", "a header with names"),
        ("coupler.length,coupler.length\n1,2\n", "has a name twice"),
        ("coupler.length\n1\nx\n", "line 3: 'x' is not 1 number"),
        ("coupler.length\n1,2\n", "line 2: '1,2' is not 1 number"),
        ("coupler.length\nnan\n", "is not 1 number"),
        ("speed\n1\n", "speed"),
        ("design,status,kept,gamma\n0,0,True,1\n", "no column is a dimension"),
        ("coupler.length\n\xff", "the designs cannot be read"),
    ],
)
def test_wrong_tables(text: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "d.csv"
    path.write_bytes(text.encode("latin-1"))
    assert said in refused(*ROCKER, "--designs", path, *GAMMA)
