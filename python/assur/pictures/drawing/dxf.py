"""Sheets as DXF, by ezdxf: the model in mm, and a layout with the paper in its scale."""

from __future__ import annotations

from io import StringIO
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.pictures.drawing.layers import valid_text
from assur.pictures.drawing.marks import (
    ARROW,
    BEYOND,
    GAP,
    LETTER,
    TEXT_HEIGHT,
    Circle,
    Diameter,
    Distance,
    Filled,
    Outline,
    Text,
)

if TYPE_CHECKING:
    from assur.pictures.drawing.marks import Mark
    from assur.pictures.drawing.sheet import Sheet

# AutoCAD's colours: black or white, red, blue, greys.
COLOURS = {"CENTRES": 1, "DIMENSIONS": 8, "DRIVER": 5, "HATCHING": 9, "SHEET": 8}
INK = 7
WEIGHTS = (13, 18, 25, 35, 50, 70, 100, 140)
STYLE = "ASSUR"
# Diameters: the text is horizontal, on a leader.
LEADER = {"dimtih": 1, "dimtoh": 1, "dimtmove": 1, "dimtad": 0}


def dxf_bytes(sheet: Sheet, decimals: int) -> bytes:
    """Return the contents of a DXF file."""
    try:
        from ezdxf.filemanagement import new
        from ezdxf.units import MM
    except ImportError as error:  # pragma: no cover
        message = 'DXF needs ezdxf: pip install "assur[drawing]"'
        raise ImportError(message) from error
    doc: Any = new("R2010", setup=["linetypes"], units=MM)
    per = 1.0 / sheet.scale
    doc.header["$LTSCALE"] = 2.5 * per
    doc.styles.new(STYLE, dxfattribs={"font": "arial.ttf"})
    _dimension_style(doc, per, decimals)
    for layer in dict.fromkeys(mark.layer for mark in sheet.marks):
        doc.layers.add(layer, color=COLOURS.get(layer, INK))
    model = doc.modelspace()
    for mark in sheet.marks:
        _add(model, mark, per)
    _paper(doc, sheet)
    stream = StringIO()
    doc.write(stream)
    contents: bytes = stream.getvalue().encode("utf-8", errors="dxfreplace")
    return contents


def _dimension_style(doc: Any, per: float, decimals: int) -> None:
    doc.dimstyles.new(
        STYLE,
        dxfattribs={
            "dimtxsty": STYLE,
            # Heights are mm of the paper.
            "dimscale": per,
            "dimtxt": TEXT_HEIGHT,
            "dimasz": ARROW,
            "dimexo": GAP,
            "dimexe": BEYOND,
            "dimgap": GAP,
            "dimtad": 1,
            "dimtih": 0,
            "dimtoh": 0,
            "dimdec": decimals,
            # No zeros at the end, a point for decimals.
            "dimzin": 8,
            "dimdsep": ord("."),
            "dimclrd": COLOURS["DIMENSIONS"],
            "dimclre": COLOURS["DIMENSIONS"],
            "dimclrt": COLOURS["DIMENSIONS"],
        },
    )


def _weight(mm: float) -> int:
    """Return the nearest line weight."""
    return min(WEIGHTS, key=lambda weight: abs(weight - 100.0 * mm))


def _add(model: Any, mark: Mark, per: float) -> None:
    attributes: dict[str, Any] = {"layer": mark.layer}
    if isinstance(mark, Outline):
        attributes["lineweight"] = _weight(mark.weight)
        if mark.dash_dotted:
            attributes["linetype"] = "CENTER"
        if len(mark.points) == 2 and mark.bulges is None:
            model.add_line(*mark.points.tolist(), dxfattribs=attributes)
            return
        bulges = np.zeros(len(mark.points)) if mark.bulges is None else mark.bulges
        points = np.column_stack([mark.points, bulges]).tolist()
        model.add_lwpolyline(points, format="xyb", close=mark.closed, dxfattribs=attributes)
    elif isinstance(mark, Circle):
        attributes["lineweight"] = _weight(mark.weight)
        if mark.filled:
            hatch = model.add_hatch(color=256, dxfattribs={"layer": mark.layer})
            path = hatch.paths.add_edge_path()
            path.add_arc(mark.centre.tolist(), mark.radius, 0.0, 360.0)
        else:
            model.add_circle(mark.centre.tolist(), mark.radius, dxfattribs=attributes)
    elif isinstance(mark, Filled):
        hatch = model.add_hatch(color=256, dxfattribs=attributes)
        hatch.paths.add_polyline_path(mark.points.tolist(), is_closed=True)
    elif isinstance(mark, Text):
        _add_text(model, mark, per)
    elif isinstance(mark, Distance):
        attributes = {"layer": mark.layer}
        model.add_linear_dim(
            base=mark.base.tolist(),
            p1=mark.start.tolist(),
            p2=mark.end.tolist(),
            angle=float(np.degrees(mark.angle)),
            dimstyle=STYLE,
            dxfattribs=attributes,
        ).render()
    else:
        _add_diameter(model, mark, per)


def _add_text(model: Any, mark: Text, per: float) -> None:
    from ezdxf.enums import TextEntityAlignment

    where = {
        "middle": TextEntityAlignment.MIDDLE_CENTER,
        "below": TextEntityAlignment.BOTTOM_CENTER,
        "left": TextEntityAlignment.LEFT,
    }
    # ^ and %% begin codes.
    text = valid_text(mark.text).replace("^", "^ ").replace("%%", "% %")
    entity = model.add_text(
        text, height=mark.height * per, dxfattribs={"layer": mark.layer, "style": STYLE}
    )
    entity.set_placement(mark.at.tolist(), align=where[mark.anchor])


def _add_diameter(model: Any, mark: Diameter, per: float) -> None:
    # The text of ezdxf stands with its middle at a place.
    half = np.array([LETTER * 4.0, 0.5]) * TEXT_HEIGHT * per
    model.add_diameter_dim(
        center=mark.centre.tolist(),
        radius=mark.radius,
        angle=float(np.degrees(mark.angle)),
        location=(mark.text_at(per) + half).tolist(),
        # The sign of the diameter comes with the number.
        text=f"{mark.count}× <>" if mark.count > 1 else "<>",
        dimstyle=STYLE,
        override=LEADER,
        dxfattribs={"layer": mark.layer},
    ).render()


def _paper(doc: Any, sheet: Sheet) -> None:
    """Show the model on the paper of a layout, in its scale."""
    layout = doc.layout("Layout1")
    width, height = sheet.size
    layout.page_setup(size=(width, height), margins=(0, 0, 0, 0), units="mm", scale=(1, 1))
    middle = sheet.origin + np.array([width, height]) / (2.0 * sheet.scale)
    layout.add_viewport(
        center=(width / 2.0, height / 2.0),
        size=(width, height),
        view_center_point=tuple(middle.tolist()),
        view_height=height / sheet.scale,
    )
