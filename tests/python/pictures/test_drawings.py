"""Drawings to scale: read back, measured, and looked for by layer."""

from __future__ import annotations

import re
import zlib
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from ezdxf.filemanagement import readfile
from ezdxf.units import MM

import assur
from assur.pictures.drawing.layers import layer_names
from assur.pictures.drawing.outline import rounded_hull

if TYPE_CHECKING:
    from pathlib import Path

FOUR_BAR = assur.Mechanism(
    joints={"A": (0, 0), "B": (0.1, 0), "C": (0.41, 0.32), "D": (0.48, 0.05), "P": (0.3, 0.4)},
    links={"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"},
    driver="crank",
)
ENGINE = assur.SliderCrank(0.05, 0.2, offset=0.01)
POINT = 25.4 / 72.0
SVG = "{http://www.w3.org/2000/svg}"
INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"


def read(path: Path) -> Any:
    document = readfile(path)
    audit = document.audit()
    assert not audit.errors
    assert not audit.fixes
    return document


def holes(document: Any, layer: str) -> Any:
    circles = document.modelspace().query(f'CIRCLE[layer=="{layer}"]')
    return np.array([tuple(circle.dxf.center)[:2] for circle in circles])


def measured(document: Any, kind: int = 0) -> list[float]:
    dims = document.modelspace().query("DIMENSION")
    return [float(dim.get_measurement()) for dim in dims if dim.dxf.dimtype & 7 == kind]


def test_a_link_has_its_holes_in_its_own_frame_dimensioned(tmp_path: Path) -> None:
    path = tmp_path / "coupler.dxf"
    scale = FOUR_BAR.to_drawing(path, link="coupler", width=0.03, hole=0.012)
    document = read(path)
    assert document.units == MM
    own = FOUR_BAR.dimensions
    length, x, y = (1000.0 * own[f"coupler.{name}"] for name in ("length", "P.x", "P.y"))
    assert holes(document, "LINK_coupler") == pytest.approx(
        np.array([[0, 0], [length, 0]]), abs=1e-9
    )
    assert sorted(measured(document)) == pytest.approx(sorted([length, x, y]), abs=1e-9)
    assert measured(document, 3) == pytest.approx([12.0], abs=1e-9)
    (outline,) = document.modelspace().query('LWPOLYLINE[layer=="LINK_coupler"]')
    # Its arcs are about the joints, its lines at half a width from the triangle's sides.
    triangle = np.array([[0.0, 0.0], [length, 0.0], [x, y]])
    parts = list(outline.virtual_entities())
    arcs = [part for part in parts if part.dxftype() == "ARC"]
    lines = [part for part in parts if part.dxftype() == "LINE"]
    assert len(arcs) == len(lines) == 3
    assert [arc.dxf.radius for arc in arcs] == pytest.approx([15.0] * 3, abs=1e-9)
    found = np.array([tuple(arc.dxf.center)[:2] for arc in arcs])
    assert found == pytest.approx(triangle, abs=1e-9)
    middles = np.array([tuple(line.dxf.start.lerp(line.dxf.end))[:2] for line in lines])
    assert distances(middles, triangle) == pytest.approx([15.0] * 3, abs=1e-9)
    centres = document.modelspace().query('LINE[layer=="CENTRES"]')
    assert len(centres) == 6
    layout = document.layout("Layout1")
    (view,) = layout.query("VIEWPORT[status>1]")
    assert view.dxf.height / view.dxf.view_height == pytest.approx(scale)


def distances(points: Any, polygon: Any) -> Any:
    """Return distances from the sides of a polygon."""
    start, along = polygon, np.roll(polygon, -1, axis=0) - polygon
    part = ((points[:, None] - start) * along).sum(-1) / (along**2).sum(-1)
    feet = start + np.clip(part, 0.0, 1.0)[..., None] * along
    return np.hypot(*np.moveaxis(points[:, None] - feet, -1, 0)).min(axis=1)


def test_all_links_are_on_one_sheet_each_on_its_layer(tmp_path: Path) -> None:
    path = tmp_path / "parts.dxf"
    FOUR_BAR.to_drawing(path, link="all")
    document = read(path)
    own = FOUR_BAR.dimensions
    for link, second in (("crank", "length"), ("coupler", "length"), ("rocker", "length")):
        first, other = holes(document, f"LINK_{link}")
        length = 1000.0 * own[f"{link}.{second}"]
        assert np.hypot(*(other - first)) == pytest.approx(length, abs=1e-9)
    first, other = holes(document, "GROUND")
    assert other - first == pytest.approx([480.0, 50.0], abs=1e-9)
    wanted = [1000.0 * own[name] for name in own if own[name]]
    assert sorted(measured(document)) == pytest.approx(sorted(wanted), abs=1e-9)
    texts = {text.dxf.text for text in document.modelspace().query("TEXT")}
    assert {"ground", "crank", "coupler", "rocker", "parts", *"ABCDP"} <= texts


