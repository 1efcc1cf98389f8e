"""Tabulation of a contact law for the kernels."""

from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.contact.bounce import calibrating_scale
from tribodyn.contact.contact_law import ContactLaw
from tribodyn.core.errors import InputError
from tribodyn.core.remembered import ContactTable

H_FIRST: Final = -4.0
H_LAST: Final = 8.0
#: 128 to the unit: a cubic Hermite error below 1e-7 of a Gaussian tail's pressure at h* = 8.
INTERVALS: Final = 1536
#: Share of the pressure at h* = 0 below which the tail of a law is left out: looking it up costs time.
TAIL: Final = 1.0e-11

#: Sixth-order first difference, in units of the step.
_CENTRAL_DIFFERENCE: Final = np.array([-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0]) / 60.0


def tabulate(law: ContactLaw, *, onset: float = 4.0, smoothing_width: float = 1.0) -> ContactTable:
    """Tabulate a contact law from h* = -4 to where its pressure has vanished, at most 8.

    Parameters
    ----------
    law
        Any contact law.
    onset
        Separation h* at which a point enters contact and its damping begins [1].
    smoothing_width
        Distance below the onset at which the damping is fully there [1].

    Returns
    -------
    ContactTable
        P_k and C times the smoothstep of the onset, up to the onset or to where P_k falls below
        :data:`TAIL`, whatever is farther. Slopes are sixth-order differences of the law, so that a
        law needs to supply no derivative. The damping of ``calibrated`` is scaled so that the design impact
        of the law returns its restitution.

    Raises
    ------
    InputError
        The width is not above zero, the onset lies outside the table, or the pressure of the law rises with
        the separation.
    """
    _check_onset(onset, smoothing_width)
    step = (H_LAST - H_FIRST) / INTERVALS
    beyond = _CENTRAL_DIFFERENCE.size // 2
    h_star = H_FIRST + step * np.arange(-beyond, INTERVALS + 1 + beyond, dtype=np.float64)
    pressure, pressure_rise = _values_and_rises(law.stiffness_pressure(h_star))
    _require_falling(law, h_star[beyond:-beyond], pressure)
    damping, damping_rise = _values_and_rises(law.damping_pressure(h_star))
    share, share_slope = onset_share(h_star[beyond:-beyond], onset, smoothing_width)
    smoothed_rise = share * damping_rise + step * share_slope * damping
    nodes = np.column_stack([pressure, pressure_rise, share * damping, smoothed_rise])
    nodes = nodes[: _end(h_star[beyond:-beyond], pressure, onset)]
    table = table_of_nodes(H_FIRST, step, nodes)
    if law.damping_factor == "calibrated":
        nodes[:, 2:] *= _scale(law, table, onset)
        table = table_of_nodes(H_FIRST, step, nodes)
    return table


def _end(h_star: FloatArray, pressure: FloatArray, onset: float) -> int:
    """Return the number of nodes up to the onset or to where the pressure has vanished."""
    counts = pressure > TAIL * np.interp(0.0, h_star, pressure)
    return int(np.flatnonzero(counts | (h_star <= onset))[-1]) + 1


def table_of_nodes(first: float, step: float, nodes: FloatArray) -> ContactTable:
    """Return the table with the given node values and rises, shape (n + 1, 4); see :class:`ContactTable`."""
    energy = _energy_from_above(nodes[:, 0], nodes[:, 1], step)
    cubics = np.hstack([_power_form(*nodes[:, :2].T), _power_form(*nodes[:, 2:].T)]).reshape(-1)
    last = first + step * (len(nodes) - 1)
    return ContactTable(first, last, 1.0 / step, np.array(nodes, order="C"), energy, cubics)


def _scale(law: ContactLaw, table: ContactTable, onset: float) -> float:
    """Return the factor on the damping of ``calibrated`` that makes it hold on this surface."""
    wanted = float(law.meant_restitution(np.array([law.design_separation()]))[0])
    return calibrating_scale(table, wanted, onset=onset, design_pressure=law.design_pressure)


def onset_share(h_star: FloatArray, onset: float, width: float) -> tuple[FloatArray, FloatArray]:
    """Return the smoothstep 3u² − 2u³, u = (onset − h*)/width in [0, 1], and its slope in h*.

    Both have the shape of ``h_star`` [1].
    """
    u = np.clip((onset - h_star) / width, 0.0, 1.0)
    return u**2 * (3.0 - 2.0 * u), -6.0 * u * (1.0 - u) / width


def _check_onset(onset: float, smoothing_width: float) -> None:
    if not smoothing_width > 0.0:
        raise InputError(f"must be positive, not {smoothing_width}", key="contact.smoothing_width")
    if not H_FIRST <= onset - smoothing_width < onset <= H_LAST:
        allowed = f"onset and onset minus smoothing width must lie in [{H_FIRST:g}, {H_LAST:g}]"
        raise InputError(
            f"{allowed}, not {onset:g} and {onset - smoothing_width:g}", key="contact.onset_separation"
        )


def _require_falling(law: ContactLaw, h_star: FloatArray, pressure: FloatArray) -> None:
    """Refuse a law whose pressure rises with the separation, or is no number."""
    steps = np.diff(pressure)
    wrong = ~(steps <= TAIL * np.max(np.abs(pressure)))
    if np.any(wrong):
        k = int(np.argmax(wrong))
        words = (
            f"its pressure rises with the separation, from {pressure[k]:.4g} Pa at h* = {h_star[k]:.3g} to "
            f"{pressure[k + 1]:.4g} Pa at {h_star[k + 1]:.3g}; surfaces that part carry less: let it fall "
            f"from h* = {H_FIRST:g} to {H_LAST:g}"
        )
        raise InputError(f"contact law {law.name}: {words}", key="contact.law")


def _values_and_rises(values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return values and step·slope at the nodes, shapes (n + 1,), from values on three more at each end."""
    beyond = _CENTRAL_DIFFERENCE.size // 2
    n = values.size - 2 * beyond
    rises = sum(weight * values[k : k + n] for k, weight in enumerate(_CENTRAL_DIFFERENCE))
    return values[beyond:-beyond], np.asarray(rises)


def _energy_from_above(pressure: FloatArray, rise: FloatArray, step: float) -> FloatArray:
    """Return the integral of the Hermite interpolant from each node to the last, shape (n + 1,) [Pa]."""
    interval = step * (0.5 * (pressure[:-1] + pressure[1:]) + (rise[:-1] - rise[1:]) / 12.0)
    return np.append(np.cumsum(interval[::-1])[::-1], 0.0)


def _power_form(values: FloatArray, rises: FloatArray) -> FloatArray:
    """Return the Hermite cubics by their coefficients, what lies below and above included, (n + 2, 4)."""
    rise = np.diff(values)
    third = rises[:-1] + rises[1:] - 2.0 * rise
    inside = np.column_stack([values[:-1], rises[:-1], rise - rises[:-1] - third, third])
    below = [values[0] - rises[0], rises[0], 0.0, 0.0]
    return np.vstack([below, inside, np.zeros(4)])
