"""What computations need of a mechanism: the core's handle, dimensions, names, the drawing."""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, TypedDict, TypeVar, cast

import numpy as np

from assur._arrays import as_number
from assur._core import KnownSigns
from assur._summary import FORMULA, shortened
from assur.description import encode
from assur.description.structure import Group, Structure
from assur.kinematics.dimensions import Dimensions
from assur.kinematics.result_columns import Buffers, Layout

if TYPE_CHECKING:
    from collections.abc import Mapping

    from typing_extensions import Self

    from assur._arrays import Float, Number, Point
    from assur._core import Inverse
    from assur._core import Mechanism as Core
    from assur._later import Mechanism
    from assur.description.encode import Description
    from assur.description.words import DriverLike, Slide

__all__ = [
    "AnyMechanism",
    "AssemblyNumbers",
    "MechanismModel",
    "Place",
    "at_place",
    "copy_from",
    "with_values",
]

# Four units in the last place: rounding moves a solved place this far from the drawing's.
ROUND_TRIP = 1e-15

AnyMechanism = TypeVar("AnyMechanism", bound="MechanismModel")


class AssemblyNumbers(TypedDict):
    """An assembly as the core knows it."""

    signs: list[int]
    class_angles: list[float]
    slides: list[float]
    joints: list[tuple[float, float]]
    angles: list[float]
    is_double: bool


@dataclass(frozen=True, slots=True)
class Place:
    """Where an assembly was found: a design, its coordinates, and the core's numbers."""

    mechanism: MechanismModel
    q: tuple[float, ...]
    numbers: AssemblyNumbers

    @property
    def is_traced(self) -> bool:
        """Whether the assembly is what can be reached from here, not signs alone."""
        return self.mechanism.core.cls > 2


