"""Independent oracle: body coordinates at 50 digits, sharing no code with assur.

Every moving link is a body (x, y, theta): the place of its first joint and its rotation from the
drawing.  Every pair and driver is a residual in these coordinates.  Positions come from Newton
with a float64 inverse and 50-digit residuals, analogues from the same residuals read as truncated
power series in the driver.  Lengths are divided by a power of two, which changes no digit.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import mpmath  # type: ignore[import-untyped]
import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

MP = mpmath.MPContext()  # a context of our own: no other test can change its precision
MP.dps = 50

Real = Any  # an mpf of MP, or a float in `follow`
Vec = tuple[Real, Real]
Pose = dict[str, tuple[float, float, float]]  # link -> x, y, rotation from the drawing
DriverSpec = tuple[str, ...]  # ("angle", link, relative_to) or ("slide", name)

GROUND = "ground"
POSITION_TOL = MP.mpf("1e-40")  # residual, relative to the size of the mechanism
SERIES_TOL = MP.mpf("1e-35")  # last correction, relative to the coefficient
FLOAT_TOL = 1e-13  # residual of `follow`: some hundred roundoffs
LEAST_STEP = 1e-8  # of `follow`, part of the way: below it roundoff hides that the path bends
MAX_ITERATIONS = 80  # each gains a factor of about 1e-16 times the condition


@dataclass(frozen=True)
class SlideSpec:
    """A sliding pair as in assur.Slide: `link` slides along a guide fixed on `on`."""

    link: str
    on: str
    angle: float
    origin: str | None = None


@dataclass(frozen=True)
class Description:
    """A mechanism: the drawing gives dimensions and assembly; "ground" is the frame."""

    joints: dict[str, tuple[float, float]]
    links: dict[str, list[str]]
    slides: dict[str, SlideSpec] = field(default_factory=dict)
    drivers: list[DriverSpec] = field(default_factory=list)


class NoConvergenceError(ArithmeticError):
    """No assembled position was found from the guess."""


class StuckError(ArithmeticError):
    """`follow` met a fold or a change point; `q` and `pose` are the last ones reached."""

    def __init__(self, q: tuple[float, ...], pose: Pose) -> None:
        super().__init__(f"cannot be followed beyond q = {q}")
        self.q, self.pose = q, pose


@dataclass(frozen=True)
class Jet:
    """A value and its partial derivatives: `partials[()]`, `[(0,)]`, `[(0, 1)]`, ... as mp."""

    partials: dict[tuple[int, ...], tuple[Real, ...]]
    drivers: int
    scalar: bool

    def tensor(self, order: int) -> NDArray[np.float64]:
        """float64 array: the component axis (2, for joints only), then one axis a derivative.

        With a single driver the derivative axes are left out.
        """
        size = len(self.partials[()])
        out = np.empty((size, *(self.drivers,) * order))
        for index in np.ndindex(out.shape[1:]):
            out[(slice(None), *index)] = [float(v) for v in self.partials[tuple(sorted(index))]]
        if self.drivers == 1:
            out = out.reshape(size)
        return out[0, ...] if self.scalar else out

    @property
    def value(self) -> NDArray[np.float64]:
        """Order 0."""
        return self.tensor(0)

    @property
    def d1(self) -> NDArray[np.float64]:
        """First analogue(s)."""
        return self.tensor(1)

    @property
    def d2(self) -> NDArray[np.float64]:
        """Second analogue(s)."""
        return self.tensor(2)

    @property
    def d3(self) -> NDArray[np.float64]:
        """Third analogue(s)."""
        return self.tensor(3)


@dataclass(frozen=True)
class Solution:
    """One position; link angles include the drawing's and may be whole turns away."""

    joints: dict[str, Jet]
    links: dict[str, Jet]
    slides: dict[str, Jet]
    pose: Pose
    residual: float  # relative to the size
    condition: float  # 2-norm condition of the scaled body Jacobian


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
        """First joint; without joints where the two guides cross that do so most squarely."""
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


