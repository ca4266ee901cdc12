"""Wide design spaces, whose designs mostly do not turn fully, and (as a program) digests of them.

``ASSUR_CARE=always python design_spaces.py 100`` solves every position by itself,
``ASSUR_CARE=knots`` traces every branch knot by knot as well.
"""

from __future__ import annotations

import hashlib
import json
import sys
from typing import TYPE_CHECKING

import numpy as np

import assur
from campaigns import campaign_cases
from models.mechanisms import named_drawings
from models.mechanisms.mechanism_data import arguments
from net import bits
from support.samples import sample

if TYPE_CHECKING:
    from collections.abc import Iterator

# Designs of a space, and coordinates of each.
DESIGNS, POSITIONS = 24, 40
# Of class II, with one driven angle.
NAMED = [
    "crank_rocker", "engine", "whitworth", "shaper", "scotch_yoke",
    "watt_six_bar", "stephenson_six_bar", "jansen_leg", "klann_leg",
]  # fmt: skip


def space(m: assur.Mechanism, rng: np.random.Generator, designs: int = DESIGNS) -> assur.Mechanism:
    """A batch with dimensions up to 60 % longer or shorter.

    Of every three designs one changes all of them, one half, and one few (some none), so that
    some keep the change points of the drawing.
    """
    shape = (len(m.dimensions), designs)
    kept = rng.random(shape) < np.resize([0.0, 0.5, 0.9], designs)
    wide = np.where(kept, 1.0, rng.uniform(0.4, 1.6, shape))
    rows = zip(m.dimensions.items(), wide, strict=True)
    return m.with_dimensions({name: value * factors for (name, value), factors in rows})


def crank_space(seed: int, designs: int = DESIGNS) -> assur.Mechanism:
    """A crank with one dyad, drawn and listed in any order, with lengths of any ratio."""
    rng = np.random.default_rng(seed)
    while True:
        a, b, c, d = rng.uniform(-2.0, 2.0, (4, 2))
        pairs = {"crank": "AB", "coupler": "BC", "rocker": "CD", "ground": "AD"}
        links = {name: sorted(pair, reverse=bool(rng.integers(2))) for name, pair in pairs.items()}
        slides = {}
        if seed % 3 == 0:
            links["rocker"] = ["C"]
            slides["guide"] = assur.Slide(
                "rocker", "ground", angle=rng.uniform(-3.0, 3.0), origin="D"
            )
        try:
            one = assur.Mechanism({"A": a, "B": b, "C": c, "D": d}, links, "crank", slides=slides)
        except ValueError:
            continue  # it does not close, or stands at a dead point
        drawn = {name: np.full(designs, value) for name, value in one.dimensions.items()}
        for name, values in drawn.items():
            if name.endswith("length"):
                drawn[name] = rng.uniform(0.3, 3.0, designs)
            elif not name.endswith("angle"):
                drawn[name] = values + rng.uniform(-2.0, 2.0, designs)
        return one.with_dimensions(drawn)


def slide_space(seed: int, designs: int = DESIGNS) -> assur.Mechanism:
    """A slide that drives a boom, by a rod or as a cylinder; often with a dyad behind it."""
    rng = np.random.default_rng(seed)
    a, b, c, p, e, f = rng.uniform(-1.5, 1.5, (6, 2))
    joints = {"A": a, "B": b, "C": c}
    if seed % 2:
        links = {"ground": ["A", "B"], "boom": ["A", "C", "P"], "barrel": ["B"], "rod": ["C"]}
        angle = float(np.arctan2(*(c - b)[::-1]))
        slides = {"drive": assur.Slide("rod", "barrel", angle=angle, origin="B")}
        joints["P"] = p
    else:
        links = {"ground": ["A"], "boom": ["A", "B"], "rod": ["B", "C"], "piston": ["C"]}
        slides = {
            "drive": assur.Slide("piston", "ground", angle=rng.uniform(-3.0, 3.0), origin="A")
        }
    if seed % 5 < 2:
        links["ground"].append("F")
        links |= {"arm": ["P" if seed % 2 else "B", "E"], "tip": ["E", "F"]}
        joints |= {"E": e, "F": f}
    elif seed % 5 == 2:
        links |= {"arm": ["P" if seed % 2 else "B", "E"], "block": ["E"]}
        slides["guide"] = assur.Slide("block", "ground", angle=rng.uniform(-3.0, 3.0), origin="A")
        joints["E"] = e
    one = assur.Mechanism({n: tuple(at) for n, at in joints.items()}, links, "drive", slides=slides)
    return space(one, rng, designs)


