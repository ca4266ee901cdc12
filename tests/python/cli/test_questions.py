"""`assur structure`, `limits`, `reactions`, `flywheel`, `plot`, `convert`, `examples`."""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest

import assur
from assur.cli.named import example
from assur.examples import ALL
from cli.command_line import assur_command, columns, refused, same, table

PRESS = Path(__file__).parents[3] / "examples" / "press.toml"


def printed(*words: object) -> list[str]:
    done = assur_command(*words)
    assert done.code == 0, done.err
    return done.out.splitlines()


def press(rod: float | list[float] = 0.4) -> assur.Machine:
    contents = assur.files.read(PRESS)
    assert contents.machine is not None
    return contents.machine.of(contents.mechanism.with_dimensions({"rod.length": rod}))


@pytest.mark.parametrize("name", ["stephenson_3", "pentagon", "locomotive"])
def test_structure_and_dimensions(name: str) -> None:
    m = example(name).mechanism
    lines = printed("structure", f"example:{name}", "--dimensions")
    shown = str(m.structure).splitlines()
    assert lines[: len(shown)] == shown
    found = [re.fullmatch(r"(\S+) = (\S+) (m|rad)", line) for line in lines[len(shown) :]]
    assert {one[1]: float(one[2]) for one in found if one} == dict(m.dimensions)
    assert len(found) == len(m.dimensions)


def test_structure_of_a_batch(tmp_path: Path) -> None:
    m = assur.examples.engine().with_dimensions({"rod.length": [0.3, 0.2]})
    m.save(tmp_path / "m.toml")
    lines = printed("structure", tmp_path / "m.toml", "--dimensions")
    assert "(2,) designs" in lines
    assert "rod.length = 0.2 to 0.3 m" in lines


@pytest.mark.parametrize("degrees", [False, True])
def test_limits_that_end(degrees: bool) -> None:
    """Of class V: one interval, two dead points, assemblies among the complex ones."""
    m = assur.examples.pentagon()
    limits, found = m.limits(), m.assemblies(m.q0)
    unit, flag = ("deg", ["--degrees"]) if degrees else ("rad", [])

    def shown(q: float) -> str:
        return repr(float(np.degrees(q)) if degrees else q)

    low, high = map(shown, limits.intervals[0].tolist())
    group, of = limits.dead_points[0].group, f"of {found.complex_count[0]} complex"
    assert printed("limits", "example:pentagon", *flag) == [
        f"intervals      [{low}, {high}] {unit}",
        "full rotation  no",
        "period         does not close",
        f"dead point     {low} {unit}, {group}",
        f"dead point     {high} {unit}, {group}",
        f"assemblies     {len(found)} at q = {shown(float(m.q0))} {unit}, {of}",
    ]
    rows = assur_command("limits", "example:pentagon", *flag, "--out", "-").out.splitlines()
    assert rows == ["start,start_group,end,end_group", f'{low},"{group}",{high},"{group}"']


def test_limits_that_close() -> None:
    m = assur.examples.stephenson_2()
    assert printed("limits", "example:stephenson_2")[:4] == [
        "intervals      everywhere",
        "full rotation  yes",
        "period         closes in 1 turn",
        "dead points    none",
    ]
    assert m.limits().full_rotation
    assert "is for one driver" in refused("limits", "example:five_bar")


def test_reactions_are_those_of_the_machine() -> None:
    speed = 200 * (np.pi / 30)
    found = table(
        *("reactions", PRESS, "--q", "0:360:90deg", "--speed", "200rpm", "--acceleration", "3"),
    )
    own = press().reactions(np.arange(5) * 90.0 * (np.pi / 180), speed, 3.0)
    assert same(found["driver"], own.driver)
    assert same(found["B.y on ram"], own.joint("B", on="ram")[:, 1])
    assert same(found["guide.normal"], own.slide("guide").normal)
    assert same(found["shaking_force.x"], own.shaking_force[:, 0])


