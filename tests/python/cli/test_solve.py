"""`assur solve` prints what `Mechanism.solve` returns, to the bit."""

from __future__ import annotations

import io
import warnings
from pathlib import Path

import numpy as np
import pytest

import assur
from assur.cli.named import example
from assur.examples import RANGES
from cli.command_line import assur_command, refused, same, table

EXAMPLES = Path(__file__).parents[3] / "examples"


def mechanism(name: str) -> assur.Mechanism:
    return example(name).mechanism


@pytest.mark.parametrize("name", ["crank_rocker", "oldham", "locomotive", "loom", "toggle_press"])
def test_all_quantities_of_an_example(name: str) -> None:
    """A turn in degrees, without flags."""
    m = mechanism(name)
    motion = m.solve(deg=np.arange(361.0), on_error="nan")
    failed = bool((motion.status >= assur.Status.UNREACHABLE).any())
    found = table("solve", f"example:{name}", code=3 if failed else 0)
    assert same(found.pop("q"), motion.q)
    assert same(found.pop("status"), motion.status)
    for joint in m.joints:
        of = motion.joint(joint)
        for order, values in enumerate((of.value, of.d1, of.d2)):
            tail = f".d{order}" if order else ""
            for axis in range(2):
                assert same(found.pop(f"{joint}.{'xy'[axis]}{tail}"), values[:, axis])
    for kind, names in (("link", m.links), ("slide", m.slides)):
        for each in names:
            of = getattr(motion, kind)(each)
            for order, values in enumerate((of.value, of.d1, of.d2)):
                assert same(found.pop(f"{each}.d{order}" if order else each), values)
    assert not found


def test_flags_choose_positions_order_and_outputs() -> None:
    motion = mechanism("crank_rocker").solve(deg=[0.0, 45.0, 90.0], order=1)
    found = table(
        *("solve", "example:crank_rocker", "--q", "0:90:45deg"),
        *("--order", 1, "--outputs", "P, rocker"),
    )
    assert list(found) == [
        *("q", "status", "P.x", "P.y", "P.x.d1", "P.y.d1", "rocker", "rocker.d1"),
    ]
    assert same(found["P.y.d1"], motion.joint("P").d1[:, 1])
    assert same(found["rocker"], motion.link("rocker").value)


def test_a_speed_gives_velocities_and_degrees_turn_angles() -> None:
    m = mechanism("engine").with_dimensions({"rod.length": 0.22})
    motion = m.solve(deg=[10.0, 20.0])
    omega = 3000 * (np.pi / 30)
    found = table(
        *("solve", "example:engine", "--set", "rod.length=220mm", "--q", "10,20deg"),
        *("--speed", "3000rpm", "--acceleration", "5", "--degrees", "--moving"),
    )
    assert "O.x" not in found
    assert same(found["q"], np.degrees(motion.q))
    assert same(found["rod"], np.degrees(motion.link("rod").value))
    assert same(found["bore.v"], motion.slide("bore").velocity(omega))
    assert same(found["bore.a"], motion.slide("bore").acceleration(omega, 5.0))


def test_several_drivers_have_one_q_each_and_a_number_holds_one() -> None:
    q = np.stack(np.broadcast_arrays(1.5 + np.arange(6) * 0.1, 1.2), axis=-1)
    motion = mechanism("five_bar").solve(q, order=0)
    words = "solve", "example:five_bar", "--q", "1.5:2:0.1", "--q", "1.2", "--order", "0"
    found = table(*words)
    assert same(found["q1"], np.full(6, 1.2))
    assert same(found["P.x"], motion.joint("P").value[:, 0])
    first, last = RANGES["five_bar"]
    usual = table("solve", "example:five_bar", "--order", 0)
    assert [usual[f"q{k}"][0] for k in range(2)] == list(np.asarray(first))
    assert [usual[f"q{k}"][-1] for k in range(2)] == list(np.asarray(last))
    assert "--q is given 1 times: the mechanism has 2 drivers" in refused(*words[:4])
    shown = refused(*words[:4], "--q", "1,2")
    assert shown == "--q: the drivers have 6, 2 positions: the same number of each is needed"


