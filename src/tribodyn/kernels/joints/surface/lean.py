"""Second-order terms of the tilt of a cylinder in the derivatives of its wrench, see ``jacobian``."""

from __future__ import annotations

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.joints.columns import PITCH, RESISTANCE
from tribodyn.kernels.joints.surface.listed import FORCE, NORMAL, SLIP, TRACTION
from tribodyn.kernels.lanes import WIDTH, load, spread, total, zeros


@kernel
def add_lean(surface: Record, scratch: Record, n: int) -> None:
    """Add the second-order terms of the ``n`` nodes in the list to the derivatives."""
    work, phi, rate = scratch.listed.work, scratch.tilt.phi, scratch.tilt.rate
    mu, radius = surface.friction_coefficient, surface.lean
    xx, xy, yy = _squares(work, FORCE, 1.0, 0.0, 0.0, n)
    _add_block(-radius, xx, xy, yy, scratch.normal_place)
    for i in range(6):
        _add_pair(work, RESISTANCE, NORMAL, i, rate, -radius, n, scratch.normal_place)
    if mu > 0.0:
        for i in range(6):
            _add_pair(work, RESISTANCE, SLIP, i, rate, -mu * radius, n, scratch.friction_place)
            x, y = _sums(work, TRACTION, NORMAL + i * PITCH, phi[0], phi[1], n)
            _add_both(-radius * x, i, 3, scratch.friction_slip)
            _add_both(-radius * y, i, 4, scratch.friction_slip)
        xx, xy, yy = _squares(work, TRACTION, 0.0, phi[0], phi[1], n)
        _add_block(radius * radius, xx, xy, yy, scratch.friction_slip)


@kernel
def _add_pair(
    work: FloatArray, weight: int, left: int, i: int, v: FloatArray, factor: float, n: int, out: FloatArray
) -> None:
    """Add ``factor`` Σ w l (n·v × ẑ) ẑ × n to the entries for tilts of a row of ``out`` (6, 6)."""
    x, y = _sums(work, weight, left + i * PITCH, v[0], v[1], n)
    out[i, 3] += factor * x
    out[i, 4] += factor * y


@kernel
def _add_both(value: float, i: int, k: int, out: FloatArray) -> None:
    """Add ``value`` to an entry of ``out`` and to the one across the diagonal."""
    out[i, k] += value
    out[k, i] += value


@kernel
def _add_block(factor: float, xx: float, xy: float, yy: float, out: FloatArray) -> None:
    """Add a symmetric matrix to the entries of ``out`` (6, 6) for moments and tilts."""
    out[3, 3] += factor * xx
    out[3, 4] += factor * xy
    out[4, 3] += factor * xy
    out[4, 4] += factor * yy


@kernel
def _sums(work: FloatArray, weight: int, left: int, v_x: float, v_y: float, n: int) -> tuple[float, float]:
    """Return Σ w l (n·v × ẑ) (−n_y, n_x) over a column ``left``."""
    x, y, along_x, along_y = zeros(), zeros(), spread(v_x), spread(v_y)
    for k in range(0, n, WIDTH):
        n_x, n_y = load(work, NORMAL + k), load(work, NORMAL + PITCH + k)
        w = load(work, weight + k) * load(work, left + k) * (n_x * along_y - n_y * along_x)
        x -= w * n_y
        y += w * n_x
    return total(x), total(y)


@kernel
def _squares(
    work: FloatArray, weight: int, steady: float, v_x: float, v_y: float, n: int
) -> tuple[float, float, float]:
    """Return Σ w (steady + n·v × ẑ)² (n_y², −n_x n_y, n_x²)."""
    xx, xy, yy = zeros(), zeros(), zeros()
    constant, along_x, along_y = spread(steady), spread(v_x), spread(v_y)
    for k in range(0, n, WIDTH):
        n_x, n_y = load(work, NORMAL + k), load(work, NORMAL + PITCH + k)
        leaning = constant + n_x * along_y - n_y * along_x
        w = load(work, weight + k) * leaning * leaning
        xx += w * n_y * n_y
        xy -= w * n_x * n_y
        yy += w * n_x * n_x
    return total(xx), total(xy), total(yy)
