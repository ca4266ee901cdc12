"""Tables of one case, in Markdown."""

from __future__ import annotations

from typing import Any

from subject import OURS

LEVELS = {"avx512": "AVX-512", "avx2": "AVX2", "baseline": "baseline", "portable": "portable"}


def quantity(seconds: float, digits: int = 2) -> str:
    """A time with its unit, to so many digits."""
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6), ("ns", 1e-9)):
        if seconds >= size or unit == "ns":
            return f"{number(seconds / size, digits)} {unit}"
    raise AssertionError


def number(value: float, digits: int = 2) -> str:
    """To so many digits, without an exponent; a thousand and more with blanks between them."""
    rounded = float(f"{value:.{digits}g}")
    if rounded >= 1000:
        return f"{rounded:,.0f}".replace(",", "\u202f")
    decimals = max(0, digits - len(str(int(rounded)))) if rounded >= 1 else None
    return f"{rounded:.{decimals}f}" if decimals is not None else f"{rounded:.{digits}g}"


def title(timing: dict[str, Any], levels: int) -> str:
    """A contender's name, with the level where there is more than one."""
    name = str(timing["name"])
    if not name.startswith(OURS):
        return name
    level = LEVELS.get(timing["level"], timing["level"])
    name = f"**`{OURS}`**{name.removeprefix(OURS)}"
    return f"{name}, {level}" if levels > 1 else name


def levels(subjects: list[dict[str, Any]]) -> list[str]:
    """Levels at which this package ran, the best one first."""
    return list(dict.fromkeys(t["level"] for s in subjects for t in s["timings"]))


def rows(unit: str, axis: str, subjects: list[dict[str, Any]]) -> list[str]:
    """One subject: a row a contender; several: a column each."""
    if len(subjects) == 1 and not axis:
        return _alone(subjects[0])
    return _side_by_side(unit, axis, subjects)


def _alone(subject: dict[str, Any]) -> list[str]:
    per = {"design": subject["designs"], "position": subject["designs"] * subject["positions"]}
    lines = ["| | a call | a design | a position | of `assur` |", "| --- | --- | --- | --- | --- |"]
    for timing in _sorted(subject["timings"]):
        seconds = timing["seconds"]
        cells = [
            title(timing, len(levels([subject]))),
            quantity(seconds),
            quantity(seconds / per["design"]),
            quantity(seconds / per["position"]),
            f"{number(timing['ratio'])} ×",
        ]
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def _side_by_side(unit: str, axis: str, subjects: list[dict[str, Any]]) -> list[str]:
    """Beside a time, in brackets, its ratio to that of the first row."""
    count = len(levels(subjects))
    keys = list(dict.fromkeys((t["name"], t["level"]) for s in subjects for t in s["timings"]))
    names = list(dict.fromkeys(name for name, _ in keys))
    keys.sort(key=lambda key: names.index(key[0]))
    heads = [str(s["label"]) for s in subjects]
    if axis:
        heads = [f"{s['label']:,}".replace(",", "\u202f") for s in subjects]
    first = f"{axis}: time a {unit}" if axis else f"time a {unit}"
    lines = ["| " + " | ".join([first, *heads]) + " |", "| --- " * (len(heads) + 1) + "|"]
    for name, level in keys:
        cells = [title({"name": name, "level": level}, count)]
        for subject in subjects:
            found = [t for t in subject["timings"] if (t["name"], t["level"]) == (name, level)]
            cell = quantity(found[0]["seconds"] / subject["units"]) if found else ""
            if found and found[0] is not subject["timings"][0]:
                cell += f" ({number(found[0]['ratio'])} ×)"
            cells.append(cell)
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def _sorted(timings: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Contenders in their order, the levels of each together."""
    names = list(dict.fromkeys(t["name"] for t in timings))
    return sorted(timings, key=lambda t: names.index(t["name"]))