def test_a_slide_that_drives_has_lengths() -> None:
    q = np.asarray(assur.files.read(EXAMPLES / "excavator.toml").mechanism.q0)
    words = [word for each in q.tolist() for word in ("--q", f"{each!r}")]
    found = table("solve", EXAMPLES / "excavator.toml", *words)
    assert same(found["q0"], q[:1])
    said = refused("solve", EXAMPLES / "excavator.toml", *words[:-1], "30deg")
    assert "is a length" in said or "is an angle" in said


def test_a_file_says_what_is_wanted_and_flags_change_it(tmp_path: Path) -> None:
    press = tmp_path / "press.toml"
    wanted = '[solve]\ndeg = { start = 0, stop = 360, step = 1 }\noutputs = ["guide"]\n'
    press.write_text((EXAMPLES / "press.toml").read_text("utf-8") + wanted, encoding="utf-8")
    contents = assur.files.read(press)
    motion = contents.result("solve")
    found = table("solve", press)
    assert list(found) == ["q", "status", "guide", "guide.d1", "guide.d2"]
    assert same(found["guide.d2"], motion.slide("guide").d2)
    less = table("solve", press, "--order", 0)
    assert list(less) == ["q", "status", "guide"]
    other = table("solve", press, "--q", "30deg", "--outputs", "B", "--order", 0)
    at = contents.mechanism.solve(deg=30.0).joint("B").value
    assert same([other["B.x"][0], other["B.y"][0]], at)


def test_a_batch_and_one_design_of_it(tmp_path: Path) -> None:
    m = mechanism("crank_rocker").with_dimensions({"coupler.length": [0.11, 0.12, 0.5]})
    m.save(tmp_path / "m.toml")
    motion = m.solve(deg=[0.0, 90.0], on_error="nan")
    words = "solve", tmp_path / "m.toml", "--q", "0,90deg"
    found = table(*words, code=3)
    assert same(found["design"], [0, 0, 1, 1, 2, 2])
    assert same(found["status"], motion.status.ravel())
    assert same(found["C.x.d2"], motion.joint("C").d2[..., 0].ravel())
    one = table(*words, "--design", 1)
    assert same(one["C.x.d2"], motion.joint("C").d2[1, :, 0])
    assert "(3,)" in refused(*words, "--design", 3)
    assert "has one design" in refused("solve", "example:engine", "--design", 0)


def test_positions_that_fail_are_counted_and_explained() -> None:
    m = mechanism("hart")
    motion = m.solve(deg=np.arange(0.0, 361.0, 90.0), on_error="nan")
    failed = motion.status >= assur.Status.UNREACHABLE
    first = int(np.flatnonzero(failed)[0])
    assert 0 < failed.sum() < 5
    done = assur_command("solve", "example:hart", "--q", "0:360:90deg")
    assert done.code == 3
    assert done.err == (
        f"assur: {failed.sum()} of 5 positions could not be solved; the first: "
        f"{motion.explain(first)}\n"
    )
    assert done.out.count("\n") == 6


def test_the_standard_input_and_other_programs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = (EXAMPLES / "crank_rocker.toml").read_text("utf-8")
    words = "--q", "1", "--order", "0"
    monkeypatch.setattr("sys.stdin", io.StringIO(text))
    assert table("solve", "-", *words) == table("solve", EXAMPLES / "crank_rocker.toml", *words)
    sketch = (
        "ground crank R 0 0 0 ffft\ncrank rod R 0 100\nrod block R 300 0\nground block P 300 0 0\n"
    )
    own = assur.importers.read(sketch, scale=0.001)
    (tmp_path / "engine.txt").write_text(sketch)
    monkeypatch.setattr("sys.stdin", io.StringIO(sketch))
    x = next(f"{name}.x" for name in own.mechanism.joints)
    expected = own.mechanism.solve(1.0).joint(x[:-2]).value[0]
    for file in ("-", tmp_path / "engine.txt"):
        found = table("solve", file, *words, "--scale", "1mm")
        assert same(found[x], [expected])
    monkeypatch.setattr("sys.stdin", io.StringIO(" \n"))
    assert refused("solve", "-") == "the standard input is empty"
    said = refused("solve", "example:engine", "--scale", "1mm")
    assert said.startswith("--scale is for files of other programs")


