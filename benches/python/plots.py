"""Plots of the page: times of one case, growth, and all cases at a glance."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

import table
from subject import OURS

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FOLDER = Path(__file__).resolve().parents[2] / "docs" / "explanation" / "speed"
COLOURS = {OURS: "#c1272d", "NumPy": "#4878a8", "numba": "#6a9a3a", "memory": "#777777"}
OTHERS = "#b07aa1"
# Text stays text, and the same figures make the same file.
mpl.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "assur", "font.size": 9})


def colour(name: str) -> str:
    """One for each kind of contender."""
    kind = "memory" if name.startswith("writing") else name.split(",", maxsplit=1)[0]
    return COLOURS.get(kind, OTHERS)


def save(figure: Figure, name: str) -> str:
    """Write it; return its place relative to docs/."""
    FOLDER.mkdir(exist_ok=True)
    file = FOLDER / f"{name}.svg"
    figure.savefig(file, metadata={"Date": None, "Creator": None}, facecolor="white")
    text = file.read_text(encoding="utf-8")
    file.write_text("\n".join(line.rstrip() for line in text.splitlines()) + "\n", encoding="utf-8")
    return f"speed/{name}.svg"


def alone(name: str, unit: str, subject: dict[str, Any]) -> str:
    """A bar a contender, on a logarithmic axis."""
    timings = subject["timings"]
    timings = [
        t for t in timings if t["name"].startswith(OURS) or t["level"] == timings[0]["level"]
    ]
    names = list(dict.fromkeys(t["name"] for t in timings))
    timings = sorted(timings, key=lambda t: names.index(t["name"]))
    figure, axes = _axes(0.22 * len(timings) + 0.9)
    values = [1e9 * t["seconds"] / subject["units"] for t in timings]
    count = len({t["level"] for t in timings})
    titles = [_plain(table.title(t, count)) for t in timings]
    places = range(len(timings))[::-1]
    axes.barh(places, values, color=[colour(t["name"]) for t in timings], height=0.7)
    axes.set_yticks(places, titles)
    for place, value in zip(places, values, strict=True):
        axes.annotate(
            table.quantity(value * 1e-9), (value, place), (3, 0), textcoords="offset points",
            va="center", fontsize=8,
        )  # fmt: skip
    axes.set_xscale("log")
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_xlim(min(values) / 2.5, max(values) * 2.5)
    axes.set_xlabel(f"ns a {unit}")
    return save(figure, name)


def growth(name: str, unit: str, axis: str, subjects: list[dict[str, Any]]) -> str:
    """A line a contender."""
    figure, axes = _axes(2.4)
    best = subjects[0]["timings"][0]["level"]
    keys = list(dict.fromkeys(t["name"] for s in subjects for t in s["timings"]))
    for key in keys:
        points = [
            (int(s["label"]), 1e9 * t["seconds"] / s["units"])
            for s in subjects
            for t in s["timings"]
            if t["name"] == key and t["level"] == best
        ]
        style = "--" if key.endswith("analogues") or "side by side" in key else "-"
        axes.plot(*zip(*points, strict=True), style, marker="o", ms=3, color=colour(key), label=key)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.xaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_minor_locator(NullLocator())
    axes.set_xlabel(axis)
    axes.set_ylabel(f"ns a {unit}")
    axes.legend(frameon=False, fontsize=8)
    return save(figure, name)


def overview(rows: list[tuple[str, dict[str, float]]]) -> str:
    """Times of others in units of this package's: a row a case."""
    figure, axes = _axes(0.26 * len(rows) + 1.0)
    places = range(len(rows))[::-1]
    kinds = list(dict.fromkeys(kind for _, ratios in rows for kind in ratios))
    for kind in kinds:
        points = [
            (ratios[kind], p) for (_, ratios), p in zip(rows, places, strict=True) if kind in ratios
        ]
        filled = "none" if "expert" in kind else None
        axes.scatter(
            *zip(*points, strict=True), s=26, label=kind, edgecolors=colour(_kind(kind)),
            facecolors=filled or colour(_kind(kind)), zorder=3,
        )  # fmt: skip
    axes.axvline(1.0, color=COLOURS[OURS], lw=1.5)
    axes.set_yticks(places, [words for words, _ in rows])
    axes.set_xscale("log")
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_xlabel("time, assur = 1 (left: quicker than assur)")
    axes.grid(axis="y", lw=0.3)
    axes.legend(frameon=False, fontsize=8, loc="upper center", bbox_to_anchor=(0.2, 1.22), ncols=5)
    return save(figure, "overview")


def _kind(kind: str) -> str:
    return kind.replace(" by an expert", ",")


def _plain(title: str) -> str:
    return title.replace("**`", "").replace("`**", "")


def _axes(height: float) -> tuple[Figure, Axes]:
    figure = Figure(figsize=(6.4, height), layout="constrained")
    axes = figure.add_subplot()
    axes.spines[["top", "right"]].set_visible(False)
    return figure, axes
