"""Numbers read off a result of a user-defined mechanism: what its key results and charts are made of."""

import math
from collections.abc import Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from tribodyn.mechanisms.mechanism_protocol import plain
from tribodyn.results.reading import column, entries, of_part
from tribodyn.views.energy_balance import EnergyBalance, EnergyTerm, energy_columns

if TYPE_CHECKING:
    import xarray as xr

_KEPT: Final = 8  #: Results of which the numbers of joints and surfaces are kept.


def lengths(vectors: FloatArray) -> FloatArray:
    """Return the lengths of vectors (..., 3)."""
    return np.asarray(np.linalg.norm(vectors, axis=-1))


def sizes(dataset: "xr.Dataset", name: str) -> FloatArray:
    """Return the lengths of the vectors of a variable over time and parts, shape (n_t, n)."""
    return lengths(column(dataset, name))


def of_joint(dataset: "xr.Dataset", joint: str) -> int:
    """Return the number of a joint, whose name may be that of a number; others raise ``KeyError``."""
    return _numbers(tuple(entries(dataset, "joint").tolist()))[plain(joint)]


@lru_cache(_KEPT)
def _numbers(joints: tuple[str, ...]) -> dict[str, int]:
    """Return the numbers of joints by their names in numbers: large results are asked for them many times."""
    return {plain(name): number for number, name in reversed([*enumerate(joints)])}


def offset(dataset: "xr.Dataset", joint: int | slice = slice(None)) -> FloatArray:
    """Return the offsets of shafts in their bores [m], shape (n_t, n_joints); (n_t,) of a single joint."""
    if isinstance(joint, int):
        across = of_part(dataset, "displacement", joint, _across)
    else:
        across = _across(column(dataset, "displacement")[:, joint])
    return np.asarray(np.where(np.isfinite(column(dataset, "clearance")[joint]), across, np.nan))


def _across(displacement: FloatArray) -> FloatArray:
    return lengths(displacement[..., :2])


def least(values: FloatArray) -> float:
    """Return the smallest finite value, NaN when there is none."""
    finite = values[np.isfinite(values)]
    return float(finite.min()) if finite.size else math.nan


NOTHING: Final = 1.0e-20  #: Size below which a number is the rounding of zero, in any unit.


def above_zero(value: float) -> float:
    """Return a number, or NaN where it is zero but for rounding, and thus not shown."""
    return value if value > NOTHING else math.nan


def of_surfaces(dataset: "xr.Dataset", joint: int) -> NDArray[np.intp]:
    """Return the numbers of the surfaces of a joint, none where it is ideal."""
    surfaces = entries(dataset, "surface").tolist() if "surface" in dataset.coords else []
    return np.array(_surfaces(tuple(surfaces)).get(str(entries(dataset, "joint")[joint]), ()), dtype=np.intp)


@lru_cache(_KEPT)
def _surfaces(names: tuple[str, ...]) -> dict[str, list[int]]:
    """Return the numbers of surfaces by the names of their joints."""
    found: dict[str, list[int]] = {}
    for number, name in enumerate(names):
        found.setdefault(name.rpartition(":")[0], []).append(number)
    return found


WHOLE: Final = EnergyBalance(
    title="Whole mechanism",
    put_in={"energy_in": "drives and loads, in", "energy_expansion": "expansion, in"},
    gained={
        "energy_kinetic": "kinetic",
        "energy_gravity": "gravity",
        "energy_stored": "stored in springs and contact",
        "energy_friction": "friction, out",
        "energy_damping": "damping, out",
        "energy_film": "oil films, out",
    },
    residual="energy_residual",
    measure=("energy_in", "energy_kinetic", "energy_gravity", "energy_stored"),
    attribute="energy_residual",
    yardstick="largest term",
)
BALANCES: Final = (WHOLE,)
TERMS: Final = {
    "energy_kinetic": EnergyTerm("energy_kinetic"),
    "energy_gravity": EnergyTerm("energy_gravity", since_start=True),
    "energy_stored": EnergyTerm("energy_stored"),
    "energy_in": EnergyTerm("work_in"),
    "energy_expansion": EnergyTerm("work_expansion"),
    "energy_friction": EnergyTerm("heat_friction"),
    "energy_damping": EnergyTerm("heat_damping"),
    "energy_film": EnergyTerm("heat_film"),
}


def balance_columns(whole: Mapping[str, FloatArray], *, oiled: bool, opening: bool) -> dict[str, FloatArray]:
    """Return the energy columns [J], each of shape (n_t,), from what is observed of the whole.

    Those of films, and of contacts that widen or follow temperatures, are left out where there are none.
    """
    left_out = {"energy_film": not oiled, "energy_expansion": not opening}
    terms = {name: term for name, term in TERMS.items() if not left_out.get(name, False)}
    return energy_columns(whole, terms, BALANCES)
