"""The papers' figures are drawn, and show what they should."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import crank_rocker_paper
import flywheel_paper
import slider_crank_papers

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

TURN = 2.0 * math.pi
FIGURES = {
    **slider_crank_papers.FIGURES,
    **crank_rocker_paper.FIGURES,
    **flywheel_paper.FIGURES,
}


def close(got: Any, wanted: Any, atol: Any) -> None:
    np.testing.assert_allclose(got, wanted, rtol=0.0, atol=atol)


def data(ax: Any, i: int = 0, gid: str = "curve") -> Any:
    """x and y of a line."""
    return [line for line in ax.lines if str(line.get_gid()).startswith(gid)][i].get_data()


def band(collection: Any) -> tuple[Any, Any, Any]:
    """x, lower and upper end of what `fill_between` drew."""
    corners = collection.get_paths()[0].vertices
    x = np.unique(corners[:, 0])
    ends = [corners[corners[:, 0] == one, 1] for one in x]
    return x, np.array([e.min() for e in ends]), np.array([e.max() for e in ends])


def slider(phi: Any) -> tuple[Any, ...]:
    """Chernysh et al., crank 0.11, rod 0.407: cos δ, δ', δ'' and x = l₁ cos φ + l₂ cos δ."""
    k = 0.407 / 0.11
    cosine = np.sqrt(1.0 - (np.sin(phi) / k) ** 2)
    d1 = np.cos(phi) / (k * cosine)
    d2 = (-np.sin(phi) + np.sin(phi) * d1**2) / (k * cosine)
    return cosine, d1, d2, 0.11 * np.cos(phi) + 0.407 * cosine


def contour(figure: Any) -> None:
    a = 0.11 * np.array([0.5, math.sqrt(0.75)])
    o, b = np.zeros(2), np.array([slider(math.pi / 3)[3], 0.0])
    (ax,) = figure.axes
    arrows = [text for text in ax.texts if not text.get_text()]
    drawn = [(*arrow.xyann, *arrow.xy) for arrow in arrows]
    close(drawn, [(*o, *a), (*a, *b), (*o, *b)], atol=1e-15)
    close([np.ravel(data(ax, i, "joint")) for i in range(3)], [o, a, b], atol=1e-15)
    assert [arrow.get_gid() for arrow in arrows] == ["vector l₁", "vector l₂", "vector l₃"]


def positions(figure: Any) -> None:
    (ax,) = figure.axes
    phi = np.linspace(0.0, TURN, 721)
    a = 0.11 * np.array([np.cos(phi), np.sin(phi)])
    b = np.array([slider(phi)[3], 0.0 * phi])
    close([data(ax, i, "path") for i in range(3)], [a, b, (a + b) / 2.0], atol=1e-14)
    place = (a + b)[:, 120] / 2.0
    close(np.ravel(data(ax, 0, "point S2")), place, atol=1e-14)


def of_slider(phi: Any) -> tuple[Any, ...]:
    cosine, d1, d2, x = slider(phi)
    sine = np.sin(phi)
    v = 0.11 * sine + 0.11 * sine * d1
    a = 0.11 * np.cos(phi) + 0.407 * (cosine * d1**2 + (0.11 / 0.407) * sine * d2)
    return 0.517 - x, 31.0 * v, 31.0**2 * a


def of_rod(phi: Any) -> tuple[Any, ...]:
    cosine, d1, d2, _ = slider(phi)
    angle = -np.arccos(np.minimum(cosine, 1.0)) * np.sign(np.sin(phi))
    return np.degrees(angle), -31.0 * d1, -(31.0**2) * d2


def diagrams(figure: Any, of: Callable[[Any], tuple[Any, ...]]) -> None:
    """The curves, and their extremes on samples a hundred times as many."""
    phi, dense = np.linspace(0.0, TURN, 721), np.linspace(0.0, TURN, 72001)
    for ax, wanted, fine in zip(figure.axes, of(phi), of(dense), strict=True):
        got = data(ax)
        close(got[0], np.degrees(phi), atol=1e-12)
        # An arccosine near 1 loses half of the digits.
        size = float(np.abs(wanted).max())
        close(got[1], wanted, 1e-6 * size)
        extremes = [data(ax, i, "mark") for i in (0, 1)]
        close([y[0] for _, y in extremes], [fine.max(), fine.min()], 1e-6 * size)


def stroke(figure: Any) -> None:
    diagrams(figure, of_slider)
    titles = [ax.get_title(loc="left") for ax in figure.axes]
    assert titles == ["Stroke s, m", "Velocity v, m/s", "Acceleration a, m/s²"]


def rod(figure: Any) -> None:
    diagrams(figure, of_rod)


