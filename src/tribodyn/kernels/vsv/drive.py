"""Motion of the crank: the sinusoid of the paper's section 5.1, or a signal."""

from tribodyn.core.quantities import Record
from tribodyn.kernels.actions import held
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.signals import evaluate
from tribodyn.kernels.vsv.closure import sinusoid
from tribodyn.kernels.vsv.data import CRANK, TIME, VsvData


@kernel
def drive(data: VsvData, segment: Record, t: float) -> tuple[float, float, float]:
    """Return crank angle [rad], speed [rad/s] and acceleration [rad/s²] at ``t`` [s] within a segment."""
    if data.mechanism.tabulated == 0.0:
        return sinusoid(data.mechanism, t)
    return _tabulated(data, segment, t)


@kernel
def _tabulated(data: VsvData, segment: Record, t: float) -> tuple[float, float, float]:
    """Return the same from the signal.

    Apart, because whatever reaches into ``data.actions`` pays for it on every path: its arrays are counted.
    """
    return evaluate(data.actions.signals, CRANK, t, held(segment, TIME, t))
