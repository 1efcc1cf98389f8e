"""Springs in results: force, length and stored energy, from the motion of their ends; key results of each."""

from collections.abc import Callable
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.mechanism.assembly.output_values import Motion, observing
from tribodyn.mechanism.frames import GROUND
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.model.output_declarations import OutputKeys
from tribodyn.mechanisms.mechanism_protocol import ByPart, plain
from tribodyn.results.reading import column, entries, settled
from tribodyn.results.summary import KeyResult


def spring_columns(case: MechanismCase, motion: Motion) -> dict[str, FloatArray]:
    """Return force [N], length [m] and energy [J] of springs, shape (n_t, n_springs); nothing without any."""
    found = []
    for name, spring in case.springs.items():
        ends = list(zip(spring.between, spring.points, strict=True))
        (body, point), (reference, other) = ends if ends[0][0] != GROUND else ends[::-1]
        keys = OutputKeys(
            body=body, reference=reference, quantity="distance", point=point, reference_point=other
        )
        observed = observing(case, name, keys)
        length = observed.value(observed.components(motion))
        longer = length - (spring.drawn_length if spring.length is None else spring.length)
        force = spring.stiffness * longer + spring.damping * observed.rate(motion)
        found.append((-force, length, 0.5 * spring.stiffness * longer**2))
    names = ("spring_force", "spring_length", "spring_energy")
    return {
        name: np.stack(parts, axis=1) for name, parts in zip(names, zip(*found, strict=True), strict=False)
    }


def _number(
    label: str, unit: str, meaning: str, variable: str, reduce: Callable[[FloatArray], float]
) -> ByPart:
    """Return a number of each spring."""

    def made(spring: str) -> KeyResult:
        def compute(dataset: xr.Dataset) -> float:
            k = [plain(str(name)) for name in entries(dataset, "spring")].index(plain(spring))
            return float(reduce(settled(dataset, column(dataset, variable)[:, k])))

        return KeyResult(label, unit, "Springs", meaning, compute).of_part(spring)

    return made


#: Key results of each spring, by what stands before its name.
BY_SPRING: Final[dict[str, ByPart]] = {
    "spring_push_max_N": _number(
        "Push, peak",
        "N",
        "Largest force that pushes its ends apart.",
        "spring_force",
        lambda force: max(np.max(force), 0.0),
    ),
    "spring_pull_max_N": _number(
        "Pull, peak",
        "N",
        "Largest force that pulls its ends together.",
        "spring_force",
        lambda force: max(np.max(-force), 0.0),
    ),
    "spring_length_min_mm": _number(
        "Length, least", "mm", "Shortest it gets.", "spring_length", lambda length: 1e3 * np.min(length)
    ),
    "spring_length_max_mm": _number(
        "Length, peak", "mm", "Longest it gets.", "spring_length", lambda length: 1e3 * np.max(length)
    ),
    "spring_energy_max_J": _number(
        "Energy, peak", "J", "Largest energy that it stores.", "spring_energy", np.max
    ),
}
