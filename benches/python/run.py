#!/usr/bin/env python3
"""Benches of this package beside what users would write without it.

From the root of the repository::

    python benches/python/run.py                     all cases, printed
    python benches/python/run.py --only chains       one of them
    python benches/python/run.py --quick             few designs, once: whether answers agree
    python benches/python/run.py --write             figures, tables, docs/explanation/speed.md
    python benches/python/run.py --page              the page again, from the figures there are
"""

from __future__ import annotations

import argparse
import warnings
from dataclasses import asdict
from time import perf_counter
from typing import Any

import figures
import page
import table
from cases import cases
from levels import sides
from rounds import measure


def parsed() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", nargs="+", metavar="NAME", help=", ".join(cases(quick=True)))
    parser.add_argument("--quick", action="store_true", help="few designs, one round, one level")
    parser.add_argument("--rounds", type=int, metavar="N", help="so many, however long they take")
    parser.add_argument(
        "--write", action="store_true", help="write docs/explanation/speed.md and its figures"
    )
    parser.add_argument(
        "--page", action="store_true", help="write docs/explanation/speed.md, measure nothing"
    )
    asked = parser.parse_args()
    known = list(cases(quick=True))
    for name in asked.only or ():
        if name not in known:
            parser.error(f"no case {name!r}; there are {', '.join(known)}")
    if asked.quick and (asked.write or asked.page):
        parser.error("--quick measures nothing worth writing")
    return asked


def main() -> None:
    asked = parsed()
    if not asked.page:
        for name, case in cases(asked.quick).items():
            if asked.only and name not in asked.only:
                continue
            start, subjects = perf_counter(), []
            rounds = 1 if asked.quick else asked.rounds or case.rounds
            with sides(case, asked.quick) as levels:
                for label in case.subjects:
                    about, timings = measure(levels, label, rounds)
                    rows: list[dict[str, Any]] = [asdict(timing) for timing in timings]
                    subjects.append({"label": label, **asdict(about), "timings": rows})
            print(f"\n{name} ({perf_counter() - start:.0f} s)\n")
            print("\n".join(table.rows(case.unit, case.axis, subjects)), flush=True)
            if asked.write:
                figures.keep(name, case, subjects)
    if asked.write or asked.page:
        page.write()


if __name__ == "__main__":
    # Rows that cannot be assembled are NaN in every contender.
    warnings.filterwarnings("ignore", "invalid value encountered")
    main()
