"""The oracle's equations: bodies, and the residuals of their pairs and drivers.

Every moving link is a body (x, y, theta): the place of its first joint and its rotation from the
drawing.  Every pair and driver is a residual in these coordinates, read as a truncated power
series.  Lengths are divided by a power of two, which changes no digit.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import mpmath  # type: ignore[import-untyped]
import numpy as np

from models.mechanisms.mechanism_data import GROUND

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from models.mechanisms.mechanism_data import Description

MP = mpmath.MPContext()  # a context of our own: no other test can change its precision
MP.dps = 50

Real = Any  # an mpf of MP, or a float in `follow`
Vec = tuple[Real, Real]
Pose = dict[str, tuple[float, float, float]]  # link -> x, y, rotation from the drawing


@dataclass(frozen=True)
class _Turn:
    """theta_a - theta_b + shift = q (q None: 0)."""

    a: int
    b: int
    shift: Real
    q: int | None


@dataclass(frozen=True)
class _Reach:
    """Along direction d of body b: point u of body a is q away from point w of b (q None: 0)."""

    a: int
    u: Vec
    b: int
    w: Vec
    d: Vec
    q: int | None


class System:
    """A compiled description; body 0 is the ground.  `exact` False computes in float64."""

    def __init__(self, description: Description, exact: bool = True) -> None:
        self.description = description
        self.number: Any = MP.mpf if exact else float
        self.names = [GROUND, *(n for n in description.links if n != GROUND)]
        self.index = {n: i for i, n in enumerate(self.names)}
        self.joint_lists = [description.links.get(n, []) for n in self.names]
        places = list(description.joints.values())
        span = max((max(c) - min(c) for c in zip(*places, strict=True)), default=0.0)
        self.size = 2.0 ** round(math.log2(span)) if span > 0 else 1.0
        mp_size = MP.mpf(self.size)
        self._drawn = {
            n: (MP.mpf(x) / mp_size, MP.mpf(y) / mp_size)
            for n, (x, y) in description.joints.items()
        }
        self._ray = {n: MP.cos_sin(MP.mpf(s.angle)) for n, s in description.slides.items()}
        self._place = [self._reference(i) for i in range(len(self.names))]
        zero = (MP.mpf(0), MP.mpf(0))
        self._origin = [zero if i == 0 else p for i, p in enumerate(self._place)]
        self.angle0 = [self.number(self._drawing_angle(n)) for n in self.names]
        self._compile()
        n = 4  # orders 0 to 3
        self.series = [[[self.number(0)] * n for _ in range(5)] for _ in self.names]
        self.series[0][3][0] = self.number(1)  # the ground's cosine

    # -- from the drawing ---------------------------------------------------------------------

    def _reference(self, body: int) -> Vec:
        """First joint; without joints where the two guides closest to perpendicular intersect."""
        name = self.names[body]
        if self.joint_lists[body]:
            return self._drawn[self.joint_lists[body][0]]
        lines: list[tuple[Vec, Vec]] = []
        for slide_name, slide in self.description.slides.items():
            through: str | None = None
            if slide.link == name:
                through = slide.origin
                if through is None and body != 0:
                    raise ValueError(f"slide {slide_name}: a link without joints needs an origin")
            elif slide.on == name and self.description.links[slide.link]:
                through = self.description.links[slide.link][0]
            if through is not None:
                lines.append((self._drawn[through], self._ray[slide_name]))
        place = lines[0][0] if lines else (MP.mpf(0), MP.mpf(0))
        best = 1e-12
        for (p, d), (r, e) in itertools.combinations(lines, 2):
            cross = d[0] * e[1] - d[1] * e[0]
            if abs(cross) > 1.01 * best:  # of equals the first
                t = ((r[0] - p[0]) * e[1] - (r[1] - p[1]) * e[0]) / cross
                best, place = float(abs(cross)), (p[0] + t * d[0], p[1] + t * d[1])
        return place

    def _drawing_angle(self, name: str) -> Real:
        joints = self.description.links.get(name, [])
        if name == GROUND:
            return MP.mpf(0)
        if len(joints) >= 2:
            (ax, ay), (bx, by) = self._drawn[joints[0]], self._drawn[joints[1]]
            return MP.atan2(by - ay, bx - ax)
        for slide_name, slide in self.description.slides.items():
            if name in (slide.link, slide.on):
                c, s = self._ray[slide_name]
                return MP.atan2(s, c)
        return MP.mpf(0)

    def _local(self, body: int, p: Vec) -> Vec:
        o = self._origin[body]
        return self.number(p[0] - o[0]), self.number(p[1] - o[1])

    def _compile(self) -> None:
        self.pins: list[tuple[int, Vec, int, Vec]] = []
        self.turns: list[_Turn] = []
        self.reaches: list[_Reach] = []
        self.values: dict[str, _Reach] = {}
        self.points: dict[str, tuple[int, Vec]] = {}
        for joint, place in self._drawn.items():
            on = [i for i, joints in enumerate(self.joint_lists) if joint in joints]
            first, *rest = ((i, self._local(i, place)) for i in on)
            self.points[joint] = first
            self.pins += [(*first, *other) for other in rest]
        for name, slide in self.description.slides.items():
            a, b = self.index[slide.link], self.index[slide.on]
            place = self._place[a]
            base = place if slide.origin is None else self._drawn[slide.origin]
            c, s = self._ray[name]
            ray, normal = (self.number(c), self.number(s)), (self.number(-s), self.number(c))
            u, w = self._local(a, place), self._local(b, place)
            self.turns.append(_Turn(a, b, self.number(0), None))
            self.reaches.append(_Reach(a, u, b, w, normal, None))
            self.values[name] = _Reach(a, u, b, self._local(b, base), ray, None)
        self.guides = list(self.reaches)  # without drivers, for `guess_from_joints`
        self.unit: list[Real] = []  # of each driver
        for k, (kind, name, *other) in enumerate(self.description.drivers):
            if kind == "angle":
                a, b = self.index[name], self.index[other[0] if other else GROUND]
                self.turns.append(_Turn(a, b, self.angle0[a] - self.angle0[b], k))
                self.unit.append(self.number(1))
            else:
                v = self.values[name]
                self.reaches.append(_Reach(v.a, v.u, v.b, v.w, v.d, k))
                self.unit.append(self.number(self.size))

    def drawing(self) -> tuple[list[Real], list[Real]]:
        """Coordinates of the bodies and of the drivers (scaled) at the drawing."""
        z = [self.number(v) for p in self._place[1:] for v in (*p, 0)]
        self.put(0, z)
        here = self.residual(0, [self.number(0)] * len(self.unit))
        return z, [here[row] for row in self._driver_rows()]

    def _driver_rows(self) -> list[int]:
        base = 2 * len(self.pins)
        keyed = [t.q for t in self.turns] + [r.q for r in self.reaches]
        return [base + keyed.index(k) for k in range(len(self.unit))]

    # -- residuals, order by order ------------------------------------------------------------

    def put(self, k: int, z: Sequence[Real]) -> None:
        """Set the coefficients of order k; cosine and sine follow (c' = -s t', s' = c t')."""
        for b, (xs, ys, ts, cs, ss) in enumerate(self.series[1:]):
            xs[k], ys[k], ts[k] = z[3 * b : 3 * b + 3]
            if k:
                cs[k] = -sum(j * ts[j] * ss[k - j] for j in range(1, k + 1)) / k
                ss[k] = sum(j * ts[j] * cs[k - j] for j in range(1, k + 1)) / k
            elif self.number is float:
                cs[0], ss[0] = math.cos(ts[0]), math.sin(ts[0])
            else:
                cs[0], ss[0] = MP.cos_sin(ts[0])

    def point(self, body: int, u: Vec, k: int) -> Vec:
        """Coefficient k of a point of a body."""
        x, y, _, c, s = self.series[body]
        return x[k] + c[k] * u[0] - s[k] * u[1], y[k] + s[k] * u[0] + c[k] * u[1]

    def reach(self, r: _Reach, k: int) -> Real:
        """Coefficient k of (R_b d) . (P_a(u) - P_b(w))."""
        total = self.number(0)
        _, _, _, c, s = self.series[r.b]
        for j in range(k + 1 if r.b else 1):  # the ground's direction has order 0 only
            (px, py), (ox, oy) = self.point(r.a, r.u, k - j), self.point(r.b, r.w, k - j)
            total += (c[j] * r.d[0] - s[j] * r.d[1]) * (px - ox)
            total += (s[j] * r.d[0] + c[j] * r.d[1]) * (py - oy)
        return total

    def residual(self, k: int, q: Sequence[Real]) -> list[Real]:
        """Coefficient k of all residuals; q: that of the drivers, scaled."""
        rows: list[Real] = []
        for a, u, b, w in self.pins:
            (px, py), (rx, ry) = self.point(a, u, k), self.point(b, w, k)
            rows += (px - rx, py - ry)
        for t in self.turns:
            value = self.series[t.a][2][k] - self.series[t.b][2][k]
            value = value if k else value + t.shift
            rows.append(value if t.q is None else value - q[t.q])
        for r in self.reaches:
            value = self.reach(r, k)
            rows.append(value if r.q is None else value - q[r.q])
        return rows

    def jacobian(self) -> NDArray[np.float64]:
        """float64 Jacobian of the order 0 residuals, scaled lengths and radians."""
        pose = [[float(v[0]) for v in body] for body in self.series]
        rows = 2 * len(self.pins) + len(self.turns) + len(self.reaches)
        out = np.zeros((rows, 3 * len(pose)))

        def arm(body: int, u: Vec) -> tuple[float, float]:
            _, _, _, c, s = pose[body]
            return c * float(u[0]) - s * float(u[1]), s * float(u[0]) + c * float(u[1])

        row = 0
        for a, u, b, w in self.pins:
            for body, local, sign in ((a, u, 1.0), (b, w, -1.0)):
                x, y = arm(body, local)
                out[row, [3 * body, 3 * body + 2]] = sign, -sign * y
                out[row + 1, [3 * body + 1, 3 * body + 2]] = sign, sign * x
            row += 2
        for t in self.turns:
            out[row, 3 * t.a + 2], out[row, 3 * t.b + 2] = 1.0, -1.0
            row += 1
        for r in self.reaches:
            (dx, dy), (px, py), i, j = arm(r.b, r.d), arm(r.a, r.u), 3 * r.a, 3 * r.b
            out[row, i : i + 3] = dx, dy, dy * px - dx * py
            # turning b turns d about b's own first joint: only a's place relative to it counts
            gx, gy = pose[r.a][0] + px - pose[r.b][0], pose[r.a][1] + py - pose[r.b][1]
            out[row, j : j + 3] = -dx, -dy, dx * gy - dy * gx
            row += 1
        return out[:, 3:]

    def pose(self) -> Pose:
        """Order 0, unscaled."""
        out: Pose = {}
        for name, (x, y, t, _, _) in zip(self.names[1:], self.series[1:], strict=True):
            out[name] = (float(x[0]) * self.size, float(y[0]) * self.size, float(t[0]))
        return out


def inverted(jacobian: NDArray[np.float64]) -> NDArray[np.float64]:
    rows, columns = jacobian.shape
    if rows < columns:
        raise ValueError(f"{rows} equations for {columns} coordinates: not driven enough")
    # redundant but consistent rows (a third bar): least squares
    inverse = np.linalg.inv if rows == columns else np.linalg.pinv
    return np.asarray(inverse(jacobian), np.float64)


def as_tuple(q: Any) -> tuple[Any, ...]:
    return tuple(q) if np.ndim(q) else (q,)
