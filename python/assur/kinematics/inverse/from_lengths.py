"""A mechanism from a rough sketch and lengths that are measured between its joints."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import short
from assur._callers import level_of_caller
from assur._validate import real_number
from assur.errors import AssurWarning, InputError, PositionError
from assur.kinematics.assembly import assemblies
from assur.kinematics.configuration import size_of
from assur.kinematics.drawn import in_assembly
from assur.kinematics.named_dimensions import with_dimensions
from assur.kinematics.solve import solve

if TYPE_CHECKING:
    from assur.kinematics.model import AnyMechanism, MechanismModel

# How far (relative to the length) a distance that others determine may be from the given one.
AGREES = 1e-6

# Sines of the angle at which a sketch shows a joint beside a line. Below the first it does not,
# because typed numbers are rounded; below the second, a degree, the other side may have been meant.
ON_LINE, HARDLY = 1e-9, 0.0175

# The joints of a link in its own frame: complex numbers.
Shape = dict[str, complex]


def sized(sketch: AnyMechanism, lengths: Any) -> AnyMechanism:
    """Return the sketched mechanism with lengths between joints, in the assembly nearest to it."""
    checked = _checked(sketch, lengths)
    dimensions: dict[str, float] = {}
    for link, joints in sketch.links.items():
        of_link = {pair: length for pair, (of, length) in checked.items() if of == link}
        if of_link:
            dimensions.update(_dimensions(sketch, link, joints, of_link))
    return _nearest(with_dimensions(sketch, dimensions), sketch)


def _checked(sketch: MechanismModel, lengths: Any) -> dict[frozenset[str], tuple[str, float]]:
    """Return for every pair of joints the link that has both, and the length."""
    if not isinstance(lengths, Mapping):
        message = f"lengths is {short(lengths)}: a mapping of pairs of joints to lengths is needed"
        raise InputError(message)
    checked: dict[frozenset[str], tuple[str, float]] = {}
    for pair, length in lengths.items():
        names = tuple(pair) if isinstance(pair, str | tuple | list) else ()
        if len(names) != 2 or not all(isinstance(name, str) for name in names):
            message = (
                f'lengths: {short(pair)} is not a pair of joints: "AB" or ("A", "B") is needed'
            )
            raise InputError(message)
        for name in names:
            sketch.core.index_of("joint", name)
        link = next((link for link, on in sketch.links.items() if set(names) <= set(on)), None)
        if link is None or names[0] == names[1]:
            slide = _between(sketch, names)
            if slide is not None:
                message = (
                    f"lengths: {names[0]}-{names[1]} is the coordinate of the slide {slide!r}, "
                    "not a length of a link: leave it out, solve() takes it or gives it"
                )
                raise InputError(message, slide=slide)
            message = f"lengths: no link has both joints {names[0]!r} and {names[1]!r}"
            raise InputError(message)
        value = real_number(length, f"length {names[0]}-{names[1]}")
        if not (value > 0.0 and math.isfinite(value)):
            message = f"length {names[0]}-{names[1]} is {short(value)}: a positive length is needed"
            raise InputError(message, value=value)
        twice = checked.get(frozenset(names))
        if twice is not None and twice[1] != value:
            one, other = names
            message = (
                f"length {other}-{one} is {twice[1]:.10g} m and {one}-{other} is {value:.10g} m: "
                "give it once"
            )
            raise InputError(message, link=link, value=value)
        checked[frozenset(names)] = (link, value)
    return checked


def _between(sketch: MechanismModel, names: tuple[str, ...]) -> str | None:
    """Return the slide whose value is the distance of two joints, as that of a cylinder is."""
    links = sketch.links
    for name, slide in sketch.slides.items():
        ends = [slide.origin, *links[slide.link][:1]]
        if len(links[slide.on]) == 1 and sorted(map(str, ends)) == sorted(names):
            return name
    return None


def _dimensions(
    sketch: MechanismModel, link: str, joints: tuple[str, ...], lengths: dict[frozenset[str], float]
) -> dict[str, float]:
    """Return the dimensions of a link whose joints have some distances."""
    at = {name: complex(x, y) for name, x, y in sketch.description.joints}
    placed: Shape = {}
    left = list(joints)
    while left:
        # The joint with the most distances to those already placed; ties in the sketch's order.
        def known(name: str) -> int:
            return sum(frozenset((name, joint)) in lengths for joint in placed)

        name = max(left, key=known)
        left.remove(name)
        placed[name] = _place(link, name, at, placed, lengths)
    for pair, length in lengths.items():
        first, second = sorted(pair)
        distance = abs(placed[first] - placed[second])
        if abs(distance - length) > AGREES * length:
            message = (
                f"link {link!r}: {first}-{second} cannot be {length:g} m; the other lengths make "
                f"it {distance:g} m"
            )
            raise InputError(message, link=link, value=length)
    return _named(link, joints, placed, lengths)


def _place(
    link: str, name: str, at: Shape, placed: Shape, lengths: dict[frozenset[str], float]
) -> complex:
    """Place one more joint, on the side of the sketch."""
    known = [(o, lengths[frozenset((name, o))]) for o in placed if frozenset((name, o)) in lengths]
    if not placed:
        return at[name]
    base = next(iter(placed))
    if not known:
        return placed[base] + (at[name] - at[base])
    (first, r), *further = known
    towards = at[name] - at[first]
    if not further:
        return placed[first] + towards * (r / abs(towards) if towards else 0.0)
    second, s = further[0]
    chord = placed[second] - placed[first]
    d = abs(chord)
    along = (r * r - s * s + d * d) / (2.0 * d)
    height2 = r * r - along * along
    if height2 < -AGREES * r * r:
        message = (
            f"link {link!r}: {name}-{first} {r:g} m, {name}-{second} {s:g} m and {first}-{second} "
            f"{d:g} m do not make a triangle"
        )
        raise InputError(message, link=link)
    drawn = (at[second] - at[first]).conjugate() * towards
    side = math.copysign(1.0, drawn.imag)
    if height2 > AGREES * r * r:
        _require_side(link, (name, first, second), drawn)
    unit = chord / d
    return placed[first] + unit * complex(along, side * math.sqrt(max(height2, 0.0)))


def _require_side(link: str, names: tuple[str, str, str], drawn: complex) -> None:
    """Refuse a sketch that does not show a joint's side of two others; warn if it hardly does."""
    name, first, second = names
    sine = abs(drawn.imag) / abs(drawn) if drawn else 0.0
    if sine >= HARDLY:
        return
    line = f"the line {first}-{second}"
    if sine <= ON_LINE:
        message = (
            f"link {link!r}: joint {name!r} is drawn on {line}, and the lengths put it beside it: "
            "draw it on its side"
        )
        raise InputError(message, joint=name, link=link)
    side = "left" if drawn.imag > 0.0 else "right"
    message = (
        f"link {link!r}: joint {name!r} is drawn {math.degrees(sine):.2g}° beside {line}, and is "
        f"taken on the {side} of {first} → {second}: draw it clearly on its side"
    )
    warnings.warn(message, AssurWarning, stacklevel=level_of_caller())


