"""The clearance at the temperatures of a run: trunnion, bushing and casing expand by different amounts.

A *free* bushing widens with its own material, r_b → r_b(1 + ε_b). A sleeve *bonded* into a casing follows it
at its outer radius and along its surface, R → R(1 + ε_c); the strain ε_b − ε_c that it lacks there in both
directions thickens it by Hooke's law: t → t[1 + ε_b + 2ν/(1 − ν)(ε_b − ε_c)]. The bore is what is left.
All strains are free ones, αΔT.
"""

from dataclasses import dataclass, replace

from tribodyn.core.errors import InputError
from tribodyn.joints.shapes.cylinder import Cylinder


@dataclass(frozen=True)
class Casing:
    """Casing of a sleeve."""

    strain: float  #: Free thermal strain ε_c of the casing [1].
    thickness: float  #: Of the sleeve, t [m].
    poisson_ratio: float  #: Of the sleeve, ν [1].


def clearance_rates(geometry: Cylinder, casing: Casing | None) -> dict[str, float]:
    """Return the gain of the clearance for each strain αΔT, by the part that it belongs to [m].

    Arguments as for :func:`expanded`; the strain of the casing itself does not matter.
    """
    of_trunnion = {"trunnion": -geometry.radius}
    if casing is None:
        return of_trunnion | {"bushing": geometry.bore_radius}
    squeeze = 2.0 * casing.poisson_ratio / (1.0 - casing.poisson_ratio) * casing.thickness
    outer = geometry.bore_radius + casing.thickness
    return of_trunnion | {"bushing": -casing.thickness - squeeze, "casing": outer + squeeze}


def expanded(
    geometry: Cylinder,
    *,
    trunnion: float,
    bushing: float,
    casing: Casing | None = None,
    key: str = "joint.clearance",
) -> Cylinder:
    """Return the dimensions at free thermal strains αΔT [1], for a bonded bushing with its casing.

    Raises ``InputError``, about ``key``, where there is no clearance left.
    """
    radius = geometry.radius * (1.0 + trunnion)
    bore = geometry.bore_radius * (1.0 + bushing) if casing is None else _bonded(geometry, bushing, casing)
    if not bore > radius:
        excess, needed = (1e6 * gap for gap in (radius - bore, geometry.clearance + radius - bore))
        raise InputError(
            f"the joint would seize: hot, the trunnion is {excess:.3g} um larger in radius than its bushing; "
            f"more than {needed:.3g} um are needed at assembly",
            key=key,
        )
    length = geometry.length * (1.0 + (bushing if casing is None else casing.strain))
    return replace(geometry, clearance=bore - radius, radius=radius, length=length)


def _bonded(geometry: Cylinder, strain: float, casing: Casing) -> float:
    """Return the bore of a bonded sleeve [m]."""
    outer = (geometry.bore_radius + casing.thickness) * (1.0 + casing.strain)
    squeezed = 2.0 * casing.poisson_ratio / (1.0 - casing.poisson_ratio) * (strain - casing.strain)
    return outer - casing.thickness * (1.0 + strain + squeezed)