def edge_spaces() -> Iterator[tuple[str, assur.Mechanism, float]]:
    """Designs 1e-16 to 1e-2 from a change point, or a narrow gap, each with where that is."""
    off = np.concatenate([[0.0], np.outer([1.0, -1.0], 10.0 ** -np.arange(2.0, 17.0)).ravel()])
    yield "parallelogram", assur.FourBar(1.0, 3.0, 1.0 + off, 3.0), np.pi
    yield "kite", assur.FourBar(1.0, 1.0 + off, 2.0, 2.0), 0.0
    yield "even", assur.FourBar(1.0, 3.0, 2.0 + off, 4.0, mode="crossed"), np.pi
    # The crank's pin passes the rocker's pivot.
    yield "coincident", assur.FourBar(2.0, 1.5, 1.5 + off, 2.0), 0.0
    yield "near pivot", assur.FourBar(2.0 + off, 1.5, 1.5, 2.0), 0.0
    yield "isosceles", assur.SliderCrank(1.0, 1.0 + off), np.pi / 2
    yield "offset", assur.SliderCrank(1.0, 2.0 + off, offset=1.0), np.pi / 2


def edge_digests() -> Iterator[tuple[str, tuple[str, str]]]:
    """Of these, beside the event and far from it, and where q is no angle at all."""
    near = np.outer([1.0, -1.0], 10.0 ** -np.arange(1.0, 17.0)).ravel()
    odd = [np.nan, np.inf, -np.inf, 1e9, -1e9, 1e17, 1e300, 5e-324]
    for name, batch, event in edge_spaces():
        q = np.concatenate([event + near, event + np.linspace(0.0, 7.0, 20), odd])
        yield f"edge {name}", digest_of(batch, q)


def digest(m: assur.Mechanism, seed: int) -> tuple[str, str]:
    """The digest of a mechanism's space."""
    rng = np.random.default_rng(seed)
    q = rng.uniform(-2.0, 8.0, (POSITIONS, *np.shape(m.q0)))
    return digest_of(space(m, rng), q)


def digest_of(batch: assur.Mechanism, q: bits.Float) -> tuple[str, str]:
    """Of joints alone (signs are enough) and of everything, to order 2; then without angles."""
    joints = [name for name in batch.joints if name not in batch.links["ground"]]
    motions = [batch.solve(q, order=order, on_error="nan") for order in (0, 2)]
    if joints:
        motions.append(batch.solve(q, order=2, outputs=joints, on_error="nan"))
    rows = b"".join(bits.bits(motion).tobytes() for motion in motions)
    for motion in motions:
        for value, *_ in motion._results.links.values():
            value.flags.writeable = True
            value[:] = 0.0
    without = b"".join(bits.bits(motion).tobytes() for motion in motions)
    first, second = (hashlib.blake2b(one).hexdigest() for one in (rows, without))
    return first, second


def digests(seeds: int) -> Iterator[tuple[str, tuple[str, str]]]:
    for name in NAMED:
        for seed in range(sample(2, 4)):
            yield f"{name} {seed}", digest(named_drawings.CLASS_II[name](), seed)
    for name in bits.NAMES:
        if np.ndim(bits.named(name).q0):
            for seed in range(sample(2, 4)):
                yield f"{name} {seed}", digest(bits.named(name), seed)
    yield from edge_digests()
    for seed in range(seeds):
        yield f"seed {seed}", digest(bits.random(seed), seed)
        q = np.random.default_rng(seed).uniform(-9.0, 15.0, POSITIONS)
        yield f"crank {seed}", digest_of(crank_space(seed), q)
        # Whole turns of such coordinates have to be taken off exactly.
        yield f"crank {seed}, far", digest_of(crank_space(seed), 3e15 * q)
        slides = slide_space(seed)
        reach = np.random.default_rng(seed).choice([0.1, 0.5, 2.0, 4.0])
        yield f"slide {seed}", digest_of(slides, slides.q0 + reach * (q - 3.0) / 12.0)
        changing = arguments(campaign_cases.changing_case(seed).description)
        yield f"changing {seed}", digest(assur.Mechanism(**changing), seed)


if __name__ == "__main__":
    json.dump(dict(digests(int(sys.argv[1]))), sys.stdout)