def test_reactions_of_a_file(tmp_path: Path) -> None:
    """[reactions] says where and how fast; flags change it. Of a batch too."""
    path = tmp_path / "m.toml"
    wanted = "[reactions]\ndeg = [10, 20]\nspeed = 20\n"
    path.write_text(PRESS.read_text("utf-8") + wanted, encoding="utf-8")
    assert same(table("reactions", path)["driver"], press().reactions(
        np.array([10.0, 20.0]) * (np.pi / 180), 20.0).driver)  # fmt: skip
    other = table("reactions", path, "--q", "1", "--speed", 0, "--set", "rod.length=0.45")
    assert same(other["driver"], [press(0.45).reactions(1.0).driver])
    batch = press([0.4, 0.45])
    batch.save(path)
    found = table("reactions", path, "--q", "1,2")
    assert same(found["driver"], batch.reactions([1.0, 2.0]).driver.ravel())


def test_reactions_with_friction_and_at_dead_points(tmp_path: Path) -> None:
    m = assur.FourBar(3.0, 2.5, 2.0, 4.0)
    rubbing = assur.Machine(
        m,
        loads=[assur.Torque("rocker", -2.0)],
        friction={"C": assur.JointFriction(0.1, radius=0.02)},
    )
    rubbing.save(tmp_path / "m.toml")
    words = "reactions", tmp_path / "m.toml", "--q", "-180:180:45deg"
    assert "sense" in refused(*words)
    done = assur_command(*words, "--sense", -1)
    q = np.arange(-180.0, 181.0, 45.0) * (np.pi / 180)
    own = rubbing.reactions(q, sense=-1, on_error="nan")
    failed = int((own.status >= assur.Status.SINGULAR).sum())
    assert done.code == 3
    assert done.err == (
        f"assur: {failed} of 9 positions could not be solved; the first: UNREACHABLE\n"
    )
    assert same(columns(done.out)["driver"], own.driver)
    assert "has no machine" in refused("reactions", "example:engine", "--q", "1")


def figures(lines: list[str]) -> dict[str, float]:
    words = [re.split(r"\s{2,}", line) for line in lines]
    return {name: float(rest.split()[0]) for name, rest in words}


def test_flywheel_of_a_machine(tmp_path: Path) -> None:
    own = assur.files.read(PRESS).result("flywheel")
    found = figures(printed("flywheel", PRESS, "--out", tmp_path / "speed.csv"))
    assert found["flywheel"] == pytest.approx(own.inertia, rel=1e-8)
    assert found["fluctuation"] == pytest.approx(0.02, rel=1e-8)
    written = columns((tmp_path / "speed.csv").read_text())
    assert same(written["speed"], own.speed(written["q"]))
    mechanism = assur.files.read(PRESS).mechanism
    free = assur.Machine(mechanism, bodies=press().bodies, loads=press().loads)
    free.save(tmp_path / "free.toml")
    words = "flywheel", tmp_path / "free.toml", "--fluctuation", 0.05, "--mean-speed"
    given = figures(printed(*words, "200rpm", "--mean", "period"))
    other = free.flywheel(0.05, mean_speed=200 * np.pi / 30, mean="period")
    assert given["flywheel"] == pytest.approx(other.inertia, rel=1e-8)
    assert "mean_speed is needed: no motor" in refused(*words[:-1])
    assert "no fluctuation is given" in refused(*words[:2])
    assert "has no machine" in refused("flywheel", "example:engine")
    assert "is for tables" in refused(*words, 1, "--spline", "natural", code=2)


def test_flywheel_of_a_table(tmp_path: Path) -> None:
    path = tmp_path / "table.txt"
    phi = np.linspace(0.0, 360.0, 25)
    moment = 100.0 * np.sin(np.radians(phi))
    moment[-1] = moment[0]
    np.savetxt(path, np.transpose([phi, moment, np.full(25, 2.0)]), delimiter=",", fmt="%.17g")
    words = "flywheel", path, "--degrees", "--mean-speed", "15rad/s"
    rows = assur.flywheel.read_table(path, degrees=True)
    own = assur.flywheel.from_table(*rows, fluctuation=0.1, mean_speed=15.0, spline="natural")
    found = figures(printed(*words, "--fluctuation", 0.1, "--spline", "natural"))
    assert found["flywheel"] == pytest.approx(own.inertia, rel=1e-8)
    given = figures(printed(*words, "--flywheel", repr(own.inertia), "--spline", "natural"))
    assert given["fluctuation"] == pytest.approx(0.1, rel=1e-8)
    for flag in ("--fluctuation", "--flywheel"):
        assert f"{flag} is written without a unit" in refused(*words, flag, "1mm")
    needed = "a table needs --fluctuation (or --flywheel) and --mean-speed"
    assert needed in refused(*words[:3], "--fluctuation", 0.1, code=2)
    assert needed in refused(*words, code=2)
    assert "are for machines" in refused(*words, "--flywheel", 1, "--set", "a=1", code=2)
    assert refused(*words, "--flywheel", 1, "--fluctuation", 1, code=2)


