"""Mechanisms and machines as functions of JAX: under ``jit``, ``vmap``, ``jvp`` and ``grad``.

Each calls the core, once for a whole batch, and takes its first derivatives from there; second ones
do not exist. JAX computes in single precision unless ``jax.config.update("jax_enable_x64", True)``
is called first: then results are those of the package to the last bit, else they are rounded.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._validate import checked_name, whole_number
from assur.errors import InputError
from assur.kinematics.derivatives.jacobian import named_dimensions, require_once

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from jax import Array
    from jax.typing import ArrayLike

    from assur._arrays import Float
    from assur.dynamics.machine import Machine
    from assur.kinematics.mechanism import Mechanism

__all__ = ["acceleration", "place", "step"]

# The derivative by the drivers needs one order more, of three.
HIGHEST = 2


def place(
    mechanism: Mechanism, name: str, *, by: str | Sequence[str] = "*", order: int = 0
) -> Callable[[ArrayLike, ArrayLike], Array]:
    """Return a function of dimensions and coordinates: where a joint, link or slide is.

    Parameters
    ----------
    mechanism : Mechanism
        One design, in the assembly that is meant.
    name : str
        A joint, link or slide.
    by : str or sequence of str
        The dimensions that are the function's first argument, also as patterns; the others stay as
        they are. All by default, in the order of ``mechanism.dimensions``.
    order : {0, 1, 2}
        Its analogue of this order in place of the value.

    Returns
    -------
    callable
        ``f(x, q)`` of the dimensions' values x, (D,), and coordinates q, () or (N,), with n drivers
        (n,) or (N, n): the place (2,) or (N, 2); the angle or value () or (N,). NaN where it does
        not exist.

    Raises
    ------
    InputError
        Names that do not exist; a batch of designs: use ``jax.vmap`` over x. JAX is not installed.

    Notes
    -----
    Over q alone, in an array or by ``jax.vmap``, it stays one design; ``jax.vmap`` over x makes a
    batch of designs. A dimension that no design can have gives NaN.

    Examples
    --------
    >>> import assur, jax
    >>> jax.config.update("jax_enable_x64", True)
    >>> m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
    >>> rocker = assur.adapters.jax.place(m, "rocker", by=["coupler.length"])
    >>> x = jax.numpy.array([3.0])
    >>> jax.jit(jax.grad(rocker))(x, 0.5).round(4), jax.grad(rocker, argnums=1)(x, 0.5).round(4)
    (Array([-0.5609], dtype=float64), Array(-0.1323, dtype=float64))
    """
    _require_one(mechanism.shape, "place")
    order = whole_number(order, "order", 0, HIGHEST)
    name, n = checked_name(name, "place"), mechanism.driver_count
    known = mechanism.core.dimension_names
    names = [known[index] for index in named_dimensions(mechanism, by)]
    require_once(names)
    kind = "joint" if name in mechanism.joints else "slide" if name in mechanism.slides else "link"
    mechanism.core.index_of(kind, name)
    components = (2,) if kind == "joint" else ()
    tail: tuple[int, ...] = (*components, *((n,) * order if n > 1 else ()))

    def motion(x: Float, q: Float, highest: int) -> Any:
        """Solve for a batch: one design at all q, or a design for each."""
        if math.prod(x.shape[:-1]) == 1:
            # A batch of one: a dimension that no design can have gives NaN there, too.
            design = mechanism.with_dimensions(dict(zip(names, x.reshape(1, -1).T, strict=True)))
            places: Float = q.reshape(-1, n)
        else:
            ahead = np.broadcast_shapes(x.shape[:-1], q.shape[:-1])
            columns = np.broadcast_to(x, (*ahead, len(names))).reshape(-1, len(names)).T
            design = mechanism.with_dimensions(dict(zip(names, columns, strict=True)))
            places = np.broadcast_to(q, (*ahead, n)).reshape(-1, 1, n)
        places = places[..., 0] if n == 1 else places
        return design.solve(places, order=highest, outputs=[name], on_error="nan")

    def values(x: Float, q: Float) -> list[Float]:
        return [getattr(motion(x, q, order), kind)(name).arrays[order]]

    def slopes(x: Float, q: Float) -> list[Float]:
        found = motion(x, q, order + 1)
        value = getattr(found, kind)(name).arrays[order]
        by_q = found.jacobian(name, by="q", order=order)
        return [value, found.jacobian(name, by=names, order=order), by_q]

    jnp = _jax().numpy
    function = _exact(_Core(values, slopes, (len(names), n), (tail,)))

    def of_arrays(x: ArrayLike, q: ArrayLike) -> Array:
        lengths = jnp.asarray(x)
        if lengths.shape != (len(names),):
            message = f"x has the shape {lengths.shape}: {len(names)} dimensions are needed"
            raise InputError(message)
        found: tuple[Array] = _over(function, (lengths, _drivers(jnp.asarray(q), n)), (False, True))
        return found[0]

    return of_arrays


def acceleration(machine: Machine) -> Callable[[ArrayLike, ArrayLike, ArrayLike], Array]:
    """Return a function of states and efforts: the accelerations of the drivers.

    Parameters
    ----------
    machine : Machine
        One design, without friction and functions of Python.

    Returns
    -------
    callable
        ``f(q, speed, effort)`` of numbers or arrays (N,), with n drivers (n,) or (N, n), which
        broadcast: rad/s² or m/s², of the same shape. NaN where there is none.

    Raises
    ------
    InputError
        As in `Machine.d_acceleration`.

    Examples
    --------
    >>> import assur, jax
    >>> jax.config.update("jax_enable_x64", True)
    >>> machine = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=20.0)}
    ... )
    >>> f = assur.adapters.jax.acceleration(machine)
    >>> f(0.5, 10.0, 4.0).round(3), jax.grad(f)(0.5, 10.0, 4.0).round(3)
    (Array(-115.277, dtype=float64), Array(251.221, dtype=float64))
    """
    n = _require_equations(machine, "acceleration")

    def values(q: Float, speed: Float, effort: Float) -> list[Float]:
        state = [_given(each, n) for each in (q, speed, effort)]
        return [machine.acceleration(*state, on_error="nan")]

    def slopes(q: Float, speed: Float, effort: Float) -> list[Float]:
        state = [_given(each, n) for each in (q, speed, effort)]
        every = machine.d_acceleration(*state, by=["q", "speed", "effort"], on_error="nan")
        every = every.reshape(-1, n, 3 * n)
        parts = np.split(every, 3, axis=-1)
        return [machine.acceleration(*state, on_error="nan"), *parts]

    function = _exact(_Core(values, slopes, (n, n, n), ((n,),)))

    def of_arrays(q: ArrayLike, speed: ArrayLike, effort: ArrayLike) -> Array:
        found: list[Array] = _over_states(function, (q, speed, effort), n)
        return found[0]

    return of_arrays


def step(
    machine: Machine, dt: float, n: int = 1
) -> Callable[[ArrayLike, ArrayLike, ArrayLike], tuple[Array, Array]]:
    """Return a function of states and efforts: the states some steps later.

    Parameters
    ----------
    machine : Machine
        One design, without friction and functions of Python.
    dt : float
        Time of a step, s.
    n : int
        Number of steps.

    Returns
    -------
    callable
        ``f(q, speed, effort)`` of numbers or arrays (N,), with n drivers (n,) or (N, n), which
        broadcast: ``(q, speed)`` as from `Machine.step`. NaN where there is none.

    Raises
    ------
    InputError
        As in `Machine.linearize`.

    Examples
    --------
    How far the crank is after a tenth of a second, and what a torque adds to that:

    >>> import assur, jax
    >>> jax.config.update("jax_enable_x64", True)
    >>> machine = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4), bodies={"crank": assur.Body(inertia=0.5)}
    ... )
    >>> f = assur.adapters.jax.step(machine, 0.01, n=10)
    >>> q, by_effort = jax.value_and_grad(lambda *at: f(*at)[0], argnums=2)(0.0, 2.0, 1.0)
    >>> q.round(6), by_effort.round(6)  # rad, rad/(N·m)
    (Array(0.21, dtype=float64), Array(0.01, dtype=float64))
    """
    drivers = _require_equations(machine, "step")
    steps = whole_number(n, "n", 1, 10**6)
    machine.step(machine.mechanism.q0, 1.0, 0.0, dt)  # type: ignore[union-attr]

    def values(q: Float, speed: Float, effort: Float) -> list[Float]:
        state = [_given(each, drivers) for each in (q, speed, effort)]
        after = machine.step(state[0], state[1], state[2], dt, steps)
        return [np.asarray(after.q), np.asarray(after.speed)]

    def slopes(q: Float, speed: Float, effort: Float) -> list[Float]:
        state = [_given(each, drivers) for each in (q, speed, effort)]
        beside = machine.linearize(*state, dt=dt, n=steps, on_error="nan")
        every = np.concatenate([beside.A, beside.B], axis=-1)
        of_q, of_speed = every[..., :drivers, :], every[..., drivers:, :]
        parts = (*np.split(of_q, 3, axis=-1), *np.split(of_speed, 3, axis=-1))
        return [*values(q, speed, effort), *parts]

    function = _exact(_Core(values, slopes, (drivers,) * 3, ((drivers,),) * 2))

    def of_arrays(q: ArrayLike, speed: ArrayLike, effort: ArrayLike) -> tuple[Array, Array]:
        after_q, after_speed = _over_states(function, (q, speed, effort), drivers)
        return after_q, after_speed

    return of_arrays


class _Core(NamedTuple):
    """A function of NumPy's arrays, vectors in rows: its values, and with them its derivatives."""

    values: Callable[..., list[Float]]
    # The values, then for each of them its derivatives by each argument.
    slopes: Callable[..., list[Float]]
    # Lengths of the arguments, and shapes of the values, of one row.
    widths: tuple[int, ...]
    tails: tuple[tuple[int, ...], ...]


