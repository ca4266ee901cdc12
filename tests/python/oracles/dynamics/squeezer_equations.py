"""Andrews' squeezer as the multibody literature solves it: seven angles, six constraints.

E. Hairer and G. Wanner, *Solving Ordinary Differential Equations II* (1996), section VII.7: mass
matrix, forces (7.6), constraints (7.8). Accelerations and multipliers follow from the constraints
differentiated twice (index 1). The angles are β, Θ, γ, Φ, δ, Ω, ε.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
import numpy.typing as npt

Float: TypeAlias = npt.NDArray[np.float64]

M1, M2, M3, M4, M5, M6, M7 = 0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498
I1, I2, I3, I4, I5, I6, I7 = 2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5
XA, YA, XB, YB, XC, YC = -0.06934, -0.00227, -0.03635, 0.03273, 0.014, 0.072
D, DA, E, EA, RR, RA = 28e-3, 115e-4, 2e-2, 1421e-5, 7e-3, 92e-5
SS, SA, SB, SC, SD, TA, TB = 35e-3, 1874e-5, 1043e-5, 18e-3, 2e-2, 2308e-5, 916e-5
U, UA, UB, ZF, ZT, FA = 4e-2, 1228e-5, 449e-5, 2e-2, 4e-2, 1421e-5
TORQUE, STIFFNESS, LENGTH = 0.033, 4530.0, 0.07785


def constraints(angles: Float) -> Float:
    """The loops over B, over A by K4 and K5, over A by K6 and K7: zero where they close."""
    b, th, g, p, de, om, ep = angles
    x, y = RR * np.cos(b) - D * np.cos(b + th), RR * np.sin(b) - D * np.sin(b + th)
    return np.array(
        [
            x - SS * np.sin(g) - XB,
            y + SS * np.cos(g) - YB,
            x - E * np.sin(p + de) - ZT * np.cos(de) - XA,
            y + E * np.cos(p + de) - ZT * np.sin(de) - YA,
            x - ZF * np.cos(om + ep) - U * np.sin(ep) - XA,
            y - ZF * np.sin(om + ep) + U * np.cos(ep) - YA,
        ]
    )


def masses(angles: Float) -> Float:
    _, th, _, p, _, om, _ = angles
    m, e, f = np.zeros((7, 7)), E - EA, ZF - FA
    m[0, 0] = M1 * RA**2 + M2 * (RR**2 - 2 * DA * RR * np.cos(th) + DA**2) + I1 + I2
    m[0, 1] = m[1, 0] = M2 * (DA**2 - DA * RR * np.cos(th)) + I2
    m[1, 1] = M2 * DA**2 + I2
    m[2, 2] = M3 * (SA**2 + SB**2) + I3
    m[3, 3] = M4 * e**2 + I4
    m[3, 4] = m[4, 3] = M4 * (e**2 + ZT * e * np.sin(p)) + I4
    m[4, 4] = M4 * (ZT**2 + 2 * ZT * e * np.sin(p) + e**2) + M5 * (TA**2 + TB**2) + I4 + I5
    m[5, 5] = M6 * f**2 + I6
    m[5, 6] = m[6, 5] = M6 * (f**2 - U * f * np.sin(om)) + I6
    m[6, 6] = M6 * (f**2 - 2 * U * f * np.sin(om) + U**2) + M7 * (UA**2 + UB**2) + I6 + I7
    return m


def forces(angles: Float, rates: Float) -> Float:
    _, th, g, p, _, om, _ = angles
    b1, th1, _, p1, de1, om1, ep1 = rates
    c, s = np.cos(g), np.sin(g)
    x, y = SD * c + SC * s + XB - XC, SD * s - SC * c + YB - YC
    long = np.hypot(x, y)
    pull = -STIFFNESS * (long - LENGTH) / long
    two, four, six = M2 * DA * RR * np.sin(th), M4 * ZT * (E - EA), M6 * U * (ZF - FA)
    return np.array(
        [
            TORQUE - two * th1 * (th1 + 2 * b1),
            two * b1**2,
            pull * (x * (SC * c - SD * s) + y * (SD * c + SC * s)),
            four * de1**2 * np.cos(p),
            -four * p1 * (p1 + 2 * de1) * np.cos(p),
            -six * ep1**2 * np.cos(om),
            six * om1 * (om1 + 2 * ep1) * np.cos(om),
        ]
    )


def gradient(angles: Float) -> Float:
    b, th, g, p, de, om, ep = angles
    out = np.zeros((6, 7))
    out[0::2, 0] = -RR * np.sin(b) + D * np.sin(b + th)
    out[1::2, 0] = RR * np.cos(b) - D * np.cos(b + th)
    out[0::2, 1], out[1::2, 1] = D * np.sin(b + th), -D * np.cos(b + th)
    out[0, 2], out[1, 2] = -SS * np.cos(g), -SS * np.sin(g)
    out[2, 3], out[3, 3] = -E * np.cos(p + de), -E * np.sin(p + de)
    out[2, 4], out[3, 4] = out[2, 3] + ZT * np.sin(de), out[3, 3] - ZT * np.cos(de)
    out[4, 5], out[5, 5] = ZF * np.sin(om + ep), -ZF * np.cos(om + ep)
    out[4, 6], out[5, 6] = out[4, 5] - U * np.cos(ep), out[5, 5] - U * np.sin(ep)
    return out


def centripetal(angles: Float, rates: Float) -> Float:
    """The constraints' second derivatives without the accelerations."""
    b, th, g, p, de, om, ep = angles
    b1, th1, g1, p1, de1, om1, ep1 = rates
    x = -RR * np.cos(b) * b1**2 + D * np.cos(b + th) * (b1 + th1) ** 2
    y = -RR * np.sin(b) * b1**2 + D * np.sin(b + th) * (b1 + th1) ** 2
    return np.array(
        [
            x + SS * np.sin(g) * g1**2,
            y - SS * np.cos(g) * g1**2,
            x + E * np.sin(p + de) * (p1 + de1) ** 2 + ZT * np.cos(de) * de1**2,
            y - E * np.cos(p + de) * (p1 + de1) ** 2 + ZT * np.sin(de) * de1**2,
            x + ZF * np.cos(om + ep) * (om1 + ep1) ** 2 + U * np.sin(ep) * ep1**2,
            y + ZF * np.sin(om + ep) * (om1 + ep1) ** 2 - U * np.cos(ep) * ep1**2,
        ]
    )


def accelerations(angles: Float, rates: Float) -> tuple[Float, Float]:
    """Of the seven angles, and the six multipliers."""
    by = gradient(angles)
    matrix = np.block([[masses(angles), by.T], [by, np.zeros((6, 6))]])
    right = np.concatenate([forces(angles, rates), -centripetal(angles, rates)])
    both = np.linalg.solve(matrix, right)
    return both[:7], both[7:]


def rhs(_: float, state: Float) -> Float:
    """Of the first-order system for an integrator."""
    return np.concatenate([state[7:], accelerations(state[:7], state[7:])[0]])
