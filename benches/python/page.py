"""Writes tables and plots of docs/explanation/speed.md between its markers, from the figures."""

from __future__ import annotations

import re
from pathlib import Path
from statistics import median
from typing import Any

import figures
import plots
import table
from memory import OLD
from subject import OURS

PAGE = Path(__file__).resolve().parents[2] / "docs" / "explanation" / "speed.md"
MARKERS = re.compile(r"(<!-- bench: (\w+) -->\n)(.*?)(<!-- /bench -->)", re.DOTALL)

# The first table: a user's words, the case, the number of its subject.
EXPECT = [
    ("one joint at one position", "one_design", 2),
    ("one position, everything, two analogues", "one_design", 3),
    ("360 positions, two angles, two analogues", "one_design", 0),
    ("random four-bars × 72, a coupler point", "random_four_bars", 0),
    ("random Stephenson III × 72, a point", "random_six_bars", 0),
    ("four-bars that turn × 360, two angles, two analogues", "turning_four_bars", 0),
    ("slider-cranks × 360, slide and angle, two analogues", "slider_cranks", 0),
    ("Jansen's leg × 360, six joints", "jansen_legs", 0),
    ("class III × 360, three joints", "classes", 1),
    ("class IV × 360, seven joints", "classes", 2),
    ("random four-bars × 72, a search by metrics", "metrics", 0),
    ("random four-bars × 72, two metrics of all", "metrics", 1),
]
# Whom the first table shows beside this package, by the names that they have in the cases.
OTHERS = {
    "NumPy": ("NumPy, whole arrays", "NumPy"),
    "numba": ("numba", "numba, Newton", "numba, the whole job"),
    "numba by an expert": ("numba, by an expert",),
    "memory": (OLD,),
}


def write() -> None:
    """Replace the text between the markers; complain of a marker without figures."""
    everything = figures.load()
    cases = everything["cases"]

    def fresh(match: re.Match[str]) -> str:
        start, name, _, end = match.groups()
        if name == "machine":
            return f"{start}{_machine(everything['machine'], cases)}\n{end}"
        if name == "expect":
            return f"{start}{_expect(cases)}\n{end}"
        if name not in cases:
            print(f"docs/explanation/speed.md: no figures of {name}: left as it is")
            return match[0]
        return f"{start}{_section(name, cases[name])}\n{end}"

    text = MARKERS.sub(fresh, PAGE.read_text(encoding="utf-8"))
    PAGE.write_text(text, encoding="utf-8")
    shown = {match[2] for match in MARKERS.finditer(text)}
    for name in sorted(set(cases) - shown):
        print(f"docs/explanation/speed.md has no marker of {name}")


def _machine(machine: dict[str, Any], cases: dict[str, Any]) -> str:
    level = table.LEVELS[machine["level"]]
    subjects = [subject for case in cases.values() for subject in case["subjects"]]
    spread = median(t["spread"] for subject in subjects for t in subject["timings"])
    about = f"{machine['processor']}, {level}, {machine['threads']} threads; "
    return f"{about}half of the rounds differ by less than {spread:.0%}."


def _section(name: str, case: dict[str, Any]) -> str:
    subjects, unit, axis = case["subjects"], case["unit"], case["axis"]
    lines = table.rows(unit, axis, subjects)
    notes = [f"{_size(s)}{s['note']}." for s in subjects if s["note"]]
    few = [_few(t) for t in subjects[0]["timings"] if t["designs"] < subjects[0]["designs"]]
    if notes or few:
        lines += ["", " ".join([*notes, *few])]
    missing = [
        words for level, words in table.LEVELS.items() if level not in table.levels(subjects)
    ]
    if missing and case["every_level"]:
        lines += ["", f"Skipped, this processor has none: {', '.join(missing)}."]
    if case["plotted"] and axis:
        file = plots.growth(name, unit, axis, subjects)
        lines += ["", f"![Time a {unit} over {axis}]({file})"]
    elif case["plotted"] and len(subjects) == 1:
        file = plots.alone(name, unit, subjects[0])
        lines += ["", f"![Time a {unit} of each contender]({file})"]
    return "\n".join(["", *lines, ""])


def _size(subject: dict[str, Any]) -> str:
    return f"Of {table.count(subject['designs'])} designs "


def _few(timing: dict[str, Any]) -> str:
    return f"{timing['name']}: timed with {table.count(timing['designs'])} designs, scaled."


def _expect(cases: dict[str, Any]) -> str:
    rows = [["your case", "a call", "a design", "a position", *OTHERS]]
    drawn = []
    for words, name, place in EXPECT:
        if name not in cases:
            continue
        subject = cases[name]["subjects"][place]
        first = subject["timings"][0]
        designs, positions = subject["designs"], subject["positions"]
        many, seconds = designs > 1, first["seconds"]
        call = table.quantity(seconds)
        per = [table.quantity(seconds / designs) if many else ""]
        per += [table.quantity(seconds / designs / positions) if positions > 1 else ""]
        ratios = _ratios(subject)
        cells = [f"{table.number(ratios[kind])} ×" if kind in ratios else "" for kind in OTHERS]
        title = f"{table.count(designs)} {words}" if many else words
        rows.append([title, call, *per, *cells])
        drawn.append((words, ratios))
    file = plots.overview(drawn)
    return "\n".join(["", *table.lines(rows), "", f"![Times of others, assur = 1]({file})", ""])


def _ratios(subject: dict[str, Any]) -> dict[str, float]:
    """Times of others, this package's being 1."""
    ratios = {t["name"]: t["ratio"] for t in subject["timings"] if not t["name"].startswith(OURS)}
    return {
        kind: ratios[name] for kind, names in OTHERS.items() for name in names if name in ratios
    }
