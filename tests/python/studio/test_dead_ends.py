"""Where a driver stops: the joint between the links of the dyad, and how they lie there."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from assur.studio import document
from studio.asking import ask

if TYPE_CHECKING:
    from collections.abc import Iterator

    from assur.kinematics.mechanism import Mechanism

# Lengths that make some driver stop.
FACTORS = (0.3, 0.6, 1.5, 2.5)


def dyads(mechanism: Mechanism) -> Iterator[tuple[str, str, list[str]]]:
    """Yield each dyad of three turning pairs: name, inner joint and outer joints, by its links."""
    for group in mechanism.structure.groups:
        if group.kind == "RRR" and len(group.links) == 2:
            first, second = (set(mechanism.links[link]) for link in group.links)
            (inner,) = first & second
            outer = [joint for joint in group.joints if joint != inner]
            assert len(outer) == 2
            yield f"II({', '.join(group.links)})", inner, outer


def stopping(mechanism: Mechanism, name: str) -> Iterator[Mechanism]:
    """Yield designs in which this dyad stops the driver."""
    for dimension, value in mechanism.dimensions.items():
        if not dimension.endswith(".length"):
            continue
        for factor in FACTORS:
            other = mechanism.with_dimensions({dimension: value * factor})
            try:
                dead = other.limits().dead_points
            except assur.AssurError:
                continue
            if any(point.group == name for point in dead):
                yield other


def distances(mechanism: Mechanism, q: float, middle: float, joints: list[str]) -> list[float]:
    """Return the distances of the pairs of three joints, almost at q; NaN if it is not there."""
    motion = mechanism.solve(q + 1e-7 * (middle - q), order=0, on_error="nan")
    a, b, c = (motion.joint(joint).value for joint in joints)
    return [float(np.hypot(*(first - second))) for first, second in ((a, b), (b, c), (a, c))]


def turning_dyads() -> list[tuple[str, str]]:
    found = []
    for example, make in assur.examples.ALL.items():
        what: Any = make()
        mechanism = getattr(what, "mechanism", what)
        if mechanism.driver_count == 1:
            found += [(example, name) for name, _, _ in dyads(mechanism)]
    return found


def test_every_dyad_of_the_examples() -> None:
    seen: set[tuple[str, str]] = set()
    shapes = {"stretched": 0, "folded": 0}
    for example, name in turning_dyads():
        what: Any = assur.examples.ALL[example]()
        mechanism = getattr(what, "mechanism", what)
        inner, outer = next((i, o) for own, i, o in dyads(mechanism) if own == name)
        for other in list(stopping(mechanism, name))[:3]:
            try:
                reply = ask("turn", document=document.document_of(other), rows=61)
            except AssertionError:
                # The drawing is out of reach of this design.
                continue
            turn = reply["payload"]["turn"]
            q = turn["grid"].get("middle")
            for end in turn["dead"]:
                if end["group"] != name:
                    continue
                a, b, apart = distances(other, end["q"], q, [outer[0], inner, outer[1]])
                # A turn further a long crank may have brought another dyad over to its other side.
                if np.isnan(apart):
                    continue
                stretched, folded = abs(apart - (a + b)), abs(apart - abs(a - b))
                assert min(stretched, folded) < 1e-3 * max(a, b)
                shape = "stretched" if stretched < folded else "folded"
                assert (end["inner"], end["shape"]) == (inner, shape), (example, name, end["q"])
                seen.add((example, name))
                shapes[shape] += 1
    assert len(seen) >= 20
    assert min(shapes.values()) >= 10


def test_the_two_ends_of_a_long_crank() -> None:
    """The page's first mechanism with a crank of 120 mm: BD is 40 and 200 mm."""
    own = document.document_of(assur.examples.crank_rocker())
    own["dimensions"] = {**own.get("dimensions", {}), "crank.length": 0.12}
    dead = ask("turn", document=own)["payload"]["turn"]["dead"]
    found = {round(np.degrees(end["q"]) % 360.0, 1): (end["inner"], end["shape"]) for end in dead}
    assert found[18.2] == ("C", "folded")
    assert found[130.5] == ("C", "stretched")


def test_other_groups_have_no_such_words() -> None:
    engine = document.document_of(assur.SliderCrank(0.4, 0.1))
    dead = ask("turn", document=engine)["payload"]["turn"]["dead"]
    assert [(end["inner"], end["shape"]) for end in dead] == [("B", None)] * len(dead)
    assert len(dead) == 2
