"""Limit of friction of a drive: Coulomb, viscous, Stribeck and load-dependent parts in one law.

With the speed w, the torque of the motor t_m and the external torque t_e, both at the output,

    limit = F_c + F_v |w| + |k_m t_m - k_e t_e| + exp(-|w/w_s|^a) (F_s + |s_m t_m - s_e t_e| + Q),

where Q = q_e t_e^2 if the motor drives against a smaller external torque, Q = q_m t_m^2 if a larger external
torque drives the motor back, and Q = 0 if both torques have the same sign.

The usual models are special cases: Coulomb and viscous friction (F_c, F_v), Stribeck friction (also F_s,
w_s, a), load-dependent friction (k_m = k_e) and friction that depends on the direction of power (k_m and k_e
apart). Joints have their friction themselves, see ``kernels.joints``. The complete law is model M6 of M.
Duclusaud, G. Passault, V. Padois, O. Ly, "Extended Friction Models for the Physics Simulation of Servo
Actuators", IEEE ICRA 2025.
"""

from dataclasses import dataclass

import numpy as np

from mebdf.arrays import FloatArray

__all__ = ["FrictionLimit", "stribeck_share"]


def stribeck_share(speed: FloatArray, stribeck_speed: float, exponent: float = 2.0) -> FloatArray:
    """Return the Stribeck factor exp(-|w/w_s|^a) [1].

    Parameters
    ----------
    speed
        Speed w [rad/s or m/s], any shape.
    stribeck_speed
        Stribeck speed w_s > 0, in the unit of ``speed``.
    exponent
        Exponent a [1].
    """
    return np.asarray(np.exp(-(np.abs(np.asarray(speed) / stribeck_speed) ** exponent)))


@dataclass(frozen=True)
class FrictionLimit:
    """Limit of friction of a drive or guide.

    Torques stand for forces where the speed is linear. Every coefficient is zero by default.
    """

    coulomb: float = 0.0  #: Coulomb friction F_c [N m].
    viscous: float = 0.0  #: Viscous coefficient F_v [N m s/rad].
    stribeck: float = 0.0  #: Static friction above Coulomb friction, F_s [N m].
    #: Stribeck speed w_s [rad/s] and exponent a [1].
    stribeck_speed: float = 1.0
    stribeck_exponent: float = 2.0
    #: Friction per transmitted torque of the motor and of the load, k_m and k_e [1].
    motor_load: float = 0.0
    external_load: float = 0.0
    #: The same at rest, in addition, s_m and s_e [1].
    motor_load_stribeck: float = 0.0
    external_load_stribeck: float = 0.0
    #: Friction at rest per squared torque, q_m and q_e [1/(N m)].
    motor_load_quadratic: float = 0.0
    external_load_quadratic: float = 0.0

    def __call__(
        self, speed: FloatArray, motor: FloatArray | float = 0.0, external: FloatArray | float = 0.0
    ) -> FloatArray:
        """Return the limit of friction [N m], the broadcast shape of the arguments.

        Parameters
        ----------
        speed
            Speed w [rad/s].
        motor, external
            Torques of motor and load at the output [N m].
        """
        motor, external = np.asarray(motor), np.asarray(external)
        moving = self.coulomb + self.viscous * np.abs(speed)
        moving = moving + np.abs(self.motor_load * motor - self.external_load * external)
        at_rest = self.stribeck + np.abs(
            self.motor_load_stribeck * motor - self.external_load_stribeck * external
        )
        at_rest = at_rest + self._quadratic(motor, external)
        return np.asarray(
            moving + stribeck_share(speed, self.stribeck_speed, self.stribeck_exponent) * at_rest
        )

    def _quadratic(self, motor: FloatArray, external: FloatArray) -> FloatArray:
        driving = self.external_load_quadratic * external**2 * (np.abs(external) < np.abs(motor))
        driven = self.motor_load_quadratic * motor**2 * (np.abs(external) > np.abs(motor))
        return np.asarray((driving + driven) * (np.sign(motor) != np.sign(external)))
