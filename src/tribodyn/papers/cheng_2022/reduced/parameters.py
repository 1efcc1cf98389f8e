"""Parameters of the variable stator vane mechanism, symbols of the paper, SI units."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Final, TypeAlias

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.core.errors import InputError
from tribodyn.core.signals import Signal
from tribodyn.joints import BushingJoint
from tribodyn.mechanisms.results import impact_time
from tribodyn.mechanisms.shaft_loads import Term, crossings

if TYPE_CHECKING:
    from scipy.interpolate import PPoly

#: Formulations, each with its number in the kernels.
FORMULATIONS: Final = {"exact": 1.0, "paper": 0.0, "printed": -1.0}
LEAST_SWING: Final = 1.0e-9  #: Of the crank: one that moves less passes no angle at a time of its own [rad].
_LEAST_RANGE: Final = 1.0e-4  #: Of the crank, where a run ends before it has moved far [rad].


def _with_room(low: float, high: float) -> tuple[float, float]:
    """Return a range of crank angles [rad] that is wide enough for a table of the ideal vane angle."""
    room = max(_LEAST_RANGE - (high - low), 0.0)
    return low - room, high + room


@dataclass(frozen=True)
class Lengths:
    """Lengths [m] and angles [rad] of the mechanism, Table 2 and Fig. 2."""

    l_1: float
    l_2: float
    l_3: float
    l_4: float
    l_v: float
    l_m: float
    gamma: float
    phi: float


@dataclass(frozen=True)
class Inertias:
    """Masses [kg] and moments of inertia [kg m²] as printed in Table 2.

    J_1, J_2 and J_v are m l²/3, about the end of the rod, and J_3 is about the casing axis B.
    ``J_vz`` is the inertia of the vane about its own axis.
    """

    m_1: float
    m_2: float
    m_3: float
    m_v: float
    J_1: float
    J_2: float
    J_3: float
    J_v: float
    J_vz: float


@dataclass(frozen=True)
class CrankMotion:
    """Crank motion θ_a = θ_a0 + Ω/ν (1 − cos ν t): angles [rad], Ω and ν [rad/s].

    With Ω < 0 the crank sets out towards smaller angles.
    """

    start_angle: float
    speed_amplitude: float
    angular_frequency: float

    @property
    def period(self) -> float:
        """Time of one drive cycle [s]."""
        return 2.0 * math.pi / self.angular_frequency

    @property
    def impact_time(self) -> float:
        """Length of impacts after a reversal [s]."""
        return impact_time(self.period)

    @property
    def swing(self) -> float:
        """Way from the first reversal of the crank to the second [rad], with its sign."""
        return 2.0 * self.speed_amplitude / self.angular_frequency

    def crank_range(self, duration: float) -> tuple[float, float]:
        """Return the smallest and the largest crank angle in a run of ``duration`` [s] [rad]."""
        phase = min(self.angular_frequency * duration, math.pi)
        far = self.start_angle + 0.5 * self.swing * (1.0 - portable.cos(phase))
        return _with_room(min(self.start_angle, far), max(self.start_angle, far))

    def angle(self, times: FloatArray) -> FloatArray:
        """Return the crank angle [rad] at times [s]."""
        return np.asarray(
            self.start_angle + 0.5 * self.swing * (1.0 - portable.cos(self.angular_frequency * times))
        )

    def speed(self, times: FloatArray) -> FloatArray:
        """Return the speed of the crank [rad/s] at times [s]."""
        return np.asarray(self.speed_amplitude * portable.sin(self.angular_frequency * times))

    def turns(self, duration: float) -> FloatArray:
        """Return the times at which the crank reverses [s], from 0 to just beyond the run."""
        half = 0.5 * self.period
        return np.asarray(half * np.arange(math.ceil(duration / half) + 1))

    def passes(self, angles: FloatArray, duration: float) -> FloatArray:
        """Return the times at which the crank passes given angles [s], in no order."""
        after = portable.acos(1.0 - (angles - self.start_angle) / (0.5 * self.swing)) / self.angular_frequency
        return np.asarray((self.turns(duration)[::2, None] + np.concatenate([after, -after])).ravel())

    @property
    def signal(self) -> None:
        """No table: kernels have the formula."""
        return


@dataclass(frozen=True)
class TableDrive:
    """Crank motion from a table."""

    signal: Signal  #: Crank angle over time [rad, s], from 0 to the end of the longest run.
    period: float  #: Time of one drive cycle [s]: the length of the table.

    @property
    def impact_time(self) -> float:
        """Length of impacts after a reversal [s]."""
        return impact_time(self.period)

    @cached_property
    def _angle(self) -> PPoly:
        from scipy.interpolate import PPoly

        return PPoly(self.signal.coefficients, self.signal.knots)

    @cached_property
    def _speed(self) -> PPoly:
        return self._angle.derivative()

    def crank_range(self, duration: float) -> tuple[float, float]:
        """Return the smallest and the largest crank angle in a run of ``duration`` [s] [rad]."""
        end = min(duration, float(self.signal.knots[-1]))
        angles = self.angle(np.append(self.turns(end), end))
        return _with_room(float(angles.min()), float(angles.max()))

    def angle(self, times: FloatArray) -> FloatArray:
        """Return the crank angle [rad] at times [s]."""
        return np.asarray(self._angle(times))

    def speed(self, times: FloatArray) -> FloatArray:
        """Return the speed of the crank [rad/s] at times [s]."""
        return np.asarray(self._speed(times))

    def turns(self, duration: float) -> FloatArray:
        """Return the times at which the crank reverses or the table kinks [s], up to ``duration``."""
        # Of a piece at rest scipy returns the beginning; where it ends the table kinks.
        found = np.concatenate([[0.0], self._speed.roots(extrapolate=False), self.signal.kinks])
        return np.asarray(np.unique(found[np.isfinite(found) & (found <= duration)]))

    def passes(self, angles: FloatArray, duration: float) -> FloatArray:
        """Return the times at which the crank passes given angles [s], in no order."""
        ends = np.unique(np.append(self.turns(duration), min(duration, self.signal.knots[-1])))
        return crossings(self.angle, ends, angles)


AnyDrive: TypeAlias = CrankMotion | TableDrive


@dataclass(frozen=True)
class AirLoads:
    """Aerodynamic loads of Table 3."""

    #: [N]; F_airx changes its sign from minus to plus where θ_v passes ``switch_angle``.
    force_x: float
    force_y: float
    moment: float  #: Size of M_air, which opposes the motion [N m].
    #: [rad].
    switch_angle: float
    switch_width: float


@dataclass(frozen=True)
class Vsv:
    """The mechanism with its clearance joint."""

    formulation: str  #: ``exact``, ``paper`` or ``printed``, see the theory manual.
    #: See their classes.
    lengths: Lengths
    inertias: Inertias
    drive: AnyDrive
    air: AirLoads
    gravity: float  #: Acceleration of gravity [m/s²].
    collar_radius: float  #: Radius r_t of the thrust collar [m].
    joint: BushingJoint  #: The trunnion in its bushing.
    terms: tuple[Term, ...] = ()  #: Loads from tables; targets and coordinates as in ``kernels/vsv/data.py``.
    #: What the clearance has more than that of the joint over time [m, s]; None where it is constant.
    opening: Signal | None = None

    def __post_init__(self) -> None:
        """Refuse an unknown formulation."""
        if self.formulation not in FORMULATIONS:
            raise InputError(
                f"given {self.formulation!r}; allowed: {', '.join(FORMULATIONS)}", key="mechanism.formulation"
            )

    @property
    def exact(self) -> bool:
        """Whether this is the consistent formulation."""
        return self.formulation == "exact"

    @property
    def vane_arm(self) -> float:
        """Distance from O_j down to the vane centre [m]: (l_v − l_z)/2; l_v/2 unless ``exact``."""
        below_lever = self.joint.geometry.length if self.exact else 0.0
        return 0.5 * (self.lengths.l_v - below_lever)

    @property
    def crank_inertia(self) -> float:
        """About the axis through its mass centre [kg m²]."""
        shift = self.inertias.m_1 * self.lengths.l_1 * self.lengths.l_1 / 4.0
        return self.inertias.J_1 - (shift if self.exact else 0.0)

    @property
    def link_inertia(self) -> float:
        """Across the drag link, about its mass centre [kg m²]."""
        shift = self.inertias.m_2 * self.lengths.l_2 * self.lengths.l_2 / 4.0
        return self.inertias.J_2 - (shift if self.exact else 0.0)

    @property
    def ring_inertia(self) -> float:
        """Of the ring about the axis through its mass centre [kg m²]."""
        arm = 0.5 * self.lengths.l_3 * portable.cos(0.5 * self.lengths.phi)
        return self.inertias.J_3 - (self.inertias.m_3 * arm * arm if self.exact else 0.0)

    @property
    def vane_inertia(self) -> float:
        """Across the vane, about its mass centre [kg m²]."""
        shift = self.inertias.m_v * self.lengths.l_v * self.lengths.l_v / 4.0
        return self.inertias.J_v - (shift if self.exact else 0.0)
