"""Tables of one case, in Markdown."""

from __future__ import annotations

from typing import Any

from subject import OURS

LEVELS = {"avx512": "AVX-512", "avx2": "AVX2", "baseline": "baseline"}


def quantity(seconds: float, digits: int = 2) -> str:
    """A time with its unit, to a number of digits."""
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6), ("ns", 1e-9)):
        if seconds >= size or unit == "ns":
            return f"{number(seconds / size, digits)} {unit}"
    raise AssertionError


def number(value: float, digits: int = 2) -> str:
    """To a number of digits, without an exponent; blanks separate thousands."""
    rounded = float(f"{value:.{digits}g}")
    if rounded >= 1000:
        return count(round(rounded))
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
    """One subject: a row a contender; several: a row each; where something grows, a column each."""
    if axis:
        cells = _side_by_side(f"{axis}: time a {unit}", subjects)
        return lines([list(column) for column in zip(*cells, strict=True)])
    return lines(
        _alone(subjects[0]) if len(subjects) == 1 else _side_by_side(f"time a {unit}", subjects)
    )


def lines(cells: list[list[str]]) -> list[str]:
    """Markdown of a table; its first row is the head."""
    head, *body = ["| " + " | ".join(row) + " |" for row in cells]
    return [head, "| --- " * len(cells[0]) + "|", *body]


def count(value: int) -> str:
    """A number of things, with thin blanks between thousands."""
    return f"{value:,}".replace(",", "\u202f")


def _alone(subject: dict[str, Any]) -> list[list[str]]:
    designs, positions = subject["designs"], subject["positions"]
    cells = [["", "a call", "a design", "a position", "of `assur`"]]
    for timing in _sorted(subject["timings"]):
        seconds = timing["seconds"]
        per = [seconds, seconds / designs, seconds / designs / positions]
        name = title(timing, len(levels([subject])))
        cells.append([name, *map(quantity, per), f"{number(timing['ratio'])} ×"])
    return cells


def _side_by_side(head: str, subjects: list[dict[str, Any]]) -> list[list[str]]:
    """Beside a time, in brackets, its ratio to that of the first contender."""
    keys = list(dict.fromkeys((t["name"], t["level"]) for s in subjects for t in s["timings"]))
    names = list(dict.fromkeys(name for name, _ in keys))
    keys.sort(key=lambda key: names.index(key[0]))
    many = len(levels(subjects))
    cells = [[head, *(title({"name": name, "level": level}, many) for name, level in keys)]]
    for subject in subjects:
        timings = {(t["name"], t["level"]): t for t in subject["timings"]}
        label = subject["label"]
        label = count(label) if isinstance(label, int) else label
        cells.append([label, *(_cell(subject, timings.get(key)) for key in keys)])
    return cells


def _cell(subject: dict[str, Any], timing: dict[str, Any] | None) -> str:
    if timing is None:
        return ""
    time = quantity(timing["seconds"] / subject["units"])
    is_first = timing is subject["timings"][0]
    return time if is_first else f"{time} ({number(timing['ratio'])} ×)"


def _sorted(timings: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Contenders in their order, the levels of each together."""
    names = list(dict.fromkeys(t["name"] for t in timings))
    return sorted(timings, key=lambda t: names.index(t["name"]))
