"""Contact laws of rough surfaces, and their tabulation."""

from __future__ import annotations

from dataclasses import fields
from importlib import import_module
from typing import Any, Protocol, cast

from tribodyn.contact.asperities import SEPARATIONS
from tribodyn.contact.base import ContactLaw
from tribodyn.contact.damping_factors import DAMPING_FACTORS
from tribodyn.contact.kogut_etsion import KogutEtsion
from tribodyn.contact.liner import Liner, lined
from tribodyn.contact.rsdc import RSDC
from tribodyn.contact.surface_pair import SurfacePair
from tribodyn.contact.table import tabulate
from tribodyn.core.errors import InputError

_MEMBERS = (
    "kogut_etsion:KogutEtsion",
    "rsdc:RSDC",
    "greenwood_williamson:GreenwoodWilliamson",
    "greenwood_tripp:GreenwoodTripp",
    "chang_etsion_bogy:ChangEtsionBogy",
    "jackson_green:JacksonGreen",
    "linear:Linear",
)
"""Every law, one line each: its file and its class."""


def _member(line: str) -> type[ContactLaw]:
    module, _, name = line.partition(":")
    return cast("type[ContactLaw]", getattr(import_module(f"{__name__}.{module}"), name))


LAWS: dict[str, type[ContactLaw]] = {kind.name: kind for kind in map(_member, _MEMBERS)}
"""All contact laws by name."""


class HasSurfacePair(Protocol):
    """Anything that knows its surfaces, such as a case."""

    @property
    def surface_pair(self) -> SurfacePair:
        """The surfaces in contact."""


def law(name: str, surfaces: SurfacePair | HasSurfacePair, **options: Any) -> ContactLaw:
    """Return the contact law called ``name`` for a pair of surfaces, or for those of a case.

    ``options`` are parameters of laws, such as ``damping_factor`` and ``restitution``. Those that another law
    has and this one has not are passed over, so that a case can hand on all it has.
    """
    if name not in LAWS:
        raise InputError(f"no contact law {name!r}; there is {', '.join(LAWS)}", key="contact.law")
    pair = surfaces if isinstance(surfaces, SurfacePair) else surfaces.surface_pair
    own = _options_of(LAWS[name])
    unknown = options.keys() - set().union(*map(_options_of, LAWS.values()))
    if unknown:
        raise InputError(f"no contact law has the option {', '.join(sorted(unknown))}", key="contact")
    return LAWS[name](pair, **{key: value for key, value in options.items() if key in own})


def _options_of(kind: type[ContactLaw]) -> set[str]:
    return {entry.name for entry in fields(kind)} - {"pair"}


__all__ = [
    "DAMPING_FACTORS",
    "LAWS",
    "RSDC",
    "SEPARATIONS",
    "ContactLaw",
    "KogutEtsion",
    "Liner",
    "SurfacePair",
    "law",
    "lined",
    "tabulate",
]