def _inverse(jacobian: NDArray[np.float64]) -> NDArray[np.float64]:
    rows, columns = jacobian.shape
    if rows < columns:
        raise ValueError(f"{rows} equations for {columns} coordinates: not driven enough")
    # redundant but consistent rows (a third bar): least squares
    inverse = np.linalg.inv if rows == columns else np.linalg.pinv
    return np.asarray(inverse(jacobian), np.float64)


def _tuple(q: Any) -> tuple[Any, ...]:
    return tuple(q) if np.ndim(q) else (q,)


def _number(v: Any) -> Any:
    return v.item() if isinstance(v, (np.ndarray, np.generic)) else v  # mpf takes no NumPy scalar


def solve(description: Description, q: Any, guess: Mapping[str, Any], order: int = 3) -> Solution:
    """The position near `guess` (link -> x, y, rotation) at q (one number a driver), with jets.

    q may be float or mpf.  Whole turns between guess and q are ignored (see `angle_gap`).
    """
    system = System(description)
    count = len(system.unit)
    here = [MP.mpf(_number(v)) / u for v, u in zip(_tuple(q), system.unit, strict=True)]
    for turn in system.turns:
        if turn.q is not None:
            a, b = (guess[system.names[i]][2] if i else 0.0 for i in (turn.a, turn.b))
            turns = round(float(here[turn.q] - (turn.shift + a - b)) / math.tau)
            here[turn.q] -= 2 * MP.pi * turns
    scale = (1 / system.size, 1 / system.size, 1.0)
    z = [
        MP.mpf(float(v)) * f for n in system.names[1:] for v, f in zip(guess[n], scale, strict=True)
    ]
    inverse, step, error = np.empty(0), 1.0, MP.inf
    for _ in range(MAX_ITERATIONS):
        system.put(0, z)
        rows = system.residual(0, here)
        error = max((abs(v) for v in rows), default=MP.mpf(0))
        if error <= POSITION_TOL or not error < 1e6:
            break
        if step > 1e-14:  # the pose's last double still changes, so the matrix does
            jacobian = system.jacobian()
            inverse = _inverse(jacobian)
        dz = inverse @ np.array([float(v) for v in rows])
        step = float(np.max(np.abs(dz)))
        z = [v - d for v, d in zip(z, dz.tolist(), strict=True)]
    if not error <= POSITION_TOL:
        raise NoConvergenceError(f"residual {float(error):.3g} at q = {q}")
    jacobian = system.jacobian()
    jets = _jets(system, _inverse(jacobian) if order else inverse, count, order)
    condition = float(np.linalg.cond(jacobian))
    return Solution(*jets, system.pose(), float(error), condition)


def _series(
    system: System, inverse: NDArray[np.float64], along: tuple[int, ...], order: int
) -> dict[tuple[str, str], list[tuple[Real, ...]]]:
    """All outputs along q + t*along: k-th derivative in t at 0, k = 0..order."""
    zero = MP.mpf(0)
    for k in range(1, order + 1):
        v = [MP.mpf(a) / u if k == 1 else zero for a, u in zip(along, system.unit, strict=True)]
        z = [zero] * (3 * len(system.names) - 3)
        for _ in range(MAX_ITERATIONS):  # affine in z: iterative refinement
            system.put(k, z)
            dz = (inverse @ np.array([float(r) for r in system.residual(k, v)])).tolist()
            z = [a - d for a, d in zip(z, dz, strict=True)]
            # what moves by less than roundoff of the lower orders does not move
            if max(map(abs, dz)) <= SERIES_TOL * max(MP.mpf("1e-10"), *map(abs, z)):
                break
        else:
            raise NoConvergenceError(f"analogue of order {k} does not converge")
        system.put(k, z)
    out: dict[tuple[str, str], list[tuple[Real, ...]]] = {}
    factor = [MP.mpf(math.factorial(k)) for k in range(order + 1)]
    for name, (body, u) in system.points.items():
        points = (system.point(body, u, k) for k in range(order + 1))
        grow = [f * system.size for f in factor]
        out["joint", name] = [(x * f, y * f) for (x, y), f in zip(points, grow, strict=True)]
    for i, name in enumerate(system.names):
        angle = [system.series[i][2][k] * f for k, f in enumerate(factor)]
        out["link", name] = [(v if k else v + system.angle0[i],) for k, v in enumerate(angle)]
    for name, r in system.values.items():
        out["slide", name] = [(system.reach(r, k) * f * system.size,) for k, f in enumerate(factor)]
    return out


