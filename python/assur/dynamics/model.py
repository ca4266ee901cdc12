"""Machines: mechanisms with bodies, loads and motors, referred to their drivers."""

from __future__ import annotations

from functools import partial
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, TypeVar

import numpy as np

from assur import _core
from assur._arrays import counted, flag
from assur._by_value import key_of
from assur._later import explorer, save
from assur._other_names import renamed
from assur._summary import FORMULA, shortened
from assur._validate import checked_index, one_of
from assur.dynamics import components
from assur.dynamics.batch_shapes import batch_shape, design_index
from assur.dynamics.loads.friction import checked_friction
from assur.dynamics.loads.load_coordinate import check_over
from assur.dynamics.loads.load_functions import check_functions
from assur.dynamics.loads.loaded_link import warn_of_ambiguous_loads
from assur.dynamics.loads.loads import checked_load
from assur.dynamics.varied import Parts, for_core
from assur.errors import InputError
from assur.flywheel import SPLINES
from assur.flywheel.sizing import warn_if_degrees

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from os import PathLike

    import numpy.typing as npt
    from typing_extensions import Self

    from assur._later import Explorer
    from assur.dynamics.loads.friction import PairFriction
    from assur.dynamics.loads.loads import Body, Load
    from assur.dynamics.loads.motors import Motor
    from assur.flywheel import Spline
    from assur.kinematics.mechanism import Mechanism

AnyMachine = TypeVar("AnyMachine", bound="MachineModel")

OnError: TypeAlias = Literal["raise", "nan"]


