"""Constants of the MEBDF, read from its source."""

from __future__ import annotations

from functools import partial
from typing import Final

from measures.base import Numbers
from mebdf.consistent import UNCHANGED
from mebdf.index import FREQUENCIES
from mebdf.jacobian import LARGEST_IN_CORE
from mebdf.kernels import acceptance, control, core, matrix, state
from mebdf.kernels.state import Settings
from tribodyn.papers.cheng_2022.runs import Runs

#: Constants by name, as fractions where no unit is given.
CONSTANTS: Final[dict[str, float]] = {
    "share of the tolerance": Settings.tight,
    "error that shortens a step": Settings.early,
    "steps beyond k": Settings.wait,
    "largest growth": Settings.largest_growth,
    "largest growth, one back value": Settings.largest_growth**2,
    "least growth with mass [%]": 100.0 * (state.LEAST_GROWTH_WITH_MASS - 1.0),
    "reluctance after a failure": Settings.shrink,
    "change that renews the matrix [%]": 100.0 * Settings.same_matrix,
    "steps that renew the matrix": Settings.renew,
    "steps that renew the Jacobian": Settings.old_jacobian,
    "steps that keep a rate": Settings.unsure,
    "slow rate": Settings.slow,
    "slowest rate": state.SLOWEST,
    "evaluations over rate": state.EVALUATIONS,
    "price": state.PRICE,
    "least price": state.LEAST_PRICE,
    "change of stage 2": Settings.larger_change,
    "least error beside stage 2": Settings.no_change,
    "error that ends with stage 1": Settings.straight,
    "doubtful residual": Settings.doubtful,
    "tiny correction": Settings.tiny,
    "share left that proves": acceptance.PROVED,
    "share left that refutes": acceptance.REFUTED,
    "trusted growth": acceptance.TRUSTED,
    "negligible residual": acceptance.NOTHING,
    "step after a refuted Jacobian": Settings.failed_newton,
    "most cautious steps": control.MOST_CAUTION,
    "failures before a look back": control.TROUBLE / control.VAIN,
    "narrow": acceptance.NARROW,
    "most failures": core.MOST_VAIN,
    "most calls": core.MOST_CALLS,
    "least progress": core.LEAST_PROGRESS,
    "change left alone": UNCHANGED,
    "largest inverse": matrix.LARGEST_INVERSE,
    "largest in core": LARGEST_IN_CORE,
    "least frequency": float(FREQUENCIES[0]),
    "largest frequency": float(FREQUENCIES[-1]),
}


def shown(runs: Runs, value: float) -> str:
    """Return a constant as text."""
    return f"{value:.3g}".replace("e-0", "e-").replace("e+0", "e")


#: Numbers by name.
NUMBERS: Final[Numbers] = {f"MEBDF: {name}": partial(shown, value=value) for name, value in CONSTANTS.items()}
