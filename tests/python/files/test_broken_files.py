"""Errors of files say where and what: file, line, column, key."""

from __future__ import annotations

import pickle
from typing import TYPE_CHECKING, Any

import pytest

import assur
from files.sample_files import BY_HAND, WANTED

if TYPE_CHECKING:
    from pathlib import Path

PRESS, EXCAVATOR, ROCKER = BY_HAND["press"], BY_HAND["excavator"], BY_HAND["crank_rocker"]

# The file, what is replaced by what; key, kind, words of the message.
CASES: list[tuple[str, str, str, str, str | None, str]] = [
    (PRESS, '["O", "A"]', '["O", "X"]', "links.crank[1]", "unknown", 'there are "A", "B", "O"'),
    (PRESS, '["O", "A"]', '["O", 3]', "links.crank[1]", None, "is 3: a text in quotes is needed"),
    (PRESS, '["O", "A"]', '"OA"', "links.crank", None, 'a list of names, ["A", "B"], is needed'),
    (PRESS, '"crank"', '"crnk"', "driver", "unknown", 'did you mean "crank"?'),
    (
        PRESS,
        '"crank"',
        '"ram"',
        "driver",
        "cannot_drive",
        ['"ram"', "cannot drive"][1],
    ),
    (PRESS, '"crank"', "1", "driver", None, "is 1: the name of a link or slide"),
    (PRESS, '"crank"', '{ lnk = "crank" }', "driver.lnk", None, "did you mean link?"),
    (PRESS, 'driver = "crank"', "", "driver", None, "is missing: joints, links and a driver"),
    (PRESS, 'link = "ram"', 'link = "rom"', "slides.guide.link", "unknown", "did you mean"),
    (PRESS, 'link = "ram"', 'lnk = "ram"', "slides.guide.lnk", None, "unknown key; did you mean"),
    (PRESS, "angle = 0", "angle = nan", "slides.guide.angle", None, "is NaN: a finite number"),
    (PRESS, "angle = 0, ", "", "slides.guide.angle", None, "is missing"),
    (PRESS, 'origin = "O"', 'origin = "A"', "slides.guide", "origin_not_on_link", 'has origin "A"'),
    (PRESS, "B = [0.39, 0]", 'B = "x"', "joints.B", None, "is the text 'x': a list of two numbers"),
    (PRESS, "B = [0.39, 0]", "B = [0.39, 0, 1]", "joints.B", None, "has 3 entries"),
    (PRESS, "B = [0.39, 0]", "B = [0.39, inf]", "joints.B[1]", None, "is infinite"),
    (PRESS, "B = [0.39, 0]", "B = [0.39, 1e999]", "joints.B[1]", None, "is infinite"),
    (PRESS, "B = [0.39, 0]", "B = [0.39, 1979-05-27]", "joints.B[1]", None, "is a date"),
    (
        PRESS,
        "B = [0.39, 0]",
        "B = [0.39, 0]\nQ = [1, 1]",
        "joints.Q",
        "loose_joint",
        "is on no link",
    ),
    (PRESS, "B = [0.39, 0]", "B = [0.0, 0.1]", "links.rod", "zero_length", "has length zero"),
    (PRESS, "rod.length", "rod.lenght", "dimensions.rod.lenght", "unknown", "did you mean"),
    (PRESS, "= 0.4", "= -0.4", "dimensions.rod.length", "bad_dimension", "must be positive"),
    (PRESS, "= 0.4", "= nan", "dimensions.rod.length", None, "is NaN: a finite number"),
    (PRESS, "= 0.4", "= [0.4, true]", "dimensions.rod.length[1]", None, "is true: a number"),
    (PRESS, "= 0.4", "= [0.4, [1]]", "dimensions.rod.length", None, "different lengths"),
    (PRESS, "[bodies]", "[bodeis]", "bodeis", None, "unknown key; did you mean bodies?"),
    (PRESS, "ram = { mass", "rom = { mass", "bodies.rom", "unknown", "there is no link"),
    (PRESS, "mass = 20", "mass = -20", "bodies.ram", None, "mass is -20"),
    (PRESS, '"Gravity"', '"gravity"', "loads[0].type", None, "did you mean Gravity?"),
    (PRESS, 'type = "Gravity"', "", "loads[0].type", None, "is missing: one of Gravity, Force"),
    (PRESS, 'on = "ram"\nforce', 'on = "crank"\nforce', "loads[1]", None, 'has no joint "B"'),
    (PRESS, 'at = "B"\n', 'at = "Z"\n', "loads[1]", "unknown", 'there is no joint "Z"'),
    (PRESS, 'at = "B"\n', 'at = ["ram"]\n', "loads[1].at", None, "the name of a joint, or"),
    (PRESS, "5.8, 6.0", "6.8, 6.0", "loads[1].force[0]", "not_increasing", "q[2] = 6.0"),
    (PRESS, "slip = 0.15", 'slip = "0.15"', "motor.slip", None, "is the text '0.15': a number"),
    (PRESS, "slip = 0.15", "slip = 0", "motor", None, "slip is 0"),
    (PRESS, "[motor]", "[[motor]]\ntype = 'None'\n[[motor]]", "motor", None, "motor is"),
    (PRESS, "fluctuation", "fluctation", "flywheel.fluctation", None, "did you mean fluctuation?"),
    (PRESS, "fluctuation = 0.02", "", "flywheel.fluctuation", None, "is missing"),
    (PRESS, "format = 1", "format = 2", "format", None, "reads format 1"),
    (PRESS, "format = 1", "format = 1.0", "format", None, "is 1.0: a whole number"),
    (PRESS, "format = 1", "", "format", None, "write format = 1 in the first line"),
    (EXCAVATOR, '"boom_base", end', '"boom_bas", end', "slides.boom_cylinder", None, "its base"),
    (EXCAVATOR, '", end = "stick_eye" }', '" }', "slides.stick_cylinder.end", None, "is missing"),
    (EXCAVATOR, '"stick_cylinder"]', '"stik_cylinder"]', "driver[1]", "unknown", "did you mean"),
    (EXCAVATOR, ', "stick_cylinder"]', "]", "links.stick", "mobility", "mobility is 2"),
    (EXCAVATOR, "elbow = {", "elbw = {", "friction.elbw", "unknown", 'no joint "elbw"'),
    (EXCAVATOR, "tip = [", "'t p' = [", "joints.'t p'", "bad_name", "is not allowed"),
    (EXCAVATOR, '"stick_eye"]\n', '"stick_eye", "tip"]\n', "links.stick", "doubled_joint", "twice"),
    (EXCAVATOR, "stick = [", "foot = [", "links.foot", "doubled_name", "is used twice"),
    (EXCAVATOR, "count = 25", "count = 0", "reactions.q", None, "from 1 to 10000000"),
    (EXCAVATOR, "count = 25", "step = 1", "reactions.q", None, "needs count, not step"),
    (EXCAVATOR, ", count = 25", "", "reactions.q", None, "either step or count"),
    (ROCKER, "deg = {", "q = 1\ndeg = {", "solve", None, "needs either q or deg"),
    (ROCKER, '"C", "P",', '"C", "Q",', "solve.outputs[1]", None, "known are A, B, C, D, P"),
    (ROCKER, "outputs", "order = 4\noutputs", "solve.order", None, "0, 1, 2 or 3"),
    (ROCKER, "step = 1", "step = 1e-9", "solve.deg", None, "from 1 to 10000000"),
    (ROCKER, "step = 1", "step = -1", "solve.deg", None, "must lead from start to stop"),
    (ROCKER, "[solve]", "[assembly]\nC = 2\n[solve]", "assembly.C", None, "must be 1 or -1"),
    (ROCKER, "[solve]", "[assembly]\nQ = 1\n[solve]", "assembly.Q", "unknown", '"Q"'),
    (ROCKER, "[solve]", "[assembly]\nA = 1\n[solve]", "assembly.A", "unknown", '"A"'),
    (ROCKER, "[solve]", "[run]\nt_end = 1\n[solve]", "run", None, "needs a machine"),
    (ROCKER, "[solve]", "[solve]\nspeed = 1", "solve.speed", None, "unknown key"),
]


