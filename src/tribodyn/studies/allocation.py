"""The cheapest tolerances with which limits on key results are kept with a stated probability.

The case is simulated at samples over the widest tolerances. Each number becomes a quadratic of the scattering
keys, with the rest as noise; what it misses of points left out is measured. The probability of a choice is
counted over the same many samples for all choices. Of steps, choices are tried in the order of their cost, so
the first that keeps the limits is the cheapest; of curves, the cost is minimised by SciPy. The case is then
simulated anew with the tolerances chosen, which confirms the probability, or improves the quadratics.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final, Unpack

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases import Case, Key
from tribodyn.cases.units import from_si
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import AnyCase, case_of
from tribodyn.results.store import write_text
from tribodyn.studies.differences import DIGITS, numbers_of
from tribodyn.studies.plan import Axis, plan_of
from tribodyn.studies.quadratic_model import Choice, QuadraticModel, Scattering, are_kept
from tribodyn.studies.sampling import SAMPLERS
from tribodyn.studies.search import Limit, limit, readable
from tribodyn.studies.statistics import Share, share_of
from tribodyn.studies.sweep import SILENT, Means, Watcher, Where, run
from tribodyn.studies.tolerances import Tolerance, read_tolerances

#: Probabilities for which the least cost is given beside the one asked for.
FRONT: Final = (0.9, 0.95, 0.99, 0.997, 0.999)
CHOSEN: Final = "chosen.toml"  #: Case file of the choice.
_ROUNDS: Final = 3  #: Times that the quadratics are made, with all that has been simulated.


@dataclass(frozen=True)
class Allocation:
    """The cheapest tolerances, and what they rest on."""

    #: What was asked.
    limits: tuple[Limit, ...]
    tolerances: tuple[Tolerance, ...]
    chosen: Choice  #: The cheapest choice.
    confirmed: Share  #: Share of fresh simulations that keep all limits, with its interval.
    #: Part of the variance of each limited number that each tolerance causes alone, shape (n_limits,
    #: n_tolerances).
    contributions: FloatArray
    #: The cheapest choice for each of :data:`FRONT` that can be reached.
    front: tuple[tuple[float, Choice], ...]
    #: Part of the spread of each number that its quadratic misses at points left out, shape (n_limits,).
    missed: FloatArray
    simulations: int  #: How many there were.


def allocate(
    case: AnyCase,
    limits: Sequence[str],
    probability: float,
    cost: str | Path,
    *,
    samples: int = 500,
    directory: str | Path | None = None,
    watcher: Watcher = SILENT,
    **where: Unpack[Where],
) -> Allocation:
    """Return the cheapest tolerances with which limits are kept with a probability.

    Parameters
    ----------
    case
        A case, a :class:`tribodyn.Mechanism`, the name of a built-in case, or a file.
    limits
        ``"NAME=MOST"`` and ``"NAME>=LEAST"``, in the unit of the number; all must be kept together.
    probability
        Of a machine that keeps them.
    cost
        File of the tolerances, see :mod:`tribodyn.studies.tolerances`.
    samples
        Fresh simulations that confirm the choice.
    directory, watcher, **where
        Where runs are kept and computed, as for :func:`sweep`; who listens and may stop them.

    Returns
    -------
    Allocation
        The choice with its cost, and the simulations that confirm it.

    Raises
    ------
    InputError
        A limit, a probability, a tolerance or a cost cannot be.
    TribodynError
        A run failed, a number is no quadratic of the keys, or no choice keeps the limits.

    Examples
    --------
    >>> from tribodyn.studies import allocate
    >>> allocate("slider-crank", ["error_rms_um_slider=40"], 0.99, "costs.toml")  # doctest: +SKIP
    """
    chosen = case_of(case)
    if not 0.0 < probability < 1.0:
        raise InputError(f"given {probability:g}; allowed: above 0 and below 1", key="--probability")
    asked = tuple(limit(text, chosen, "--limit") for text in limits)
    means = Means(**where, keep_results=False)
    tolerances = read_tolerances(cost, chosen)
    runs = _Runs(chosen, asked, tolerances, None if directory is None else Path(directory))
    runs.simulate(runs.design(), means, watcher)
    for seed in range(_ROUNDS):
        model = runs.model()
        best = model.cheapest(probability)
        scatter = runs.scattering.draw("lhs", samples, 1000 + seed)
        fresh = runs.simulate(runs.scattering.deviations(scatter, best.widths), means, watcher)
        share = share_of(np.where(are_kept(fresh, asked), 0.0, 1.0), 0.0, sampled=True)
        error = math.sqrt(best.probability * (1.0 - best.probability) / samples)
        if abs(share.within / share.points - best.probability) <= 2.0 * error:
            break
    if directory is not None:
        write_text(Path(directory) / CHOSEN, _as_case(chosen, tolerances, best))
    front = tuple((each, one) for each in FRONT if (one := model.known(each)) is not None)
    parts = model.contributions(best.widths)
    return Allocation(asked, tolerances, best, share, parts, front, model.missed, len(runs.numbers))


def _as_case(case: Case, tolerances: tuple[Tolerance, ...], choice: Choice) -> str:
    """Return the case file of a choice: its tolerances in comments, then the case."""
    lines = (
        f"# {one.name}: {label}; {one.key.path} scatters over {from_si(width * abs(one.share), one.key.unit)}"
        for one, label, width in zip(tolerances, choice.labels, choice.widths, strict=True)
    )
    return "\n".join([*lines, case.to_toml()])


class _Runs:
    """The case at deviations of its keys; all that was simulated is kept."""

    def __init__(
        self, case: Case, limits: tuple[Limit, ...], tolerances: tuple[Tolerance, ...], directory: Path | None
    ) -> None:
        self._case, self._limits, self._directory = case, limits, directory
        self._keys: list[Key] = list({one.key.path: one.key for one in tolerances}.values())
        acts = np.array([[one.key.path == key.path for key in self._keys] for one in tolerances], dtype=float)
        self.scattering = Scattering(tolerances, acts)
        self.deviations = np.zeros((0, len(self._keys)))
        self.numbers = np.zeros((0, len(limits)))

    def design(self) -> FloatArray:
        """Return deviations that fill the widest tolerances [SI], shape (n, n_keys)."""
        n = len(self._keys)
        terms = (n + 1) * (n + 2) // 2
        return (2.0 * SAMPLERS["lhs"](2 * terms + 8, n, 0) - 1.0) * self.scattering.span

    def model(self) -> QuadraticModel:
        """Return the numbers as quadratics, from all that was simulated."""
        return QuadraticModel(self.scattering, self._limits, self.deviations, self.numbers)

    def simulate(self, deviations: FloatArray, means: Means, watcher: Watcher) -> FloatArray:
        """Return the limited numbers at deviations of the keys, shape (n, n_limits)."""
        columns = {}
        for key, of_key in zip(self._keys, deviations.T, strict=True):
            values = (readable(self._case.at(key.path) + one, DIGITS) for one in of_key)
            columns[key] = tuple(values)
        found = run(plan_of(self._case, (Axis("run", columns),)), self._directory, means, watcher)
        numbers = np.column_stack([numbers_of(found, one.name) for one in self._limits])
        self.deviations = np.vstack([self.deviations, deviations])
        self.numbers = np.vstack([self.numbers, numbers])
        return numbers
