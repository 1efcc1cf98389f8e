"""From a case to a dataset: build its system, integrate it, gather what a user asks for."""

from __future__ import annotations

from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, cast

from tribodyn.core.errors import InputError
from tribodyn.mechanisms.base import Part, SystemCase
from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.simulation.compilation import compile_elsewhere, loaded
from tribodyn.simulation.session import Progress, Session, Stop
from tribodyn.simulation.wear import simulate_campaign, simulate_plain

if TYPE_CHECKING:
    import xarray as xr

    from tribodyn.cases.base import Case


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
    prepare(case)
    return _simulated(case, progress, stop, None if checkpoint is None else Path(checkpoint))


def _simulated(
    case: Case, progress: Progress = None, stop: Stop = None, checkpoint: Path | None = None
) -> xr.Dataset:
    session = _session(case, progress, stop)
    if not session.mechanism.of_cycle:
        return session.dataset(session.integrated(case.duration), Part())
    return simulate_campaign(session, checkpoint) if case.campaign_cycles else simulate_plain(session)


def _session(case: Case, progress: Progress = None, stop: Stop = None) -> Session:
    kind: str = getattr(case, "case", "")
    if kind not in MECHANISMS:
        raise InputError(f"given {kind!r}; allowed: {', '.join(MECHANISMS)}", key="case")
    mechanism = MECHANISMS[kind]
    known = cast(SystemCase, case)
    return Session(known, mechanism, mechanism.system(known), progress, stop)


def _first_steps(case: Case) -> None:
    """Call every compiled function that a case needs: a few steps do."""
    session = _session(case, stop=lambda: True)
    session.dataset(session.integrated(case.duration), Part())


def prepare(case: Case) -> None:
    """Have the equations of a case compiled, if they are not, and load them."""
    if not loaded(case, _first_steps):
        compile_elsewhere(case)
        loaded(case, _first_steps)


def load_equations(case: Case) -> None:
    """Load the equations of a case if they are compiled."""
    loaded(case, _first_steps)


def compile_case(toml: str) -> None:
    """Compile the equations of a case, given as TOML, and leave them in numba's cache."""
    from tribodyn.mechanisms.catalogue import parse_case

    _first_steps(parse_case(toml, "case"))


__all__ = ["compile_case", "load_equations", "prepare", "simulate"]