def _exact(core: _Core) -> Callable[..., Any]:
    """Return a function of JAX's vectors whose values and derivatives come from the core."""
    jax = _jax()
    jnp = jax.numpy

    def call(function: Callable[..., list[Float]], tails: Any, arguments: Any) -> Any:
        dtype = jnp.result_type(float, *arguments)

        def of_numpy(*given: Any) -> list[Float]:
            rows = [np.asarray(each, np.float64) for each in given]
            ahead = np.broadcast_shapes(*(row.shape[:-1] for row in rows))
            found = function(*rows)
            return [
                np.asarray(
                    np.broadcast_to(
                        values.reshape(_rows(values, tail, ahead) + tail), ahead + tail
                    ),
                    dtype,
                )
                for values, tail in zip(found, tails, strict=True)
            ]

        results = [jax.ShapeDtypeStruct(tail, dtype) for tail in tails]
        # Under vmap an argument that all rows share keeps one row.
        return jax.pure_callback(of_numpy, results, *arguments, vmap_method="expand_dims")

    def evaluate(*arguments: Any) -> Any:
        return tuple(call(core.values, core.tails, arguments))

    def rule(primals: Any, tangents: Any) -> Any:
        by_each = [(*tail, width) for tail in core.tails for width in core.widths]
        found = call(core.slopes, [*core.tails, *by_each], primals)
        count, each = len(core.tails), len(core.widths)
        rates = []
        for k in range(count):
            slopes = found[count + k * each : count + (k + 1) * each]
            rates.append(sum(slope @ rate for slope, rate in zip(slopes, tangents, strict=True)))
        return tuple(found[:count]), tuple(rates)

    function: Callable[..., Any] = jax.custom_jvp(evaluate)
    function.defjvp(rule)  # type: ignore[attr-defined]
    return function


