"""Constants of the MEBDF, read from its source."""

from __future__ import annotations

from functools import partial
from typing import Final

from measures.base import Numbers
from mebdf.index import FREQUENCIES
from mebdf.jacobian import LARGEST_IN_CORE
from mebdf.kernels import acceptance, control, core, matrix, newton, state
from tribodyn.papers.cheng_2022.runs import Runs


def setting(entry: int) -> float:
    """Return the default of a setting by its place in the state."""
    return float(state.DEFAULTS[entry - state.SETTINGS])


CONSTANTS: Final[dict[str, float]] = {
    "share of the tolerance": setting(state.TIGHT),
    "error that shortens a step": setting(state.EARLY),
    "steps beyond k": setting(state.WAIT),
    "largest growth": setting(state.LARGEST_GROWTH),
    "largest growth, one back value": setting(state.LARGEST_GROWTH) ** 2,
    "least growth with mass [%]": 100.0 * (state.LEAST_GROWTH_WITH_MASS - 1.0),
    "reluctance after a failure": setting(state.SHRINK),
    "change that renews the matrix [%]": 100.0 * setting(state.SAME_MATRIX),
    "steps that renew the matrix": setting(state.RENEW),
    "steps that renew the Jacobian": setting(state.OLD_JACOBIAN),
    "steps that keep a rate": setting(state.UNSURE),
    "slow rate": setting(state.SLOW),
    "slowest rate": state.SLOWEST,
    "evaluations over rate": state.EVALUATIONS,
    "price": state.PRICE,
    "least price": state.LEAST_PRICE,
    "change of stage 2": newton.LARGER_CHANGE,
    "least error beside stage 2": newton.NO_CHANGE,
    "doubtful residual": setting(state.DOUBTFUL),
    "tiny correction": setting(state.TINY),
    "share left that proves": acceptance.PROVED,
    "share left that refutes": acceptance.REFUTED,
    "trusted growth": acceptance.TRUSTED,
    "negligible residual": acceptance.NOTHING,
    "step after a refuted Jacobian": control.FAILED_NEWTON,
    "most cautious steps": control.MOST_CAUTION,
    "most failures": core.MOST_VAIN,
    "least progress": core.LEAST_PROGRESS,
    "largest inverse": matrix.LARGEST_INVERSE,
    "largest in core": LARGEST_IN_CORE,
    "least frequency": float(FREQUENCIES[0]),
    "largest frequency": float(FREQUENCIES[-1]),
}
"""Constants by name, as fractions where no unit is given."""


def shown(runs: Runs, value: float) -> str:
    """Return a constant as text."""
    return f"{value:.3g}".replace("e-0", "e-").replace("e+0", "e")


NUMBERS: Final[Numbers] = {f"MEBDF: {name}": partial(shown, value=value) for name, value in CONSTANTS.items()}
"""Numbers by name."""
