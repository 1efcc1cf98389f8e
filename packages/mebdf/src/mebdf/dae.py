"""Implicit equations F(t, y, y') = 0 by a function of their own."""

from collections.abc import Callable, Sequence
from typing import Any

from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp

from mebdf.solver import MEBDF


def solve_dae(
    F: Callable[..., Any],
    t_span: Sequence[float],
    y0: ArrayLike,
    yp0: ArrayLike,
    *,
    args: tuple[Any, ...] = (),
    jac: Callable[..., Any] | None = None,
    **options: Any,
) -> Any:
    """Integrate the implicit equation F(t, y, y') = 0.

    Parameters
    ----------
    F
        ``F(t, y, yp, *args)``: residual, shape (n,).
    t_span
        Start and end.
    y0, yp0
        Values and slopes at the start, shape (n,) each. What F determines of the slopes is found, and
        algebraic values of index 1 are, too.
    args
        Further arguments of ``F`` and ``jac``.
    jac
        ``jac(t, y, yp, *args)``: ∂F/∂y and ∂F/∂y', shape (n, n) each; ``None`` for differences.
    options
        All others of `scipy.integrate.solve_ivp` and of `MEBDF`, such as ``t_eval``, ``rtol`` and ``index``.
        Events are functions of (t, y) alone.

    Returns
    -------
    scipy.integrate.OdeResult
        What ``solve_ivp`` returns.

    Examples
    --------
    A decay whose rate is the root of a cubic equation, s³ + s + y = 0:

    >>> from mebdf import solve_dae
    >>> solution = solve_dae(lambda t, y, yp: yp**3 + yp + y, (0.0, 5.0), [2.0], [0.0], rtol=1e-6)
    >>> solution.success
    True
    >>> print(f"{solution.y[0, -1]:.4f}")
    0.0302
    """
    given = None if jac is None else lambda t, y, yp: jac(t, y, yp, *args)
    integrate: Any = solve_ivp  # whose types know nothing of `slope`
    return integrate(
        lambda t, y, yp: F(t, y, yp, *args), t_span, y0, method=MEBDF, slope=yp0, jac=given, **options
    )