@pytest.mark.parametrize("outlines", [False, True])
def test_a_position_has_the_joints_where_they_are(tmp_path: Path, outlines: bool) -> None:
    path = tmp_path / "position.dxf"
    FOUR_BAR.to_drawing(path, q=1.0, outlines=outlines)
    document = read(path)
    motion = FOUR_BAR.solve(1.0)
    layer = "LINK_coupler" if outlines else "JOINTS"
    found = holes(document, layer)
    for joint in "BC" if outlines else "ABCD":
        at = 1000.0 * motion.joint(joint).value
        assert np.abs(found - at).max(axis=1).min() < 1e-9
    own = FOUR_BAR.dimensions
    names = ("crank.length", "coupler.length", "rocker.length", "ground.D.x", "ground.D.y")
    assert measured(document) == pytest.approx([1000.0 * own[n] for n in names], abs=1e-9)
    layers = {layer.dxf.name for layer in document.layers}
    assert {"GROUND", "LINK_crank", "LINK_coupler", "LINK_rocker", "DIMENSIONS", "TEXT"} <= layers


def test_slots_and_cylinders(tmp_path: Path) -> None:
    ENGINE.to_drawing(tmp_path / "bore.dxf", link="ground")
    document = read(tmp_path / "bore.dxf")
    stroke = np.sqrt(0.25**2 - 0.01**2) - np.sqrt(0.15**2 - 0.01**2)
    assert sorted(measured(document)) == pytest.approx([10.0, 1000.0 * stroke], abs=1e-9)
    (slot,) = [
        p
        for p in document.modelspace().query('LWPOLYLINE[layer=="GROUND"]')
        if len(p) == 4 and not any(v[4] for v in p)
    ]
    corners = np.array([v[:2] for v in slot])
    assert corners[:, 1].mean() == pytest.approx(10.0, abs=1e-9)
    excavator = assur.examples.excavator()
    excavator.to_drawing(tmp_path / "barrel.dxf", link="boom_barrel")
    assert len(read(tmp_path / "barrel.dxf").modelspace().query("LWPOLYLINE")) >= 2


def rectangle(path: Path, layer: str) -> Any:
    """Return length and width of the only rectangle of a layer, mm."""
    (one,) = [
        np.array([v[:2] for v in p])
        for p in read(path).modelspace().query(f'LWPOLYLINE[layer=="{layer}"]')
        if len(p) == 4 and not any(v[4] for v in p)
    ]
    return np.ptp(one, axis=0)


@pytest.mark.parametrize("width", [0.02, 0.05])
def test_a_slot_is_longer_than_its_stroke_by_the_block(tmp_path: Path, width: float) -> None:
    stroke = np.sqrt(0.25**2 - 0.01**2) - np.sqrt(0.15**2 - 0.01**2)
    for link in ("ground", "piston"):
        ENGINE.to_drawing(tmp_path / f"{link}.dxf", link=link, width=width)
    slot = rectangle(tmp_path / "ground.dxf", "GROUND")
    block = rectangle(tmp_path / "piston.dxf", "LINK_piston")
    assert block == pytest.approx([1200.0 * width, 600.0 * width], abs=1e-9)
    assert slot == pytest.approx([1000.0 * stroke + block[0], block[1]], abs=1e-9)


@pytest.mark.parametrize(
    ("lengths", "stroke"),
    [
        ((0.05, 0.2, 0.03), np.sqrt(0.25**2 - 0.03**2) - np.sqrt(0.15**2 - 0.03**2)),
        ((0.1, 0.4, 0.0), 0.2),
        # To dead points, where the rod is upright on the guide: of two intervals the drawing's.
        ((2.0, 1.5, 0.3), np.sqrt(3.5**2 - 0.3**2) - np.sqrt(2.0**2 - 1.8**2)),
        ((1.0, 1.2, 0.6), np.sqrt(2.2**2 - 0.6**2) + np.sqrt(1.0**2 - 0.6**2)),
    ],
)
def test_slots_are_as_long_as_their_strokes(
    tmp_path: Path, lengths: tuple[float, ...], stroke: float
) -> None:
    """Between the positions of a picture a slide goes on beyond all of them."""
    m = assur.SliderCrank(*lengths)
    for link in ("ground", "all"):
        m.to_drawing(tmp_path / "slot.dxf", link=link)
        found = measured(read(tmp_path / "slot.dxf"))
        assert min(abs(one - 1000.0 * stroke) for one in found) < 1e-6 * stroke


