"""Numbers of the page on contact: laws, damping and bounces on the surfaces of the built-in case."""

from __future__ import annotations

from functools import cache, partial
from typing import Final

import numpy as np
from scipy.optimize import brentq

import tribodyn as td
from measures.base import Numbers, vsv
from tribodyn.contact import Liner, law, tabulate
from tribodyn.contact.bounce import Bounce, bounce
from tribodyn.contact.contact_law import ContactLaw, asperity_integral
from tribodyn.contact.elastic_plastic import KogutEtsion
from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.papers.cheng_2022.runs import Runs
from tribodyn.simulation.bounce import BounceRow, bounces

RESTITUTION: Final = 0.7
#: Laws and damping factors that the page lists.
BOUNCES: Final = (
    ("ke", "lankarani-nikravesh"),
    ("ke", "flores"),
    ("ke", "kelvin-voigt"),
    ("ke", "calibrated"),
    ("rsdc", "lankarani-nikravesh"),
    ("rsdc", "flores"),
    ("rsdc", "calibrated"),
)
#: Pressures that the plates of the page would reach without damping [Pa].
PLATES: Final = (0.3e6, 10e6, 100e6, 400e6, 1500e6)
ASPERITIES: Final = ("gt", "gw", "ke", "ceb", "jg")
LEVEL: Final = 14e6  #: Pressure at which depths of laws are compared [Pa].


def the_law(name: str, **more: object) -> ContactLaw:
    """Return a law on the surfaces of the built-in case."""
    return law(name, td.load_case("vsv"), **more)


def separation_at(chosen: ContactLaw, pressure: float) -> float:
    """Return the separation over σ at which a law carries a pressure [Pa]."""
    return float(brentq(lambda h: float(chosen.stiffness_pressure(np.array([h]))[0]) - pressure, -3.5, 7.0))


def slope(runs: Runs, pressure: float) -> float:
    """Return the slope of the law of Kogut and Etsion at a pressure [Pa], in MPa/µm."""
    chosen = the_law("ke")
    at, step = separation_at(chosen, pressure), 1e-4
    low, high = chosen.stiffness_pressure(np.array([at + step, at - step]))
    return float((high - low) / (2.0 * step * vsv(runs).attrs["roughness"])) * 1e-12


def sleeve(pressure_of_one: float = 1e-3) -> float:
    """Return the stiffness of a polyimide sleeve of this thickness [m], in MPa/µm."""
    bushing = td.load_case("vsv").surfaces.bushing
    return Liner(pressure_of_one, bushing.young_modulus, bushing.poisson_ratio).stiffness * 1e-12


def softer_from(runs: Runs) -> str:
    """Return the pressure from which a millimetre of sleeve is softer than its asperities [MPa]."""
    found = brentq(lambda pressure: slope(runs, pressure) - sleeve(), 1e5, 5e7)
    return f"{float(found) * 1e-6:.0f}"


def elastic_plastic(runs: Runs, h_star: float) -> str:
    """Return the share of the pressure that elastic-plastic asperities carry at a separation [%]."""
    rough = the_law("ke")
    assert isinstance(rough, KogutEtsion)
    parts = [float(regime.integral(np.array([h_star]))[0]) for regime in rough.regimes]
    return f"{100.0 * (parts[1] + parts[2]) / sum(parts):.1f}"


def power_law(runs: Runs, h_star: float) -> str:
    """Return how far the usual power law is below F_5/2 at a separation [%]."""
    exact = float(asperity_integral(np.array([h_star]), 2.5, 0.0, np.inf)[0])
    return f"{100.0 * (1.0 - 4.4086e-5 * (4.0 - h_star) ** 6.804 / exact):.0f}"


def meant(runs: Runs, h_star: float) -> str:
    """Return the restitution that RSDC means at a separation."""
    return f"{float(the_law('rsdc').meant_restitution(np.array([h_star]))[0]):.3f}"


def damping_over_stiffness(runs: Runs, h_star: float) -> str:
    """Return C/P_k of RSDC at a separation."""
    chosen, at = the_law("rsdc"), np.array([h_star])
    return f"{float(chosen.damping_pressure(at)[0] / chosen.stiffness_pressure(at)[0]):.2f}"


def point_ratio(runs: Runs, h_star: float) -> str:
    """Return the ratio a that the factor gives at a separation."""
    chosen = the_law("rsdc")
    return f"{float(chosen.factor(chosen.meant_restitution(np.array([h_star])))[0]):.2f}"


