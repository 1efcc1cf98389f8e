"""What a worker makes of a case: the body of a frame, or a file to download."""

from __future__ import annotations

import json
import tempfile
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from tribodyn.workbench import frame

if TYPE_CHECKING:
    import xarray as xr

    from tribodyn.cases.case import Case

Progress = Callable[[float], None]
Stop = Callable[[], bool]


class Interrupted(Exception):
    """The run was stopped before its end."""


def picture(case: Case, order: Mapping[str, Any], progress: Progress, stop: Stop) -> bytes:
    """Run a case and return the body of its frame.

    Parameters
    ----------
    case
        What is run.
    order
        With ``told``, which goes into the header as it is.
    progress, stop
        As for :func:`tribodyn.simulate`.

    Raises
    ------
    Interrupted
        ``stop`` was true before the end.
    """
    began = time.perf_counter()
    found = shown(_simulated(case, progress, stop))
    return frame.body({**order["told"], **found, "seconds": time.perf_counter() - began})


def shown(dataset: xr.Dataset) -> dict[str, Any]:
    """Return what the page shows of a result; sections hold exactly what they hold in a report."""
    from tribodyn.mechanisms.results import known, mechanism_of, summarise
    from tribodyn.views.playback import clock

    summary = summarise(dataset)
    return {
        "headlines": {name: summary[name] for name in known(summary, str(summary["kind"]))},
        **{name: summary[name] for name in ("failure", "doubtful", "warnings", "notes")},
        "time_reached": float(dataset.attrs.get("time_reached", 0.0)),
        "events": _events(dataset),
        "clock": clock(dataset),
        "sections": {
            section.name: payload
            for chapter in mechanism_of(dataset).chapters
            for section in chapter.sections
            if (payload := section.payload(dataset)) is not None
        },
    }


def _events(dataset: xr.Dataset) -> dict[str, Any]:
    """Return when the motion turns around, and when impacts follow [s]."""
    from tribodyn.views.events import impact_time, reversal_times

    turns = [float(turn) for turn in reversal_times(dataset)]
    settling, end = impact_time(dataset), float(dataset.attrs.get("time_reached", 0.0))
    begins = [0.0, *turns] if settling > 0.0 else []
    return {"reversals": turns, "impacts": [[begin, min(begin + settling, end)] for begin in begins]}


def result(case: Case, order: Mapping[str, Any], progress: Progress, stop: Stop) -> bytes:
    """Run a case and return its result as NetCDF."""
    from tribodyn.results import netcdf_content

    return bytes(netcdf_content(_simulated(case, progress, stop)))


def report(case: Case, order: Mapping[str, Any], progress: Progress, stop: Stop) -> bytes:
    """Run a case and return its report."""
    from tribodyn.report.page import render

    dataset = _simulated(case, progress, stop)
    with tempfile.TemporaryDirectory() as nothing:
        return render(dataset, (), Path(nothing)).encode("utf-8", "replace")


def load(case: Case, order: Mapping[str, Any], progress: Progress, stop: Stop) -> bytes:
    """Load the equations of a case and tell in JSON whether they are compiled."""
    from tribodyn.simulation import load_equations

    return json.dumps(load_equations(case)).encode()


def prepared(case: Case, order: Mapping[str, Any], progress: Progress, stop: Stop) -> bytes:
    """Have the equations of a case compiled, if they are not, and load them."""
    from tribodyn.simulation import prepare

    prepare(case, stop)
    return b""


def _simulated(case: Case, progress: Progress, stop: Stop) -> xr.Dataset:
    from tribodyn.simulation import simulate

    dataset = simulate(case, progress=progress, stop=stop)
    if dataset.attrs["failure"] and stop():
        raise Interrupted
    return dataset


WORK: Final = {
    "picture": picture,
    "result.nc": result,
    "report.html": report,
    "load": load,
    "prepare": prepared,
}
"""Everything that a worker does, by name."""