def broken(text: str, old: str, new: str, path: Path) -> assur.files.FileError:
    """The error of a text in which something is replaced."""
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(assur.files.FileError) as caught:
        assur.files.read(path)
    return caught.value


@pytest.mark.parametrize(("text", "old", "new", "key", "kind", "words"), CASES)
def test_the_place_of_errors(
    text: str, old: str, new: str, key: str, kind: str | None, words: str, tmp_path: Path
) -> None:
    path = tmp_path / "m.toml"
    error = broken(text, old, new, path)
    assert (error.key, error.kind) == (key, kind)
    assert words in str(error)
    assert (error.path, type(error.line), type(error.column)) == (str(path), int, int)
    assert str(error).startswith(f"{path}:{error.line}:{error.column}: {key}: ")
    # At the key, or, where that is missing, at what it is missing from.
    assert error.line is not None
    line = path.read_text(encoding="utf-8").splitlines()[error.line - 1]
    last = key.replace("'", "").split(".")[-1].partition("[")[0]
    owner = key.rpartition(".")[0].partition("[")[0].rpartition(".")[2]
    is_missing = "missing" in str(error)
    assert last in line or key.endswith("]") or (is_missing and owner in line)
    assert isinstance(error, assur.InputError)
    other = pickle.loads(pickle.dumps(error))
    assert (str(other), repr(other.__dict__)) == (str(error), repr(error.__dict__))


