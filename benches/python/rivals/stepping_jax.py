"""The steps of `stepping` under jit, all environments at once."""

from __future__ import annotations

from functools import partial
from typing import Any

import jax
import jax.numpy as jnp

from rivals import stepping

jax.config.update("jax_enable_x64", True)


@partial(jax.jit, static_argnums=(0, 4))
def _steps(two: bool, q: Any, speed: Any, dt: float, count: int) -> Any:
    def acceleration(at: Any, rate: Any) -> Any:
        if two:
            return jnp.stack(stepping.five_bar(jnp, at, rate, (0.0, 0.0)))
        return stepping.slider_crank(jnp, at, rate, 0.0)

    def one(_: Any, state: Any) -> Any:
        return stepping.steps(acceleration, *state, dt, 1)

    return jax.lax.fori_loop(0, count, one, (q, speed))


def by_jax(two: bool, q: Any, speed: Any, dt: float, count: int) -> tuple[Any, Any]:
    """Steps without efforts."""
    after_q, after_speed = _steps(two, q, speed, dt, count)
    after_q.block_until_ready()
    return after_q, after_speed
