"""Mechanisms that are saved come back with the same bits."""

from __future__ import annotations

import math
import struct
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import assur
from assur.files import toml
from assur.files.parser import loads
from assur.files.toml import value_text
from assur.files.write import text_of, tree_of
from assur.studio.document import document_of, flat
from models.machines.file_machines import whole_machines
from models.machines.machines import five_bar, four_bar
from models.mechanisms.named_drawings import CLASS_II, HIGHER

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

NAMED: dict[str, Callable[[], assur.Mechanism]] = {**CLASS_II, **HIGHER}
# 1e22 and 5e-324 have exponents, 0.1 + 0.2 seventeen digits.
ODD = (-0.0, 5e-324, 2.2250738585072014e-308, 1e22, 1e16, 0.1 + 0.2, 1.7976931348623157e308, 123.0)


def again(mechanism: assur.Mechanism, path: Path) -> assur.Mechanism:
    """The mechanism, saved and loaded; equal in description, dimensions and place."""
    mechanism.save(path)
    loaded = assur.load(path)
    assert isinstance(loaded, assur.Mechanism)
    assert loaded == mechanism
    assert loaded.values.tobytes() == mechanism.values.tobytes()
    # Saving is a function of the mechanism alone.
    assert text_of(loaded) == path.read_text(encoding="utf-8")
    return loaded


def assert_same_motion(one: assur.Mechanism, other: assur.Mechanism) -> None:
    q = np.asarray(one.q0) + np.array([0.0, 0.01, -0.02]).reshape(
        (3,) + (1,) * (one.driver_count > 1)
    )
    a, b = (m.solve(q, on_error="nan") for m in (one, other))
    assert a.status.tobytes() == b.status.tobytes()
    for name in one.joints:
        for order in ("value", "d1", "d2"):
            of = (getattr(motion.joint(name), order).tobytes() for motion in (a, b))
            assert len(set(of)) == 1
    assert one.assembly == other.assembly


@pytest.mark.parametrize("name", list(NAMED))
def test_named_mechanisms(name: str, tmp_path: Path) -> None:
    mechanism = NAMED[name]()
    loaded = again(mechanism, tmp_path / "m.toml")
    assert_same_motion(mechanism, loaded)
    assert loaded.driver == mechanism.driver
    assert dict(loaded.slides) == dict(mechanism.slides)


@pytest.mark.parametrize("name", list(NAMED))
def test_designs_and_assemblies(name: str, tmp_path: Path) -> None:
    path, mechanism = tmp_path / "m.toml", NAMED[name]()
    dims = {n: x * (1.0 + 1e-3 / 3) for n, x in mechanism.dimensions.items() if x != 0.0}
    other = again(mechanism.with_dimensions(dims), path)
    assert_same_motion(mechanism.with_dimensions(dims), other)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", assur.AssurWarning)  # some of the library may be incomplete
        found = mechanism.assemblies(mechanism.q0)
    for assembly in found[:3]:
        redrawn = mechanism.with_assembly(assembly)
        assert_same_motion(redrawn, again(redrawn, path))


def test_an_assembly_found_from_another(tmp_path: Path) -> None:
    loom = next(m for m in (make() for make in HIGHER.values()) if len(m.assemblies(m.q0)) > 1)
    first = loom.with_assembly(loom.assemblies(loom.q0)[-1])
    second = first.with_assembly(first.assemblies(float(first.q0) + 0.01)[0])
    assert second.place is not None
    assert second.place.mechanism.place is not None
    sized = {n: x * 1.001 for n, x in loom.dimensions.items() if n.endswith("length")}
    for mechanism in (first, second, second.with_dimensions(sized)):
        assert_same_motion(mechanism, again(mechanism, tmp_path / "m.toml"))
    batch = second.with_dimensions({n: [x, x * 1.001] for n, x in sized.items()})
    again(batch, tmp_path / "m.toml")


def test_a_tree_is_what_its_text_says(monkeypatch: pytest.MonkeyPatch) -> None:
    """JSON of the studio is that tree: no text is made of it and parsed again."""
    loom = next(m for m in (make() for make in HIGHER.values()) if len(m.assemblies(m.q0)) > 1)
    first = loom.with_assembly(loom.assemblies(loom.q0)[-1])
    second = first.with_assembly(first.assemblies(float(first.q0) + 0.01)[0])
    length = next(name for name in loom.dimensions if name.endswith("length"))
    sized = second.with_dimensions({length: [1.0, 1.001]})
    for what in (*whole_machines().values(), first, second, sized):
        tree, read = tree_of(what), loads(text_of(what))
        inner: Any = read
        while inner:
            if "dimensions" in inner:
                inner["dimensions"] = dict(flat(inner["dimensions"]))
            inner = inner.get("drawn")
        assert repr(tree) == repr(read)
    monkeypatch.setattr(toml, "value_text", None)
    assert document_of(first)["drawn"]["q"] == [first.q0]


