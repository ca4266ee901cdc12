"""Linear least squares with bounds, by an active-set method.

P. B. Stark and R. L. Parker, *Bounded-variable least-squares: an algorithm and applications*,
Computational Statistics 10 (1995) 129, which extends C. L. Lawson and R. J. Hanson, *Solving Least
Squares Problems* (1974), chapter 23.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from assur._arrays import Float

# A column counts as a sum of others where less than this fraction of it is left: some rounding
# errors.
DEPENDENT = 1e-13
# A bounded variable is freed where its gradient exceeds this fraction of the right side.
GRADIENT = 1e-14
_Mask = npt.NDArray[np.bool_]


def bounded_least_squares(matrix: Float, right: Float, lower: Float, upper: Float) -> Float:
    """Return x with lower ≤ x ≤ upper that makes |matrix x − right| least.

    Parameters
    ----------
    matrix, right : ndarray
        Finite, (rows, n) and (rows,); dependent columns are allowed.
    lower, upper : ndarray
        Bounds, (n,), lower < upper; may be infinite.
    """
    n = matrix.shape[1]
    # Columns and the right side near 1 by powers of two, so that bounds stay exact.
    columns, unit = _exponents(matrix), _exponents(right)
    shift = columns - unit
    with np.errstate(over="ignore", under="ignore"):
        low, high = np.ldexp(lower, shift), np.ldexp(upper, shift)
        a, b = _triangle(np.ldexp(matrix, -columns), np.ldexp(right, -unit))
    free = np.isinf(low) & np.isinf(high)
    x = np.where(np.abs(low) <= np.abs(high), low, high)
    x[free] = 0.0
    tolerance = GRADIENT * float(np.sqrt((b * b).sum()))
    x, free = _solve_free(a, b, x, free, low, high)
    # Each round lowers the sum of squares or excludes a variable, so it ends.
    excluded = np.zeros(n, np.bool_)
    while True:
        left = b - (a * x).sum(axis=1)
        gain = (a * left[:, np.newaxis]).sum(axis=0)
        # For a variable at its upper bound a smaller value may help.
        gain = np.where(x >= high, -gain, gain)
        gain[free | excluded] = -np.inf
        chosen = int(np.argmax(gain)) if n else 0
        if not n or gain[chosen] <= tolerance:
            with np.errstate(over="ignore", under="ignore"):
                solution: Float = np.clip(np.ldexp(x, -shift), lower, upper)
            return solution
        tried = free.copy()
        tried[chosen] = True
        y, kept = _solve_free(a, b, x, tried, low, high)
        now = b - (a * y).sum(axis=1)
        if (now * now).sum() < (left * left).sum():
            x, free, excluded[:] = y, kept, False
        else:
            excluded[chosen] = True


def _solve_free(
    a: Float, b: Float, x: Float, free: _Mask, low: Float, high: Float
) -> tuple[Float, _Mask]:
    """Return the least squares over free variables, and which of them no bound stopped."""
    x, free = x.copy(), free.copy()
    while free.any():
        step = _least_squares(a[:, free], b - (a * x).sum(axis=1))
        target = x[free] + step
        low_free, high_free = low[free], high[free]
        beyond = (target < low_free) | (target > high_free)
        if not beyond.any():
            x[free] = target
            break
        bound = np.where(target < low_free, low_free, high_free)
        part = np.ones(step.shape)
        part[beyond] = (bound[beyond] - x[free][beyond]) / step[beyond]
        least = part.min()
        stopped = beyond & (part <= least)
        x[free] = np.where(stopped, bound, np.clip(x[free] + least * step, low_free, high_free))
        free[np.flatnonzero(free)[stopped]] = False
    return x, free


def _least_squares(a: Float, b: Float) -> Float:
    """Return a basic solution: columns that depend on others get 0."""
    order, rank, r, c = _factor(a, b)
    x = np.zeros(a.shape[1])
    for k in range(rank - 1, -1, -1):
        x[order[k]] = (c[k] - (r[k, k + 1 : rank] * x[order[k + 1 : rank]]).sum()) / r[k, k]
    return x


def _triangle(a: Float, b: Float) -> tuple[Float, Float]:
    """Return a smaller system with the same least squares, up to a constant."""
    order, rank, r, c = _factor(a, b)
    small = np.zeros((rank, a.shape[1]))
    small[:, order] = r[:rank]
    return small, c[:rank]


def _factor(a: Float, b: Float) -> tuple[npt.NDArray[np.intp], int, Float, Float]:
    """Return Householder's triangle with the greatest column first, its rank, and the right side.

    G. H. Golub and C. F. Van Loan, *Matrix Computations* (1996), section 5.4.1.
    """
    rows, n = a.shape
    r, c, order = a.copy(), b.copy(), np.arange(n)
    first = 0.0
    rank = min(rows, n)
    for k in range(min(rows, n)):
        lengths = np.sqrt((r[k:, k:] * r[k:, k:]).sum(axis=0))
        best = k + int(np.argmax(lengths))
        length = float(lengths[best - k])
        first = max(first, length)
        if length <= DEPENDENT * first:
            rank = k
            break
        r[:, [k, best]], order[[k, best]] = r[:, [best, k]], order[[best, k]]
        mirror = r[k:, k].copy()
        mirror[0] += length if mirror[0] >= 0.0 else -length
        half = 0.5 * (mirror * mirror).sum()
        r[k:, k:] -= mirror[:, np.newaxis] * (
            (mirror[:, np.newaxis] * r[k:, k:]).sum(axis=0) / half
        )
        c[k:] -= mirror * ((mirror * c[k:]).sum() / half)
    return order, rank, np.triu(r), c


def _exponents(columns: Float) -> npt.NDArray[np.int32]:
    """Return the exponents of the greatest number of each column; 0 where all are 0."""
    exponents: npt.NDArray[np.int32] = np.frexp(np.abs(columns).max(axis=0))[1]
    return exponents
