"""Contribution of each joint to the error of an output.

The case is simulated with all its clearances, and once for each of them with every other joint ideal. With
the error e of the whole, the error eₖ with joint k alone, and ⟨·,·⟩ the mean of a product over time (of
several cycles without the first),

    1 = Σ ⟨eₖ, e⟩ / ⟨e, e⟩ + interaction.

A share is the part of the mean square error that varies together with the error of that joint (a variance is
divided into covariances in the same way); it is below zero for a joint that compensates others. The
interaction is what joints cause only together. Elastic bodies count as one joint more: they are rigid where
a joint is alone, and alone where all joints are ideal.

Beside it stands the estimate by superposition, which takes one kinematic analysis: smooth, rigid surfaces,
every shaft against one side of its bore.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, Unpack

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from tribodyn.cases import Case, keys_in
from tribodyn.core.errors import InputError, TribodynError
from tribodyn.mechanisms.catalogue import AnyCase, case_of
from tribodyn.mechanisms.results import read
from tribodyn.results.reading import column, settled
from tribodyn.results.store import POINTS
from tribodyn.results.variables import ERROR_UNITS
from tribodyn.simulation import simulate
from tribodyn.studies.archive import refuse_failures
from tribodyn.studies.plan import Axis, SweepPlan, plan_of
from tribodyn.studies.sweep import SILENT, Means, Watcher, Where, run

_SWITCH: Final = "joints.{}.clearance.ideal"
BENDING: Final = "elastic bodies"  #: In the place of a joint, what bends with all joints ideal.


@dataclass(frozen=True)
class OutputShares:
    """Parts of the error of an output."""

    output: str  #: Its name.
    unit: str  #: Unit of the errors, as they are shown.
    joints: tuple[str, ...]  #: Names of the joints with clearance, and ``BENDING`` where bodies are elastic.
    #: Root mean square error with each of these joints alone, in that unit, shape (n_joints,).
    alone: FloatArray
    together: float  #: The same with all.
    shares: FloatArray  #: Part of the mean square error that each joint causes [1], shape (n_joints,).
    #: Root mean square error with all joints by superposition, in that unit; NaN where there is none.
    estimated: float
    estimate: FloatArray  #: Part of its mean square that each joint causes [1], shape (n_joints, n_causes).
    #: What that is divided into: clearance, tilt, friction; empty without an estimate.
    causes: tuple[str, ...]

    @property
    def interaction(self) -> float:
        """Part of the mean square error that joints cause together only [1]."""
        return 1.0 - float(np.sum(self.shares))


def contributions(
    case: AnyCase, *, directory: str | Path, watcher: Watcher = SILENT, **where: Unpack[Where]
) -> tuple[OutputShares, ...]:
    """Return the parts of the error of each output of a case by its joints.

    Parameters
    ----------
    case
        A case with outputs and joints with clearance, the name of a built-in one, or a file.
    directory, watcher, **where
        Where runs are kept and computed, as for :func:`sweep`; who listens and may stop them.

    Returns
    -------
    tuple of OutputShares
        One for each output with an ideal value; its shares have the shape (n_joints,) and, with the
        interaction, add up to one.

    Raises
    ------
    InputError
        The case has no outputs, or no joint with clearance.
    TribodynError
        A run failed, or no output has an ideal value.

    Examples
    --------
    >>> from tribodyn.studies import contributions
    >>> [shares] = contributions("slider-crank", directory="shares")  # doctest: +SKIP
    >>> shares.shares  # doctest: +SKIP
    array([1.])
    """
    chosen = case_of(case)
    switches = real_joints(chosen)
    means = Means(**where, keep_results=True)

    def simulated(one: Case, real: NDArray[np.bool_]) -> list[xr.Dataset]:
        """Return results with some joints real, ``real`` of shape (n_runs, n_joints)."""
        plan = _plan(one, switches, real)
        refuse_failures(run(plan, Path(directory), means, watcher))
        return [read(Path(directory) / POINTS / point.name) for point in plan.points]

    every, each = np.ones(len(switches), bool), np.eye(len(switches), dtype=bool)
    joints, rigid = (*switches,), chosen.rigid()
    if rigid is None:
        whole, *alone = simulated(chosen, np.vstack([every, each]))
    else:
        whole, bent = simulated(chosen, np.vstack([every, ~every]))
        joints, alone = (*switches, BENDING), [*simulated(rigid, each), bent]
    ideal = _kinematic(chosen)
    shares = [_shares_of(str(output), whole, alone, joints, ideal) for output in whole["output"].values]
    known = tuple(one for one in shares if np.isfinite(one.together))
    if not known:
        raise TribodynError("no output has an ideal value that it could be compared with")
    return known


def real_joints(case: Case) -> dict[str, str]:
    """Return the joints with clearance, and the gears with backlash, of a case with outputs.

    Each name has the path of the key that makes it ideal.

    Raises InputError if it has no outputs, or fewer joints than could share the error.
    """
    if not getattr(case, "outputs", None):
        words = "the case has no output whose error could be divided; write one, such as outputs.NAME.body"
        raise InputError(words, key="outputs")
    joints: Mapping[str, Any] = getattr(case, "joints", {})
    if not joints:
        raise InputError("the case has one joint with clearance, which causes all of the error", key="case")
    found = {name: _SWITCH.format(name) for name, joint in joints.items() if joint.real is not None}
    elements = getattr(case, "elements", tuple)
    found |= {name: f"{table}.{name}.ideal" for table, name, keys in elements() if keys.has_play}
    if not found:
        raise InputError("no joint has clearance; write joints.NAME.clearance", key="joints")
    return found


def _plan(case: Case, joints: Mapping[str, str], real: NDArray[np.bool_]) -> SweepPlan:
    """Return the plan of the runs with some joints real."""
    keys = keys_in(case)
    ideal = (~real).T.tolist()
    columns = {keys[path]: tuple(one) for path, one in zip(joints.values(), ideal, strict=True)}
    return plan_of(case, (Axis("run", columns),))


def _kinematic(case: Case) -> xr.Dataset | None:
    """Return the kinematic analysis of a case; None where it has none."""
    try:
        return simulate(case.replace({"run.analysis": "kinematic", "run.directions": "forward"}))
    except InputError:
        return None


def _estimated(output: str, joints: tuple[str, ...], ideal: xr.Dataset | None) -> tuple[float, FloatArray]:
    """Return the root mean square error by superposition [SI], and its shares, (n_joints, n_causes)."""
    real = [one for one in joints if one != BENDING]
    if ideal is None or ideal.attrs["failure"] or not set(real) <= set(ideal["joint"].values.tolist()):
        return math.nan, np.zeros((len(joints), 0))
    known = ideal["error_estimate"].sel(output=output)
    parts = known.sel(joint=real).values
    if BENDING in joints:
        # Of the joints between the pieces of elastic bodies.
        parts = np.hstack([parts, known.drop_sel(joint=real).values.sum(axis=1, keepdims=True)])
    time, total = column(ideal, "time"), parts.sum(axis=(1, 2))
    square = _mean(time, total * total)
    found = [[_mean(time, one * total) / square for one in of_joint.T] for of_joint in parts.swapaxes(0, 1)]
    return math.sqrt(square), np.array(found)


def _shares_of(
    output: str,
    whole: xr.Dataset,
    alone: Sequence[xr.Dataset],
    joints: tuple[str, ...],
    ideal: xr.Dataset | None,
) -> OutputShares:
    time, error = settled(whole, column(whole, "time")), settled(whole, _error(whole, output))
    errors = [np.interp(time, column(one, "time"), _error(one, output)) for one in alone]
    square = _mean(time, error * error)
    unit = ERROR_UNITS[str(whole["output_unit"].sel(output=output).values)]
    estimated, estimate = _estimated(output, joints, ideal)
    return OutputShares(
        output,
        unit.shown,
        joints,
        unit.scale * np.array([np.sqrt(_mean(time, one * one)) for one in errors]),
        unit.scale * float(np.sqrt(square)),
        np.array([_mean(time, one * error) / square for one in errors]),
        unit.scale * estimated,
        estimate,
        () if ideal is None else tuple(ideal["cause"].values.tolist())[: estimate.shape[1]],
    )


def _error(result: xr.Dataset, output: str) -> FloatArray:
    return np.asarray(result["output_error"].sel(output=output).values, dtype=np.float64)


def _mean(time: FloatArray, values: FloatArray) -> float:
    return float(np.trapezoid(values, time) / (time[-1] - time[0]))