def test_an_endless_chain_of_assemblies_is_refused(tmp_path: Path) -> None:
    mechanism = next(m for m in (make() for make in HIGHER.values()) if np.ndim(m.q0) == 0)
    for _ in range(20):
        mechanism = mechanism.with_assembly(mechanism.assemblies(mechanism.q0)[0])
    with pytest.raises(assur.InputError, match="too many assemblies"):
        mechanism.save(tmp_path / "m.toml")


def test_a_four_bar_drawn_where_it_exists(tmp_path: Path) -> None:
    """Its drawing's q is outside its motion; one at a dead point is double."""
    m = assur.FourBar(3.0, 2.5, 2.0, 4.0)
    assert m.place is not None
    assert_same_motion(m, again(m, tmp_path / "m.toml"))
    assert "[dimensions]" in text_of(m)
    end = float(m.limits().intervals[0, 1])
    for assembly in m.assemblies(end):
        again(m.with_assembly(assembly), tmp_path / "m.toml")


@pytest.mark.parametrize(
    "mechanism",
    [
        assur.FourBar(1.0, 3.0, 2.5, 3.0, mode="crossed"),
        assur.FourBar(1.0, 3.0, 2.5, 3.0, point=(1.5, 1.0 / 3.0)),
        assur.SliderCrank(0.1, 0.3, -0.0),
        assur.FourBar(1.0, 3.0, 2.5, 3.0).with_driver("rocker", q=1.0),
        assur.FourBar(1.0, 3.0, 2.5, 3.0).with_driver(assur.Drive("coupler", relative_to="rocker")),
        five_bar().with_driver([assur.Drive("c1"), assur.Drive("c2", relative_to="b2")]),
        assur.Mechanism.from_lengths(
            {"A": (0, 0), "B": (0, 1), "C": (3, 2), "D": (3, 0)},
            {"ground": "AD", "crank": "AB", "coupler": "BC", "rocker": "DC"},
            "crank",
            {"AB": 1.0, "BC": 3.0, "DC": 2.5},
        ),
        assur.Mechanism(
            {"A": (0, 0), "B": (1, 0), "C": (3, 0), "D": (2, 0)},
            {"ground": "AD", "crank": "AB", "coupler": "BC", "rocker": "DC"},
            "crank",
            assembly={"C": -1},
        ),
    ],
    ids=["crossed", "point", "bore", "rocker", "drive", "drives", "lengths", "in line"],
)
def test_other_constructors(mechanism: assur.Mechanism, tmp_path: Path) -> None:
    assert_same_motion(mechanism, again(mechanism, tmp_path / "m.toml"))


@pytest.mark.parametrize("shape", [(1,), (3,), (2, 3), (1, 1), (2, 1, 2)])
def test_batches(shape: tuple[int, ...], tmp_path: Path) -> None:
    lengths = np.random.default_rng(1).uniform(-1.0, 4.0, shape)
    batch = assur.FourBar(1.0, 3.0, lengths, 3.0)
    assert again(batch, tmp_path / "m.toml").shape == shape
    # All alike: the shape is kept.
    again(four_bar().with_dimensions({"crank.length": np.full(shape, 0.5)}), tmp_path / "m.toml")
    # A design without dimensions that exist is one of the batch.
    again(four_bar().with_dimensions({"crank.length": np.full(shape, np.nan)}), tmp_path / "m.toml")


def test_a_batch_lists_only_what_differs() -> None:
    text = text_of(assur.FourBar(1.0, 3.0, [2.4, 2.5], 3.0))
    assert "rocker.length = [2.4, 2.5]\n" in text
    assert "coupler.length = 3.0\n" in text


def test_no_designs_are_refused(tmp_path: Path) -> None:
    empty = four_bar().with_dimensions({"crank.length": []})
    with pytest.raises(assur.InputError, match=r"\(0,\) without designs"):
        empty.save(tmp_path / "m.toml")