class MechanismModel:
    """What a mechanism is: immutable, equal by value."""

    __slots__ = (
        "__weakref__",
        "_joints",
        "_moved",
        "_names",
        "_structure",
        "core",
        "description",
        "inverses",
        "known_signs",
        "place",
        "signs",
        "values",
    )
    core: Core
    # Designs that earlier calls found to have constant signs.
    known_signs: KnownSigns
    description: Description
    # What it is when coordinates drive it, by their names: kept for all designs.
    inverses: dict[tuple[str, ...], Inverse]
    # By how much joints were moved within the tolerance that was given, m.
    _moved: float
    # Dimensions, shape (number of dimensions, *S).
    values: Float
    _structure: Structure | None
    _joints: MappingProxyType[str, Any] | None
    # Where it is drawn, if not in the drawing.
    place: Place | None
    # Signs of all dyads in the drawing; not to be modified.
    signs: list[int]
    # Indices of joints, links and slides by name.
    _names: tuple[dict[str, int], dict[str, int], dict[str, int]] | None
    # The class of mechanisms derived from it: a plain one, also for `FourBar` and others.
    _plain: ClassVar[type[Any]]

    def _initialise(
        self, description: Description, values: Float | None, core: Core | None = None
    ) -> None:
        core = core or encode.core_of(description)
        self._set(
            core=core,
            description=description,
            _structure=None,
            _joints=None,
            _moved=0.0,
            _names=None,
            inverses={},
            place=None,
            signs=[sign for _, sign in core.assembly],
        )
        self._set_values(np.array(core.drawing) if values is None else values)

    @classmethod
    def _make(
        cls, description: Description, values: Float | None, core: Core | None = None
    ) -> Self:
        mechanism = cls._blank()
        mechanism._initialise(description, values, core)
        return mechanism

    @classmethod
    def _blank(cls) -> Self:
        blank: Self = object.__new__(cls._plain)
        return blank

    def _set(self, **attributes: object) -> None:
        for name, value in attributes.items():
            object.__setattr__(self, name, value)

    def _set_values(self, values: Float) -> None:
        # Takes over the caller's array without a copy: a batch may be large.
        array = np.asarray(values, dtype=np.float64, order="C")
        array.flags.writeable = False
        self._set(values=array, known_signs=KnownSigns(math.prod(array.shape[1:])))

    def _moved_as(self, other: MechanismModel) -> Self:
        """Return self, a mechanism of the other's drawing."""
        self._set(_moved=other._moved)
        return self

    def _share(self, other: MechanismModel, values: Float) -> None:
        """Become the other mechanism with other values of its dimensions."""
        for name in ("core", "description", "_moved", "_structure", "_names", "place", "signs"):
            object.__setattr__(self, name, getattr(other, name))
        self._set(_joints=None, inverses=other.inverses)
        self._set_values(values)

    def __setattr__(self, name: str, value: object) -> None:
        message = f"Mechanism is immutable ({name!r}): use with_dimensions() or with_driver()"
        raise AttributeError(message)

    def __delattr__(self, name: str) -> None:
        message = f"Mechanism is immutable ({name!r}): use with_dimensions() or with_driver()"
        raise AttributeError(message)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, MechanismModel):
            return NotImplemented
        return (
            self.description == other.description
            and self.place == other.place
            and self.values.shape == other.values.shape
            and self.values.tobytes() == other.values.tobytes()
        )

    def __hash__(self) -> int:
        return hash((self.description, self.values.shape, self.values.tobytes()))

    def __repr__(self) -> str:
        batch = f", {self.shape} designs" if self.shape else ""
        return f"<assur.Mechanism {shortened(self.core.formula, FORMULA)}{batch}>"

    @property
    def shape(self) -> tuple[int, ...]:
        """Design shape S: ``()`` for one mechanism."""
        return self.values.shape[1:]

    @property
    def joints(self) -> Mapping[str, Point]:
        """Positions of the joints at `q0`, m: (x, y), or arrays S + (2,) for a batch.

        NaN for designs that cannot be assembled at `q0`.
        """
        if self._joints is None:
            drawn: dict[str, Any] = {name: (x, y) for name, x, y in self.description.joints}
            if not self._is_as_drawn:
                arrays = self._solved_joints()
                single = not self.shape
                drawn = {
                    name: _as_typed(at, drawn[name]) if single else at
                    for name, at in arrays.items()
                }
            object.__setattr__(self, "_joints", MappingProxyType(drawn))
        assert self._joints is not None
        return self._joints

    def _solved_joints(self) -> dict[str, Float]:
        """Solve for the joints at `q0`: NaN of designs that cannot be assembled there."""
        joints = self.indices[0]
        outputs: tuple[list[int], list[int], list[int], list[int]] = (
            [*joints.values()],
            [],
            [],
            [],
        )
        numbers, status, _ = self.core.solve(
            self.values.reshape(-1),
            self.q0_array.reshape(-1),
            False,
            self.signs,
            0,
            outputs,
            None,
            None,
            None,
            self.known_signs,
        )
        layout = Layout(joints, {}, {}, self.shape, self.driver_count, 0)
        return {n: place for n, (place,) in layout.held("joint", Buffers(numbers, status)).items()}

    @property
    def _is_as_drawn(self) -> bool:
        """Whether this is the drawing, not with another assembly or adjusted redundant links."""
        return (
            self.place is None
            and self.values.tolist() == self.core.drawing
            and not self.description.assembly
            and self.core.adjustment == 0.0
        )

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Names of the joints: unlike `joints`, without solving a design.

        :meta private:
        """
        return tuple(name for name, _, _ in self.description.joints)

    @property
    def links(self) -> Mapping[str, tuple[str, ...]]:
        """Joints of each link."""
        return MappingProxyType(dict(self.description.links))

    @property
    def slides(self) -> Mapping[str, Slide]:
        """Sliding pairs by name."""
        return MappingProxyType(dict(self.description.slides))

    @property
    def driver(self) -> DriverLike | tuple[DriverLike, ...]:
        """The driver, or a tuple of drivers."""
        drivers = self.description.drivers
        return drivers[0] if len(drivers) == 1 else drivers

    @property
    def q0(self) -> Number:
        """Coordinate of the driver in the drawing, rad or m; an array (n,) for n drivers."""
        q0 = self.q0_array
        return as_number(float(q0) if q0.ndim == 0 else q0)

    @property
    def q0_array(self) -> Float:
        """The same; an array () for one driver.

        :meta private:
        """
        q0 = np.array(self.core.q0)
        return q0[0] if len(q0) == 1 else q0

    @property
    def driver_count(self) -> int:
        """Number of drivers.

        :meta private:
        """
        return len(self.description.drivers)

    @property
    def indices(self) -> tuple[dict[str, int], dict[str, int], dict[str, int]]:
        """Indices of joints, links and slides by name; not to be modified.

        :meta private:
        """
        if self._names is None:
            description = self.description
            named = description.joints, description.links, description.slides
            names = tuple({item[0]: i for i, item in enumerate(of)} for of in named)
            object.__setattr__(self, "_names", names)
        assert self._names is not None
        return self._names

    @property
    def structure(self) -> Structure:
        """Mobility, structural formula, Assur groups, redundant links."""
        if self._structure is None:
            real, drawn, counted = self.core.mobility
            links, slides = self.core.redundant
            groups = tuple(
                Group(
                    cls=group["cls"],
                    order=group["order"],
                    kind=group["kind"],
                    artobolevsky_kind=group["artobolevsky_kind"],
                    links=tuple(group["links"]),
                    joints=tuple(group["joints"]),
                    slides=tuple(group["slides"]),
                )
                for group in self.core.groups
            )
            named = dict(self.description.links)
            at_joints = [joint for on in named.values() for joint in on]
            pins = [at_joints.count(joint) - 1 for joint in dict.fromkeys(at_joints)]
            structure = Structure(
                mobility=real,
                mobility_at_drawing=drawn,
                mobility_counted=counted,
                cls=self.core.cls,
                formula=self.core.formula,
                groups=groups,
                redundant=(*links, *slides),
                moving_links=len(named) - ("ground" in named),
                turning_pairs=sum(pins),
                sliding_pairs=len(self.description.slides),
                adjustment=max(self.core.adjustment, self._moved),
            )
            object.__setattr__(self, "_structure", structure)
        assert self._structure is not None
        return self._structure

    @property
    def dimensions(self) -> Dimensions:
        """The dimensions by name, m or rad: floats, or arrays of shape S.

        Examples
        --------
        >>> import assur
        >>> dict(assur.SliderCrank(1.0, 3.0).dimensions)["rod.length"]
        3.0
        """
        names = self.core.dimension_names
        values = self.values if self.shape else self.values.tolist()
        return Dimensions(dict(zip(names, values, strict=True)))

    def __len__(self) -> int:
        if not self.shape:
            message = "one mechanism has no length: it is not a batch of designs"
            raise TypeError(message)
        return self.shape[0]

    def __bool__(self) -> bool:
        return True


def as_made(mechanism: MechanismModel) -> Mechanism:
    """Return it typed as what it is: users make mechanisms of the class on top alone."""
    return cast("Mechanism", mechanism)


def with_values(mechanism: AnyMechanism, values: Float) -> AnyMechanism:
    """Return a mechanism with other values of its dimensions; the rest is shared."""
    changed = mechanism._blank()
    changed._share(mechanism, values)
    return changed


def at_place(mechanism: AnyMechanism, place: Place, core: Core) -> AnyMechanism:
    """Return a mechanism drawn at a place of one of its designs."""
    placed = with_values(mechanism, mechanism.values)
    placed._set(core=core, inverses={}, place=place, signs=[sign for _, sign in core.assembly])
    return placed


def copy_from(mechanism: MechanismModel, made: MechanismModel) -> None:
    """Turn a named mechanism under construction into the one that was made for it."""
    mechanism._share(made, made.values)


def _as_typed(solved: Float, drawn: tuple[float, float]) -> tuple[float, ...]:
    """Return a place; coordinates that differ by rounding alone become the drawing's."""
    size = float(np.abs(solved).max())
    return tuple(
        typed if abs(x - typed) <= ROUND_TRIP * size else x
        for x, typed in zip(solved.tolist(), drawn, strict=True)
    )