def svg_circles(path: Path, layer: str) -> Any:
    """Return middles of closed curves as wide as high on a layer, mm of the paper."""
    root = ET.fromstring(path.read_text(encoding="utf-8"))
    width, height = (float(root.attrib[name].removesuffix("mm")) for name in ("width", "height"))
    box = [float(x) for x in root.attrib["viewBox"].split()]
    assert box[2:] == pytest.approx([width / POINT, height / POINT], rel=1e-6)
    (group,) = [g for g in root.iter(f"{SVG}g") if g.get(f"{INKSCAPE}label") == layer]
    assert group.get(f"{INKSCAPE}groupmode") == "layer"
    found = []
    for one in group.iter(f"{SVG}path"):
        text = one.attrib["d"]
        points = np.array([float(x) for x in re.findall(r"-?\d+\.?\d*", text)]).reshape(-1, 2)
        span = np.ptp(points, axis=0)
        if "C" in text and abs(span[0] - span[1]) < 1e-3:
            found.append((points.min(axis=0) + points.max(axis=0)) / 2.0 * POINT)
    return np.array(found)


def test_an_svg_is_to_scale_on_its_paper_with_named_layers(tmp_path: Path) -> None:
    path = tmp_path / "crank.svg"
    assert FOUR_BAR.to_drawing(path, link="crank", scale="1:2") == 0.5
    first, second = svg_circles(path, "LINK_crank")
    assert np.hypot(*(second - first)) == pytest.approx(50.0, abs=1e-4)
    text = path.read_text(encoding="utf-8")
    assert 'width="297mm" height="210mm"' in text
    labels = re.findall(r'inkscape:label="([^"]*)"', text)
    assert labels == ["LINK_crank", "CENTRES", "DIMENSIONS", "TEXT", "SHEET"]


def test_a_pdf_is_to_scale_on_its_paper(tmp_path: Path) -> None:
    path = tmp_path / "press.pdf"
    scale = FOUR_BAR.to_drawing(path, q=1.0, title="press")
    raw = path.read_bytes()
    (box,) = re.findall(rb"/MediaBox \[ ([\d. ]+) \]", raw)
    assert [float(x) * POINT for x in box.split()] == pytest.approx([0, 0, 297, 210], abs=1e-3)
    streams = re.findall(rb"stream\r?\n(.*?)\r?\nendstream", raw, re.DOTALL)
    middles = []
    for stream in streams:
        try:
            content = zlib.decompress(stream).decode("latin-1")
        except zlib.error:
            continue
        for path_text in re.findall(r"[\d.\- ]+ m\n(?:[\d.\- ]+ [lc]\n)+h?", content):
            points = np.array([float(x) for x in re.findall(r"-?\d+\.?\d*", path_text)])
            points = points.reshape(-1, 2)
            span = np.ptp(points, axis=0)
            if " c\n" in path_text and len(points) > 20 and abs(span[0] - span[1]) < 1e-2:
                middles.append((points.min(axis=0) + points.max(axis=0)) / 2.0 * POINT)
    motion = FOUR_BAR.solve(1.0)
    b, c = (motion.joint(joint).value for joint in "BC")
    wanted = 1000.0 * scale * np.hypot(*(c - b))
    apart = [np.hypot(*(m - n)) for i, m in enumerate(middles) for n in middles[:i]]
    assert min(abs(np.array(apart) - wanted)) < 1e-2


@pytest.mark.parametrize("form", ["dxf", "svg", "pdf"])
def test_every_example_is_drawn(tmp_path: Path, form: str) -> None:
    for name in ("excavator", "oldham"):
        mechanism: Any = assur.examples.ALL[name]()
        path = tmp_path / f"{name}.{form}"
        assert mechanism.to_drawing(path) > 0.0
        if form == "dxf":
            read(path)
            mechanism.to_drawing(path, link="all")
            read(path)


@pytest.mark.parametrize("factor", [1e-6, 1.0, 1e6])
def test_of_any_size_the_scale_is_a_standard_one_that_fits(tmp_path: Path, factor: float) -> None:
    mechanism = assur.FourBar(0.04 * factor, 0.12 * factor, 0.08 * factor, 0.1 * factor)
    scale = mechanism.to_drawing(tmp_path / "m.svg")
    digits = f"{scale:.0e}" if scale >= 1.0 else f"{1.0 / scale:.0e}"
    assert digits[0] in "125"
    assert scale * factor == pytest.approx(1.0)