def test_too_many_designs_are_refused_when_they_are_saved(tmp_path: Path) -> None:
    batch = four_bar().with_dimensions({"crank.length": np.random.default_rng(1).random(500_000)})
    with pytest.raises(assur.InputError, match="MiB") as caught:
        batch.save(tmp_path / "m.toml")
    assert "500000" not in str(caught.value)
    assert not (tmp_path / "m.toml").exists()


def test_cylinders_stay_cylinders(tmp_path: Path) -> None:
    excavator = CLASS_II["excavator"]()
    text = text_of(excavator)
    assert 'boom_cylinder = { base = "boom_base", end = "boom_eye"' in text
    assert "angle" not in text
    # A cylinder whose links are used otherwise, or drawn with another angle, is written in full.
    plain = assur.Mechanism(
        {"A": (0, 0), "B": (1.1, 0.9), "R": (0.9, 0.0)},
        {"ground": "AR", "lift_barrel": "R", "lift_rod": "B", "arm": "AB"},
        "lift",
        slides={
            "lift": assur.Slide(
                "lift_rod", "lift_barrel", angle=math.atan2(0.9, 1.1 - 0.9), origin="R"
            )
        },
    )
    assert "angle" in text_of(plain)
    again(plain, tmp_path / "m.toml")


def test_a_slide_keeps_whether_it_is_a_length(tmp_path: Path) -> None:
    def held(length: bool) -> assur.Mechanism:
        return assur.Mechanism(
            {"H": (0, 0), "foot": (0, -1.0), "eye": (1.0, 0)},
            {"ground": ["H", "foot"], "door": ["H", "eye"], "tube": ["foot"], "ram": ["eye"]},
            "lift",
            slides={
                "lift": assur.Slide("ram", "tube", angle=math.pi / 4, origin="foot", length=length)
            },
        )

    for mechanism, low in ((held(length=False), -2.0), (held(length=True), 0.0)):
        copy = again(mechanism, tmp_path / "door.toml")
        assert copy.slides["lift"].length == (low == 0.0)
        assert copy.limits().intervals.tolist() == [[low, 2.0]]
    assert held(length=False) != held(length=True)
    written = (tmp_path / "door.toml").read_text()
    assert 'base = "foot"' in written
    held(length=False).save(tmp_path / "door.toml")
    assert 'base = "foot"' not in (tmp_path / "door.toml").read_text()


def test_names_of_any_letters(tmp_path: Path) -> None:
    names = {"A": "точка", "B": "Ω-1", "C": "7", "D": "e=#", "P": "-"}
    own = four_bar()
    m = assur.Mechanism(
        {names[n]: at for n, at in own.joints.items()},
        {n: [names[j] for j in on] for n, on in own.links.items()},
        "crank",
    )
    assert_same_motion(m, again(m, tmp_path / "ü.toml"))


@settings(max_examples=200, deadline=None)
@given(st.floats(allow_nan=False, allow_infinity=False) | st.sampled_from(ODD))
def test_numbers_keep_their_bits(number: float) -> None:
    back = loads(f"x = {value_text(number)}")["x"]
    assert type(back) is float
    assert struct.pack("d", back) == struct.pack("d", number)


values: st.SearchStrategy[Any] = st.recursive(
    st.text(st.characters(exclude_categories=["Cs"]), max_size=12)
    | st.booleans()
    | st.integers(-(2**63), 2**63 - 1)
    | st.floats(allow_nan=False),
    lambda inner: (
        st.lists(inner, max_size=30)
        | st.dictionaries(st.text(st.characters(exclude_categories=["Cs"]), max_size=8), inner)
    ),
    max_leaves=40,
)


@settings(max_examples=60, deadline=None)
@given(values)
def test_values_are_read_back(value: Any) -> None:
    assert loads(f"x = {value_text(value)}") == {"x": value}


coordinates = st.floats(-1e3, 1e3).map(lambda x: x * (1.0 + 1e-9))


@settings(max_examples=100, deadline=None)
@given(st.lists(st.tuples(coordinates, coordinates), min_size=5, max_size=5), st.booleans())
def test_any_drawing(places: list[tuple[float, float]], is_crank: bool) -> None:
    """A drawing that makes a mechanism makes the same one from its text."""
    try:
        m = assur.Mechanism(
            dict(zip("ABCDP", places, strict=True)),
            {"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"},
            "crank" if is_crank else "rocker",
        )
    except assur.StructureError:
        return
    data = loads(text_of(m))
    for name, place in zip("ABCDP", places, strict=True):
        assert struct.pack("2d", *data["joints"][name]) == struct.pack("2d", *place)
