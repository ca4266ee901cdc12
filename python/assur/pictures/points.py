"""Places on a chart in points of print, in which the sizes of texts are known."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.pictures.axes import root_figure

if TYPE_CHECKING:
    from assur._arrays import Float


def settle(ax: Any) -> None:
    """Compute the figure's layout now, so that texts placed clear of others stay clear."""
    figure = root_figure(ax)
    engine = figure.get_layout_engine()
    if engine is not None:
        with warnings.catch_warnings():
            # Figures too small for their axes warn.
            warnings.simplefilter("ignore")
            engine.execute(figure)


def per_px(ax: Any) -> float:
    """Return the length of a px, points."""
    return 72.0 / float(ax.figure.dpi)


def in_points(ax: Any, data: Float) -> Float:
    """Return places of the data in points, on settled axes."""
    shown: Float = ax.transData.transform(data)
    return shown * per_px(ax)


def in_data(ax: Any, points: Float) -> Float:
    """Return places in points as places of the data."""
    places: Float = ax.transData.inverted().transform(points / per_px(ax))
    return places


def bounds(ax: Any) -> tuple[Float, Float]:
    """Return the lower left and the upper right corner of the axes, points."""
    low, high = ax.bbox.get_points() * per_px(ax)
    return low, high


def point_in_data(ax: Any) -> Float:
    """Return a point along x and along y, in units of the data; the scales are linear."""
    apart: Float = np.abs(np.diff(in_data(ax, np.array([[0.0, 0.0], [1.0, 1.0]])), axis=0)[0])
    return apart


def text_box(text: Any) -> Float:
    """Return the lower left and the upper right corner of a text that is written, points."""
    corners: Float = text.get_window_extent().get_points() * per_px(text.axes)
    return corners
