"""From a case to a dataset: build the problem, integrate it, gather what a user asks for."""

from __future__ import annotations

from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from tribodyn.core.errors import InputError
from tribodyn.simulation.compilation import Simulator, compile_elsewhere, loaded
from tribodyn.simulation.journal import simulate_journal
from tribodyn.simulation.vsv import simulate_vsv
from tribodyn.simulation.vsv_wear import simulate_vsv_wear

if TYPE_CHECKING:
    import xarray as xr

    from tribodyn.cases.case import Case

SIMULATORS: Final[dict[str, Callable[..., Any]]] = {"vsv": simulate_vsv, "journal": simulate_journal}
"""What runs each kind of case."""

CAMPAIGNS: Final[dict[str, Callable[..., Any]]] = {"vsv": simulate_vsv_wear}
"""What runs a wear campaign of each kind of case that has one."""


def simulate(
    case: Case,
    *,
    progress: Callable[[float], None] | None = None,
    stop: Callable[[], bool] | None = None,
    checkpoint: str | PathLike[str] | None = None,
) -> xr.Dataset:
    """Simulate a case.

    Parameters
    ----------
    case
        From :func:`tribodyn.load_case`.
    progress
        Called with the simulated time [s] after every accepted step; in a wear campaign with the cycles
        of wear behind.
    stop
        Asked after every accepted step; when true the run ends there.
    checkpoint
        File in which a wear campaign is kept after every jump, and from which it goes on if the file is
        there. It stays when the campaign is over. Other runs do not use it.

    Returns
    -------
    xarray.Dataset
        See the manual's page on results. A run that stopped before its end says why in the attribute
        ``failure`` and holds what was computed.

    Raises
    ------
    InputError
        If the case asks for something that cannot be.
    """
    simulator = _simulator(case)
    prepare(case)
    dataset: xr.Dataset
    if case.campaign_cycles > 0:
        kept = None if checkpoint is None else Path(checkpoint)
        dataset = CAMPAIGNS[case.case](case, progress=progress, stop=stop, checkpoint=kept)
    else:
        dataset = simulator(case, progress=progress, stop=stop)
    return dataset


def _simulator(case: Case) -> Simulator:
    kind: str = getattr(case, "case", "")
    if kind not in SIMULATORS:
        raise InputError(f"given {kind!r}; allowed: {', '.join(SIMULATORS)}", key="case")
    return SIMULATORS[kind]


def prepare(case: Case) -> None:
    """Have the equations of a case compiled, if they are not, and load them."""
    simulator = _simulator(case)
    if not loaded(case, simulator):
        compile_elsewhere(case)
        loaded(case, simulator)


def load_equations(case: Case) -> None:
    """Load the equations of a case if they are compiled."""
    loaded(case, _simulator(case))


def compile_case(toml: str) -> None:
    """Compile the equations of a case, given as TOML, and leave them in numba's cache: a few steps do."""
    from tribodyn.cases import parse_case

    case = parse_case(toml, "case")
    _simulator(case)(case, stop=lambda: True)


__all__ = ["CAMPAIGNS", "SIMULATORS", "compile_case", "load_equations", "prepare", "simulate"]
