"""Amount of work and memory of a run of the variable stator vane mechanism."""

from typing import Final

from tribodyn.kernels.joints.quantities import STATES
from tribodyn.kernels.vsv.quantities import OBSERVED
from tribodyn.mechanisms.bushing import grid_of
from tribodyn.mechanisms.workload import AFTER_REVERSAL, EVEN, MOST_CLOSE, Keys, Workload, simulated_cycles
from tribodyn.papers.cheng_2022.reduced.case import VsvCase

#: Steps of a reversal at ``rtol`` 1e-3, measured over 2 and 40 cycles and with drives of 1 and 10 rad/s.
_STEPS_OF_REVERSAL: Final = 1150.0
#: Steps of a second between impacts, where the trunnion rings at 30 Hz, from the same.
_STEPS_OF_SECOND: Final = 100.0
_TOLERANCE_POWER: Final = -0.1
_SNAPSHOTS: Final = 6.0
_STRIDE: Final = 3.0  #: Steps per sample that follows them, see ``times.py``.


def workload(case: VsvCase) -> Workload:
    """Return the counts of a case."""
    duration = case.period if case.campaign_cycles else case.duration
    cycles, run = duration / case.period, case.run
    around, along = grid_of(case)
    windows = 1.0 + 2.0 * cycles
    steps = _STEPS_OF_REVERSAL * (2.0 * cycles) + _STEPS_OF_SECOND * duration
    length = "run.cycles" if run.cycles is not None else "run.duration"
    steps *= (case.solver.rtol / 1.0e-3) ** _TOLERANCE_POWER
    frames = EVEN + min(2 * AFTER_REVERSAL, MOST_CLOSE)
    return Workload(
        steps=steps,
        states=len(STATES),
        nodes=around * (along + 2.0),
        joints=1.0,
        fields=_SNAPSHOTS + frames * min(2.0, max(1.0, cycles)),
        samples=duration / run.output_interval + windows,
        followed=min(run.impact_rows * windows, steps / _STRIDE) if run.impact_window else 0.0,
        quantities=len(OBSERVED),
        breaks=windows,
        runs=_runs(case),
        solver=case.solver.name,
        keys=Keys(length=length, followed="run.impact_rows"),
    )


def _runs(case: VsvCase) -> float:
    if not case.campaign_cycles:
        return 1.0
    roughness, rows = case.surface_pair.roughness_rms, len(case.temperature_times)
    return simulated_cycles(case.wear, case.settling_cycles, roughness, case.joint.radius, rows)


WORKLOAD: Final = workload