def pressure(runs: Runs, h_star: float, digits: str, unit: float) -> str:
    """Return the pressure of Kogut and Etsion at a separation in a unit [Pa]."""
    return format(float(the_law("ke").stiffness_pressure(np.array([h_star]))[0]) / unit, digits)


def apart(runs: Runs) -> str:
    """Return the range of separations at one pressure over the laws of asperities [σ]."""
    found = [separation_at(the_law(name), LEVEL) for name in ASPERITIES]
    return f"{max(found) - min(found):.1f}"


def jump(runs: Runs, number: int) -> str:
    """Return how much the published load of an asperity jumps from one regime to the next [%]."""
    rough = the_law("ke")
    assert isinstance(rough, KogutEtsion)
    before, after = rough.regimes[number : number + 2]
    loads = [one.stress * before.upper**one.power for one in (before, after)]
    return f"{100.0 * abs(loads[1] / loads[0] - 1.0):.0f}"


@cache
def rows(restitution: float) -> dict[tuple[str, str], BounceRow]:
    """Return the bounce test of the built-in case."""
    case = td.load_case("vsv").replace({"contact.restitution": restitution})
    (bearing,) = MECHANISMS["vsv"].bearings_of(case).values()
    return {(row.law, row.factor): row for row in bounces(bearing, ("ke", "rsdc"))}


def returned(runs: Runs, name: str, factor: str, what: str) -> str:
    """Return the restitution of a bounce."""
    return f"{getattr(rows(RESTITUTION)[name, factor], what):.3f}"


def shaft_beyond(runs: Runs, restitution: float) -> str:
    """Return how much more than meant a shaft returns at most, damping calibrated."""
    found = rows(restitution)
    return f"{max(found[name, 'calibrated'].shaft for name in ('ke', 'rsdc')) - restitution:.3f}"


@cache
def plate(reached: float) -> Bounce:
    """Return the bounce of a plate that would reach a pressure [Pa] under RSDC."""
    return bounce(tabulate(the_law("rsdc")), design_pressure=reached)


def depth(runs: Runs, reached: float) -> str:
    """Return the deepest separation of a plate over σ."""
    return f"{plate(reached).deepest:.2f}"


def meant_there(runs: Runs, reached: float) -> str:
    """Return the restitution meant at the deepest separation of a plate."""
    return meant(runs, plate(reached).deepest)


def plate_returned(runs: Runs, reached: float) -> str:
    """Return the restitution of a plate."""
    return f"{plate(reached).restitution:.3f}"


#: Numbers by name.
NUMBERS: Final[Numbers] = {
    **{f"elastic-plastic share, h* = {h} [%]": partial(elastic_plastic, h_star=float(h)) for h in (0, 2)},
    **{f"power law low, h* = {h} [%]": partial(power_law, h_star=float(h)) for h in (2, 3)},
    **{f"meant restitution, h* = {h}": partial(meant, h_star=float(h)) for h in (0, 1, 3)},
    "C over P_k, h* = 2": partial(damping_over_stiffness, h_star=2.0),
    "C over P_k, h* = 3": partial(damping_over_stiffness, h_star=3.0),
    "a, h* = 2": partial(point_ratio, h_star=2.0),
    "pressure, h* = 0 [MPa]": partial(pressure, h_star=0.0, digits=".0f", unit=1e6),
    "pressure, h* = 4 [kPa]": partial(pressure, h_star=4.0, digits=".0f", unit=1e3),
    "pressure, h* = 6.5 [Pa]": partial(pressure, h_star=6.5, digits=".1e", unit=1.0),
    "laws apart at 14 MPa [σ]": apart,
    **{
        f"stiffness at {level} MPa [MPa/µm]": lambda runs, level=level: f"{slope(runs, level * 1e6):.3g}"
        for level in (9, 33, 35)
    },
    "sleeve of 1 mm [MPa/µm]": lambda runs: f"{sleeve():.0f}",
    "sleeve softer from [MPa]": softer_from,
    **{f"jump of the load, regime {k + 1} [%]": partial(jump, number=k) for k in range(3)},
    **{
        f"bounce, {name}, {factor}, {what}": partial(returned, name=name, factor=factor, what=what)
        for name, factor in BOUNCES
        for what in ("point", "plate", "shaft")
    },
    **{f"shaft beyond {e}": partial(shaft_beyond, restitution=e) for e in (0.3, RESTITUTION)},
    **{
        f"plate of {reached * 1e-6:g} MPa, {what}": partial(measure, reached=reached)
        for reached in PLATES
        for what, measure in (("depth", depth), ("meant", meant_there), ("returned", plate_returned))
    },
}
