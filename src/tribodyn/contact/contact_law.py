"""Base class of contact laws, and the integrals over Gaussian asperity heights that laws share."""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass
from typing import ClassVar, Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.contact.damping_factors import DAMPING_FACTORS, DampingFactor
from tribodyn.contact.parameter import check_parameters
from tribodyn.contact.surface_pair import SurfacePair
from tribodyn.core.errors import InputError
from tribodyn.core.splines import gauss_legendre

_POINTS: Final = 48
#: Heights whose density is below exp(-40) = 4e-18 of the largest one in the interval are left out.
_DECAY: Final = 40.0


def density(z: FloatArray) -> FloatArray:
    """Return the standard normal density Φ(z), any shape."""
    return np.asarray(portable.exp(-0.5 * z**2) / np.sqrt(2.0 * np.pi))


def exceedance(z: FloatArray) -> FloatArray:
    """Return ∫_z^∞ Φ, the share of asperities higher than ``z``, any shape."""
    return np.asarray(0.5 * portable.erfc(z / np.sqrt(2.0)))


def asperity_integral(
    h_star: FloatArray,
    power: float,
    lower: float,
    upper: float,
    weight: Callable[[FloatArray], FloatArray] = density,
) -> FloatArray:
    """Return ∫_lower^upper s^power · weight(h* + s) ds for every separation, shape of ``h_star`` [1].

    With ``weight=exceedance`` it is the integral of the same with :func:`density` over all separations
    from h* to infinity, since ∫_h*^∞ Φ(x + s) dx = exceedance(h* + s).

    Gauss–Legendre in t = √s, which makes the integrand smooth at s = 0 for the powers 1 and 1.5; the
    upper limit is cut where the density has died away.
    """
    h, t, half = _nodes(h_star, lower, upper)
    integrand = 2.0 * portable.power(t, 2.0 * power + 1.0) * weight(h + t**2)
    return np.asarray(half[..., 0] * np.sum(integrand * gauss_legendre(_POINTS)[1], axis=-1))


def height_integral(
    h_star: FloatArray, load: Callable[[FloatArray], FloatArray], lower: float, upper: float
) -> FloatArray:
    """Return ∫_lower^upper load(s) · Φ(h* + s) ds for every separation, shape of ``h_star`` [1].

    For the loads of asperities that are not powers of the interference s; nodes as above.
    """
    h, t, half = _nodes(h_star, lower, upper)
    s = t**2
    weights = gauss_legendre(_POINTS)[1]
    return np.asarray(half[..., 0] * np.sum(2.0 * t * load(s) * density(h + s) * weights, axis=-1))