def convergence(figure: Any) -> None:
    """Harmonics by the Fourier transform of the stroke, terms by the binomial series in sin²."""
    harmonics, terms = figure.axes
    phi = np.linspace(0.0, TURN, 721)[:-1]
    for i, k in enumerate((1.5, 3.0, 5.0)):
        x = (np.sin(phi) / k) ** 2
        lifted = k * (1.0 - np.sqrt(1.0 - x))
        coefficients = np.fft.rfft(lifted)
        left = {}
        for n in range(1, 9):
            kept = np.where(np.arange(coefficients.size) <= 2 * n, coefficients, 0.0)
            left[n] = np.abs(np.fft.irfft(kept, phi.size) - lifted).max()
        close(data(harmonics, i), (range(1, 9), [*left.values()]), 1e-14)
        for n in left:
            series = sum(math.comb(2 * m, m) / (2 * m - 1) * (x / 4) ** m for m in range(1, n + 1))
            left[n] = np.abs(k * series - lifted).max()
        close(data(terms, i), (range(1, 9), [*left.values()]), 1e-14)
    # Formula (14): one term.
    close([data(terms, i)[1][0] for i in (1, 2)], [0.004906, 0.001021], 5e-7)


def deviations(figure: Any) -> None:
    """Per cent and degrees, recomputed at λ = 1/3 (printed: 0.472, 0.013, 0.948)."""
    wanted = [(0.472502, 73.69), (0.013217, 80.51), (0.948717, 127.64), (0.029660, 117.89)]
    for ax, (largest, at) in zip(figure.axes, wanted, strict=True):
        x, y = data(ax)
        k = int(np.argmax(np.abs(y)))
        # The points are 0.18° apart: a largest value between two of them is missed by its square.
        assert abs(abs(y[k]) - largest) < 1e-5 * largest + 5e-7
        assert abs(x[k] - at) < 0.18
        # The mark is between them.
        (mark,), (value,) = data(ax, 0, "mark")
        assert mark == pytest.approx(at, abs=6e-3)
        assert abs(value) == pytest.approx(largest, abs=6e-7)


def zone(figure: Any) -> None:
    """1 + |l₂ - l₃| + Δ and l₂ - 1 + l₃ - Δ; with friction by the law of cosines at γ = 0.2."""
    margins, friction = figure.axes[0].collections
    assert [margins.get_gid(), friction.get_gid()] == ["zone", "zone with friction"]
    l3, low, high = band(margins)
    assert (l3[0], l3[-1], len(l3)) == (1.05, 4.0, 60)
    close(low, 5.0 - l3 + 0.05, atol=1e-14)
    close(high, 3.0 + l3 - 0.05, atol=1e-14)
    l3, low, high = band(friction)
    assert len(l3) > 55
    least = 1.0 + np.sqrt(16.0 + l3**2 - 8.0 * l3 * math.cos(0.2))
    most = np.sqrt(16.0 + l3**2 + 8.0 * l3 * math.cos(0.2)) - 1.0
    close(low, least + 0.05, atol=1e-14)
    close(high, most - 0.05, atol=1e-14)


def push_and_pull(figure: Any) -> None:
    """φ₃ grows while the coupler pushes: the arrow on C points away from B then, else to B."""
    for ax, phi, name in zip(figure.axes, (1.6, 4.2), ("pushes", "pulls"), strict=True):
        # C lies 1.5 from D and 4.5 from B, on the upper side.
        b, d = np.array([math.cos(phi), math.sin(phi)]), np.array([-4.8, 0.0])
        arrow = next(text for text in ax.texts if text.get_gid() == "force")
        c = np.array(arrow.xy)
        assert math.dist(b, c) == pytest.approx(4.5, rel=1e-14)
        assert math.dist(c, d) == pytest.approx(1.5, rel=1e-14)
        assert c[1] > 0.0
        along = np.array(arrow.xyann) @ (c - b)
        # The pin B comes nearer along the coupler where it pushes.
        pin = np.array([-math.sin(phi), math.cos(phi)])
        assert (along > 0.0) == (pin @ (c - b) > 0.0) == (name == "pushes")
        gamma = math.acos(abs((b - c) @ (d - c)) / (4.5 * 1.5))
        assert ax.get_title(loc="left") == f"The coupler {name}: γ = {gamma:.3f} rad"
        joints = [artist for artist in ax.get_children() if artist.get_gid() == "joint C"]
        assert len(joints) == 1


def least_angle(figure: Any) -> None:
    x, y = data(figure.axes[0])
    assert x[0] == 0.0
    assert 0.999 < x[-1] < 1.0
    close(y, np.arcsin(x), atol=1e-12)


