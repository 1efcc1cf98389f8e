"""How compiled code lets its caller look around: by the clock, and without a trace in the results."""

import json
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise

import numpy as np
import pytest
import xarray as xr
from numpy.typing import NDArray

from tribodyn.integrate import mebdf
from tribodyn.kernels.mebdf.drive import AFTER_EVALUATION
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.simulation import first_steps, simulate

SHORT = {
    "vsv": {"run.duration": "50 ms", "run.output_interval": "1 ms"},
    "journal-oil": {"run.duration": "0.5 ms"},
}
SLOW = {
    "joints.bearing.film.grid.theta": 360,
    "joints.bearing.film.grid.z": 64,
}  #: A film whose steps take many milliseconds.


def bits(result: xr.Dataset) -> dict[str, bytes]:
    return {str(name): result[name].values.tobytes() for name in result.variables}


@pytest.mark.parametrize("name", SHORT)
def test_pauses_after_every_evaluation_change_no_bit(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    case, looks, pauses = load_case(name).replace(SHORT[name]), [], []
    alone = simulate(case)

    @contextmanager
    def always(pause: NDArray[np.int64]) -> Iterator[None]:
        pauses[:] = [pause]
        yield

    def stop() -> bool:
        for pause in pauses:  # None before the integration begins
            pause[0] = AFTER_EVALUATION
        looks.append(None)
        return False

    monkeypatch.setattr(mebdf, "_ticking", always)
    assert bits(simulate(case, stop=stop)) == bits(alone)
    assert len(looks) > json.loads(alone.attrs["solver"])["rhs_evaluations"]


@pytest.mark.parametrize("solver", ["mebdf", "bdf"])
def test_a_stop_is_heard_soon_however_long_a_step_takes(solver: str) -> None:
    case = load_case("journal-oil").replace({**SLOW, "solver.name": solver})
    first_steps(case)
    looks: list[float] = []

    def stop() -> bool:
        # Processor time of this thread: on a busy machine others would be measured too.
        looks.append(time.thread_time())
        return looks[-1] - looks[0] > 1.0

    result = simulate(case, stop=stop)
    assert result.attrs["failure"] == "interrupted"
    # A step takes some tenths of a second; where other programs use the caches, a few times that.
    assert max(later - sooner for sooner, later in pairwise(looks)) < 2.0


def test_no_thread_is_left() -> None:
    before = threading.active_count()
    simulate(load_case("vsv").replace(SHORT["vsv"]))
    assert threading.active_count() == before
