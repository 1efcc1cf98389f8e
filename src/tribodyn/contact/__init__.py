"""Contact laws of rough surfaces, and their tabulation."""

from __future__ import annotations

from collections.abc import Callable

from tribodyn.contact.base import ContactLaw
from tribodyn.contact.kogut_etsion import KogutEtsion
from tribodyn.contact.rsdc import RSDC
from tribodyn.contact.surface_pair import SurfacePair
from tribodyn.contact.table import tabulate
from tribodyn.core.errors import InputError

LAWS: dict[str, Callable[[SurfacePair], ContactLaw]] = {
    KogutEtsion.name: KogutEtsion,
    RSDC.name: RSDC,
}


def law(name: str, pair: SurfacePair) -> ContactLaw:
    """Return the contact law called ``name`` for a pair of surfaces."""
    if name not in LAWS:
        raise InputError(f"no contact law {name!r}; there is {', '.join(LAWS)}", key="contact.law")
    return LAWS[name](pair)


__all__ = ["LAWS", "RSDC", "ContactLaw", "KogutEtsion", "SurfacePair", "law", "tabulate"]