def transmission(figure: Any) -> None:
    """cos γ₂₃ by the law of cosines; γ is it or what it wants of a half turn."""
    phi = np.linspace(0.0, TURN, 721)
    for i, ground in enumerate((4.8, 4.85, 4.9, 4.95, 4.995)):
        s2 = 1.0 + ground**2 + 2.0 * ground * np.cos(phi)
        angle = np.arccos((4.5**2 + 1.5**2 - s2) / (2.0 * 4.5 * 1.5))
        for ax, wanted in zip(figure.axes, (angle, np.minimum(angle, np.pi - angle)), strict=True):
            x, y = data(ax, i)
            close(x, np.degrees(phi), atol=1e-12)
            close(y, wanted, atol=1e-13)


ROD2 = 4.5**2 + 1.5**2 + 2.0 * 4.5 * 1.5 * math.cos(0.2)  # γ₂₃ = π - 0.2
JAM = math.degrees(math.acos((ROD2 - 1.0 - 4.995**2) / 9.99))


def successive_positions(figure: Any) -> None:
    """From the jam at -11.744° to the return at 11.744° coupler and rocker are one rod."""
    (ax,) = figure.axes
    assert sum(artist.get_gid() == "position" for artist in ax.get_children()) == 23 * 3
    (text,) = (text.get_text() for text in ax.texts if text.get_gid() == "sliding text")
    assert text == "C jammed: D slides 0.0175 m"
    sliding = [line.get_data() for line in ax.lines if line.get_gid() == "sliding"]
    angles = []
    for chain in sliding:
        corners = np.array(chain).T
        close(np.linalg.norm(np.diff(corners, axis=0), axis=1), (1.0, 4.5, 1.5), atol=1e-12)
        assert math.dist(corners[1], corners[3]) == pytest.approx(math.sqrt(ROD2), rel=1e-9)
        angles.append(math.degrees(math.atan2(corners[1, 1], corners[1, 0])))
    close((min(angles), max(angles)), (-11.7440973691, 11.7440973691), atol=1e-9)
    # C is 1.5 from D, which lies on the line of centres.
    x, y = data(ax, 0, "path C")
    assert np.abs(np.abs(y)).max() <= 1.5
    assert x.min() < -4.9 < -3.5 < x.max()
    # No arrow drives D.
    assert sum(artist.get_gid() == "driver" for artist in ax.get_children()) == 2


def support(figure: Any) -> None:
    (ax,) = figure.axes
    phi, ad = data(ax)
    angle = np.radians(phi)
    sliding = -np.cos(angle) + np.sqrt(ROD2 - np.sin(angle) ** 2)
    close(ad, np.where(np.abs(phi) <= JAM, sliding, 4.995), atol=1e-12)
    assert 4.995 - ad.min() == pytest.approx(0.0174671643849, abs=1e-12)
    events = [line.get_xdata()[0] for line in ax.lines if "event" in str(line.get_gid())]
    close(events, [348.2559026309 - 360.0, 11.7440973691], atol=1e-10)
    texts = [text.get_text() for text in ax.texts if text.get_gid() == "event text"]
    assert texts == ["C jams at −11.7°", "D is back at 11.7°"]


def jammed_angle(figure: Any) -> None:
    """It stays at its least while D slides."""
    phi, gamma = data(figure.axes[0])
    distance2 = 1.0 + 4.995**2 + 2.0 * 4.995 * np.cos(np.radians(phi))
    between = np.arccos((4.5**2 + 1.5**2 - distance2) / (2.0 * 4.5 * 1.5))
    free = np.minimum(between, np.pi - between)
    close(gamma, np.where(np.abs(phi) <= JAM, 0.2, free), atol=1e-9)


MOMENT = CubicSpline(flywheel_paper.PHI, flywheel_paper.MOMENT)  # not-a-knot
INERTIA = CubicSpline(flywheel_paper.PHI, flywheel_paper.INERTIA)


def paper_speed(q: Any, speed0: float, added: float) -> Any:
    """The paper's energy integral, with SciPy's spline."""
    work = MOMENT.antiderivative()
    motor = -work(TURN) / TURN
    whole = INERTIA(q) + added
    energy = work(q) + motor * q + (INERTIA(0.0) + added) * speed0**2 / 2.0
    return np.sqrt(2.0 * energy / whole)


def table(figure: Any) -> None:
    for ax, spline, rows in zip(
        figure.axes,
        (MOMENT, INERTIA),
        (flywheel_paper.MOMENT, flywheel_paper.INERTIA),
        strict=True,
    ):
        x, y = data(ax)
        assert (x[0], x[-1]) == (0.0, TURN)
        close(y, spline(x), atol=1e-12 * np.abs(y).max())
        np.testing.assert_array_equal(data(ax, 0, "rows"), (flywheel_paper.PHI, rows))