def test_what_is_left_out_is_said(tmp_path: Path) -> None:
    sketch = "ground crank R 0 0 0 ffft|crank rod R 0 1|rod block R 3 0|ground block P 3 0 0"
    found = assur.importers.read(sketch.replace("crank", "a.b"))
    assert found.omitted
    path = tmp_path / "renamed.txt"
    path.write_text(sketch.replace("crank", "a.b"))
    done = assur_command("solve", path, "--q", 1)
    assert done.code == 0
    assert done.err == "".join(f"assur: note: {sentence}\n" for sentence in found.omitted)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("missing.toml",), "missing.toml: cannot be read: No such file"),
        (("missing",), "missing: cannot be read: No such file"),
        (("example:jansen",), "there is no example 'jansen'; did you mean jansen_leg?"),
        (("example:engine", "--q", "5mm"), "--q is an angle: its unit can be rad, deg, not mm"),
        (("example:engine", "--q", "1", "--q", "2"), "--q is given 2 times: the mechanism has one"),
        (
            ("example:engine", "--outputs", "X"),
            "outputs: no joint, link or slide is called 'X'; there are",
        ),
        (("example:engine", "--set", "rod.lenght=1"), "rod.length"),
        (("example:engine", "--set", "rod.length=1deg"), "--set rod.length is a length"),
        (("example:engine", "--set", "rod.length=-1"), "a length must be positive"),
        (("example:engine", "--set", "rod.length=1,2"), "one number is needed"),
        (("example:engine", "--speed", "1,2"), "--speed has 2 numbers: one number is needed"),
        (("example:engine", "--speed", "1m/s"), "--speed is an angular speed"),
        (("example:engine", "--speed", "1", "--acceleration", "1rpm"), "write no unit"),
        (("://",), "the text is of no known format"),
        (("",), "cannot be read"),
    ],
)
def test_wrong_input_is_one_line(words: tuple[str, ...], said: str) -> None:
    assert said in refused("solve", *words)


@pytest.mark.parametrize(
    "words",
    [
        (),
        ("solve",),
        ("nothing", "x"),
        ("solve", "example:engine", "--q", "abc"),
        ("solve", "example:engine", "--q", "0:360"),
        ("solve", "example:engine", "--q", "0:360:0"),
        ("solve", "example:engine", "--order", "4"),
        ("solve", "example:engine", "--set", "rod.length"),
        ("solve", "example:engine", "--unknown"),
        ("solve", "example:engine", "--deg"),
        ("solve", "example:engine", "--drivers", "x"),
        ("solve", "--", "example:engine"),
        ("solve", "example:engine", "--out=--"),
    ],
)
def test_a_wrong_command_line_is_one_line_and_2(words: tuple[str, ...]) -> None:
    assert "--help" in refused(*words, code=2)


def test_degrees_without_their_unit_are_noticed() -> None:
    words = "solve", "example:engine", "--q", "0:360:90"
    assert refused(*words).endswith("write --q 0:360:1deg")  # warnings are errors here
    with warnings.catch_warnings():
        warnings.simplefilter("default")
        done = assur_command(*words)
    assert done.code == 0
    assert done.err == (
        "assur: warning: q = 360 is 360 rad, 57.3 turns; for degrees: write --q 0:360:1deg\n"
    )
