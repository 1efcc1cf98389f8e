"""Reversals of the drives of a mechanism, and largest values in the impacts that follow."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.core.quantities import Quantity
from tribodyn.core.signals import Signal
from tribodyn.mechanism.model.drives_and_loads import GIVEN, DriveKeys
from tribodyn.mechanisms.results import impact_time, of_rows
from tribodyn.mechanisms.self_checks import of_reversals
from tribodyn.mechanisms.shaft_loads import inside

#: Sizes whose largest values results hold for each reversal and joint.
PEAKS: Final = (
    Quantity("joint_force", "N", "force in the joint"),
    Quantity("pressure", "Pa", "contact pressure in the joint"),
    Quantity("offset", "m", "distance of the shaft from the middle of its bore"),
    Quantity("drive_moment", "N m", "moment of the drives of the joint"),
)


@dataclass(frozen=True)
class Reversals:
    """The reversals of all drives that give a motion in a run."""

    drives: tuple[DriveKeys, ...]  #: All drives.
    #: Time of a cycle, and of the whole run [s].
    period: float
    duration: float

    @cached_property
    def times(self) -> FloatArray:
        """Times at which a drive reverses, stops or starts, strictly inside the run [s], shape (n,)."""
        return self._within(self.duration)

    def _within(self, duration: float) -> FloatArray:
        found = (_turns(drive, duration)[0] for drive in self.drives)
        return inside(np.concatenate([np.empty(0), *found]), duration)

    def _of_cycle(self) -> FloatArray:
        """Return the reversals of a cycle [s], its beginning among them where it is one, shape (n,)."""
        ends = [found for drive in self.drives if (found := _turns(drive, self.period)[1]).size]
        begins = [0.0] if any(directions[0] != directions[-1] for directions in ends) else []
        return np.concatenate([begins, self._within(self.period)])

    def _begins(self, t_end: float) -> FloatArray:
        """Return the start and the reversals up to a time [s], shape (n,)."""
        return np.concatenate([[0.0], self.times[self.times <= t_end]])

    @property
    def attributes(self) -> dict[str, float]:
        """Length of the impacts after each reversal [s], by name; none where no drive reverses."""
        return {"impact_time": impact_time(self.period)} if self.times.size else {}

    def coordinates(self, t_end: float) -> dict[str, FloatArray]:
        """Return number and time of the start and of the reversals reached, by name; nothing without any."""
        begins = self._begins(t_end)
        found = {"reversal": np.arange(begins.size, dtype=np.float64), "reversal_time": begins}
        return found if self.times.size else {}

    def peaks(
        self, t: FloatArray, couplings: Mapping[str, FloatArray], clearances: FloatArray
    ) -> dict[str, FloatArray]:
        """Return the largest values after each reversal and their times, by name; nothing without any.

        ``t``: times of the rows [s], shape (n_t,); ``couplings``: observed of all couplings, joints first,
        shape (n_t, n_couplings) or (n_t, n_couplings, size); ``clearances``: of the joints [m], shape
        (n_joints,); NaN where they are ideal.
        """
        if not (self.times.size and t.size):
            return {}
        real = np.isfinite(clearances)
        rows = {name: values[:, : real.size] for name, values in couplings.items()}
        values = {
            "joint_force": np.linalg.norm(rows["reaction_force"], axis=-1),
            "pressure": np.where(real, rows["pressure_max"], np.nan),
            "offset": np.where(real, np.linalg.norm(rows["displacement"][..., :2], axis=-1), np.nan),
            "drive_moment": rows["drive_moment"],
        }
        return of_rows(t, values, self._begins(float(t[-1])), impact_time(self.period))

    def notes(self, t_end: float, *, carried: bool) -> list[str]:
        """Return the reversals of a cycle that a run up to ``t_end`` [s] does not hold with their impacts."""
        if not self.times.size:
            return []
        begins = self._begins(t_end)
        found = of_reversals(self._of_cycle(), begins, period=self.period, t_end=t_end, carried=carried)
        return [found] if found else []


def _turns(drive: DriveKeys, duration: float) -> tuple[FloatArray, FloatArray]:
    """Return the times at which the direction of a drive changes [s], and all its directions in turn."""
    level, signal = GIVEN[drive.gives][1], drive.signal.signal()
    if level > 1:
        return np.empty(0), np.empty(0)
    times = inside(_candidates(signal, level, duration), duration)
    ends = np.concatenate([[0.0], times, [duration]])
    directions = np.sign(_rate(signal, level, 0.5 * (ends[:-1] + ends[1:])))
    return times[np.diff(directions) != 0.0], directions


def _rate(signal: Signal, level: int, times: FloatArray) -> FloatArray:
    """Return the rate of a drive that gives its coordinate (level 0) or the rate itself (level 1)."""
    if signal.kind == "table":
        within = (times >= signal.knots[0]) & (times <= signal.knots[-1])
        return signal(times) if level == 1 else np.where(within, signal.slope(times, 1), 0.0)
    if signal.kind == "constant":
        return np.full(times.shape, level * signal.coefficients[0])
    mean, amplitude, frequency, phase = signal.coefficients
    wave = frequency * times + phase
    return np.asarray(
        mean + amplitude * portable.sin(wave) if level == 1 else amplitude * frequency * portable.cos(wave)
    )


def _candidates(signal: Signal, level: int, duration: float) -> FloatArray:
    """Return the times among which those are where the rate of a drive changes its sign [s]."""
    if signal.kind == "table":
        return np.concatenate([signal.zeros(1 - level), signal.kinks, signal.knots[[0, -1]]])
    if signal.kind == "constant":
        return np.empty(0)
    mean, amplitude, frequency, phase = signal.coefficients
    if amplitude == 0.0 or frequency == 0.0 or (level == 1 and abs(mean) > abs(amplitude)):
        return np.empty(0)
    first = math.asin(-mean / amplitude) if level == 1 else 0.5 * math.pi
    turn = 2.0 * math.pi
    angles = np.array([first, math.pi - first if level == 1 else -0.5 * math.pi])
    # Whole turns that bring the first of them into the run, and on to its end.
    n = math.ceil(abs(frequency) * duration / turn) + 1
    low = min(phase, phase + frequency * duration)
    begin = low + np.mod(angles - low, turn)
    return np.asarray(((begin[:, None] + turn * np.arange(n)).ravel() - phase) / frequency)
