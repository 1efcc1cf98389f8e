"""The mechanism told by positions alone, against which derivatives and balances are tested.

Written from the geometry (frames, closure and mass centres), with no derivative in it: velocities and
accelerations are differences of positions.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from scipy.optimize import brentq

from mebdf.arrays import FloatArray
from tribodyn.papers.cheng_2022.reduced.parameters import Vsv

FIRST_DIFFERENCE = np.array([-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0]) / 60.0
#: Sixth-order differences on seven points, in units of the step and of its square.
SECOND_DIFFERENCE = np.array([2.0, -27.0, 270.0, -490.0, 270.0, -27.0, 2.0]) / 180.0
STENCIL = np.arange(-3.0, 4.0)

#: Names in the order of the rows of the motion table.
COORDINATES = [
    *("theta_a", "theta_b", "theta_v", "o1_x", "o1_z", "o2_x", "o2_y", "o2_z", "n_x", "n_y", "n_z"),
    *("o3_x", "o3_y", "o3_z", "ov_x", "ov_y", "e_x", "e_y", "phi_x", "phi_y"),
    *("s1_x", "s1_z", "s2_x", "s2_y", "s2_z", "s3_x", "s3_y", "s3_z"),
]


@dataclass(frozen=True)
class Positions:
    """Where everything is, for a crank angle and an attitude of the trunnion."""

    vsv: Vsv

    def crank(self, t: float) -> float:
        """θ_a = −16° + 20°(1 − cos t)."""
        drive = self.vsv.drive
        swing = drive.speed_amplitude / drive.angular_frequency
        return drive.start_angle + swing * (1.0 - math.cos(drive.angular_frequency * t))

    def lever_end(self, theta_v: float, q: FloatArray) -> FloatArray:
        """S3: the end of the lever, half the bushing above the trunnion centre."""
        arm, half = self.vsv.lengths.l_4, self.vsv.joint.geometry.length / 2.0
        tan_x, tan_y = math.tan(q[2]), math.tan(q[3])
        cos, sin = math.cos(theta_v), math.sin(theta_v)
        x = q[0] + arm * cos - half * tan_y
        y = q[1] + arm * sin - half * tan_x
        return np.array([x, y, self.vsv.lengths.l_3 + arm * (sin * tan_x + cos * tan_y)])

    def link_start(self, theta_a: float) -> FloatArray:
        """S1: the end of the crank."""
        lengths = self.vsv.lengths
        return self.pivot() + lengths.l_1 * np.array([-math.sin(theta_a), 0.0, math.cos(theta_a)])

    def pivot(self) -> FloatArray:
        """A: the axis of the crank."""
        lengths = self.vsv.lengths
        x, z = lengths.l_m * math.cos(lengths.gamma), lengths.l_m * math.sin(lengths.gamma)
        return np.array([x, lengths.l_4, z])

    def link_end(self, s3: FloatArray) -> FloatArray:
        """S2: on the ring, the angle φ from its radial pin, which points at S3."""
        lengths = self.vsv.lengths
        angle = math.atan2(s3[0], s3[2]) + lengths.phi
        return np.array([lengths.l_3 * math.sin(angle), s3[1], lengths.l_3 * math.cos(angle)])

    def vane_angle(self, theta_a: float, q: FloatArray) -> float:
        """θ_v from |S1S2| = l_2; the bracket holds only the assembly with the larger angle."""
        s1 = self.link_start(theta_a)

        def stretch(theta_v: float) -> float:
            s2 = self.link_end(self.lever_end(theta_v, q))
            return float(np.sum((s2 - s1) ** 2)) - self.vsv.lengths.l_2**2

        return float(brentq(stretch, 0.6, 2.6, xtol=1e-15, rtol=1e-15))

    def at(self, theta_a: float, q: FloatArray) -> FloatArray:
        """Return all :data:`COORDINATES`."""
        exact = self.vsv.formulation == "exact"
        lengths = self.vsv.lengths
        seen = q if exact else np.zeros(4)
        theta_v = self.vane_angle(theta_a, seen)
        s1, s3 = self.link_start(theta_a), self.lever_end(theta_v, seen)
        s2 = self.link_end(s3)
        theta_b = math.atan2(-s3[0], s3[2])
        o1 = 0.5 * (self.pivot() + s1)
        o2 = 0.5 * (s1 + s2)
        # The ring's mass lies in its two arms' chord: l_3/2 cos(φ/2) out, half way between the arms.
        out, angle = 0.5 * lengths.l_3 * math.cos(lengths.phi / 2.0), theta_b - lengths.phi / 2.0
        o3 = np.array([-out * math.sin(angle), s3[1], out * math.cos(angle)])
        if not exact:
            o2 += (q[0] / 2.0, q[1] / 2.0, 0.0)
            o3 += (q[0] / 2.0, q[1], 0.0)
        arm = (lengths.l_v - (self.vsv.joint.geometry.length if exact else 0.0)) / 2.0
        ov = [q[0] + arm * math.tan(q[3]), q[1] + arm * math.tan(q[2])]
        n = (s2 - s1) / lengths.l_2
        crank = [theta_a, theta_b, theta_v, o1[0], o1[2]]
        return np.concatenate([crank, o2, n, o3, ov, q, [s1[0], s1[2]], s2, s3])

    def along(
        self, path: Callable[[float], FloatArray], t: float, step: float
    ) -> tuple[FloatArray, FloatArray]:
        """Return velocities and accelerations of all coordinates at ``t`` along ``q = path(t)``."""
        values = np.array([self.at(self.crank(t + step * k), path(t + step * k)) for k in STENCIL])
        return FIRST_DIFFERENCE @ values / step, SECOND_DIFFERENCE @ values / step**2


@pytest.fixture(scope="session")
def make_positions() -> Callable[[Vsv], Positions]:
    """Return a maker of the position model of a mechanism."""
    return Positions


@pytest.fixture(scope="session")
def coordinate_names() -> list[str]:
    """Return the names of the coordinates of the position model, in order."""
    return COORDINATES