def _jets(
    system: System, inverse: NDArray[np.float64], count: int, order: int
) -> tuple[dict[str, Jet], dict[str, Jet], dict[str, Jet]]:
    """Partials by polarisation: D(v1..vk) = 1/k! sum over subsets S of (-1)^(k-|S|) D^k[sum S]."""
    cache: dict[tuple[int, ...], Any] = {}

    def derivative(key: tuple[str, str], along: tuple[int, ...], k: int) -> tuple[Real, ...]:
        g = math.gcd(*along) or 1
        unit = tuple(a // g for a in along)
        if unit not in cache:
            cache[unit] = _series(system, inverse, unit, order)
        return tuple(v * g**k for v in cache[unit][key][k])

    first = tuple(int(i == 0) for i in range(count))
    found: dict[str, dict[str, Jet]] = {"joint": {}, "link": {}, "slide": {}}
    derivative(("link", GROUND), first, 0)
    for key in cache[first]:
        partials: dict[tuple[int, ...], tuple[Real, ...]] = {(): derivative(key, first, 0)}
        for k in range(1, order + 1):
            for index in itertools.combinations_with_replacement(range(count), k):
                total = [MP.mpf(0)] * len(partials[()])
                for r in range(1, k + 1):
                    for subset in itertools.combinations(index, r):
                        along = tuple(subset.count(i) for i in range(count))
                        part = derivative(key, along, k)
                        total = [t + (-1) ** (k - r) * p for t, p in zip(total, part, strict=True)]
                partials[index] = tuple(t / math.factorial(k) for t in total)
        found[key[0]][key[1]] = Jet(partials, count, key[0] != "joint")
    return found["joint"], found["link"], found["slide"]


def drawing_pose(description: Description) -> Pose:
    """The pose of the drawing: a guess for q near `drawing_q`."""
    system = System(description)
    system.drawing()
    return system.pose()


def drawing_q(description: Description) -> tuple[float, ...]:
    """q of the drawing, one entry a driver."""
    system = System(description)
    _, q = system.drawing()
    return tuple(float(v * unit) for v, unit in zip(q, system.unit, strict=True))


def angle_gap(a: Any, b: Any) -> Any:
    """a - b without whole turns, at 50 digits."""
    d = MP.mpf(_number(a)) - MP.mpf(_number(b))
    return d - 2 * MP.pi * MP.nint(d / (2 * MP.pi))


def guess_from_joints(
    description: Description,
    joints: Mapping[str, Any],
    angles: Mapping[str, Any] | None = None,
) -> Pose:
    """A pose from approximate joint places and, where known, link angles (with their turns).

    Rotations not given are found from two joints, or from the links slid on; where only the
    distance along a guide between two single joints is left, it keeps the drawing's sign.
    """
    system = System(description, exact=False)
    names, given = system.names, angles or {}
    place: dict[int, Any] = {0: np.zeros(2)}
    turn = {0: 0.0}
    for i, own in enumerate(system.joint_lists):
        if i and own:
            place[i] = np.asarray(joints[own[0]], float) / system.size
        if names[i] in given:
            turn[i] = float(given[names[i]]) - system.angle0[i]
        elif i and len(own) > 1:
            turn[i] = _rotation(description.joints, joints, own)
    for _ in names:
        _spread(system, turn, place)
    for i in range(1, len(names)):
        if i not in place:
            place[i] = _crossing(system, i, turn, place)
    size = system.size
    return {
        n: (float(place[i][0]) * size, float(place[i][1]) * size, turn.get(i, 0.0))
        for i, n in enumerate(names)
        if i
    }


def _rotation(drawn: Mapping[str, Any], now: Mapping[str, Any], own: Sequence[str]) -> float:
    """Rotation of the line from the first joint to the one farthest from it."""
    far = max(own[1:], key=lambda n: math.dist(drawn[n], drawn[own[0]]))
    new, old = (np.asarray(p[far], float) - np.asarray(p[own[0]], float) for p in (now, drawn))
    return math.atan2(new[1], new[0]) - math.atan2(old[1], old[0])


def _spread(system: System, turn: dict[int, float], place: dict[int, Any]) -> None:
    """Rotations of links that slide on links of known rotation; if none, of one RPR pair."""
    for r in system.guides * len(system.names):  # often enough for any chain of slides
        if r.a in turn or r.b in turn:
            turn.setdefault(r.a, turn.get(r.b, 0.0))
            turn.setdefault(r.b, turn[r.a])
    for r in system.guides:
        if r.a not in turn and r.a in place and r.b in place:
            (nx, ny), (wx, wy), (x, y) = r.d, r.w, place[r.a] - place[r.b]
            across, along = nx * wx + ny * wy, ny * wx - nx * wy  # of the drawing
            along = math.copysign(math.sqrt(max(x * x + y * y - across**2, 0.0)), along)
            drawn = math.atan2(across, along) + math.atan2(-nx, ny)
            turn[r.a] = turn[r.b] = math.atan2(y, x) - drawn
            return


def _crossing(
    system: System, i: int, turn: dict[int, float], place: dict[int, Any]
) -> NDArray[np.float64]:
    """Place of a link without joints: where its guides cross."""

    def spin(body: int, u: Vec) -> NDArray[np.float64]:
        c, s = math.cos(turn.get(body, 0.0)), math.sin(turn.get(body, 0.0))
        return np.array([c * u[0] - s * u[1], s * u[0] + c * u[1]])

    rows, rhs = [], []
    for r in system.guides:
        other = r.b if r.a == i else r.a
        if i in (r.a, r.b) and other in place:
            u, w = (r.u, r.w) if r.a == i else (r.w, r.u)
            rows.append(spin(r.b, r.d))
            rhs.append(rows[-1] @ (place[other] + spin(other, w) - spin(i, u)))
    return np.asarray(np.linalg.lstsq(np.array(rows), np.array(rhs), rcond=None)[0], np.float64)


def follow(description: Description, q_target: Any, steps: int = 100) -> Pose:
    """float64 continuation from the drawing straight to q_target; the pose there.

    `steps` bounds the step; it shrinks where the path bends.  Raises StuckError at a fold.
    """
    system = System(description, exact=False)
    z_list, start_list = system.drawing()
    z, start = np.array(z_list), np.array(start_list)
    unit = np.array(system.unit)
    delta = np.array([float(v) for v in _tuple(q_target)]) / unit - start
    drive = np.zeros(2 * len(system.pins) + len(system.turns) + len(system.reaches))
    drive[system._driver_rows()] = delta
    t, h = 0.0, 1.0 / steps
    jacobian = system.jacobian()
    square = jacobian.shape[0] == jacobian.shape[1]
    sign = np.linalg.slogdet(jacobian)[0] if square else 1.0
    while t < 1.0:
        h = min(h, 1.0 - t)
        predictor = _inverse(jacobian) @ drive * h
        trial, fine = z + predictor, False
        for _ in range(6):
            system.put(0, trial.tolist())
            rows = np.array(system.residual(0, (start + (t + h) * delta).tolist()))
            here = system.jacobian()
            fine = bool(np.max(np.abs(rows)) < FLOAT_TOL)
            if fine or np.max(np.abs(rows)) > 1e3:
                break
            trial = trial - _inverse(here) @ rows
        length = np.max(np.abs(predictor))
        fine = fine and bool(np.max(np.abs(trial - z - predictor)) <= 0.1 * length + FLOAT_TOL)
        if fine and length < 0.3 and (not square or np.linalg.slogdet(here)[0] == sign):
            t, z, jacobian = (1.0 if h >= 1.0 - t else t + h), trial, here
            h = min(2 * h, 1.0 / steps)
        else:
            h /= 2
        if h < LEAST_STEP and t < 1.0:
            system.put(0, z.tolist())
            raise StuckError(tuple(((start + t * delta) * unit).tolist()), system.pose())
    system.put(0, z.tolist())
    return system.pose()
