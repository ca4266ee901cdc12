"""What a file holds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, overload

from assur._arrays import real_number, short
from assur._summary import summary
from assur._validate import one_of
from assur.dynamics.machine import Machine
from assur.errors import InputError
from assur.files.node import Node
from assur.files.read_machine import SECTIONS, read_machine
from assur.files.read_mechanism import read_input_speed, read_mechanism
from assur.files.source import Source
from assur.files.wanted import WANTED, read_wanted
from assur.kinematics.mechanism import Mechanism
from assur.kinematics.solve_arguments import in_radians

if TYPE_CHECKING:
    from os import PathLike

    from assur.dynamics.forces.reactions import Reactions
    from assur.dynamics.motion.run import Run
    from assur.dynamics.motion.steady import SteadyState
    from assur.files.read_mechanism import InputSpeed
    from assur.files.tree import Tree
    from assur.files.wanted import Result
    from assur.flywheel import Flywheel
    from assur.kinematics.motion import Motion

    # What the methods give that a file may ask for.
    Wanted: TypeAlias = Motion | Reactions | Run | SteadyState | Flywheel

__all__ = ["Contents", "load", "read"]

FORMAT = 1
KEYS = (
    *("format", "driver", "input_speed", "joints", "links", "slides"),
    *("assembly", "dimensions", "drawn"),
    *SECTIONS,
    *WANTED,
)


@dataclass(frozen=True)
class Contents:
    """What a file holds.

    Attributes
    ----------
    mechanism : Mechanism
        The mechanism, or a batch of designs.
    machine : Machine or None
        The machine, if the file has bodies, loads, a motor or friction.
    wanted : mapping of str to mapping
        Results that the file asks for, by the name of the method (``"solve"``, ``"reactions"``,
        ``"run"``, ``"steady_state"``, ``"flywheel"``): its arguments.
    input_speed : float or tuple of float or None
        The driver's speed, counter-clockwise in rad/s, or m/s for a slide; one each for several
        drivers. No result depends on it: the studio plays at this speed.

    Examples
    --------
    >>> import assur
    >>> engine = assur.SliderCrank(0.05, 0.2)
    >>> contents = assur.files.Contents(engine, wanted={"solve": {"q": [0.0, 1.0], "order": 0}})
    >>> contents.result("solve").slide("bore").value.round(6)                # m
    array([0.25   , 0.22254])
    """

    __repr__ = summary

    mechanism: Mechanism
    machine: Machine | None = None
    wanted: Mapping[str, Mapping[str, Any]] = field(default_factory=lambda: MappingProxyType({}))
    input_speed: InputSpeed = None
    _nodes: Mapping[str, Node] = field(
        default_factory=lambda: MappingProxyType({}), repr=False, compare=False
    )

    def __post_init__(self) -> None:
        mechanism, machine, wanted = (getattr(self, n) for n in ("mechanism", "machine", "wanted"))
        if not isinstance(mechanism, Mechanism):
            message = f"mechanism is {short(mechanism)}: an assur.Mechanism is needed"
            raise InputError(message)
        if not isinstance(machine, Machine | None):
            message = f"machine is {short(machine)}: an assur.Machine is needed"
            raise InputError(message)
        if not isinstance(wanted, Mapping) or not all(
            isinstance(arguments, Mapping) for arguments in wanted.values()
        ):
            message = f"wanted is {short(wanted)}: arguments by the name of the method are needed"
            raise InputError(message)
        if self.machine is not None and self.machine.mechanism != self.mechanism:
            message = "mechanism is not that of the machine"
            raise InputError(message)
        if self.input_speed is not None:
            object.__setattr__(self, "input_speed", _checked_speed(self.input_speed, mechanism))
        for name in self.wanted:
            one_of(name, tuple(WANTED), "wanted")
            if name != "solve" and self.machine is None:
                message = f"wanted: {name!r} needs a machine"
                raise InputError(message)

    @overload
    def result(self, name: Literal["solve"]) -> Motion: ...
    @overload
    def result(self, name: Literal["reactions"]) -> Reactions: ...
    @overload
    def result(self, name: Literal["run"]) -> Run: ...
    @overload
    def result(self, name: Literal["steady_state"]) -> SteadyState: ...
    @overload
    def result(self, name: Literal["flywheel"]) -> Flywheel: ...
    @overload
    def result(self, name: str) -> Wanted: ...
    def result(self, name: str) -> Wanted:
        """Return a result that the file asks for.

        Parameters
        ----------
        name : str
            The name of the method, one of `wanted`.

        Returns
        -------
        Motion, Reactions, Run, SteadyState or Flywheel
            What the method returns.

        Raises
        ------
        FileError
            Arguments that the method refuses, at their section.
        PositionError, MotionError
            As raised by the method.
        InputError
            A result that the file does not ask for.

        Examples
        --------
        >>> import assur
        >>> wanted = {"solve": {"deg": 0}}
        >>> contents = assur.files.Contents(assur.SliderCrank(1.0, 3.0), wanted=wanted)
        >>> float(contents.result("solve").slide("bore").value)              # m
        4.0
        """
        asked: object = name
        if not isinstance(asked, str) or asked not in self.wanted:
            known = ", ".join(self.wanted) or "none"
            message = f"the file does not ask for {short(name)}; it asks for: {known}"
            raise InputError(message)
        arguments = dict(self.wanted[name])
        if name not in self._nodes:
            return self._called(name, arguments)
        with self._nodes[name].refusing():
            return self._called(name, arguments)

    def _called(self, name: str, arguments: dict[str, Any]) -> Wanted:
        if "deg" in arguments and name != "solve":
            arguments["q"] = in_radians(self.mechanism, None, arguments.pop("deg"))
        method = getattr(self.mechanism if name == "solve" else self.machine, name)
        found: Wanted = method(**arguments)
        return found


def read(path: str | PathLike[str]) -> Contents:
    """Return all that a file holds: mechanism, machine, and the results that it asks for.

    Parameters
    ----------
    path : path-like
        A TOML file (docs/reference/files.md).

    Returns
    -------
    Contents
        The mechanism, the machine if there is one, and the requested results.

    Raises
    ------
    FileError
        A file that cannot be read, is not TOML, or does not describe a mechanism: with line,
        column and key.

    Examples
    --------
    >>> import assur, pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "engine.toml")
    ...     assur.SliderCrank(0.05, 0.2).save(path)
    ...     contents = assur.files.read(path)
    >>> contents.mechanism, contents.machine, dict(contents.wanted)
    (<assur.Mechanism I(crank) → II(rod, piston)>, None, {})
    """
    return contents_of(Source(path))


def contents_of(source: Tree) -> Contents:
    """Return what a file that has been read and parsed holds, or a tree of the same words."""
    root = Node(source, (), source.data)
    if "format" not in source.data:
        raise root.missing("format", f": write format = {FORMAT} in the first line")
    entries = root.keys(KEYS)
    if entries["format"].whole() != FORMAT:
        message = f"is {entries['format'].value}: this version of assur reads format {FORMAT}"
        raise entries["format"].error(message)
    mechanism = read_mechanism(root)
    machine = read_machine(root, mechanism)
    results: Mapping[str, Result] = read_wanted(root, mechanism, machine is not None)
    return Contents(
        mechanism,
        machine,
        MappingProxyType({name: result.arguments for name, result in results.items()}),
        read_input_speed(root, mechanism),
        MappingProxyType({name: result.node for name, result in results.items()}),
    )


def known_speed(input_speed: Any) -> InputSpeed:
    """Return the speed that an importer found, or None if it is not that of all drivers."""
    several = isinstance(input_speed, tuple)
    return None if several and None in input_speed else input_speed


def _checked_speed(speed: Any, mechanism: Mechanism) -> InputSpeed:
    count = mechanism.driver_count
    if count == 1:
        return real_number(speed, "input_speed")
    if not isinstance(speed, list | tuple) or len(speed) != count:
        message = (
            f"input_speed is {short(speed)}: a number for each of the {count} drivers is needed"
        )
        raise InputError(message)
    return tuple(real_number(number, "input_speed") for number in speed)


def load(path: str | PathLike[str]) -> Mechanism | Machine:
    """Return the mechanism in a file, or its machine if it has one.

    Parameters
    ----------
    path : path-like
        A TOML file (docs/reference/files.md), such as `Mechanism.save` and `Machine.save` write.

    Returns
    -------
    Mechanism or Machine
        The machine if the file has bodies, loads, a motor or friction; its ``.mechanism`` is the
        mechanism. Everything has the same bits as what was saved.

    Raises
    ------
    FileError
        A file that cannot be read, is not TOML, or does not describe a mechanism: with line,
        column and key. It is an `InputError`.

    See Also
    --------
    assur.files.read : mechanism, machine, and the results that a file asks for.

    Examples
    --------
    >>> import assur, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "engine.toml"
    >>> engine = assur.SliderCrank(crank=0.05, rod=0.2)
    >>> engine.save(path)
    >>> assur.load(path) == engine
    True
    """
    contents = read(path)
    return contents.mechanism if contents.machine is None else contents.machine