def _nodes(h_star: FloatArray, lower: float, upper: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return h*, the nodes t and half the length of the interval, shapes (..., 1), (..., n), (..., 1)."""
    h = np.asarray(h_star, dtype=np.float64)[..., np.newaxis]
    reach = np.sqrt(np.maximum(h + lower, 0.0) ** 2 + 2.0 * _DECAY) - h
    t_first = math.sqrt(lower)
    half = 0.5 * (np.sqrt(np.minimum(upper, reach)) - t_first)
    return h, t_first + half * (1.0 + gauss_legendre(_POINTS)[0]), half


#: Default peak pressure of the impact that ``calibrated`` and ``kelvin-voigt`` are made for [Pa].
DESIGN_PRESSURE: Final = 50.0e6

#: δ̇₋ of all points where damping is in proportion to the speed [m/s]: none is faster.
MEMORYLESS: Final = 1.0e3

#: Separations h* between which the peak pressure of that impact must lie [1].
DESIGN_RANGE: Final = (-4.0, 4.0)


@dataclass(frozen=True)
class ContactLaw(ABC):
    """Two functions of the separation h* = h/σ; nothing else is asked of a law.

    All functions take an array of any shape and return an array of that shape. A law is evaluated when it is
    tabulated and where a user plots it, never inside a simulation. A new law gives ``stiffness_pressure``;
    its damping follows from the named factor.

    Parameters
    ----------
    pair
        The surfaces in contact.
    damping_factor
        Name of the factor that turns a restitution into damping, one of ``DAMPING_FACTORS``.
    restitution
        Restitution e that the factor is given [1]; a law that knows its own may leave it out.
    design_pressure
        Peak pressure that an undamped impact would reach [Pa], for which ``calibrated`` and
        ``kelvin-voigt`` are made; the other factors do not need it.
    loss_coefficient
        α [s/m] of a damping P_d = 3/2 α P_k δ̇, in proportion to the speed, in the place of a factor: points
        remember no entry velocity, their δ̇₋ is :data:`MEMORYLESS`. Hunt and Crossley (1975), J. Appl. Mech.
        42, 440, by whom e = 1 − αv of slow impacts gives 0.08 to 0.32 s/m for steel, bronze and ivory.
    """

    name: ClassVar[str]
    title: ClassVar[str]  #: One line for people.
    source: ClassVar[str]
    validity: ClassVar[str]  #: Range in which the law holds, one sentence.
    #: Whether the law has a restitution of its own when none is asked for.
    knows_restitution: ClassVar[bool] = False

    pair: SurfacePair
    damping_factor: str = "none"
    _: KW_ONLY
    restitution: float | None = None
    design_pressure: float = DESIGN_PRESSURE
    loss_coefficient: float | None = None

    def __post_init__(self) -> None:
        """Refuse damping that does not exist or lacks its restitution, and parameters out of their range."""
        check_parameters(self)
        self._check_loss()
        if self.damping_factor not in DAMPING_FACTORS:
            raise InputError(
                f"no damping factor {self.damping_factor!r}; there is {', '.join(DAMPING_FACTORS)}",
                key="contact.damping_factor",
            )
        if self.restitution is None:
            if self.damping_factor != "none" and not self.knows_restitution:
                raise InputError(
                    f"the law {self.name} has no restitution of its own: the damping factor "
                    f"{self.damping_factor} needs one, such as 0.7",
                    key="contact.restitution",
                )
        elif not 0.0 < self.restitution <= 1.0:
            raise InputError(f"must lie in (0, 1], not {self.restitution}", key="contact.restitution")
        if not self.design_pressure > 0.0:
            raise InputError(f"must be positive, not {self.design_pressure}", key="contact.design_pressure")

    def _check_loss(self) -> None:
        if self.loss_coefficient is None:
            return
        key = "contact.loss_coefficient"
        if not self.loss_coefficient > 0.0:
            raise InputError(f"must be positive, not {self.loss_coefficient}", key=key)
        if self.damping_factor != "none" or self.restitution is not None:
            raise InputError("give either this or a damping factor with its restitution", key=key)

    @abstractmethod
    def stiffness_pressure(self, h_star: FloatArray) -> FloatArray:
        """Return the pressure P_k(h*) of the surfaces at rest.

        Parameters
        ----------
        h_star
            Separation over the roughness h* [1], any shape.

        Returns
        -------
        numpy.ndarray
            [Pa], shape of ``h_star``.
        """

    def real_area_fraction(self, h_star: FloatArray) -> FloatArray:
        """Return the real contact area over the nominal one.

        Parameters
        ----------
        h_star
            Separation over the roughness h* [1], any shape.

        Returns
        -------
        numpy.ndarray
            [1], shape of ``h_star``; NaN where the theory gives none.
        """
        return np.full(np.shape(h_star), np.nan)

    def contact_count(self, h_star: FloatArray) -> FloatArray:
        """Return the number of contacts per nominal area.

        Parameters
        ----------
        h_star
            Separation over the roughness h* [1], any shape.

        Returns
        -------
        numpy.ndarray
            [1/m²], shape of ``h_star``; NaN where the theory gives none.
        """
        return np.full(np.shape(h_star), np.nan)

    def touching_share(self, h_star: FloatArray) -> FloatArray:
        """Return the share of asperities that touch, on which ``kelvin-voigt`` puts its dashpots.

        Parameters
        ----------
        h_star
            Separation over the roughness h* [1], any shape.

        Returns
        -------
        numpy.ndarray
            [1], shape of ``h_star``; by default that of Gaussian heights above h*.
        """
        return exceedance(np.asarray(h_star, dtype=np.float64))

    @property
    def factor(self) -> DampingFactor:
        """The damping factor."""
        return DAMPING_FACTORS[self.damping_factor]

    def meant_restitution(self, h_star: FloatArray) -> FloatArray:
        """Return the restitution e given to the factor at each separation.

        Parameters
        ----------
        h_star
            Separation over the roughness h* [1], any shape.

        Returns
        -------
        numpy.ndarray
            [1], shape of ``h_star``; 1 without one.
        """
        return np.full(np.shape(h_star), 1.0 if self.restitution is None else self.restitution)

    def damping_pressure(self, h_star: FloatArray) -> FloatArray:
        """Return the coefficient C(h*) of the damping pressure P_d = C·δ̇/δ̇₋.

        For ``calibrated`` it is that of a point contact; :func:`tabulate` scales it to the surface.

        Parameters
        ----------
        h_star
            Separation over the roughness h* [1], any shape.

        Returns
        -------
        numpy.ndarray
            [Pa], shape of ``h_star``; zeros for no damping.

        Raises
        ------
        InputError
            A factor with dashpots needs a design pressure that the law reaches on these surfaces.
        """
        if self.loss_coefficient is not None:
            return np.asarray(1.5 * self.loss_coefficient * MEMORYLESS * self.stiffness_pressure(h_star))
        if self.damping_factor == "none":
            return np.zeros(np.shape(h_star))
        ratio = self.factor(self.meant_restitution(h_star))
        if self.factor.dashpot:
            share = self.touching_share(np.append(np.ravel(h_star), self.design_separation()))
            strength = self.design_pressure / share[-1]
            return np.asarray(ratio * strength * share[:-1].reshape(np.shape(h_star)))
        return self.damping_for(ratio, h_star)

    def design_separation(self) -> float:
        """Return the separation h* at which the stiffness pressure is the design pressure.

        Returns
        -------
        float
            [1].

        Raises
        ------
        InputError
            The law carries less than that, however close the surfaces are.
        """
        from scipy.optimize import brentq

        def excess(h_star: float) -> float:
            return float(self.stiffness_pressure(np.array([h_star]))[0]) - self.design_pressure

        first, last = DESIGN_RANGE
        if not excess(first) > 0.0 > excess(last):
            raise InputError(
                f"the law {self.name} carries at most {excess(first) + self.design_pressure:.3g} Pa on these "
                f"surfaces, not {self.design_pressure:g}",
                key="contact.design_pressure",
            )
        return float(brentq(excess, first, last, xtol=1.0e-13))

    def damping_for(self, ratio: FloatArray, h_star: FloatArray) -> FloatArray:
        """Return the coefficient C for a ratio of damping to stiffness.

        Parameters
        ----------
        ratio
            Damping pressure over stiffness pressure at δ̇ = δ̇₋ [1], shape of ``h_star``.
        h_star
            Separation over the roughness h* [1], any shape.

        Returns
        -------
        numpy.ndarray
            [Pa], shape of ``h_star``.
        """
        return ratio * self.stiffness_pressure(h_star)

    def pressure(self, gap: FloatArray) -> FloatArray:
        """Return the pressure P_k of the surfaces at rest.

        Parameters
        ----------
        gap
            Distance of the mean planes [m], any shape.

        Returns
        -------
        numpy.ndarray
            [Pa], shape of ``gap``.
        """
        return self.stiffness_pressure(np.asarray(gap, dtype=np.float64) / self.pair.roughness_rms)
