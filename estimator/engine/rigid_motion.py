"""The rigid motion between paired points, by Horn's quaternions and Jacobi's eigenvalues.

B. K. P. Horn, "Closed-form solution of absolute orientation using unit quaternions", JOSA A 4
(1987). It is the motion of Umeyama's method, which Open3D takes, wherever that is determined.
"""

import numpy as np
from numpy.typing import NDArray

from estimator.engine.compiled import compiled

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

_SWEEPS = 30
"""Jacobi takes five or six; a limit for numbers that overflow."""


@compiled
def rigid_motion(
    source: Floats, target: Floats, paired: Indices, partner: Indices, count: int, motion: Floats
) -> tuple[float, float]:
    """Find the rigid motion that takes paired source points nearest to their target points.

    Args:
        source: (N, 3) metres.
        target: (M, 3) metres.
        paired: rows of the source, the first `count` are read.
        partner: rows of the target that they are paired with.
        count: number of pairs, > 0.
        motion: (4, 4), the result. Its last row is left as it is.

    Returns:
        The largest eigenvalue of Horn's matrix and how far the second is below. The rotation is
        arbitrary where that is nothing; one
        pair is not turned.
    """
    px = py = pz = qx = qy = qz = 0.0
    for k in range(count):
        i, j = paired[k], partner[k]
        px, py, pz = px + source[i, 0], py + source[i, 1], pz + source[i, 2]
        qx, qy, qz = qx + target[j, 0], qy + target[j, 1], qz + target[j, 2]
    px, py, pz, qx, qy, qz = px / count, py / count, pz / count, qx / count, qy / count, qz / count
    xx = xy = xz = yx = yy = yz = zx = zy = zz = 0.0
    for k in range(count):
        i, j = paired[k], partner[k]
        x, y, z = source[i, 0] - px, source[i, 1] - py, source[i, 2] - pz
        u, v, w = target[j, 0] - qx, target[j, 1] - qy, target[j, 2] - qz
        xx, xy, xz = xx + x * u, xy + x * v, xz + x * w
        yx, yy, yz = yx + y * u, yy + y * v, yz + y * w
        zx, zy, zz = zx + z * u, zy + z * v, zz + z * w

    A = np.zeros((8, 4))  # Horn's matrix above, its eigenvectors below
    A[0, 0], A[1, 1] = xx + yy + zz, xx - yy - zz
    A[2, 2], A[3, 3] = yy - xx - zz, zz - xx - yy
    A[0, 1] = A[1, 0] = yz - zy
    A[0, 2] = A[2, 0] = zx - xz
    A[0, 3] = A[3, 0] = xy - yx
    A[1, 2] = A[2, 1] = xy + yx
    A[1, 3] = A[3, 1] = zx + xz
    A[2, 3] = A[3, 2] = yz + zy
    A[4, 0] = A[5, 1] = A[6, 2] = A[7, 3] = 1.0
    _diagonalise(A)
    top = 0
    for i in range(1, 4):
        if A[i, i] > A[top, top]:
            top = i
    gap = np.inf
    for i in range(4):
        if i != top:
            gap = min(gap, A[top, top] - A[i, i])

    w, x, y, z = A[4, top], A[5, top], A[6, top], A[7, top]
    length = np.sqrt(w * w + x * x + y * y + z * z)
    w, x, y, z = w / length, x / length, y / length, z / length
    motion[0, 0] = 1.0 - 2.0 * (y * y + z * z)
    motion[0, 1] = 2.0 * (x * y - w * z)
    motion[0, 2] = 2.0 * (x * z + w * y)
    motion[1, 0] = 2.0 * (x * y + w * z)
    motion[1, 1] = 1.0 - 2.0 * (x * x + z * z)
    motion[1, 2] = 2.0 * (y * z - w * x)
    motion[2, 0] = 2.0 * (x * z - w * y)
    motion[2, 1] = 2.0 * (y * z + w * x)
    motion[2, 2] = 1.0 - 2.0 * (x * x + y * y)
    motion[0, 3] = qx - (motion[0, 0] * px + motion[0, 1] * py + motion[0, 2] * pz)
    motion[1, 3] = qy - (motion[1, 0] * px + motion[1, 1] * py + motion[1, 2] * pz)
    motion[2, 3] = qz - (motion[2, 0] * px + motion[2, 1] * py + motion[2, 2] * pz)
    return A[top, top], gap


@compiled
def _diagonalise(A: Floats) -> None:
    """Turn the symmetric matrix in the upper half of A (8, 4) until it is diagonal.

    What stands in the lower half takes part in the turns of columns: eigenvectors come of the
    identity.
    """
    for _ in range(_SWEEPS):
        on = abs(A[0, 0]) + abs(A[1, 1]) + abs(A[2, 2]) + abs(A[3, 3])
        off = 0.0
        for p in range(3):
            for q in range(p + 1, 4):
                off += abs(A[p, q])
        if off <= 1e-17 * on:
            return
        for q in range(1, 4):  # pairs of axes in this order: the next turn waits less for the last
            _turn(A, 0, q)
            _turn(A, 2 if q == 1 else 1, 2 if q == 3 else 3)


@compiled
def _turn(A: Floats, p: int, q: int) -> None:
    """Turn the axes p and q so that A[p, q] becomes zero."""
    if A[p, q] == 0.0:
        return
    difference, twice = A[q, q] - A[p, p], 2.0 * A[p, q]
    root = np.sqrt(difference * difference + twice * twice)
    tangent = twice / (difference + root if difference >= 0.0 else difference - root)
    cosine = 1.0 / np.sqrt(tangent * tangent + 1.0)
    sine = tangent * cosine
    for i in range(8):
        on_p, on_q = A[i, p], A[i, q]
        A[i, p] = cosine * on_p - sine * on_q
        A[i, q] = sine * on_p + cosine * on_q
    for i in range(4):
        on_p, on_q = A[p, i], A[q, i]
        A[p, i] = cosine * on_p - sine * on_q
        A[q, i] = sine * on_p + cosine * on_q
    A[p, q] = A[q, p] = 0.0
