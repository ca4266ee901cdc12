"""Drawings to scale: sheets of a position or of links, as DXF, SVG and PDF; see `export`.

A sheet is made of marks without a library (`marks`); `dxf` and `print` write them. Lengths of
marks are mm: of the mechanism for places, of the paper for texts, arrows and gaps.
"""

from assur.pictures.axes import pyplot

# Without matplotlib, any of these modules raises the error that says what to install.
pyplot()