def test_the_fields_are_those_of_the_error_in_python(tmp_path: Path) -> None:
    error = broken(PRESS, "= 0.4", "= -0.4", tmp_path / "m.toml")
    cause = error.__cause__
    assert isinstance(cause, assur.DimensionError)
    assert (error.dimension, error.value) == (cause.dimension, cause.value) == ("rod.length", -0.4)
    error = broken(PRESS, '["O", "A"]', '["O", "X"]', tmp_path / "m.toml")
    assert isinstance(error.__cause__, assur.StructureError)


@pytest.mark.parametrize(
    ("old", "new", "line", "column", "words"),
    [
        ("[joints]", "[joints", 4, 8, "']'"),
        ("A = [0, 0.1]", "A = [0 0.1]", 6, 8, "unclosed"),
        ("A = [0, 0.1]", "A = [0, 0.1]\nA = [0, 1]", 7, 11, "overwrite"),
        ("A = [0, 0.1]", "A = [0, 0.1]\r\nA = [0, 1]", 7, 11, "overwrite"),
        ("A = [0, 0.1]", "Ä = [0, 0.1]", 6, 1, "not TOML"),
        ("A = [0, 0.1]", "A = [0, 0.1\x00]", 6, 12, "not TOML"),
    ],
)
def test_text_that_is_not_toml(
    old: str, new: str, line: int, column: int, words: str, tmp_path: Path
) -> None:
    error = broken(PRESS, old, new, tmp_path / "m.toml")
    assert (error.line, error.column, error.key) == (line, column, None)
    assert words in str(error)


def test_bytes_that_are_not_text(tmp_path: Path) -> None:
    path = tmp_path / "m.toml"
    raw = PRESS.encode()
    for bad, line in ((raw.replace(b"A = [0", b"A = \xff[0", 1), 6), (PRESS.encode("utf-16"), 1)):
        path.write_bytes(bad)
        with pytest.raises(assur.files.FileError, match="not UTF-8") as caught:
            assur.load(path)
        assert (caught.value.line, caught.value.key) == (line, None)
    for good in (b"\xef\xbb\xbf" + raw, raw.replace(b"\n", b"\r\n")):
        path.write_bytes(good)
        assert (
            repr(assur.load(path)) == "<assur.Machine I(crank) → II(rod, ram), 3 bodies, 2 loads>"
        )


@pytest.mark.parametrize("name", ["none.toml", "", "a\0b"])
def test_files_that_cannot_be_read(name: str, tmp_path: Path) -> None:
    path = f"{tmp_path}/{name}"
    with pytest.raises(assur.files.FileError, match="cannot be read") as caught:
        assur.load(path)
    assert (caught.value.path, caught.value.line, caught.value.key) == (path, None, None)


@pytest.mark.parametrize("path", [3, None, ["m.toml"], 1.5])
def test_paths_that_are_no_names(path: Any) -> None:
    for ask in (assur.load, assur.files.read, assur.FourBar(1.0, 3.0, 2.5, 3.0).save):
        with pytest.raises(assur.InputError, match="the name of a file is needed"):
            ask(path)


def test_a_drawn_place_that_does_not_fit(tmp_path: Path) -> None:
    path = tmp_path / "m.toml"
    m = assur.FourBar(3.0, 2.5, 2.0, 4.0)
    m.save(path)
    text = path.read_text(encoding="utf-8")
    number = text.partition("[drawn]\nq = [")[2].partition("]")[0]
    for old, new, words in (
        (number, "0.5", "does not fit the dimensions"),
        (number, f"{number}, 1", "has 2 numbers: there are 1 drivers"),
        ("coupler.length = 2.5", "coupler.length = 2.4", "does not fit the dimensions"),
        ("coupler.length = 2.5", "coupler.length = [2.4, 2.5]", "a batch is drawn"),
        ("signs = { C = 1 }", "signs = { C = -1 }", "does not fit the dimensions"),
        ("signs = { C = 1 }", "", ["signs", "is", "missing"][1]),
        ("class_angles = [", "class_angles = [1.0, ", "one of another mechanism"),
    ):
        error = broken(text, old, new, path)
        assert words in str(error)
        assert (error.key or "").startswith("drawn")


def test_results_are_of_a_machine(tmp_path: Path) -> None:
    error = broken(
        ROCKER + WANTED.replace("[solve]", "[s]"), "nothing" * 0, "", tmp_path / "m.toml"
    )
    assert error.key == "s"
