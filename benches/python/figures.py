"""The figures that the page shows, kept beside the code that measured them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from assur import _core

if TYPE_CHECKING:
    from subject import Case

FILE = Path(__file__).with_name("figures.json")
# Digits that a shared machine gives.
DIGITS = 4


def load() -> dict[str, Any]:
    """All that was measured last, by case; and the machine."""
    everything: dict[str, Any] = (
        json.loads(FILE.read_text(encoding="utf-8")) if FILE.exists() else {}
    )
    return everything


def keep(name: str, case: Case, subjects: list[dict[str, Any]]) -> None:
    """Replace the figures of one case; drop those of another machine, which do not compare."""
    here = machine()
    everything = load()
    if everything.get("machine") != here:
        everything = {"machine": here, "cases": {}}
    everything["cases"][name] = {
        "unit": case.unit,
        "axis": case.axis,
        "plotted": case.plotted,
        "every_level": case.every_level,
        "subjects": [_rounded(subject) for subject in subjects],
    }
    text = json.dumps(everything, indent=1, ensure_ascii=False, sort_keys=True)
    FILE.write_text(text + "\n", encoding="utf-8")


def machine() -> dict[str, Any]:
    """Processor, its level of instructions, and how many threads run at once."""
    from memory import cores

    name = "unknown processor"
    about = Path("/proc/cpuinfo")
    if about.exists():
        first: dict[str, str] = {}
        for line in about.read_text(encoding="utf-8").splitlines():
            key, _, value = line.partition(":")
            first.setdefault(key.strip(), value.strip())
        family, model = first.get("cpu family", "?"), first.get("model", "?")
        name = f"{first.get('model name', name)} (family {family}, model {model})"
    return {"processor": name, "level": _core.simd_level(), "threads": cores()}


def _rounded(value: Any) -> Any:
    if isinstance(value, float):
        return float(f"{value:.{DIGITS}g}")
    if isinstance(value, dict):
        return {key: _rounded(item) for key, item in value.items()}
    return [_rounded(item) for item in value] if isinstance(value, list) else value