def test_an_explicit_scale_chooses_the_paper(tmp_path: Path) -> None:
    path = tmp_path / "m.svg"
    FOUR_BAR.to_drawing(path, scale=1.0)
    assert 'width="841mm" height="594mm"' in path.read_text(encoding="utf-8")
    with pytest.raises(assur.InputError, match=r'scale is 1:1: .* no room on A3; .*paper="A0"'):
        FOUR_BAR.to_drawing(path, scale=1.0, paper="A3")
    with pytest.raises(assur.InputError, match=r"scale is 100:1: .* no room on A0"):
        FOUR_BAR.to_drawing(path, scale=100)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"path": "m.png"}, r"'.*m\.png' ends in '\.png': .*\.dxf, \.svg, \.pdf"),
        ({"path": "m"}, "ends in ''"),
        ({"path": 3}, "a path is needed"),
        ({"path": b"m.dxf"}, "a path is needed"),
        ({"path": "none/m.dxf"}, "cannot be written: No such file"),
        ({"path": "m\0.dxf"}, "cannot be written"),
        ({"link": "rod"}, 'no link "rod"'),
        ({"link": 3}, "the name of a link"),
        ({"link": "crank", "q": 1.0}, "a part has no position"),
        ({"q": [1.0, 2.0]}, r"positions \(2,\): a drawing shows one"),
        ({"scale": 0}, "scale is 0"),
        ({"scale": float("nan")}, "scale is nan"),
        ({"scale": -1}, "scale is -1"),
        ({"scale": "1:0"}, "scale is '1:0'"),
        ({"scale": "half"}, "scale is 'half'"),
        ({"scale": [1]}, "scale"),
        ({"paper": "A5"}, "one of A4"),
        ({"title": 3}, "title is 3"),
        ({"width": 0.0}, "width is 0: a positive length"),
        ({"width": 0.01, "hole": 0.01}, "links must be wider than holes"),
    ],
)
def test_bad_input_is_named(tmp_path: Path, wrong: dict[str, Any], words: str) -> None:
    given = {"path": "m.dxf", **wrong}
    if isinstance(given["path"], str):
        given["path"] = str(tmp_path / given["path"])
    with pytest.raises(assur.InputError, match=words):
        FOUR_BAR.to_drawing(**given)


def test_batches_and_positions_out_of_reach_are_refused(tmp_path: Path) -> None:
    batch = FOUR_BAR.with_dimensions({"crank.length": [0.1, 0.11]})
    with pytest.raises(assur.InputError, match=r"batch \(2,\): use design"):
        batch.to_drawing(tmp_path / "m.dxf")
    with pytest.raises(assur.PositionError):
        assur.FourBar(3.0, 2.5, 2.0, 4.0).to_drawing(tmp_path / "m.dxf", q=3.0)


ODD = [
    "a:b:",
    "A:B:",
    "a;b?",
    "x*|=",
    "кривошип",
    "曲柄",
    "e\u0301",
    "%%d",
    "^J",
    "L" * 300,
    "-",
    "_",
]


def test_layers_are_valid_and_different_whatever_the_names(tmp_path: Path) -> None:
    names = layer_names(["", " ", "\ud800", "a\nb", 'a"b', "a/b\\", "x,y", *ODD])
    assert len({one.casefold() for one in names.values()}) == len(names)
    assert not any(set(one) & set('<>/\\":;?*|=`,\n\ud800') or not one for one in names.values())
    assert all(len(one) <= 110 for one in names.values())
    from ezdxf.lldxf.validator import is_valid_layer_name

    assert all(is_valid_layer_name(one) for one in names.values())
    for i in range(0, len(ODD) - 2, 3):
        crank, coupler, rocker = ODD[i : i + 3]
        mechanism = assur.Mechanism(
            joints={"A": (0, 0), "%%c": (0.1, 0), "^M": (0.4, 0.3), "Ж|": (0.48, 0)},
            links={
                "ground": ["A", "Ж|"], crank: ["A", "%%c"], coupler: ["%%c", "^M"],
                rocker: ["Ж|", "^M"],
            },
            driver=crank,
        )  # fmt: skip
        mechanism.to_drawing(tmp_path / "m.dxf", link="all", title="a\x00\ud800%%u")
        document = read(tmp_path / "m.dxf")
        layers = [layer.dxf.name for layer in document.layers]
        assert sum(one.startswith("LINK_") for one in layers) == 3
    mechanism.to_drawing(tmp_path / "m.svg", link="all", title="a\x00\ud800<&")
    ET.fromstring((tmp_path / "m.svg").read_text(encoding="utf-8"))
    mechanism.to_drawing(tmp_path / "m.pdf", link="all", title="a\x00\ud800")


def test_outlines_of_any_points_keep_their_distance() -> None:
    random = np.random.default_rng(7)
    for count in (1, 2, 3, 4, 7):
        points = random.normal(size=(count, 2))
        if count == 4:
            points[:, 1] = 0.3 * points[:, 0]
        outline = rounded_hull("0", points, 0.2)
        assert outline.bulges is not None
        inside = np.hypot(*np.moveaxis(outline.points[:, None] - points[None], -1, 0)).min(axis=1)
        assert inside == pytest.approx(0.2)
        # All arcs together turn once.
        assert 4.0 * np.arctan(outline.bulges).sum() == pytest.approx(2.0 * np.pi)