def speed_without(figure: Any) -> None:
    x, y = data(figure.axes[0])
    assert (x[0], x[-1]) == (0.0, TURN)
    close(y, paper_speed(x, flywheel_paper.SPEED0, 0.0), atol=1e-11)
    extremes = np.ravel([data(figure.axes[0], i, "mark") for i in (0, 1)])
    close(extremes, (0.705044, 19.649, 2.184668, 10.4665), atol=5e-7)


def speed_with(figure: Any) -> None:
    """Over the time: the area below is a turn; speeds at it by the energy integral."""
    t, y = data(figure.axes[0])
    assert t[0] == 0.0
    assert t[-1] == pytest.approx(0.41989702, abs=5e-9)
    q = CubicSpline(t, y).antiderivative()(t)
    assert q[-1] == pytest.approx(TURN, abs=1e-8)
    close(y, paper_speed(q, 15.516642, 19.918150), atol=1e-6)
    extremes = [data(figure.axes[0], i, "mark")[1][0] for i in (0, 1)]
    close(extremes, (15.9375, 14.0625), atol=1e-9)


def energy_mass(figure: Any) -> None:
    """The tangents have the slopes ω²/2 and meet at (-I, -I ω₀²/2), I of the flywheel."""
    (ax,) = figure.axes
    inertia, energy = data(ax)
    q = np.linspace(0.0, TURN, 721)
    close(inertia, INERTIA(q), atol=1e-11)
    speed = paper_speed(q, 15.516642, 19.918150)
    own = (inertia + 19.918150) * speed**2 / 2.0 - 19.918150 * 15.516642**2 / 2.0
    close(energy, own, atol=5e-4)
    for i, extreme in enumerate((15.9375, 14.0625)):
        x, y = data(ax, i, "tangent")
        slope = (y[1] - y[0]) / (x[1] - x[0])
        assert slope == pytest.approx(extreme**2 / 2.0, rel=1e-9)
        at = y[0] + slope * (-19.918150 - x[0])
        assert at == pytest.approx(-19.918150 * 15.516642**2 / 2.0, abs=5e-4)


def moment(figure: Any) -> None:
    """The areas are the integrals of motor and moment between their crossings."""
    (ax,) = figure.axes
    q, resistance = data(ax)
    close(resistance, -MOMENT(q), atol=1e-11 * 950.0)
    motor = -MOMENT.integrate(0.0, TURN) / TURN
    close(data(ax, 1)[1], motor, atol=1e-9)
    ends = [0.0, *(x for x in MOMENT.solve(float(-motor)) if 0.0 < x < TURN), TURN]
    energies = [float(MOMENT.integrate(a, b)) + motor * (b - a) for a, b in pairwise(ends)]
    assert sum(energies) == pytest.approx(0.0, abs=1e-9)
    texts = [text.get_text() for text in ax.texts if text.get_gid() == "energy"]
    assert texts == [
        f"{energy:+#.3g} J".replace("-", "−").replace(". ", " ") for energy in energies
    ]


def energy(figure: Any) -> None:
    """The work of motor and loads, and what of it the flywheel stores."""
    (ax,) = figure.axes
    q, work = data(ax)
    own = MOMENT.antiderivative()
    close(work, own(q) - own(TURN) / TURN * q, atol=1e-9)
    speed = paper_speed(q, 15.516642, 19.918150)
    close(data(ax, 1)[1], 19.918150 * (speed**2 - 15.516642**2) / 2.0, atol=5e-3)


SHOWN: dict[str, Callable[[Any], None]] = {
    check.__name__: check
    for check in (
        *(contour, positions, stroke, rod, convergence, deviations),
        *(zone, push_and_pull, least_angle, transmission),
        *(successive_positions, support, jammed_angle),
        *(table, speed_without, speed_with, moment, energy, energy_mass),
    )
}


@pytest.mark.parametrize("name", FIGURES)
def test_figures_show_the_functions_of_the_papers(name: str) -> None:
    figure = np.ravel(FIGURES[name]())[0].figure
    SHOWN[name](figure)
    plt.close(figure)


def test_the_scripts_draw_them_all(tmp_path: Path) -> None:
    slider_crank_papers.main(tmp_path)
    crank_rocker_paper.main(tmp_path)
    flywheel_paper.main(tmp_path)
    drawn = {path.stem for path in tmp_path.glob("*.png")}
    wanted = {f"slider_crank_{name}" for name in slider_crank_papers.FIGURES}
    wanted |= {f"crank_rocker_{name}" for name in crank_rocker_paper.FIGURES}
    assert drawn == wanted | {f"flywheel_{name}" for name in flywheel_paper.FIGURES}
