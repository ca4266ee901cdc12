"""The equations of motion of the five-bar of `stepping` in CasADi, compiled by the C compiler."""

from __future__ import annotations

import subprocess
import tempfile
from pathlib import Path
from typing import Any

import casadi
import numpy as np

from rivals.stepping import BODY, FIVE, GRAVITY

FLAGS = ("-O3", "-march=native", "-ffast-math", "-shared", "-fPIC")


def symbols() -> Any:
    """Function of (q, speed): mass matrix, its derivatives, bias, gravity, Jacobian of P."""
    ground, r, t, rod, other = FIVE
    mass, inertia, (along, across) = BODY
    q, v = casadi.SX.sym("q", 2), casadi.SX.sym("v", 2)
    b = r * casadi.vertcat(casadi.cos(q[0]), casadi.sin(q[0]))
    d = casadi.vertcat(ground + t * casadi.cos(q[1]), t * casadi.sin(q[1]))
    k = d - b
    d2 = casadi.dot(k, k)
    x = (d2 + (rod - other) * (rod + other)) / (2 * d2)
    y = casadi.sqrt((d2 - (rod - other) ** 2) * ((rod + other) ** 2 - d2)) / (2 * d2)
    u = casadi.vertcat(k[0] * x - k[1] * y, k[1] * x + k[0] * y)
    w = u - k
    angles = [q[0], casadi.atan2(u[1], u[0]), casadi.atan2(w[1], w[0]), q[1]]
    origins = [casadi.SX(2, 1), b, d, casadi.vertcat(ground, 0)]
    matrix, bias, gravity = casadi.SX(2, 2), casadi.SX(2, 1), casadi.SX(2, 1)
    for angle, origin in zip(angles, origins, strict=True):
        cos, sin = casadi.cos(angle), casadi.sin(angle)
        centre = origin + casadi.vertcat(along * cos - across * sin, along * sin + across * cos)
        place, turn = casadi.jacobian(centre, q), casadi.jacobian(angle, q)
        matrix += mass * place.T @ place + inertia * turn.T @ turn
        accelerated = casadi.jtimes(place @ v, q, v), casadi.jtimes(turn @ v, q, v)
        bias += mass * place.T @ accelerated[0] + inertia * turn.T @ accelerated[1]
        gravity += mass * GRAVITY * place.T @ casadi.vertcat(0, 1)
    rates = casadi.jacobian(casadi.vec(matrix), q)
    of_point = casadi.jacobian(b + u, q)
    return casadi.Function("five", [q, v], [matrix, rates, bias + gravity, gravity, of_point])


def compiled() -> Any:
    """The same function in machine code."""
    folder = Path(tempfile.mkdtemp())
    generator = casadi.CodeGenerator("five.c")
    generator.add(symbols())
    generator.generate(f"{folder}/")
    library = folder / "five.so"
    subprocess.run(["cc", *FLAGS, str(folder / "five.c"), "-o", str(library), "-lm"], check=True)
    return casadi.external("five", str(library))


class Buffered:
    """Its call on memory that is set once, without a conversion of arrays."""

    def __init__(self, function: Any) -> None:
        self._buffer, self._call = function.buffer()
        self.q, self.speed = np.zeros(2), np.zeros(2)
        shapes = [(2, 2), (2, 4), 2, 2, (2, 2)]
        self.results = [np.zeros(shape) for shape in shapes]
        for index, given in enumerate((self.q, self.speed)):
            self._buffer.set_arg(index, memoryview(given))
        for index, result in enumerate(self.results):
            self._buffer.set_res(index, memoryview(result))

    def __call__(self, q: Any, speed: Any) -> list[Any]:
        """Mass matrix, its derivatives, bias, gravity, Jacobian: by columns, as CasADi has them."""
        self.q[:], self.speed[:] = q, speed
        self._call()
        return self.results