def _named(
    link: str, joints: tuple[str, ...], placed: Shape, lengths: dict[frozenset[str], float]
) -> dict[str, float]:
    """Return the dimensions of a link whose joints are placed."""
    if link == "ground":
        axes = (("x", "real"), ("y", "imag"))
        return {f"ground.{n}.{x}": getattr(placed[n], part) for n in joints for x, part in axes}
    first, second, *further = joints
    axis = placed[second] - placed[first]
    length = abs(axis)
    # As it was given, to the last bit.
    dimensions = {f"{link}.length": lengths.get(frozenset((first, second)), length)}
    for name in further:
        local = (placed[name] - placed[first]) * axis.conjugate() / length
        dimensions |= {f"{link}.{name}.x": local.real, f"{link}.{name}.y": local.imag}
    return dimensions


def _nearest(mechanism: AnyMechanism, sketch: AnyMechanism) -> AnyMechanism:
    """Return the mechanism drawn in the assembly nearest to the sketch, at the sketch's q."""
    drawn = np.array([at for _, *at in sketch.description.joints])
    candidates = list(assemblies(mechanism, sketch.q0))
    if not candidates:
        where = solve(mechanism, sketch.q0, order=0, on_error="nan").explain()
        message = f"these lengths do not fit the sketch's position: {where}"
        raise PositionError(message)

    def apart(index: int) -> float:
        joints = candidates[index].joints
        assert joints is not None
        return float(np.abs(np.array(list(joints.values())) - drawn).max()) / size_of(mechanism)

    return in_assembly(mechanism, candidates[min(range(len(candidates)), key=apart)])
