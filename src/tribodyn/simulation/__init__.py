"""From a case to a dataset: build the problem, integrate it, gather what a user asks for."""

from __future__ import annotations

from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from tribodyn.core.errors import InputError, TribodynError
from tribodyn.integrate import INTERRUPTED
from tribodyn.simulation.compilation import Simulator, compile_elsewhere, from_parent, loaded
from tribodyn.simulation.journal import journals, simulate_journal
from tribodyn.simulation.vsv import mechanism, simulate_vsv
from tribodyn.simulation.vsv_wear import simulate_vsv_wear

if TYPE_CHECKING:
    import xarray as xr

    from tribodyn.cases.case import Case

SIMULATORS: Final[dict[str, Callable[..., Any]]] = {"vsv": simulate_vsv, "journal": simulate_journal}
"""What runs each kind of case."""

MODELS: Final[dict[str, Callable[..., object]]] = {"vsv": mechanism, "journal": journals}
"""What makes of each kind of case the mechanism, its joint and its contact laws with it."""

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
        Called with the simulated time [s] after accepted steps, by the solver ``mebdf`` some ten times a
        second; in a wear campaign with the cycles of wear behind.
    stop
        Asked whenever ``progress`` is called, and several times a second while equations are compiled; when
        true the run ends there.
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
    Stopped
        If ``stop`` was true before anything was computed.
    """
    simulator = _simulator(case)
    prepare(case, stop)
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


def prepare(case: Case, stop: Callable[[], bool] | None = None) -> None:
    """Have the equations of a case compiled, if they are not, and load them; ``stop`` as for `simulate`."""
    simulator = _simulator(case)
    if not loaded(case, simulator):
        compile_elsewhere(case, stop)
        loaded(case, simulator)


def check(case: Case, *, deep: bool = False) -> None:
    """Find out without running it what a run of a case would refuse.

    Parameters
    ----------
    case
        The case. Its mechanism is put together, with the tables of its contact laws.
    deep
        Whether its equations are compiled too, if they are not yet, its start is found and the first step
        taken.

    Raises
    ------
    InputError
        What the run would raise.
    TribodynError
        If the run would fail at its first step.
    """
    simulator = _simulator(case)
    MODELS[case.case](case)
    if not deep:
        return
    prepare(case)
    failure = simulator(case, stop=lambda: True).attrs["failure"]
    if failure not in ("", INTERRUPTED):
        raise TribodynError(f"a run fails at its first step: {failure}")


def load_equations(case: Case) -> None:
    """Load the equations of a case if they are compiled."""
    loaded(case, _simulator(case))


def compile_for_parent() -> None:
    """Compile the case that the parent process hands over into numba's cache: the first step does."""
    from tribodyn.cases import parse_case

    case = parse_case(from_parent(), "case")
    _simulator(case)(case, stop=lambda: True)


__all__ = [
    "CAMPAIGNS",
    "MODELS",
    "SIMULATORS",
    "check",
    "compile_for_parent",
    "load_equations",
    "prepare",
    "simulate",
]
