"""Work of a worker process of the workbench: from a case to the body of a frame, or to a file to download.

An order is JSON. A reply begins with a letter: an event, the result, a failure in words, or that the work was
stopped. Nothing is unpickled on either side.
"""

from __future__ import annotations

import json
import tempfile
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from tribodyn.core.errors import Stopped, TribodynError
from tribodyn.core.platforms import unexpected
from tribodyn.workbench import messages

if TYPE_CHECKING:
    import xarray as xr

    from tribodyn.cases.case import Case

Progress = Callable[[float], None]
Stop = Callable[[], bool]

EVENT, RESULT, FAILURE, GIVEN_UP = b"e", b"r", b"f", b"s"
STOP: Final = b"{}"  #: Message that stops the work under way; a worker that has finished ignores it.
_EVENTS_APART: Final = 0.5  #: Least time between two events [s].
_GB: Final = 1e9
#: Copies simulated at least for histograms of builds, and builds drawn from them.
_COPIES, _DRAWS = 120, 20_000


@dataclass(frozen=True)
class Limits:
    """Limits of a worker."""

    memory: int = 4_000_000_000  #: Address space beyond what it has when it starts [bytes]; kept on Linux.
    result: int = 100_000_000  #: Size of a result [bytes].


class Interrupted(Exception):
    """The run was stopped before its end."""


def picture(case: Case, order: Mapping[str, Any], progress: Progress, stop: Stop) -> bytes:
    """Run a case and return the body of its frame.

    ``case``: what is run; ``order``: with ``header``, which is copied into the header of the frame;
    ``progress``, ``stop``: as for :func:`tribodyn.simulate`. Raises Interrupted if ``stop`` was true before
    the end.
    """
    began = time.perf_counter()
    found = shown(_simulated(case, progress, stop))
    return messages.body({**order["header"], **found, "seconds": time.perf_counter() - began})


def shown(dataset: xr.Dataset) -> dict[str, Any]:
    """Return the page's content for a result; sections are the same as in a report."""
    from tribodyn.mechanisms.results import known, mechanism_of, summarise
    from tribodyn.views.playback import clock

    summary = summarise(dataset)
    return {
        "results": {name: summary[name] for name in known(summary, str(summary["kind"]))},
        **{
            name: summary[name]
            for name in ("failure", "doubtful", "warnings", "notes", "assumed", "intervals")
        },
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
    """Return the times of reversals and the length of the impacts after them [s]."""
    from tribodyn.views.playback import impact_time, reversal_times

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


def distribution(case: Case, order: Mapping[str, Any], progress: Progress, stop: Stop) -> bytes:
    """Return histograms of builds, drawn from copies of a case, as SVG.

    Raises TribodynError, as :func:`tribodyn.studies.builds.builds`, also if ``stop`` was true before the end.
    """
    from io import BytesIO

    from tribodyn.figures.builds import draw
    from tribodyn.studies.builds import builds
    from tribodyn.studies.sweep import Watcher

    scattered = len(getattr(case, "scattered", ()))
    copies = max(_COPIES, 4 * scattered**2, *(one.count for one in getattr(case, "pattern", {}).values()))
    found = builds(case, copies=copies, draws=_DRAWS, workers=0, watcher=Watcher(stop=stop))
    content = BytesIO()
    numbers = [(one.label, one.quantiles, one.drawn, one.together) for one in found.numbers]
    draw(numbers, case.title).savefig(content, format="svg", metadata={"Date": None})
    return content.getvalue()


def _simulated(case: Case, progress: Progress, stop: Stop) -> xr.Dataset:
    from tribodyn.simulation import simulate

    dataset = simulate(case, progress=progress, stop=stop)
    if dataset.attrs["failure"] and stop():
        raise Interrupted
    return dataset


#: All kinds of work, by name.
WORK: Final = {"picture": picture, "result.nc": result, "report.html": report, "builds.svg": distribution}


def reply(limits: Limits, message: bytes, connection: Connection) -> bytes | None:
    """Return the reply to an order; no exception leaves this function but those that end processes.

    ``limits``: what this process may take; ``message``: the order, or :data:`STOP`, to which there is no
    reply; ``connection``: takes events, and has a message waiting when the work is to stop.
    """
    if message == STOP:
        return None
    try:
        content = _done(json.loads(message), connection)
    except (Interrupted, Stopped):
        return GIVEN_UP
    except TribodynError as error:
        return _failure(str(error))
    except MemoryError:
        return _failure(f"this takes more memory than a worker may have, {limits.memory / _GB:g} GB")
    except Exception as error:
        return _failure(unexpected(error))
    if len(content) > limits.result:
        return _failure(f"the result is larger than {limits.result / 1e6:g} MB")
    return RESULT + content


def _failure(reason: str) -> bytes:
    return FAILURE + reason.encode("utf-8", "replace")


def _done(order: Mapping[str, Any], connection: Connection) -> bytes:
    from tribodyn.mechanisms.catalogue import parse_case

    case = parse_case(order["case"], "workbench")
    last = time.monotonic()

    def progress(reached: float) -> None:
        nonlocal last
        if time.monotonic() - last > _EVENTS_APART:
            last = time.monotonic()
            connection.send_bytes(EVENT + json.dumps({"reached": reached}).encode())

    return WORK[order["work"]](case, order, progress, connection.poll)