def test_pictures(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert printed("plot", "example:crank_rocker") == ["crank_rocker.svg"]
    assert ET.parse("crank_rocker.svg").getroot().tag.endswith("svg")
    first = Path("crank_rocker.svg").read_text("utf-8")
    assert printed("plot", "example:crank_rocker", "--q", "60deg", "--out", "m.svg") == ["m.svg"]
    assert Path("m.svg").read_text("utf-8") != first
    printed("plot", "example:crank_rocker", "--joint", "P", "--out", "path.png")
    assert Path("path.png").read_bytes().startswith(b"\x89PNG")
    many = ("plot", "example:crank_rocker", "--q", "0:330:30deg", "--groups", "--dark")
    assert printed(*many, "--out", "many.svg") == ["many.svg"]
    assert Path("many.svg").read_text("utf-8").count('id="position"') == 33
    printed("plot", "example:crank_rocker", "--q", "0:60:10deg", "--joint", "P", "--out", "f.gif")
    assert Path("f.gif").read_bytes().startswith(b"GIF89a")
    for q in ((), ("--q", "60deg"), ("--q", "0:60:10deg")):
        printed("plot", "example:crank_rocker", *q, "--joint", "P", "--out", "page.html")
        assert Path("page.html").read_text("utf-8").startswith("<!doctype html>")
    assert "a switch" in refused("plot", "example:engine", "--groups", "--out", "p.html")
    assert "cannot be written" in refused("plot", "example:engine", "--out", "no/p.svg")
    assert "cannot be written" in refused("plot", "example:engine", "--out", "p.nothing")
    assert "no joint" in refused("plot", "example:engine", "--joint", "X", "--out", "p.svg")


@pytest.mark.parametrize("name", list(ALL))
def test_every_example_is_written_and_loads(name: str, tmp_path: Path) -> None:
    made = ALL[name]()
    path = tmp_path / "m.toml"
    assert assur_command("examples", name, "--out", path) == (0, "", "")
    contents = assur.files.read(path)
    own = made if isinstance(made, assur.Mechanism) else made.mechanism
    assert contents.mechanism == own
    assert (contents.machine is None) == isinstance(made, assur.Mechanism)
    text = assur_command("convert", path)
    assert text.out == path.read_text("utf-8") == assur_command("examples", name).out
    first, last = (np.atleast_1d(end).tolist() for end in assur.examples.RANGES[name])
    wanted = contents.wanted["solve"]
    q = np.asarray(wanted["q"]) if "q" in wanted else np.radians(np.asarray(wanted["deg"]))
    assert (np.atleast_1d(q[0]).tolist(), np.atleast_1d(q[-1]).tolist()) == (first, last)


def test_the_list_of_examples() -> None:
    lines = printed("examples")
    assert [line.split()[0] for line in lines] == list(ALL)
    assert all(len(line.split()) > 3 for line in lines)
    assert "there is no example 'x'" in refused("examples", "x")
    assert "needs the NAME" in refused("examples", "--out", "x.toml", code=2)


def test_conversions(tmp_path: Path) -> None:
    sketch = "ground crank R 0 0 0 ffft|crank rod R 0 100|rod block R 300 0|ground block P 300 0 0"
    source, target = tmp_path / "engine.pmks", tmp_path / "engine.toml"
    source.write_text(sketch)
    done = assur_command("convert", source, "--out", target, "--scale", "1mm")
    read = assur.importers.read(sketch, scale=0.001)
    assert done == (0, "", "".join(f"assur: note: {sentence}\n" for sentence in read.omitted))
    assert assur.load(target) == read.mechanism
    words = "convert", PRESS, "--out", tmp_path / "press.toml", "--set", "rod.length=45cm"
    assert assur_command(*words) == (0, "", "")
    machine = assur.load(tmp_path / "press.toml")
    assert isinstance(machine, assur.Machine)
    assert machine.mechanism
    assert machine.mechanism.dimensions["rod.length"] == 0.45
    assert machine.bodies == press().bodies
    assert assur.files.read(tmp_path / "press.toml").wanted == assur.files.read(PRESS).wanted
    expression = (
        "M[J[R, P[0, 0], L[ground, crank]], J[R, P[0, 1], L[crank, rod]], "
        "J[RP, A[0], P[3, 0], L[ground, rod]]]"
    )
    source.with_suffix(".pyslvs").write_text(expression)
    drawn = source.with_suffix(".pyslvs")
    assert assur_command("convert", drawn, "--out", target, "--force", "--drivers", "0-1").code == 0
    own = assur.importers.read(expression, drivers=[(0, 1)]).mechanism
    assert assur.load(target) == own
    assert "format is 'x': one of 'pmks'" in refused("convert", source, "--format", "x")


def test_extremes(tmp_path: Path) -> None:
    own = assur.examples.shaper().extremes("bed")
    lines = printed("extremes", "example:shaper", "bed")
    assert lines == [
        f"min         {own.min.value!r} m at q = {own.min.q!r} rad",
        f"max         {own.max.value!r} m at q = {own.max.q!r} rad",
        f"stroke      {own.stroke!r} m",
        f"time ratio  {own.time_ratio!r}",
    ]
    rocker = assur.examples.crank_rocker().extremes("rocker")
    asked = "extremes", "example:crank_rocker", "rocker", "--degrees"
    assert printed(*asked)[2] == f"stroke      {float(np.degrees(rocker.stroke))!r} deg"
    path = tmp_path / "speed.csv"
    assert printed("extremes", "example:engine", "bore", "--order", 1, "--out", path)
    speed = assur.examples.engine().extremes("bore", order=1)
    assert columns(path.read_text())["value"].tolist() == [speed.min.value, speed.max.value]
    misspelt = refused("extremes", "example:engine", "bor")
    assert 'there is no coordinate "bor"; did you mean "bore"' in misspelt


def test_extremes_of_a_link_that_only_slides(tmp_path: Path) -> None:
    """Its angle stands, its slide moves: a stroke of 0 alone would mislead."""
    stroke = assur.examples.engine().extremes("bore").stroke
    lines = printed("extremes", "example:engine", "piston")
    assert lines[2] == "stroke      0.0 rad"
    assert lines[3:] == [
        "note        piston does not turn",
        f"note        it slides: bore has a stroke of {stroke!r} m",
    ]
    # A pin in a slot, and the coupler of a parallelogram.
    pin = assur.Mechanism(
        {"O": (0.0, 0.0), "A": (0.03, 0.04)},
        {"ground": "O", "crank": "OA", "block": "A", "yoke": ""},
        "crank",
        slides={
            "block_slide": assur.Slide("block", on="yoke", angle=np.pi / 2),
            "yoke_slide": assur.Slide("yoke", on="ground", angle=0.0, origin="O"),
        },
    )
    pin.save(tmp_path / "pin.toml")
    found = printed("extremes", tmp_path / "pin.toml", "block")[3:]
    assert found[0] == "note        block does not turn"
    moves = re.fullmatch(r"note        it slides: block_slide has a stroke of (\S+) m", found[1])
    assert moves is not None
    assert float(moves[1]) == pytest.approx(0.1, abs=1e-12)
    locomotive = printed("extremes", "example:locomotive", "coupling_rod")[3:]
    assert locomotive == ["note        coupling_rod does not turn"]
    assert not any("note" in line for line in printed("extremes", "example:engine", "rod"))
    refused = assur_command("extremes", "example:engine", "crank")
    assert refused.code == 1
    assert "turns fully with the driver" in refused.err
