"""Contact laws of rough surfaces, and their tabulation."""

from __future__ import annotations

from dataclasses import fields
from typing import Any, Protocol

from tribodyn.contact.asperities import SEPARATIONS
from tribodyn.contact.base import ContactLaw
from tribodyn.contact.chang_etsion_bogy import ChangEtsionBogy
from tribodyn.contact.damping_factors import DAMPING_FACTORS
from tribodyn.contact.greenwood_tripp import GreenwoodTripp
from tribodyn.contact.greenwood_williamson import GreenwoodWilliamson
from tribodyn.contact.kogut_etsion import KogutEtsion
from tribodyn.contact.linear import Linear
from tribodyn.contact.rsdc import RSDC
from tribodyn.contact.surface_pair import SurfacePair
from tribodyn.contact.table import tabulate
from tribodyn.core.errors import InputError

LAWS: dict[str, type[ContactLaw]] = {
    kind.name: kind
    for kind in (
        KogutEtsion,
        RSDC,
        GreenwoodWilliamson,
        GreenwoodTripp,
        ChangEtsionBogy,
        Linear,
    )
}


class HasSurfacePair(Protocol):
    """Anything that knows its surfaces, such as a case."""

    @property
    def surface_pair(self) -> SurfacePair:
        """The surfaces in contact."""


def law(name: str, surfaces: SurfacePair | HasSurfacePair, **options: Any) -> ContactLaw:
    """Return the contact law called ``name`` for a pair of surfaces, or for those of a case.

    ``options`` are parameters of laws, such as ``penalty_stiffness`` of ``linear``. Those of laws other than
    the one asked for are passed over, so that a case can hand on all it has; so is a ``damping_factor``
    without a ``restitution`` for a law that has none of its own.
    """
    if name not in LAWS:
        raise InputError(f"no contact law {name!r}; there is {', '.join(LAWS)}", key="contact.law")
    pair = surfaces if isinstance(surfaces, SurfacePair) else surfaces.surface_pair
    own = _options_of(LAWS[name])
    unknown = options.keys() - set().union(*map(_options_of, LAWS.values()))
    if unknown:
        raise InputError(f"no contact law has the option {', '.join(sorted(unknown))}", key="contact")
    if options.get("restitution") is None and not LAWS[name].knows_restitution:
        own -= {"damping_factor"}
    return LAWS[name](pair, **{key: value for key, value in options.items() if key in own})


def _options_of(kind: type[ContactLaw]) -> set[str]:
    return {entry.name for entry in fields(kind)} - {"pair"}


__all__ = [
    "DAMPING_FACTORS",
    "LAWS",
    "RSDC",
    "SEPARATIONS",
    "ChangEtsionBogy",
    "ContactLaw",
    "GreenwoodTripp",
    "GreenwoodWilliamson",
    "KogutEtsion",
    "Linear",
    "SurfacePair",
    "law",
    "tabulate",
]