class MachineModel:
    """What a machine consists of."""

    mechanism: Mechanism | None
    varies: tuple[str, ...]
    _shape: tuple[int, ...]

    @renamed(masses="bodies", forces="loads", motors="motor")
    def __init__(
        self,
        mechanism: Mechanism,
        *,
        bodies: Mapping[str, Body] = MappingProxyType({}),
        loads: Sequence[Load] = (),
        motor: Motor | Sequence[Motor | None] | None = None,
        friction: Mapping[str, PairFriction] = MappingProxyType({}),
    ) -> None:
        self._make(mechanism, bodies, loads, motor, friction)
        # Not for machines derived from this one.
        warn_of_ambiguous_loads(mechanism, self.loads, self.friction)

    def _make(
        self,
        mechanism: Mechanism,
        bodies: Mapping[str, Body],
        loads: Sequence[Load],
        motor: Motor | Sequence[Motor | None] | None,
        friction: Mapping[str, PairFriction],
    ) -> None:
        components.check_types(mechanism, bodies)
        self.mechanism = mechanism
        self.bodies = MappingProxyType(
            dict(components.body(mechanism, link, body) for link, body in bodies.items())
        )
        self.loads = tuple(components.as_list(loads, "loads"))
        self.driver_count = int(np.size(mechanism.q0))
        # With one driver, the motor itself.
        self.motor: Any = tuple(motor) if isinstance(motor, list | tuple) else motor
        if isinstance(self.motor, tuple) and len(self.motor) == 1 == self.driver_count:
            self.motor = self.motor[0]
        self.friction: Mapping[str, PairFriction] = MappingProxyType(
            checked_friction(mechanism, friction)
        )
        self._rebuild_with: tuple[Any, ...] = (
            type(self)._made,
            (mechanism, dict(self.bodies), self.loads, self.motor, dict(self.friction)),
        )
        motors = components.motors(self.motor, self.driver_count)
        self._parts = Parts(
            self.bodies,
            [components.load(mechanism, checked_load(load)) for load in self.loads],
            motors,
        )
        varied = self._parts.varied()
        self._shape = batch_shape(mechanism.shape, varied)
        # What messages call the arrays among the numbers.
        self.varies = tuple(f"{of.name}: {of.field}" for of in varied)
        one = self._parts.single() if varied else self._parts
        self.core = _core.Machine(
            mechanism.core,
            loads=list(one.loads),
            bodies=list(one.bodies.items()),
            motors=list(one.motors),
            friction=list(self.friction.items()),
            varied=for_core(varied, self._shape),
        )
        check_over(mechanism, self.loads)
        check_functions(self.loads, motors, np.ravel(mechanism.q0).tolist())
        if mechanism.driver not in mechanism.slides:
            for rows, periodic in self.core.tables:
                warn_if_degrees(rows[-1] - rows[0], periodic)

    @classmethod
    def _made(cls, *parts_of_one: Any) -> Self:
        """Return a machine made of another's parts, of which the user has been warned already."""
        self = cls.__new__(cls)
        self._make(*parts_of_one)
        return self

    def of(self, mechanism: Mechanism) -> Self:
        """Return a machine with the same parts for other designs of its mechanism.

        Parameters
        ----------
        mechanism : Mechanism
            Its mechanism with other dimensions, or a batch.

        Returns
        -------
        Machine
            A new one.

        Examples
        --------
        >>> import assur
        >>> press = assur.SliderCrank(0.1, 0.4)
        >>> machine = assur.Machine(press, bodies={"piston": assur.Body(mass=20.0)})
        >>> machine.of(press.with_dimensions({"rod.length": [0.3, 0.5]})).shape
        (2,)
        """
        return self._made(mechanism, self.bodies, self.loads, self.motor, self.friction)

    @classmethod
    def from_table(
        cls,
        phi: npt.ArrayLike,
        moment: npt.ArrayLike,
        inertia: npt.ArrayLike = 0.0,
        *,
        motor: Motor | None = None,
        spline: Spline = "not-a-knot",
        periodic: bool = True,
    ) -> Self:
        """Return a machine given only by its reduced moment and inertia.

        Parameters
        ----------
        phi : array_like
            Coordinates of the driver, rad, ascending, both ends of the period included: (K,). One
            given twice is a jump of the moment.
        moment : array_like
            Reduced moment of the loads there, N·m: (K,).
        inertia : array_like
            Reduced inertia there, kg·m²: (K,), or one number; not negative. Where it is 0, a rotor
            or flywheel must add some.
        motor : ConstantTorque, LinearMotor, InductionMotor or Table, optional
            Motor of the driver.
        spline : {"not-a-knot", "pchip", "natural", "clamped", "periodic", "linear"}
            Interpolation between the rows.
        periodic : bool
            Whether the table is one period; otherwise motions end where the table ends.

        Returns
        -------
        Machine
            A machine without a mechanism.

        Examples
        --------
        >>> import assur
        >>> import numpy as np
        >>> phi = np.linspace(0.0, 2 * np.pi, 25)
        >>> machine = assur.Machine.from_table(phi, -10 * np.sin(phi), np.full(25, 2.0))
        >>> machine.run(t_end=3.0, q0=0.1).energy.error < 1e-9
        True
        """
        self = cls.__new__(cls)
        self.mechanism, self.loads, self.motor = None, (), motor
        self.bodies, self.friction = MappingProxyType({}), MappingProxyType({})
        self.driver_count = 1
        self._shape, self.varies = (), ()
        x, columns = components.columns(phi, moment, inertia)
        one_of(spline, SPLINES, "spline")
        periodic = flag(periodic, "periodic")
        warn_if_degrees(float(x[-1] - x[0]), periodic)
        table = x, columns["moment"], columns["inertia"]
        options: dict[str, Any] = {"motor": motor, "spline": spline, "periodic": periodic}
        self._rebuild_with = partial(cls.from_table, **options), table
        motors = components.motors(motor, 1)
        self.core = _core.Machine.from_table(
            x, columns["moment"], columns["inertia"], spline, periodic, *motors
        )
        check_functions((), motors, [float(x[0])])
        return self

    def save(self, path: str | PathLike[str]) -> None:
        """Write the machine with its mechanism to a TOML file.

        Parameters
        ----------
        path : path-like
            The file; one that exists is replaced. docs/reference/files.md describes the format.

        Raises
        ------
        InputError
            A load or motor that is a function, a machine of a table, a file that cannot be written
            (`assur.files.FileError`).

        See Also
        --------
        assur.load : returns the machine, to the last bit.

        Examples
        --------
        >>> import assur, pathlib, tempfile
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "press.toml"
        >>> press = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=20.0)}
        ... )
        >>> press.save(path)
        >>> assur.load(path)
        <assur.Machine I(crank) → II(rod, piston), 1 body, 0 loads>
        """
        save(self, path)

    def explore(self, *, height: int = 640) -> Explorer:
        """Show the studio's view in a notebook: play, drag and change it there.

        Both ways: changes there reach ``view.machine``, assigning ``view.machine`` redraws.
        Needs anywidget: extra ``notebook``.

        Parameters
        ----------
        height : int
            Height of the cell, px.

        Returns
        -------
        Explorer
            The widget: a notebook shows it if it is the last line of a cell.

        Raises
        ------
        InputError
            A machine of a batch or of functions, or anywidget is not installed.

        Examples
        --------
        >>> import assur
        >>> press = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=20.0)}
        ... )
        >>> press.explore().machine
        <assur.Machine I(crank) → II(rod, piston), 1 body, 0 loads>
        """
        return explorer(self, height)

    def __setattr__(self, name: str, value: object) -> None:
        # The core has copied everything: a change here would have no effect.
        if "core" in self.__dict__:
            message = f"Machine is immutable ({name!r}): make another one"
            raise AttributeError(message)
        super().__setattr__(name, value)

    def __delattr__(self, name: str) -> None:
        message = f"Machine is immutable ({name!r}): make another one"
        raise AttributeError(message)

    def __reduce__(self) -> tuple[Any, ...]:
        return self._rebuild_with

    def _key(self) -> tuple[Any, ...]:
        """All that the machine was made of."""
        if self.mechanism is None:
            rebuild, table = self._rebuild_with
            return tuple(map(key_of, (*table, *rebuild.keywords.values())))
        pairs = (frozenset(of.items()) for of in (self.bodies, self.friction))
        return self.mechanism, self.loads, self.motor, *pairs

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, MachineModel) or type(other) is not type(self):
            return NotImplemented
        return self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def __repr__(self) -> str:
        if self.mechanism is None:
            return "<assur.Machine of a table>"
        formula = shortened(self.mechanism.structure.formula, FORMULA - 12)
        bodies = "1 body" if len(self.bodies) == 1 else f"{len(self.bodies)} bodies"
        loads = counted(len(self.loads), "load")
        rubs = f", friction in {counted(len(self.friction), 'pair')}" if self.friction else ""
        return f"<assur.Machine {formula}, {bodies}, {loads}{rubs}>"

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the batch; () for one machine.

        It is that of the designs and of the arrays in bodies, loads and motors, which go together
        by NumPy's rules.
        """
        return self._shape

    def design(self, index: int | tuple[int, ...]) -> Self:
        """Return one design of a batch as a single machine.

        Parameters
        ----------
        index : int or tuple of int
            Index into `shape`.

        Returns
        -------
        Machine
            A new one.

        Examples
        --------
        >>> import assur
        >>> press = assur.SliderCrank(0.1, [0.3, 0.5])
        >>> machine = assur.Machine(press, bodies={"piston": assur.Body(mass=20.0)})
        >>> machine.design(1).mechanism.dimensions["rod.length"]
        0.5
        """
        if self.mechanism is None:
            message = "this machine is a single table, not a batch"
            raise InputError(message)
        if not self.varies:
            return self.of(self.mechanism.design(index))
        entry = checked_index(index, self.shape, "design")
        bodies, loads, motors = self._parts.at(entry, self.shape)
        mechanism = self.mechanism
        if mechanism.shape:
            mechanism = mechanism.design(design_index(mechanism.shape, self.shape, entry))
        return self._made(mechanism, bodies, loads, motors, self.friction)