def _jax() -> Any:
    """Return JAX, imported when it is used."""
    try:
        import jax
    except ImportError as error:
        message = "assur.adapters.jax needs JAX: pip install assur[jax]"
        raise InputError(message) from error
    return jax


def _rows(values: Float, tail: tuple[int, ...], ahead: tuple[int, ...]) -> tuple[int, ...]:
    """Return the axes ahead of a row: all of them, or none where one row stands for all."""
    return ahead if values.size == math.prod(ahead) * math.prod(tail) else (1,) * len(ahead)


def _over(function: Callable[..., Any], arguments: tuple[Any, ...], each: tuple[bool, ...]) -> Any:
    """Apply a function of vectors along the axes ahead of those of some arguments."""
    jax = _jax()
    axes = max(argument.ndim for argument in arguments) - 1
    for _ in range(axes):
        function = jax.vmap(function, tuple(0 if one else None for one in each))
    return function(*arguments)


def _over_states(function: Callable[..., Any], states: tuple[Any, ...], n: int) -> Any:
    """Apply a function of vectors of the drivers to states that broadcast."""
    jnp = _jax().numpy
    vectors = [_drivers(jnp.asarray(each), n) for each in states]
    every = jnp.broadcast_arrays(*vectors)
    found = _over(function, tuple(every), (True,) * len(every))
    return [each[..., 0] if n == 1 else each for each in found]


def _drivers(values: Any, n: int) -> Any:
    """Return numbers with an axis of the drivers."""
    if n == 1:
        return values[..., np.newaxis]
    if values.ndim == 0 or values.shape[-1] != n:
        message = f"an argument has the shape {values.shape}: with {n} drivers its last axis is {n}"
        raise InputError(message)
    return values


def _given(rows: Float, n: int) -> Float:
    """Return rows of vectors as the package takes them."""
    return rows[..., 0] if n == 1 else rows


def _require_one(shape: tuple[int, ...], call: str) -> None:
    if shape:
        message = f"{call} is of one design, this is a batch {shape}: use design(i), and jax.vmap"
        raise InputError(message)


def _require_equations(machine: Machine, call: str) -> int:
    """Refuse what has no derivatives; return the number of drivers."""
    _require_one(machine.shape, call)
    q0 = 0.0 if machine.mechanism is None else machine.mechanism.q0
    # Moving: loads with `while_` have no value at rest.
    machine.linearize(q0, 1.0, on_error="nan")
    return machine.driver_count
