"""What a user of JAX writes: the closed form of one position, vmap over all, jvp for analogues."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import jax
import jax.numpy as jnp

if TYPE_CHECKING:
    from collections.abc import Callable

jax.config.update("jax_enable_x64", True)


def _diagonal(lengths: Any, q: Any) -> Any:
    """B, and the vectors from it to D and to C, of the open four-bar."""
    a, b, c, g = lengths
    bx, by = a * jnp.cos(q), a * jnp.sin(q)
    kx, ky = g - bx, -by
    d2 = kx * kx + ky * ky
    x = (d2 + (b - c) * (b + c)) / (2.0 * d2)
    y = jnp.sqrt((d2 - (b - c) ** 2) * ((b + c) ** 2 - d2)) / (2.0 * d2)
    return (bx, by), (kx, ky), (kx * x - ky * y, ky * x + kx * y)


def _angles(lengths: Any, q: Any) -> Any:
    _, (kx, ky), (ux, uy) = _diagonal(lengths, q)
    return jnp.stack([jnp.arctan2(uy, ux), jnp.arctan2(uy - ky, ux - kx)])


def _point(lengths: Any, point: Any, q: Any) -> Any:
    (bx, by), _, (ux, uy) = _diagonal(lengths, q)
    px, py = point / lengths[1]
    return jnp.stack([bx + ux * px - uy * py, by + uy * px + ux * py])


def _derivative(function: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """The derivative in one direction, forward."""
    return lambda q: jax.jvp(function, (q,), (1.0,))[1]


def _angles_to_order_2(lengths: Any, q: Any) -> Any:
    """Coupler and rocker angle, each with two analogues."""

    def angles(q: Any) -> Any:
        return _angles(lengths, q)

    first = _derivative(angles)
    return angles(q), first(q), _derivative(first)(q)


four_bar = jax.jit(jax.vmap(jax.vmap(_angles_to_order_2, (None, 0)), (1, None)))
four_bar_point = jax.jit(jax.vmap(jax.vmap(_point, (None, None, 0)), (1, 1, None)))


def run(function: Callable[..., Any], *arguments: Any) -> Any:
    """Call it and wait for the result."""
    return jax.block_until_ready(function(*arguments))
