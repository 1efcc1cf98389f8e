"""Derive the coefficients of the MEBDF in exact arithmetic and write them as a kernel module.

The extended formula with k back values is sought in backward differences of y at t_{n+1},

    Σ_{m=1}^{k} (b_0/m + b_1 H_m) ∇^m y_{n+1} = h (b_0 f_{n+1} + b_1 f_{n+2}),

because h f_{n+1} = Σ ∇^m y_{n+1}/m and h f_{n+2} = Σ H_m ∇^m y_{n+1} + … (the generating functions of
differentiation at the last point and one step beyond). Two conditions fix b_0 and b_1: the coefficient
of y_{n+1}, Σ_m (b_0/m + b_1 H_m), is one, and the term ∇^{k+1} cancels, b_0/(k+1) + b_1 H_{k+1} = 0. The
order is k + 1.

Cash (1983), Computers & Mathematics with Applications 9, 645; Hairer & Wanner, Solving ODEs II, V.3.

    python scripts/derive_mebdf.py          # check the order conditions and rewrite the module
"""

from __future__ import annotations

from fractions import Fraction
from math import comb
from pathlib import Path

MAX_K = 7
TARGET = Path(__file__).parents[1] / "packages" / "mebdf" / "src" / "mebdf" / "kernels" / "coefficients.py"


def harmonic(k: int) -> Fraction:
    """Return H_k."""
    return sum((Fraction(1, j) for j in range(1, k + 1)), Fraction(0))


def extended(k: int) -> tuple[Fraction, Fraction]:
    """Return b_0 and b_1 of the extended formula with k back values."""
    # Σ_{m≤k} H_m = (k + 1) H_k − k
    ratio = -1 / ((k + 1) * harmonic(k + 1))
    b_0 = 1 / (harmonic(k) + ratio * ((k + 1) * harmonic(k) - k))
    return b_0, ratio * b_0


def differences(k: int) -> list[Fraction]:
    """Return b_0/m + b_1 H_m for m = 1 … k."""
    b_0, b_1 = extended(k)
    return [b_0 / m + b_1 * harmonic(m) for m in range(1, k + 1)]


def check_order(k: int) -> None:
    """Check in exact arithmetic that monomials up to degree k + 1 satisfy the formula."""
    b_0, b_1 = extended(k)
    for degree in range(k + 2):
        left = Fraction(0)
        for m, weight in enumerate(differences(k), start=1):
            # ∇^m of t^degree at t = 0 with step one
            left += weight * sum((-1) ** j * comb(m, j) * Fraction(-j) ** degree for j in range(m + 1))
        slope_here = Fraction(int(degree == 1))
        slope_next = Fraction(degree)
        assert left == b_0 * slope_here + b_1 * slope_next, (k, degree)


def literal(rows: list[list[Fraction]]) -> str:
    """Return rows as source text, each number with its exact fraction beside it."""
    lines = []
    for row in rows:
        numbers = ", ".join(
            f"{x.numerator} / {x.denominator}" if x.denominator != 1 else f"{x}.0" for x in row
        )
        lines.append(f"        [{numbers}],")
    return "\n".join(lines)


def module() -> str:
    """Return the text of the kernel module."""
    history = [[Fraction(0)] * MAX_K]
    bdf_history = [[Fraction(0)] * MAX_K]
    scalars = [[Fraction(0)] * 4]
    for k in range(1, MAX_K + 1):
        check_order(k)
        weights = differences(k)
        partial = [sum(weights[:i], Fraction(0)) for i in range(k)]
        history.append([1 - a for a in partial] + [Fraction(0)] * (MAX_K - k))
        bdf_history.append([1 - harmonic(i) / harmonic(k) for i in range(k)] + [Fraction(0)] * (MAX_K - k))
        b_0, b_1 = extended(k)
        scalars.append([1 / harmonic(k), b_0, b_1, 1 / ((k + 1) * harmonic(k))])
    return TEMPLATE.format(
        scalars=literal(scalars), bdf=literal(bdf_history), history=literal(history), k=MAX_K
    )


TEMPLATE = '''"""Coefficients of the MEBDF in backward-difference form.

Written by ``scripts/derive_mebdf.py`` in exact arithmetic, where the derivation stands; do not edit. Row
``k`` belongs to the method with ``k`` back values, of order k + 1; row 0 is unused.
"""

from __future__ import annotations

from typing import Final

import numpy as np

MAX_K: Final = {k}

SCALARS: Final = np.array(
    [
{scalars}
    ]
)
"""β = 1/H_k, b_0, b_1, and the error constant 1/((k + 1) H_k) of the BDF of stage 1; shape (k, 4)."""

BDF_HISTORY: Final = np.array(
    [
{bdf}
    ]
)
"""1 − H_i/H_k: weights of ∇^i y_n in stages 1 and 2, shape (k, MAX_K)."""

EXTENDED_HISTORY: Final = np.array(
    [
{history}
    ]
)
"""1 − Σ_(m≤i) (b_0/m + b_1 H_m): weights of ∇^i y_n in stage 3, shape (k, MAX_K)."""
'''


def main() -> None:
    """Write the module."""
    TARGET.write_text(module(), encoding="utf-8")


if __name__ == "__main__":
    main()
